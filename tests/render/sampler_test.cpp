// Numbers of samples: where they lie, and that what one ray draws does not move what another gets.
#include "render/samples/sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include "image/film/pixel_filter.h"
#include "scene/options.h"

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

/// The names of the choices are in scene/options.cpp, the rows elsewhere.
template <class Row>
void expectRowsOf(std::string_view option, std::span<const Row> rows) {
  const auto choices = findOption(option).choices;
  ASSERT_EQ(rows.size(), choices.size()) << option;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].name, choices[i]) << option;
    EXPECT_EQ(static_cast<std::size_t>(rows[i].kind), i) << option;
  }
}

TEST(Sampler, EveryGeneratorAndFilterToChooseHasItsRow) {
  expectRowsOf("sampling", generators());
  expectRowsOf("filter", filters());
}

TEST(Sampler, TheTableIsInTheOrderOfItsKinds) {
  for (std::size_t g = 0; g < generators().size(); ++g) {
    EXPECT_EQ(static_cast<std::size_t>(generators()[g].kind), g);
    EXPECT_EQ(samplesOf(with(generators()[g], 5)), generators()[g].square ? 9 : 5);
  }
}

TEST(Sampler, WhatIsLeftOutDoesNotMoveWhatIsDrawnAfterwards) {
  for (const GeneratorRow& row : generators()) {
    const SampleRules rules(with(row, 4), {10, 5});
    Sampler all(rules, 3, 2, 1), some = all;
    all.next();
    EXPECT_EQ(some.skip(), 0);
    EXPECT_EQ(all.next(), some.next()) << row.name;
    EXPECT_EQ(all.next2(), some.next2()) << row.name;
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

/// Two pairs of numbers that a sample draws in different places.
struct TwoDraws {
  const char* name;
  std::pair<Vec2, Vec2> (*draw)(const Sampler& sample);
};
const std::array kTwoDraws{
    TwoDraws{"of two branches",
             [](const Sampler& s) { return std::pair(s.branch(3).next2(), s.branch(9).next2()); }},
    TwoDraws{"of a branch and one below it",
             [](const Sampler& s) { return std::pair(s.branch(3).next2(), s.branch(3).branch(3).next2()); }},
    TwoDraws{"of one branch, one after the other",
             [](const Sampler& s) {
               Sampler branch = s.branch(3);
               const Vec2 first = branch.next2();
               return std::pair(first, branch.next2());
             }},
    TwoDraws{"the second pairs of two branches",
             [](const Sampler& s) { return std::pair(s.branch(3).second2(), s.branch(9).second2()); }},
    TwoDraws{"the second pair of one branch and the first of another",
             [](const Sampler& s) { return std::pair(s.branch(3).second2(), s.branch(9).next2()); }},
    TwoDraws{"single numbers of two branches",
             [](const Sampler& s) {
               Sampler a = s.branch(3), b = s.branch(9);
               const Real x = a.next(), x2 = b.next(), y = a.next();
               return std::pair(Vec2{x, y}, Vec2{x2, b.next()});
             }},
};

/// The mean squares of the errors of means that samples estimate, times their number: the variances of one
/// sample, if they are independent. `values(sample)` have to have means of 0.
template <std::size_t kValues, class Values>
std::array<Real, kValues> variancesOf(const GeneratorRow& row, int samples, const Values& values) {
  const int trials = samples > 1000 ? 80 : 200;
  std::array<Real, kValues> squares{};
  for (int trial = 0; trial < trials; ++trial) {
    Settings settings = with(row, samples);
    settings.seed = trial;  // "blue" scrambles all pixels of a branch alike
    const SampleRules rules(settings, {1000, 1});
    std::array<Real, kValues> sums{};
    for (int k = 0; k < rules.samples(); ++k) {
      const std::array<Real, kValues> found = values(Sampler(rules, 7 * trial % 1000, 0, k));
      for (std::size_t i = 0; i < kValues; ++i) sums[i] += found[i];
    }
    for (std::size_t i = 0; i < kValues; ++i) squares[i] += sums[i] * sums[i] / rules.samples() / trials;
  }
  return squares;
}

constexpr std::array kNumbersOfSamples{4, 9, 16, 64, 256, 1024, 4096};

// Of a product of two factors of mean 0 nothing can be told from one of them: pairs of two draws have to meet
// as by chance. An order that is shuffled digit by digit (Owen 1995) has a variance of b / (b - 1) times
// chance's in base b, at most; the same order in two draws has one that grows with the number of samples.
TEST(Sampler, TheProductOfTwoDrawsConvergesAsFastAsChance) {
  constexpr Real kBase2 = 2, kNoise = 1.7;
  constexpr std::array kProducts{"x x'", "y y'", "x y'", "waves", "brightness"};
  constexpr std::array<Real, 5> kVariances{1, 1, 1, 0.25, 7.0 / 144};
  const auto products = [](const Vec2& a, const Vec2& b) {
    const auto sign = [](Real u) { return u < 0.5 ? -1.0 : 1.0; };
    return std::array<Real, 5>{sign(a.x) * sign(b.x), sign(a.y) * sign(b.y), sign(a.x) * sign(b.y),
                               std::cos(2 * kPi * (3 * a.y + a.x)) * std::cos(2 * kPi * (3 * b.y - b.x)),
                               a.x * b.x - 0.25};
  };
  for (const GeneratorRow& row : generators())
    for (const TwoDraws& two : kTwoDraws)
      for (const int samples : kNumbersOfSamples) {
        if (samples > 1000 && &two != &kTwoDraws.front() && &two != &kTwoDraws[2]) continue;
        const auto found = variancesOf<5>(row, samples, [&](const Sampler& sample) {
          const auto [a, b] = two.draw(sample);
          return products(a, b);
        });
        for (std::size_t i = 0; i < found.size(); ++i) {
          // The last has a mean, which each factor tells alone better than by chance.
          const bool known = i == 4 && row.kind != SampleKind::random;
          EXPECT_LT(found[i], kNoise * kVariances[i] * (known ? 0.5 : kBase2))
              << row.name << ", " << kProducts[i] << " " << two.name << ", " << samples << " samples";
        }
      }
}

// A path of four bounces: at each a direction, of which one half is darker, and the place on a lamp, a part
// of which is hidden.
TEST(Sampler, APathOfFourBouncesConvergesAsFastAsChance) {
  constexpr int kBounces = 4;
  constexpr Real kSquare = 1 + 0.64 / 2 + 0.25 * 0.25;  // the mean square of a factor below
  const Real variance = std::pow(kSquare, kBounces) - 1;
  const auto light = [](const Sampler& sample) {
    Real brings = 1;
    Sampler at = sample;
    for (int bounce = 0; bounce < kBounces; ++bounce) {
      const Vec2 direction = at.branch(0x80000003u).next2(), lamp = at.branch(0x80000000u).next2();
      brings *= 1 + 0.8 * std::cos(2 * kPi * direction.x) * (direction.y < 0.5 ? -1 : 1) +
                0.25 * (lamp.x + lamp.y < 1 ? -1 : 1);
      at = at.branch(0x80000003u);
    }
    return std::array{brings - 1};
  };
  for (const GeneratorRow& row : generators())
    for (const int samples : kNumbersOfSamples) {
      const Real found = variancesOf<1>(row, samples, light)[0];
      EXPECT_LT(found, 1.5 * variance) << row.name << ", " << samples << " samples";
      if (row.kind == SampleKind::random && samples < 1000) {
        EXPECT_GT(found, variance / 2);
      }
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
