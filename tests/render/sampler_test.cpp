// Numbers of samples: where they lie, and that what one ray draws does not move what another gets.
#include "render/sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace trace {
namespace {

TEST(Sampler, GridLiesAtTheCellsOfThePixel) {
  const SampleRules rules({.spp = 4}, {10, 5});
  ASSERT_EQ(rules.samples(), 4);
  EXPECT_EQ(Sampler(rules, 0, 4, 0).film(), (Vec2{0, 0}));  // the lower left corner
  EXPECT_EQ(Sampler(rules, 3, 4, 1).film(), (Vec2{0.35, 0}));
  EXPECT_EQ(Sampler(rules, 3, 4, 2).film(), (Vec2{0.3, 0.1}));
  Settings border{.spp = 4};
  border.pixelPosition = PixelPosition::border;
  EXPECT_EQ(Sampler(SampleRules(border, {10, 5}), 9, 0, 3).film(), (Vec2{1, 1}));
}

TEST(Sampler, NumbersAreFunctionsOfWhereTheyAreDrawn) {
  for (std::size_t g = 0; g < generators().size(); ++g) {
    const SampleRules rules({.spp = 16}, {100, 100});
    std::set<Real> seen;
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 4; ++y)
        for (int k = 0; k < 4; ++k) {
          Sampler one(rules, x, y, k), again(rules, x, y, k);
          for (int dimension = 0; dimension < 4; ++dimension) {
            const Real number = one.next();
            EXPECT_GE(number, 0);
            EXPECT_LT(number, 1);
            EXPECT_EQ(number, again.next());
            seen.insert(number);
          }
        }
    EXPECT_EQ(seen.size(), 4u * 4 * 4 * 4) << generators()[g].name;
  }
}

TEST(Sampler, ABranchIsMovedByNothing) {
  const SampleRules rules({}, {100, 100});
  Sampler parent(rules, 5, 6, 0);
  Sampler before = parent.branch(2);
  parent.next();
  Sampler first = parent.branch(0);
  first.next2();
  Sampler after = parent.branch(2);
  const Vec2 expected = before.next2();
  EXPECT_EQ(after.next2(), expected);
  EXPECT_NE(parent.branch(1).next2(), expected);
  EXPECT_NE(parent.branch(2).branch(2).next2(), expected);
}

TEST(Sampler, NumbersAreSpreadEvenly) {  // chi-square of 64 cells of pairs
  const SampleRules rules({}, {256, 256});
  std::array<int, 64> counts{};
  constexpr int kPairs = 256 * 256;
  for (int i = 0; i < kPairs; ++i) {
    const Vec2 u = Sampler(rules, i % 256, i / 256, 0).branch(3).next2();
    ++counts[static_cast<std::size_t>(u.x * 8) * 8 + static_cast<std::size_t>(u.y * 8)];
  }
  double chiSquare = 0;
  for (const int count : counts)
    chiSquare += (count - kPairs / 64.0) * (count - kPairs / 64.0) / (kPairs / 64.0);
  EXPECT_LT(chiSquare, 125);  // of 63 degrees of freedom one in 200,000 is more
}

}  // namespace
}  // namespace trace
