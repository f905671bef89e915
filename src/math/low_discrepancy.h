// Points that fill a square more evenly than chance does, each a function of its number and a seed.
#pragma once

#include <cstdint>

#include "math/noise.h"
#include "math/vec.h"

namespace trace {

constexpr std::uint32_t reversedBits(std::uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

/// Owen's nested scrambling of base 2, of reversed bits: each is flipped, or not, by a hash of those below
/// it. Laine and Karras 2011 with the constants of Vegdahl 2021: every step carries only upward.
constexpr std::uint32_t owenScrambledReversed(std::uint32_t v, std::uint64_t seed) {
  const auto s = static_cast<std::uint32_t>(mixBits(seed));
  v ^= v * 0x3d20adeau;
  v += s;
  v *= (s >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}
/// The same: each bit is flipped, or not, by a hash of those above it.
constexpr std::uint32_t owenScrambled(std::uint32_t v, std::uint64_t seed) {
  return reversedBits(owenScrambledReversed(reversedBits(v), seed));
}

/// The first two dimensions of Sobol's sequence (1967): of any 2^(a+b) points that begin at a multiple, one
/// lies in each box of 2^-a by 2^-b.
constexpr std::uint32_t sobolSecondReversed(std::uint32_t i) {
  // Bit j is the sum modulo 2 of the bits k of i for which the binomial coefficient of k and j is odd, and so
  // of those k that have all bits of j (Lucas 1878).
  i ^= (i >> 1) & 0x55555555u;
  i ^= (i >> 2) & 0x33333333u;
  i ^= (i >> 4) & 0x0f0f0f0fu;
  i ^= (i >> 8) & 0x00ff00ffu;
  return i ^ (i >> 16);
}
constexpr std::uint32_t sobolSecond(std::uint32_t i) { return reversedBits(sobolSecondReversed(i)); }

constexpr Vec2 sobolPoint(std::uint32_t i) { return {reversedBits(i) * 0x1p-32, sobolSecond(i) * 0x1p-32}; }

/// The point moved by another, around the edges (Cranley and Patterson 1976).
constexpr Vec2 rotated(const Vec2& p, const Vec2& by) {
  const auto turned = [](Real a, Real b) { return a + b < 1 ? a + b : a + b - 1; };
  return {turned(p.x, by.x), turned(p.y, by.y)};
}

/// Where the order of the seed's own puts point i.
constexpr std::uint32_t sobolOrder(std::uint32_t i, std::uint64_t seed) {
  return owenScrambled(i, mixBits(seed ^ 1));
}
/// The point that comes there, with scrambling of the seed's own.
constexpr Vec2 sobolPointInOrder(std::uint32_t k, std::uint64_t seed) {
  return {reversedBits(owenScrambledReversed(k, mixBits(seed ^ 2))) * 0x1p-32,
          reversedBits(owenScrambledReversed(sobolSecondReversed(k), mixBits(seed ^ 3))) * 0x1p-32};
}
/// Point i of that sequence, in an order and with scrambling of the seed's own (Burley, Practical Hash-based
/// Owen Scrambling, 2020).
constexpr Vec2 sobolPoint(std::uint32_t i, std::uint64_t seed) {
  return sobolPointInOrder(sobolOrder(i, seed), seed);
}

/// The bits of Sobol's third and fourth dimension for each byte of a point's number, bits reversed: with
/// primitive polynomials and first numbers by Joe and Kuo (2008).
struct SobolBytes {
  std::uint32_t of[2][4][256];
};
constexpr SobolBytes sobolBytes() {
  // x^2 + x + 1 with 1, 3; x^3 + x + 1 with 1, 3, 1.
  std::uint32_t direction[2][32] = {{1u << 31, 3u << 30}, {1u << 31, 3u << 30, 1u << 29}};
  for (int i = 2; i < 32; ++i) {
    std::uint32_t* v = direction[0];
    v[i] = v[i - 2] ^ (v[i - 2] >> 2) ^ v[i - 1];
  }
  for (int i = 3; i < 32; ++i) {
    std::uint32_t* v = direction[1];
    v[i] = v[i - 3] ^ (v[i - 3] >> 3) ^ v[i - 2];
  }
  SobolBytes bytes{};
  for (int dimension = 0; dimension < 2; ++dimension)
    for (int byte = 0; byte < 4; ++byte)
      for (std::uint32_t value = 0; value < 256; ++value)
        for (int bit = 0; bit < 8; ++bit)
          if (value >> bit & 1)
            bytes.of[dimension][byte][value] ^= reversedBits(direction[dimension][8 * byte + bit]);
  return bytes;
}
inline constexpr SobolBytes kSobolBytes = sobolBytes();

/// Its third and fourth coordinate, scrambled likewise.
constexpr Vec2 sobolPointBesideInOrder(std::uint32_t k, std::uint64_t seed) {
  const auto coordinate = [&](int dimension) {
    const auto& bytes = kSobolBytes.of[dimension];
    const std::uint32_t reversed =
        bytes[0][k & 255] ^ bytes[1][k >> 8 & 255] ^ bytes[2][k >> 16 & 255] ^ bytes[3][k >> 24];
    const std::uint64_t own = mixBits(seed ^ static_cast<std::uint64_t>(4 + dimension));
    return reversedBits(owenScrambledReversed(reversed, own)) * 0x1p-32;
  };
  return {coordinate(0), coordinate(1)};
}
/// The third and fourth coordinate of the same point i.
constexpr Vec2 sobolPointBeside(std::uint32_t i, std::uint64_t seed) {
  return sobolPointBesideInOrder(sobolOrder(i, seed), seed);
}

/// i written in base 2 and mirrored at the point (van der Corput 1935): 1, 2, 3 ... lie evenly together.
constexpr Real vanDerCorput(std::uint32_t i) { return reversedBits(i) * 0x1p-32; }

/// i written in `base` and mirrored at the point (van der Corput 1935), with digits permuted by the seed.
inline Real radicalInverse(std::uint32_t i, std::uint32_t base, std::uint64_t seed) {
  Real value = 0, place = 1;
  std::uint64_t prefix = mixBits(seed);
  // Until digits no longer count. Each digit is turned by a hash of those before it (Owen 1995, by
  // rotations).
  for (int digit = 0; place > 0x1p-40; ++digit) {
    const std::uint32_t own = i % base;
    i /= base;
    place /= base;
    value += static_cast<Real>((own + prefix % base) % base) * place;
    prefix = mixBits(prefix ^ (own + 1));
  }
  return value < 1 ? value : 1 - 0x1p-53;
}

/// i, less than kBase^digits, with its digits in that base permuted, each by a hash of those above it and of
/// the seed: the first kBase^n numbers stay together, in an order of the seed's own. `permute(digit, prefix)`
/// permutes 0, 1, ... kBase - 1.
template <std::uint32_t kBase, class Permute>
constexpr std::uint64_t shuffledDigits(std::uint64_t i, int digits, std::uint64_t seed,
                                       const Permute& permute) {
  std::uint64_t place = 1, shuffled = 0, prefix = seed;
  for (int digit = 1; digit < digits; ++digit) place *= kBase;
  for (; place > 0; place /= kBase) {
    const auto own = static_cast<std::uint32_t>(i / place % kBase);
    shuffled = shuffled * kBase + permute(own, prefix);
    prefix = mixBits(prefix ^ (own + 1));
  }
  return shuffled;
}

/// Where i goes in a random order of 0, 1, ... kCount - 1, all orders equally likely (Fisher and Yates 1938).
template <std::uint32_t kCount>
constexpr std::uint32_t permutedOf(std::uint32_t i, std::uint64_t seed) {
  std::uint32_t order[kCount] = {};
  std::uint64_t chance = mixBits(seed);
  for (std::uint32_t n = 0; n < kCount; ++n) {
    const auto other = static_cast<std::uint32_t>(chance % (n + 1));
    chance /= n + 1;
    order[n] = order[other];
    order[other] = n;
  }
  return order[i];
}

/// Point i of Halton's sequence (1960) in bases 2 and 3, in an order and with scrambling of the seed's own:
/// points of different seeds have nothing to do with each other. Of 2^n 3^n points that begin at a multiple
/// one lies in each box of 2^-n by 3^-n.
inline Vec2 haltonPoint(std::uint32_t i, std::uint64_t seed) {
  // Digits of base 6 are those of bases 2 and 3 together. Without an order of its own, two seeds would have
  // both their points in one half of their squares, or never, and their product a wrong mean.
  constexpr int kDigits = 12;  // 6^12 numbers: more than samples are counted
  const auto k = static_cast<std::uint32_t>(shuffledDigits<6>(
      i, kDigits, mixBits(seed ^ 3),
      [](std::uint32_t digit, std::uint64_t prefix) { return permutedOf<6>(digit, prefix); }));
  return {radicalInverse(k, 2, mixBits(seed ^ 1)), radicalInverse(k, 3, mixBits(seed ^ 2))};
}

/// Where i goes in a random order of 0, 1, ... count - 1 (Kensler, Correlated Multi-Jittered Sampling, 2013,
/// section 3).
constexpr std::uint32_t permuted(std::uint32_t i, std::uint32_t count, std::uint64_t seed) {
  const auto p = static_cast<std::uint32_t>(mixBits(seed));
  std::uint32_t w = count - 1;
  w |= w >> 1;
  w |= w >> 2;
  w |= w >> 4;
  w |= w >> 8;
  w |= w >> 16;
  do {
    i ^= p;
    i *= 0xe170893du;
    i ^= p >> 16;
    i ^= (i & w) >> 4;
    i ^= p >> 8;
    i *= 0x0929eb3fu;
    i ^= p >> 23;
    i ^= (i & w) >> 1;
    i *= 1 | p >> 27;
    i *= 0x6935fa69u;
    i ^= (i & w) >> 11;
    i *= 0x74dcb303u;
    i ^= (i & w) >> 2;
    i *= 0x9e501cc3u;
    i ^= (i & w) >> 2;
    i *= 0xc860a3dfu;
    i &= w;
    i ^= i >> 5;
  } while (i >= count);
  return (i + p) % count;
}

}  // namespace trace
