// Noise taken out of pictures that are made here, so that the truth is known.
#include "image/development/denoise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace trace::test {
namespace {

constexpr int kSize = 48;

/// Squares of two colours on the left, a slope from dark to bright on the right.
Color truth(int x, int y) {
  if (x < kSize / 2) return (x / 4 + y / 4) % 2 ? Color(0.8, 0.3, 0.2) : Color(0.2, 0.3, 0.5);
  return Color(0.2 + 0.6 * y / kSize);
}

struct Noisy {
  Halves halves{Picture(kSize, kSize), Picture(kSize, kSize), {}, {}};
  NoiseGuides guides{Picture(kSize, kSize), Picture(kSize, kSize), Picture(kSize, kSize)};
};

Noisy noisy(double deviation) {
  Random random(7);
  const auto normal = [&] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum * deviation;
  };
  Noisy picture;
  picture.halves.variance.assign(kSize * kSize, deviation * deviation / 2);
  picture.halves.share.assign(kSize * kSize, 0.5);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Color c = truth(x, y);
      for (Picture* half : {&picture.halves.first, &picture.halves.second})
        half->at(x, y) = c + Color(normal());
      picture.guides.albedo.at(x, y) = x < kSize / 2 ? c : Color(0.5);
      picture.guides.normal.at(x, y) = {0, 0, 1};
      picture.guides.nearness.at(x, y) = Color(0.1);
    }
  return picture;
}

/// The mean squared error, of columns from `first` on, before `end`.
double error(const Picture& picture, int first, int end) {
  double sum = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = first; x < end; ++x) {
      const Color d = picture.at(x, y) + truth(x, y) * -1;
      sum += (d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    }
  return sum / (kSize * (end - first));
}

Picture cleaned(const Noisy& picture, int threads) {
  Job job;
  return withoutNoise(picture.halves, picture.guides, threads, job);
}

Picture meanOf(const Halves& halves) {
  Picture mean(kSize, kSize);
  for (std::size_t i = 0; i < mean.pixels.size(); ++i)
    mean.pixels[i] = (halves.first.pixels[i] + halves.second.pixels[i]) * 0.5;
  return mean;
}

TEST(Denoise, LeavesAPictureWithoutNoiseAlone) {
  const Noisy clean = noisy(0);
  const Picture result = cleaned(clean, 1);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Color d = result.at(x, y) + truth(x, y) * -1;
      EXPECT_LT(std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)}), 1e-6) << x << " " << y;
    }
}

TEST(Denoise, TakesNoiseOutAndKeepsTextures) {
  const Noisy picture = noisy(0.15);
  const Picture before = meanOf(picture.halves), after = cleaned(picture, 2);
  EXPECT_LT(error(after, kSize / 2 + 4, kSize), error(before, kSize / 2 + 4, kSize) / 8) << "smooth";
  EXPECT_LT(error(after, 0, kSize / 2 - 4), error(before, 0, kSize / 2 - 4) / 6) << "a texture";
}

TEST(Denoise, KeepsEdgesThatTheGuidesDoNotKnow) {
  Noisy picture = noisy(0.05);
  for (Color& c : picture.guides.albedo.pixels) c = Color(0.5);  // such as shadows
  const Picture before = meanOf(picture.halves), after = cleaned(picture, 2);
  EXPECT_LT(error(after, 0, kSize / 2 - 4), error(before, 0, kSize / 2 - 4) / 2);
}

TEST(Denoise, LeavesNoNoiseAroundABall) {
  constexpr double kRadius = 12, kBright = 0.9, kDark = 0.1;
  Noisy picture = noisy(0.06);
  const auto outside = [](int x, int y) { return std::hypot(x - kSize / 2, y - kSize / 2) - kRadius; };
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Color shift = Color(outside(x, y) < 0 ? kBright : kDark) + truth(x, y) * -1;
      for (Picture* half : {&picture.halves.first, &picture.halves.second}) half->at(x, y) += shift;
      picture.guides.albedo.at(x, y) = Color(0.5);
      picture.guides.normal.at(x, y) = outside(x, y) < 0 ? Color(0.6, 0, 0.8) : Color(0, 0, 1);
    }
  const Picture after = cleaned(picture, 1), before = meanOf(picture.halves);
  const auto error = [&](const Picture& of, double least, double most) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (outside(x, y) > least && outside(x, y) < most) sum += std::pow(of.at(x, y).g - kDark, 2), ++count;
    return sum / count;
  };
  EXPECT_LT(error(after, 0.1, 3), error(before, 0.1, 3) / 4) << "beside its edge";
  EXPECT_LT(error(after, 5, 12), error(before, 5, 12) / 8) << "far from it";
}

TEST(Denoise, TheSameBitsForAnyNumberOfThreads) {
  const Noisy picture = noisy(0.1);
  const Picture one = cleaned(picture, 1);
  for (const int threads : {2, 7}) EXPECT_EQ(cleaned(picture, threads), one);
}

TEST(Denoise, PixelsWithoutSamplesStayBlackAndCountForNoOther) {
  Noisy picture = noisy(0.1);
  for (int y = 0; y < kSize; ++y) {
    for (Picture* half : {&picture.halves.first, &picture.halves.second}) half->at(10, y) = Color(1000);
    picture.halves.share[static_cast<std::size_t>(y * kSize + 10)] = 0;
  }
  const Picture result = cleaned(picture, 1);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) EXPECT_LT(result.at(x, y).r, x == 10 ? 0.001 : 1.2);
}

}  // namespace
}  // namespace trace::test
