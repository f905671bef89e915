// Sums of gradient noise at rising frequencies (Ebert, Musgrave, Peachey, Perlin and Worley, Texturing and
// Modeling, 3rd ed., chapters 2 and 16).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/field.h"
#include "math/noise.h"

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
    return std::tuple{
        Field{"sum", &FractalSum::sum, "", -kNoLimit, kNoLimit,
              "of noise itself, of its magnitude, or with ridges where it is 0"},
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

template <int N>
Real FractalSum::at(std::array<Real, N> p, Real width, const std::int64_t* period) const {
  // Each octave is moved, so that the places where all noise is 0 lie neither on each other nor on the faces
  // of objects.
  constexpr Real kMoved[]{0.3183, 0.5707, 0.7321, 0.4142};
  constexpr Real kFadeFrom = 0.25, kFadeTo = 0.5;  // of a wave in a pixel
  for (int axis = 0; axis < N; ++axis) p[axis] += kMoved[axis];
  std::int64_t repeats[N] = {};
  if (period) std::copy(period, period + N, repeats);
  const int count = std::clamp(octaves, 1, kMostOctaves);
  Real total = 0, weight = 1, squares = 0, weights = 0, ridge = 1;
  for (int i = 0; i < count; ++i) {
    const Real shown = width <= kFadeFrom ? 1
                       : width >= kFadeTo ? 0
                                          : (kFadeTo - width) / (kFadeTo - kFadeFrom);
    Real n = 0, magnitude = kMeanMagnitude[N];
    if (shown > 0) {
      n = gradientNoise<N>(
          p, mixBits32(static_cast<std::uint32_t>(seed) + 0x9e3779b9u * static_cast<std::uint32_t>(i)),
          period ? repeats : nullptr);
      magnitude += shown * (std::abs(n) - magnitude);
      n *= shown;
    }
    if (sum == SumKind::fractal) {
      total += weight * n;
    } else if (sum == SumKind::turbulence) {
      total += weight * 2 * magnitude;
    } else {  // Musgrave's ridged multifractal: a ridge is rough where the octave before is high
      const Real sharp = 1 - magnitude, signal = sharp * sharp * ridge;
      total += weight * signal;
      ridge = std::clamp(2 * signal, 0.0, 1.0);
    }
    squares += weight * weight, weights += weight;
    weight *= gain, width *= lacunarity;
    for (int axis = 0; axis < N; ++axis) {
      p[axis] = p[axis] * lacunarity + kMoved[axis];
      repeats[axis] = static_cast<std::int64_t>(static_cast<Real>(repeats[axis]) * lacunarity + 0.5);
    }
  }
  if (sum == SumKind::fractal) return squares > 0 ? total / std::sqrt(squares) : 0;
  return weights > 0 ? total / weights : 0;
}

}  // namespace trace
