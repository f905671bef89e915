// A fractal sum of which the part above a level is seen.
#pragma once

#include "math/fractal_sum.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Clouds : PatternColors, FractalSum {
  static constexpr std::string_view kKeyword = "clouds";
  static constexpr std::string_view kHelp = "clouds in a sky: a is the sky, b the clouds";

  Real cover = 0.5, softness = 0.5, time = 0;

  Clouds() {
    a = {0.25, 0.45, 0.85};
    b = Color(1);
  }

  static constexpr auto fields() {
    return Fields{PatternColors::fields(),
                  Field{"cover", &Clouds::cover, "", 0, 1, "how much of the sky they hide"},
                  Field{"softness", &Clouds::softness, "", 0, 1, "softness of their edges"},
                  Field{"time", &Clouds::time, "", -kNoLimit, kNoLimit, "time, which changes them"},
                  FractalSum::fields()};
  }
  bool operator==(const Clouds&) const = default;

  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, TextureSpace::point);
    const Real width = p.widest();
    const Real value = time == 0 ? FractalSum::at<3>(p.point(), width)
                                 : FractalSum::at<4>({p.at.x, p.at.y, p.at.z, time}, width);
    constexpr Real kSpread = 0.5;  // nearly all of a fractal sum is within it
    const Real height = (sum == SumKind::fractal ? value : 2 * value - 1) + (2 * cover - 1) * kSpread;
    const Real soft = softness * kSpread;
    return soft > 0 ? smoothStep(0.5 + height / (2 * soft)) : height > 0;
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
