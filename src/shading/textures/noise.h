// Gradient noise in 1 to 4 dimensions and the sums of it.
#pragma once

#include "math/fractal_sum.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Noise : PatternColors, FractalSum {
  static constexpr std::string_view kKeyword = "noise";
  static constexpr std::string_view kHelp =
      "gradient noise (Perlin), and fractal sums, turbulence and ridges of it";

  int dimensions = 3;
  Real time = 0;
  Vec3 period;
  TextureSpace space = TextureSpace::point;

  Noise() { octaves = 1; }

  static constexpr auto fields() {
    return Fields{PatternColors::fields(),
                  FractalSum::fields(),

                  Field{"dimensions", &Noise::dimensions, "", 1, 4,
                        "1: changes along x; 2: x and y; 3; 4: with time too"},
                  Field{"time", &Noise::time, "", -kNoLimit, kNoLimit, "the fourth coordinate"},
                  Field{"period", &Noise::period, "", 0, 1e9,
                        "period in whole steps along x, y and z; 0: none. lacunarity must be whole"},
                  Field{"space", &Noise::space, "", -kNoLimit, kNoLimit, "solid, or in u and v"}};
  }
  bool operator==(const Noise&) const = default;

  /// -1 to 1 becomes 0 to 1.
  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, space);
    const Real value = sumAt(p);
    return sum == SumKind::fractal ? 0.5 + 0.5 * value : value;
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }

 private:
  Real sumAt(const PatternPlace& p) const {
    std::int64_t repeats[4] = {};
    for (int axis = 0; axis < 3; ++axis)
      if (period[axis] >= 1) repeats[axis] = static_cast<std::int64_t>(min(period[axis], 1e9));
    const std::int64_t* of = repeats[0] || repeats[1] || repeats[2] ? repeats : nullptr;
    const Real width = p.widest();
    if (dimensions <= 1) return FractalSum::at<1>({p.at.x}, width, of);
    if (dimensions == 2) return FractalSum::at<2>({p.at.x, p.at.y}, width, of);
    if (dimensions == 3) return FractalSum::at<3>(p.point(), width, of);
    return FractalSum::at<4>({p.at.x, p.at.y, p.at.z, time}, width, of);
  }
};

}  // namespace trace
