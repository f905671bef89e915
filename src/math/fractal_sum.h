// Sums of gradient noise at rising frequencies (Ebert, Musgrave, Peachey, Perlin and Worley, Texturing and
// Modeling, 3rd ed., chapters 2 and 16).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/field.h"
#include "math/vec.h"

namespace trace {

/// How the octaves are added up.
enum class SumKind { fractal, turbulence, ridged };
constexpr std::array<std::string_view, 3> names(SumKind) { return {"fractal", "turbulence", "ridged"}; }

struct FractalSum {
  SumKind sum = SumKind::fractal;
  int octaves = 6;
  Real lacunarity = 2, gain = 0.5;
  int seed = 0;

  static constexpr int kMostOctaves = 16;
  static constexpr auto fields() {
    return Fields{
        Field{"sum", &FractalSum::sum, "", -kNoLimit, kNoLimit,
              "sum of noise itself, of its magnitude, or with ridges where it is 0"},
        Field{"octaves", &FractalSum::octaves, "", 1, kMostOctaves, "how many are added, each finer"},
        Field{"lacunarity", &FractalSum::lacunarity, "", 1, 16, "how much finer each octave is"},
        Field{"gain", &FractalSum::gain, "", 0, 1, "how much weaker each octave is"},
        Field{"seed", &FractalSum::seed, "", -kNoLimit, kNoLimit, "chooses among patterns of the same kind"}};
  }
  bool operator==(const FractalSum&) const = default;

  /// At a place in N dimensions, 1 to 4. `width` is that of a pixel there: octaves that it cannot show give
  /// way to their mean, between 2 and 4 samples to a wave (Peachey, section 2.8). A fractal sum is spread
  /// about 0 as a single octave is, for gain up to 1; turbulence and ridges lie between 0 and about 1.
  template <int N>
  Real at(std::array<Real, N> p, Real width, const std::int64_t* period = nullptr) const;

  /// The mean of the magnitude of gradient noise, by dimensions.
  static constexpr std::array<Real, 5> kMeanMagnitude{0, 0.232, 0.249, 0.2185, 0.236};
};

}  // namespace trace
