// Rings around z, bent by noise, with fibres along z (Peachey, Solid Texturing of Complex Surfaces, SIGGRAPH
// 1985).
#pragma once

#include "math/fractal_sum.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Wood : PatternColors, FractalSum {
  static constexpr std::string_view kKeyword = "wood";
  static constexpr std::string_view kHelp = "the rings of a tree that grows along z, with fibres";

  Real frequency = 8, turbulence = 0.4, fibres = 0.15;
  WaveForm wave = WaveForm::saw;

  Wood() {
    a = {0.72, 0.47, 0.24};
    b = {0.34, 0.17, 0.07};
    octaves = 2;
  }

  static constexpr auto fields() {
    return Fields{
        PatternColors::fields(),
        Field{"frequency", &Wood::frequency, "", -kNoLimit, kNoLimit, "rings in a step from the axis"},
        Field{"turbulence", &Wood::turbulence, "", -kNoLimit, kNoLimit, "how far they are bent, in rings"},
        Field{"fibres", &Wood::fibres, "", 0, 1, "how strong they are"},
        Field{"wave", &Wood::wave, "", -kNoLimit, kNoLimit,
              "transition of a ring from a to b; saw: slowly, and back at once"},
        FractalSum::fields()};
  }
  bool operator==(const Wood&) const = default;

  Real pattern(const TexturePlace& place) const {
    constexpr Real kFibresPerRing = 6, kSlender = 1.0 / 24;
    const Vec3& p = place.point;
    const Vec3 width = abs(place.pointX) + abs(place.pointY);
    const Real radius = std::sqrt(p.x * p.x + p.y * p.y);
    const Real bent = turbulence == 0 ? 0 : FractalSum::at<3>({p.x, p.y, p.z}, maxComponent(width));
    const Real ring = trace::wave(wave, radius * frequency + turbulence * bent);
    Real fibre = 0;
    if (fibres > 0) {
      const Real fine = frequency * kFibresPerRing;
      FractalSum single = *this;
      single.sum = SumKind::fractal;
      single.octaves = 1;
      fibre = single.at<3>({p.x * fine, p.y * fine, p.z * fine * kSlender},
                           max(max(width.x, width.y), width.z * kSlender) * std::abs(fine));
    }
    // A saw stays light at first, as the wood of spring does.
    return (wave == WaveForm::saw ? ring * ring : ring) + fibres * fibre;
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
