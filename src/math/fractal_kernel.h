// Sums of octaves of noise where they are computed: for the files that compile them into their loops. Each
// names the function that computes an octave.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "math/fractal_sum.h"
#include "math/noise.h"

namespace trace::fractal_kernel {

/// FractalSum::at(), for one kind of sum. `noise(p, seed, period)` is an octave; `period` counts only if it
/// is kPeriodic.
template <SumKind kSum, bool kPeriodic, int N, class Noise>
Real summed(const FractalSum& f, std::array<Real, N> p, Real width, const std::int64_t* period,
            const Noise& noise) {
  // Each octave is moved, so that the places where all noise is 0 lie neither on each other nor on the faces
  // of objects.
  constexpr Real kMoved[]{0.3183, 0.5707, 0.7321, 0.4142};
  constexpr Real kFadeFrom = 0.25, kFadeTo = 0.5;  // fade from and fade to of a wave in a pixel
  for (int axis = 0; axis < N; ++axis) p[axis] += kMoved[axis];
  std::int64_t repeats[N] = {};
  if (kPeriodic) std::copy(period, period + N, repeats);
  const int count = std::clamp(f.octaves, 1, FractalSum::kMostOctaves);
  const Real lacunarity = f.lacunarity, gain = f.gain;
  Real total = 0, weight = 1, squares = 0, weights = 0, ridge = 1;
  for (int i = 0; i < count; ++i) {
    const Real shown = width <= kFadeFrom ? 1
                       : width >= kFadeTo ? 0
                                          : (kFadeTo - width) / (kFadeTo - kFadeFrom);
    Real n = 0, magnitude = FractalSum::kMeanMagnitude[N];
    if (shown > 0) {
      n = noise(p,
                mixBits32(static_cast<std::uint32_t>(f.seed) + 0x9e3779b9u * static_cast<std::uint32_t>(i)),
                repeats);
      magnitude += shown * (std::abs(n) - magnitude);
      n *= shown;
    }
    if constexpr (kSum == SumKind::fractal) {
      total += weight * n;
      squares += weight * weight;
    } else if constexpr (kSum == SumKind::turbulence) {
      total += weight * 2 * magnitude;
      weights += weight;
    } else {  // Musgrave's ridged multifractal: a ridge is rough where the octave before is high
      const Real sharp = 1 - magnitude, signal = sharp * sharp * ridge;
      total += weight * signal;
      ridge = std::clamp(2 * signal, 0.0, 1.0);
      weights += weight;
    }
    weight *= gain;
    width *= lacunarity;
    for (int axis = 0; axis < N; ++axis) p[axis] = p[axis] * lacunarity + kMoved[axis];
    if constexpr (kPeriodic)
      for (std::int64_t& steps : repeats)
        steps = static_cast<std::int64_t>(static_cast<Real>(steps) * lacunarity + 0.5);
  }
  if constexpr (kSum == SumKind::fractal) return squares > 0 ? total / std::sqrt(squares) : 0;
  return weights > 0 ? total / weights : 0;
}

template <bool kPeriodic, int N, class Noise>
Real summedBy(const FractalSum& f, const std::array<Real, N>& p, Real width, const std::int64_t* period,
              const Noise& noise) {
  switch (f.sum) {
    case SumKind::fractal: return summed<SumKind::fractal, kPeriodic, N>(f, p, width, period, noise);
    case SumKind::turbulence: return summed<SumKind::turbulence, kPeriodic, N>(f, p, width, period, noise);
    case SumKind::ridged: break;
  }
  return summed<SumKind::ridged, kPeriodic, N>(f, p, width, period, noise);
}

}  // namespace trace::fractal_kernel
