// Points that fill a square evenly.
#include "math/low_discrepancy.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <set>

namespace trace {
namespace {

/// Points first .. first + 2^bits - 1 hold one in each box of 2^-a by 2^-(bits - a), for every a.
void expectNet(const std::function<Vec2(std::uint32_t)>& point, std::uint32_t first, int bits) {
  for (int a = 0; a <= bits; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (std::uint32_t i = 0; i < 1u << bits; ++i) {
      const Vec2 p = point(first + i);
      boxes.emplace(static_cast<int>(std::ldexp(p.x, a)), static_cast<int>(std::ldexp(p.y, bits - a)));
    }
    EXPECT_EQ(boxes.size(), 1u << bits) << a;
  }
}

TEST(LowDiscrepancy, SobolPointsAreANetUnderEveryScrambling) {
  EXPECT_EQ(sobolSecond(1), 0x80000000u);
  EXPECT_EQ(sobolSecond(2), 0xc0000000u);
  EXPECT_EQ(sobolSecond(3), 0x40000000u);
  for (const std::uint64_t seed : {1u, 2u, 77u})
    for (const std::uint32_t first : {0u, 64u, 4096u})
      expectNet([&](std::uint32_t i) { return sobolPoint(i, seed); }, first, 6);
}

TEST(LowDiscrepancy, FourCoordinatesFillTheirSpace) {
  for (const std::uint64_t seed : {1u, 2u, 77u})
    for (const std::uint32_t first : {0u, 256u, 4096u}) {
      std::array<int, 16> halves{};  // of each axis
      std::array<std::set<int>, 2> strata;
      for (std::uint32_t i = first; i < first + 256; ++i) {
        const Vec2 p = sobolPoint(i, seed), q = sobolPointBeside(i, seed);
        ++halves[static_cast<std::size_t>((p.x < 0.5) + 2 * (p.y < 0.5) + 4 * (q.x < 0.5) + 8 * (q.y < 0.5))];
        strata[0].insert(static_cast<int>(q.x * 256));
        strata[1].insert(static_cast<int>(q.y * 256));
      }
      for (const int count : halves) EXPECT_EQ(count, 16);
      for (const auto& each : strata) EXPECT_EQ(each.size(), 256u);
    }
}

TEST(LowDiscrepancy, ScramblingKeepsWhatLiesInABoxTogether) {
  for (std::uint32_t i = 0; i < 64; ++i)
    for (std::uint32_t j = 0; j < 64; ++j) {
      const std::uint32_t a = i << 26, b = j << 26;
      const auto common = [](std::uint32_t v, std::uint32_t w) { return v == w ? 32 : __builtin_clz(v ^ w); };
      EXPECT_EQ(common(owenScrambled(a, 5), owenScrambled(b, 5)), common(a, b));
    }
}

TEST(LowDiscrepancy, HaltonPointsFillTheirBoxes) {
  for (const std::uint64_t seed : {1u, 9u}) {
    for (const std::uint32_t first : {0u, 36u, 4320u, 2147483628u}) {
      std::set<std::pair<int, int>> boxes;  // 4 x 9
      for (std::uint32_t i = first; i < first + 36; ++i) {
        const Vec2 p = haltonPoint(i, seed);
        EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
        boxes.emplace(static_cast<int>(p.x * 4), static_cast<int>(p.y * 9));
      }
      EXPECT_EQ(boxes.size(), 36u) << first;
    }
  }
}

TEST(LowDiscrepancy, ShuffledDigitsKeepWhatLiesInABlockTogether) {
  const auto shuffled = [](std::uint64_t i) {
    return shuffledDigits<6>(
        i, 12, 5, [](std::uint32_t digit, std::uint64_t prefix) { return permutedOf<6>(digit, prefix); });
  };
  for (const std::uint64_t block : {6u, 36u, 216u})
    for (std::uint64_t first = 0; first < 3 * block; first += block) {
      std::set<std::uint64_t> seen, blocks;
      for (std::uint64_t i = first; i < first + block; ++i) {
        seen.insert(shuffled(i));
        blocks.insert(shuffled(i) / block);
      }
      EXPECT_EQ(seen.size(), block);
      EXPECT_EQ(blocks.size(), 1u);
    }
}

TEST(LowDiscrepancy, AllOrdersAreEquallyLikely) {
  constexpr int kSeeds = 24'000;
  std::map<std::array<std::uint32_t, 4>, int> counts;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    std::array<std::uint32_t, 4> order;
    for (std::uint32_t i = 0; i < 4; ++i) order[i] = permutedOf<4>(i, seed);
    ++counts[order];
  }
  ASSERT_EQ(counts.size(), 24u);
  double chiSquare = 0;
  for (const auto& [order, count] : counts) chiSquare += (count - 1000.0) * (count - 1000.0) / 1000;
  EXPECT_LT(chiSquare, 60);  // of 23 degrees of freedom one in 25,000 is more
}

TEST(LowDiscrepancy, PermutationsAreWhole) {
  for (const std::uint32_t count : {1u, 2u, 3u, 10u, 100u}) {
    std::set<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < count; ++i) seen.insert(permuted(i, count, 12345));
    EXPECT_EQ(seen.size(), count);
    EXPECT_EQ(*seen.rbegin(), count - 1);
  }
}

}  // namespace
}  // namespace trace
