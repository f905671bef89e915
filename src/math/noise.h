// Gradient noise (Perlin, Improving Noise, 2002), seeded: a function of its arguments only, made of whole
// numbers and + - *, so that it has the same bits everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/vec.h"

namespace trace {

/// Bits that look random (the finaliser of SplitMix64: Steele, Lea and Flood, 2014).
constexpr std::uint64_t mixBits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

/// From 0 up to 1, from the upper bits.
constexpr Real unitFromBits(std::uint64_t bits) { return static_cast<Real>(bits >> 11) * 0x1p-53; }

/// Smooth, 0 where x and y are whole, between about -1 and 1.
inline Real noise(Real x, Real y, std::uint64_t seed) {
  const Real x0 = std::floor(x), y0 = std::floor(y), u = x - x0, v = y - y0;
  const auto corner = [&](int i, int j) {
    const auto column = static_cast<std::uint64_t>(static_cast<std::int64_t>(x0) + i);
    const auto row = static_cast<std::uint64_t>(static_cast<std::int64_t>(y0) + j);
    const std::uint64_t bits = mixBits(mixBits(mixBits(seed) ^ column) ^ row);
    const Real a = 2 * unitFromBits(bits) - 1, b = 2 * unitFromBits(mixBits(bits)) - 1;
    return a * (u - i) + b * (v - j);
  };
  const auto fade = [](Real t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const Real s = fade(u), low = corner(0, 0) + s * (corner(1, 0) - corner(0, 0));
  const Real high = corner(0, 1) + s * (corner(1, 1) - corner(0, 1));
  return low + fade(v) * (high - low);
}

/// The whole part of x, downward, and the rest. From 2^52 on every number is whole.
struct Lattice {
  std::int64_t whole = 0;
  Real rest = 0;
  explicit Lattice(Real x) {
    if (!(std::abs(x) < 0x1p52)) return;
    whole = static_cast<std::int64_t>(x);
    whole -= x < static_cast<Real>(whole);
    rest = x - static_cast<Real>(whole);
  }
};

/// The bits that a lattice point adds to those of its cell, along an axis.
constexpr std::uint32_t axisBits(std::int64_t i, int axis) {
  constexpr std::uint32_t kOdd[]{0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du, 0x27d4eb2fu};
  return static_cast<std::uint32_t>(i) * kOdd[axis];
}

/// Bits that look random (the 32 bit mixer "lowbias32" of Wellons' Hash Prospector, 2018).
constexpr std::uint32_t mixBits32(std::uint32_t v) {
  v = (v ^ (v >> 16)) * 0x7feb352du;
  v = (v ^ (v >> 15)) * 0x846ca68bu;
  return v ^ (v >> 16);
}

/// Gradient noise in N dimensions, 1 to 4: smooth, 0 where all coordinates are whole, between about -1 and 1,
/// with mean 0. `period`, if given, is after how many whole steps it repeats along each axis; 0 for never.
template <int N>
Real gradientNoise(const std::array<Real, N>& p, std::uint32_t seed, const std::int64_t* period = nullptr);

}  // namespace trace
