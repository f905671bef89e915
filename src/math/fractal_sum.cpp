#include "math/fractal_sum.h"

#include <algorithm>
#include <cmath>

#include "math/noise.h"

namespace trace {

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
    squares += weight * weight;
    weights += weight;
    weight *= gain;
    width *= lacunarity;
    for (int axis = 0; axis < N; ++axis) p[axis] = p[axis] * lacunarity + kMoved[axis];
    if (period)
      for (std::int64_t& steps : repeats)
        steps = static_cast<std::int64_t>(static_cast<Real>(steps) * lacunarity + 0.5);
  }
  if (sum == SumKind::fractal) return squares > 0 ? total / std::sqrt(squares) : 0;
  return weights > 0 ? total / weights : 0;
}

template Real FractalSum::at<1>(std::array<Real, 1>, Real, const std::int64_t*) const;
template Real FractalSum::at<2>(std::array<Real, 2>, Real, const std::int64_t*) const;
template Real FractalSum::at<3>(std::array<Real, 3>, Real, const std::int64_t*) const;
template Real FractalSum::at<4>(std::array<Real, 4>, Real, const std::int64_t*) const;

}  // namespace trace
