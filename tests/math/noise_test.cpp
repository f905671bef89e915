#include "math/noise.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "math/fractal_sum.h"
#include "math/noise_lanes.h"

namespace trace {
namespace {

template <class Count>
class GradientNoise : public ::testing::Test {
 protected:
  static constexpr int kAxes = Count::value;
  using Place = std::array<Real, kAxes>;
  /// The k-th of a sequence that fills a cube of side 4096 evenly (Weyl).
  static Place spread(int k) {
    constexpr Real kSteps[]{0.8191725133961645, 0.6710436067037893, 0.5497004779019703, 0.4502995220980297};
    Place p;
    for (int axis = 0; axis < kAxes; ++axis) p[axis] = 4096 * Lattice(k * kSteps[axis]).rest - 2048;
    return p;
  }
};
using AllDimensions = ::testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                       std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(GradientNoise, AllDimensions);

TYPED_TEST(GradientNoise, IsZeroAtLatticePoints) {
  constexpr int kN = TypeParam::value;
  for (int k = 0; k < 100; ++k) {
    auto p = TestFixture::spread(k);
    for (Real& x : p) x = std::floor(x);
    EXPECT_EQ(gradientNoise<kN>(p, 3), 0) << k;
  }
}

TYPED_TEST(GradientNoise, LiesBetweenAboutMinusOneAndOneWithMeanZero) {
  constexpr int kN = TypeParam::value;
  constexpr int kCount = 200000;
  Real least = 0, most = 0, sum = 0, magnitude = 0;
  for (int k = 0; k < kCount; ++k) {
    const Real n = gradientNoise<kN>(TestFixture::spread(k), 1);
    least = min(least, n), most = max(most, n), sum += n, magnitude += std::abs(n);
  }
  EXPECT_GT(least, -1.2);
  EXPECT_LT(most, 1.2);
  EXPECT_LT(least, -0.6);
  EXPECT_GT(most, 0.6);
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(magnitude / kCount, FractalSum::kMeanMagnitude[kN], 0.01);
}

TYPED_TEST(GradientNoise, IsContinuousWithItsSlopeAcrossCells) {
  constexpr int kN = TypeParam::value;
  constexpr Real kStep = 1e-4;
  for (int k = 0; k < 200; ++k)
    for (int axis = 0; axis < kN; ++axis) {
      auto p = TestFixture::spread(k);
      p[axis] = std::floor(p[axis]);
      const auto at = [&](Real move) {
        auto moved = p;
        moved[axis] += move;
        return gradientNoise<kN>(moved, 5);
      };
      EXPECT_NEAR(at(-kStep), at(kStep), 10 * kStep);
      const Real before = (at(0) - at(-kStep)) / kStep, after = (at(kStep) - at(0)) / kStep;
      EXPECT_NEAR(before, after, 0.01) << k << " axis " << axis;
    }
}

TYPED_TEST(GradientNoise, RepeatsAfterItsPeriod) {
  constexpr int kN = TypeParam::value;
  const std::int64_t period[4] = {3, 4, 5, 7};
  int same = 0;
  for (int k = 0; k < 100; ++k) {
    const auto p = TestFixture::spread(k);
    auto moved = p;
    for (int axis = 0; axis < kN; ++axis) moved[axis] += 2.0 * static_cast<Real>(period[axis]);
    EXPECT_NEAR(gradientNoise<kN>(p, 9, period), gradientNoise<kN>(moved, 9, period), 1e-10);
    same += std::abs(gradientNoise<kN>(p, 9) - gradientNoise<kN>(moved, 9)) < 1e-3;
  }
  EXPECT_LT(same, 20);
}

TYPED_TEST(GradientNoise, DiffersBySeedAndIsFiniteFarOut) {
  constexpr int kN = TypeParam::value;
  std::array<Real, kN> p;
  p.fill(0.37);
  EXPECT_NE(gradientNoise<kN>(p, 1), gradientNoise<kN>(p, 2));
  for (const Real far : {1e15, -1e15, 1e18, 1e300, -1e300, kInfinity}) {
    p.fill(far);
    EXPECT_TRUE(std::isfinite(gradientNoise<kN>(p, 1))) << far;
  }
}

// The mean over many places of f(place).
template <class F>
Real mean(const F& f) {
  constexpr int kCount = 60000;
  Real sum = 0;
  for (int k = 0; k < kCount; ++k)
    sum += f(std::array<Real, 3>{256 * Lattice(k * 0.8191725133961645).rest,
                                 256 * Lattice(k * 0.6710436067037893).rest,
                                 256 * Lattice(k * 0.5497004779019703).rest});
  return sum / kCount;
}

TEST(FractalSum, OneOctaveIsNoiseItself) {
  FractalSum one;
  one.octaves = 1;
  const std::array<Real, 3> p{0.3, 1.7, -2.2};
  const Real n = gradientNoise<3>({0.3 + 0.3183, 1.7 + 0.5707, -2.2 + 0.7321}, mixBits32(0));  // moved
  EXPECT_EQ(one.at<3>(p, 0), n);
  one.sum = SumKind::turbulence;
  EXPECT_DOUBLE_EQ(one.at<3>(p, 0), 2 * std::abs(n));
  one.sum = SumKind::ridged;
  EXPECT_DOUBLE_EQ(one.at<3>(p, 0), (1 - std::abs(n)) * (1 - std::abs(n)));
}

TEST(FractalSum, IsSpreadAsOneOctaveIs) {
  FractalSum sum;
  const auto variance = [&](int octaves, Real gain) {
    sum.octaves = octaves, sum.gain = gain;
    return mean([&](const auto& p) { return sum.at<3>(p, 0) * sum.at<3>(p, 0); });
  };
  const Real one = variance(1, 0.5);
  EXPECT_NEAR(variance(6, 0.5), one, 0.05 * one);
  EXPECT_NEAR(variance(6, 0.9), one, 0.05 * one);
  EXPECT_NEAR(mean([&](const auto& p) { return sum.at<3>(p, 0); }), 0, 0.01);
}

TEST(FractalSum, TurbulenceAndRidgesLieBetweenZeroAndAboutOne) {
  FractalSum sum;
  for (const SumKind kind : {SumKind::turbulence, SumKind::ridged}) {
    sum.sum = kind;
    Real least = 1, most = 0;
    mean([&](const auto& p) {
      const Real value = sum.at<3>(p, 0);
      least = min(least, value), most = max(most, value);
      return value;
    });
    EXPECT_GE(least, 0);
    EXPECT_LT(most, 1.5);
    EXPECT_GT(most, 0.8);
  }
}

// What a pixel is too wide for gives way to its mean, and does so gradually.
TEST(FractalSum, FadesWithTheWidthOfAPixel) {
  FractalSum sum;
  const std::array<Real, 3> p{0.3, 1.7, -2.2};
  EXPECT_EQ(sum.at<3>(p, 1), 0);
  sum.octaves = 3;
  const Real three = sum.at<3>(p, 0) * std::sqrt(1 + 0.25 + 0.0625);
  sum.octaves = 4;
  EXPECT_NEAR(sum.at<3>(p, 1.0 / 16) * std::sqrt(1 + 0.25 + 0.0625 + 0.015625), three, 1e-12);
  Real before = sum.at<3>(p, 0);
  for (Real width = 0; width < 1; width += 1e-3) {
    const Real now = sum.at<3>(p, width);
    EXPECT_NEAR(now, before, 0.01) << width;
    before = now;
  }
  sum.sum = SumKind::turbulence;
  EXPECT_DOUBLE_EQ(sum.at<3>(p, 1), 2 * FractalSum::kMeanMagnitude[3]);
}

TEST(FractalSum, KeepsItsPeriodInEveryOctave) {
  FractalSum sum;
  const std::int64_t period[3]{4, 0, 2};
  const std::array<Real, 3> p{0.3, 1.7, -2.2}, moved{4.3, 1.7, -0.2};
  EXPECT_NEAR(sum.at<3>(p, 0, period), sum.at<3>(moved, 0, period), 1e-12);
}

// An absurd number of octaves ends.
TEST(FractalSum, BoundsItsOctaves) {
  FractalSum many, most;
  many.octaves = 1000000000, most.octaves = FractalSum::kMostOctaves;
  EXPECT_EQ((many.at<3>({0.1, 0.2, 0.3}, 0)), (most.at<3>({0.1, 0.2, 0.3}, 0)));
}

/// What repeats after 0 steps does not repeat, and is computed corner by corner.
constexpr std::int64_t kNever[3]{};

/// Points at all distances, some of them on faces of cells.
std::array<Real, 3> pointOfAnySize(std::mt19937_64& numbers) {
  std::array<Real, 3> p;
  const Real size = std::ldexp(1.0, static_cast<int>(numbers() % 64) - 8);
  for (Real& x : p) {
    x = (unitFromBits(numbers()) - 0.5) * size;
    const auto kind = numbers() % 8;
    if (kind == 0) x = std::floor(x);
    if (kind == 1) x = -0.0;
  }
  return p;
}

TEST(NoiseLanes, HaveTheBitsOfCornersThatAreComputedOneByOne) {
  const NoiseLanes* lanes = noiseLanes();
  if (!lanes) GTEST_SKIP() << "the processor has no AVX2";
  std::mt19937_64 numbers(1);
  for (int k = 0; k < 200000; ++k) {
    const auto p = pointOfAnySize(numbers);
    const auto seed = static_cast<std::uint32_t>(numbers());
    ASSERT_EQ(std::bit_cast<std::uint64_t>(lanes->noise(p, seed)),
              std::bit_cast<std::uint64_t>(gradientNoise<3>(p, seed, kNever)))
        << p[0] << ' ' << p[1] << ' ' << p[2] << " seed " << seed;
  }
}

TEST(NoiseLanes, HaveTheBitsOfTheirSums) {
  const NoiseLanes* lanes = noiseLanes();
  if (!lanes) GTEST_SKIP() << "the processor has no AVX2";
  std::mt19937_64 numbers(2);
  for (const SumKind kind : {SumKind::fractal, SumKind::turbulence, SumKind::ridged})
    for (int k = 0; k < 20000; ++k) {
      FractalSum f;
      f.sum = kind;
      f.octaves = 1 + k % 9;
      f.seed = k;
      const auto p = pointOfAnySize(numbers);
      const Real width = k % 3 * unitFromBits(numbers());
      ASSERT_EQ(std::bit_cast<std::uint64_t>(lanes->sum(f, p, width)),
                std::bit_cast<std::uint64_t>(f.at<3>(p, width, kNever)))
          << names(kind)[static_cast<std::size_t>(kind)] << ' ' << k;
    }
}

}  // namespace
}  // namespace trace
