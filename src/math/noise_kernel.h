// Gradient noise where it is computed: for the files that compile it into their loops.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "math/noise.h"

namespace trace::noise_kernel {

/// The slopes of lattice points: in 3 and 4 dimensions toward the edges of the cube, as Perlin has them, in 2
/// the corners and sides of a square, all equally long; in 1 from -2 to 2.
template <int N>
constexpr auto slopes() {
  constexpr int kCount = N == 1 ? 16 : N == 2 ? 8 : N == 3 ? 16 : 32;
  std::array<std::array<Real, N>, kCount> all{};
  if constexpr (N == 1) {
    for (int i = 0; i < kCount; ++i) all[i][0] = (i < 8 ? i - 8 : i - 7) / 4.0;
  } else if constexpr (N == 2) {
    constexpr Real kSide = 1.41421356237309504880;
    for (int i = 0; i < 4; ++i) {
      all[i] = {i & 1 ? -1.0 : 1.0, i & 2 ? -1.0 : 1.0};
      all[4 + i][i / 2] = i & 1 ? -kSide : kSide;
    }
  } else {
    constexpr int kEach = 1 << (N - 1);  // edges along one axis; Perlin repeats four of 3 dimensions
    for (int i = 0; i < kCount; ++i) {
      const int along = i / kEach < N ? i / kEach : 0;
      for (int axis = 0, bit = 0; axis < N; ++axis)
        if (axis != along) all[i][axis] = (i % kEach) >> bit++ & 1 ? -1 : 1;
    }
  }
  return all;
}
template <int N>
inline constexpr auto kSlopes = slopes<N>();

/// The two corners of an edge along x, which are computed together.
typedef Real Pair __attribute__((vector_size(2 * sizeof(Real))));

/// gradientNoise() (math/noise.h); `period` is looked at only if it is kPeriodic.
template <int N, bool kPeriodic>
inline Real at(const std::array<Real, N>& p, std::uint32_t seed, const std::int64_t* period) {
  Real rest[N], fade[N];
  std::uint32_t bits[N][2];
  for (int axis = 0; axis < N; ++axis) {
    const Lattice at(p[axis]);
    const Real t = rest[axis] = at.rest;
    fade[axis] = t * t * t * (t * (t * 6 - 15) + 10);
    std::int64_t low = at.whole, high = low + 1;
    if (kPeriodic && period[axis] > 0) {
      low %= period[axis];
      if (low < 0) low += period[axis];
      high = low + 1 == period[axis] ? 0 : low + 1;
    }
    bits[axis][0] = axisBits(low, axis);
    bits[axis][1] = axisBits(high, axis);
  }
  constexpr auto& kSlopes = noise_kernel::kSlopes<N>;
  constexpr int kEdges = 1 << (N - 1), kDrop = 32 - std::countr_zero(kSlopes.size());
  const std::uint32_t x[2]{mixBits32(bits[0][0]), mixBits32(bits[0][1])};
  const Pair restX{rest[0], rest[0] - 1};
  Pair v[kEdges];
  for (int edge = 0; edge < kEdges; ++edge) {
    std::uint32_t row = seed;
    for (int axis = 1; axis < N; ++axis) row += bits[axis][edge >> (axis - 1) & 1];
    row = mixBits32(row);
    const auto &low = kSlopes[((row ^ x[0]) * 0x7feb352du) >> kDrop],
               &high = kSlopes[((row ^ x[1]) * 0x7feb352du) >> kDrop];
    v[edge] = Pair{low[0], high[0]} * restX;
    for (int axis = 1; axis < N; ++axis)
      v[edge] += Pair{low[axis], high[axis]} * (rest[axis] - (edge >> (axis - 1) & 1));
  }
  for (int axis = N - 1; axis > 0; --axis)
    for (int i = 0; i < 1 << (axis - 1); ++i) v[i] += fade[axis] * (v[i + (1 << (axis - 1))] - v[i]);
  return v[0][0] + fade[0] * (v[0][1] - v[0][0]);
}

}  // namespace trace::noise_kernel
