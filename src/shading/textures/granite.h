// Grains of several sizes: turbulence without layers.
#pragma once

#include "math/fractal_sum.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Granite : PatternColors, FractalSum {
  static constexpr std::string_view kKeyword = "granite";
  static constexpr std::string_view kHelp = "fine grains of stone, light and dark";

  Real frequency = 4, contrast = 2;

  Granite() {
    a = {0.17, 0.15, 0.16};
    b = {0.89, 0.82, 0.79};
    sum = SumKind::turbulence;
    gain = 0.7;
  }

  static constexpr auto fields() {
    return Fields{PatternColors::fields(),

                  Field{"frequency", &Granite::frequency, "", -kNoLimit, kNoLimit, "grains in a step"},
                  Field{"contrast", &Granite::contrast, "", 0, kNoLimit, "contrast between light and dark"},
                  FractalSum::fields()};
  }
  bool operator==(const Granite&) const = default;

  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, TextureSpace::point);
    const Real value = FractalSum::at<3>({p.at.x * frequency, p.at.y * frequency, p.at.z * frequency},
                                         p.widest() * std::abs(frequency));
    const Real mean = sum == SumKind::fractal ? 0 : 0.437;  // mean of turbulence in 3 dimensions
    return 0.5 + contrast * (value - mean);
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
