// Numbers of samples: where they lie, and that what one ray draws does not move what another gets.
#include "render/sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace trace::sampler_test {
namespace {

Settings with(const GeneratorRow& row, int spp) {
  Settings settings{.spp = spp};
  settings.sampling = row.kind;
  return settings;
}

TEST(Sampler, GridLiesAtTheCellsOfThePixel) {
  const SampleRules rules({.spp = 4}, {10, 5});
  ASSERT_EQ(rules.samples(), 4);
  EXPECT_EQ(Sampler(rules, 0, 4, 0).film().place, (Vec2{0, 0}));  // the lower left corner
  EXPECT_EQ(Sampler(rules, 3, 4, 1).film().place, (Vec2{0.35, 0}));
  EXPECT_EQ(Sampler(rules, 3, 4, 2).film().place, (Vec2{0.3, 0.1}));
  Settings border{.spp = 4};
  border.pixelPosition = PixelPosition::border;
  EXPECT_EQ(Sampler(SampleRules(border, {10, 5}), 9, 0, 3).film().place, (Vec2{1, 1}));
}

TEST(Sampler, TheTableIsInTheOrderOfItsKinds) {
  for (std::size_t g = 0; g < generators().size(); ++g) {
    EXPECT_EQ(static_cast<std::size_t>(generators()[g].kind), g);
    EXPECT_EQ(samplesOf(with(generators()[g], 5)), generators()[g].square ? 9 : 5);
  }
}

TEST(Sampler, SamplesLieInTheirPixel) {
  for (const GeneratorRow& row : generators()) {
    const SampleRules rules(with(row, 16), {10, 5});
    Real x = 0, y = 0;
    for (int k = 0; k < 16; ++k) {
      const FilmSample sample = Sampler(rules, 3, 1, k).film();
      EXPECT_EQ(sample.weight, 1);
      EXPECT_GE(sample.place.x, 0.3) << row.name;
      EXPECT_LT(sample.place.x, 0.4) << row.name;
      EXPECT_GE(sample.place.y, 0.6) << row.name;
      EXPECT_LT(sample.place.y, 0.8) << row.name;
      x += sample.place.x / 16, y += sample.place.y / 16;
    }
    if (row.kind == SampleKind::random || row.kind == SampleKind::grid) continue;
    EXPECT_NEAR(x, 0.35, 0.01) << row.name;
    EXPECT_NEAR(y, 0.7, 0.02) << row.name;
  }
}

TEST(Sampler, NumbersAreFunctionsOfWhereTheyAreDrawn) {
  for (const GeneratorRow& row : generators()) {
    const SampleRules rules(with(row, 16), {100, 100});
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
    EXPECT_EQ(seen.size(), 4u * 4 * 4 * 4) << row.name;
    Settings other = with(row, 16);
    other.seed = 1;
    EXPECT_NE(Sampler(SampleRules(other, {100, 100}), 0, 0, 0).next(), Sampler(rules, 0, 0, 0).next())
        << row.name;
  }
}

// What a pixel's samples estimate: the area of a quarter disk, over many pixels. Chance has a variance of
// 0.1685 / n.
TEST(Sampler, ASingleNumberIsTheFirstOfTwo) {
  for (const GeneratorRow& row : generators()) {
    const SampleRules rules(with(row, 16), {10, 5});
    for (int k = 0; k < rules.samples(); ++k) {
      Sampler one = Sampler(rules, 3, 1, k).branch(7), two = one;
      for (int i = 0; i < 3; ++i) EXPECT_EQ(one.next(), two.next2().x) << row.name;
    }
  }
}

/// The mean and the mean square of the error of a share that is estimated in each of many pixels.
template <class IsInside>
std::pair<Real, Real> errorsOf(const GeneratorRow& row, int samples, Real share, const IsInside& isInside) {
  constexpr int kPixels = 1000;
  const SampleRules rules(with(row, samples), {kPixels, 1});
  Real square = 0, mean = 0;
  for (int x = 0; x < kPixels; ++x) {
    Real inside = 0;
    for (int k = 0; k < samples; ++k) inside += isInside(Sampler(rules, x, 0, k).branch(5));
    const Real error = inside / samples - share;
    mean += error / kPixels, square += error * error / kPixels;
  }
  return {mean, square};
}

TEST(Sampler, EvenPairsEstimateBetterThanChance) {
  constexpr int kSamples = 16;
  constexpr Real kShare = kPi / 4, kByChance = kShare * (1 - kShare) / kSamples;
  for (const GeneratorRow& row : generators()) {
    const auto [mean, square] = errorsOf(row, kSamples, kShare, [](Sampler sampler) {
      const Vec2 u = sampler.next2();
      return u.x * u.x + u.y * u.y < 1;
    });
    EXPECT_NEAR(mean, 0, 0.006) << row.name;
    if (row.kind == SampleKind::random)
      EXPECT_NEAR(square, kByChance, 0.15 * kByChance);
    else
      EXPECT_LT(square, 0.5 * kByChance) << row.name;
  }
}

// The share of the samples in a ball around a corner, which depends on all four numbers at once.
TEST(Sampler, TwoPairsOfABranchEstimateWhatDependsOnBoth) {
  constexpr int kSamples = 64;
  constexpr Real kShare = kPi * kPi / 32, kByChance = kShare * (1 - kShare) / kSamples;
  for (const GeneratorRow& row : generators()) {
    const auto [mean, square] = errorsOf(row, kSamples, kShare, [](Sampler sampler) {
      const Vec2 u = sampler.next2(), v = sampler.second2();
      return u.x * u.x + u.y * u.y + v.x * v.x + v.y * v.y < 1;
    });
    EXPECT_NEAR(mean, 0, 0.006) << row.name;
    if (row.kind == SampleKind::random) {
      EXPECT_NEAR(square, kByChance, 0.15 * kByChance);
    }
    if (row.second) {
      EXPECT_LT(square, 0.4 * kByChance) << row.name;
    }
  }
}

// checks.md, E3: four times the samples, and all but chance become more than twice as exact.
TEST(Sampler, FourTimesTheSamplesAreMoreThanTwiceAsExact) {
  constexpr int kPixels = 100, kBranches = 16;  // "blue" scrambles all pixels of a branch alike
  const auto error = [](const GeneratorRow& row, int samples) {
    const SampleRules rules(with(row, samples), {kPixels, 1});
    Real square = 0;
    for (std::uint32_t branch = 0; branch < kBranches; ++branch)
      for (int x = 0; x < kPixels; ++x) {
        Real inside = 0;
        for (int k = 0; k < samples; ++k) {
          const Vec2 u = Sampler(rules, x, 0, k).branch(branch).next2();
          inside += u.x * u.x + u.y * u.y < 1;
        }
        const Real off = inside / samples - kPi / 4;
        square += off * off;
      }
    return std::sqrt(square);
  };
  for (const GeneratorRow& row : generators()) {
    const Real ratio = error(row, 64) / error(row, 256);
    if (row.kind == SampleKind::random)
      EXPECT_NEAR(ratio, 2, 0.15);
    else
      EXPECT_GT(ratio, 2.2) << row.name;
  }
}

// checks.md, E3: of as many samples as there are strata, each has one.
TEST(Sampler, OneSampleInEachStratum) {
  const auto fills = [](const GeneratorRow& row, int across, int up) {
    const int samples = across * up;
    const SampleRules rules(with(row, samples), {40, 40});
    EXPECT_EQ(rules.samples(), samples) << row.name;
    for (int pixel = 0; pixel < 40; ++pixel) {
      std::set<std::pair<int, int>> strata;
      for (int k = 0; k < samples; ++k) {
        const Vec2 u = Sampler(rules, pixel, 3, k).branch(9).next2();
        strata.insert({static_cast<int>(u.x * across), static_cast<int>(u.y * up)});
      }
      if (static_cast<int>(strata.size()) != samples) return false;
    }
    return true;
  };
  for (const GeneratorRow& row : generators()) {
    const bool nets =
        row.kind == SampleKind::grid || row.kind == SampleKind::sobol || row.kind == SampleKind::blue;
    if (row.kind == SampleKind::random) {
      EXPECT_FALSE(fills(row, 4, 4)) << "by chance";
    } else if (row.kind == SampleKind::halton) {
      EXPECT_TRUE(fills(row, 4, 9)) << "powers of 2 across, of 3 up";
    } else {
      EXPECT_TRUE(fills(row, 4, 4)) << row.name;
    }
    if (row.kind == SampleKind::stratified || nets) {
      EXPECT_TRUE(fills(row, 16, 1)) << row.name;
      EXPECT_TRUE(fills(row, 1, 16)) << row.name;
    }
    if (nets) {
      EXPECT_TRUE(fills(row, 8, 2)) << row.name;
      EXPECT_TRUE(fills(row, 2, 8)) << row.name;
    }
  }
}

// Blue noise: the mean of a pixel and its neighbours is better than that of as many strangers.
TEST(Sampler, BlueNeighboursMakeUpForEachOther) {
  const auto errorOfBlocks = [](SampleKind kind) {
    Settings settings{.spp = 1};
    settings.sampling = kind;
    const SampleRules rules(settings, {64, 64});
    Real square = 0;
    for (int block = 0; block < 256; ++block) {
      Real sum = 0;
      for (int i = 0; i < 16; ++i)
        sum += Sampler(rules, block % 16 * 4 + i % 4, block / 16 * 4 + i / 4, 0).branch(2).next();
      square += (sum / 16 - 0.5) * (sum / 16 - 0.5) / 256;
    }
    return square;
  };
  EXPECT_LT(errorOfBlocks(SampleKind::blue), 0.2 * errorOfBlocks(SampleKind::sobol));
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
}  // namespace trace::sampler_test
