// Filters of reconstruction: samples lie where they count, and count one in the mean.
#include "image/film/pixel_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace trace {
namespace {

TEST(PixelFilter, AreOneAndCenteredInTheMean) {
  constexpr int kSide = 1000;
  for (const FilterRow& row : filters()) {
    const PixelFilter filter(row.kind, 0);
    Real weight = 0, x = 0, last = -row.radius;
    for (int i = 0; i < kSide; ++i) {
      const FilmSample s = filter.sample({(i + 0.5) / kSide, 0.25});
      EXPECT_GE(s.place.x, last) << row.name;
      last = s.place.x;
      EXPECT_LE(std::abs(s.place.x), row.radius) << row.name;
      weight += s.weight, x += s.weight * s.place.x;
    }
    const Real down = filter.sample({0.5, 0.25}).weight / filter.sample({0.5, 0.5}).weight;
    const Real oneWay = std::sqrt(filter.sample({0.5, 0.5}).weight) * down;  // of the product of two weights
    EXPECT_NEAR(weight / kSide, oneWay, 0.01) << row.name;
    EXPECT_NEAR(x / kSide, 0, 1e-3) << row.name;
  }
}

TEST(PixelFilter, FollowTheirProfiles) {
  constexpr int kCount = 200000, kBins = 20;
  for (const FilterRow& row : filters()) {
    const PixelFilter filter(row.kind, 0);
    std::array<Real, kBins> sums{}, expected{};
    Real all = 0;
    for (int i = 0; i < kCount; ++i) {
      const FilmSample s = filter.sample({(i + 0.5) / kCount, 0.5});
      const auto bin = static_cast<std::size_t>((s.place.x / row.radius + 1) / 2 * kBins);
      sums[std::min<std::size_t>(bin, kBins - 1)] += s.weight;
      all += s.weight;
    }
    Real total = 0;
    for (int i = 0; i < 100 * kBins; ++i) {
      const Real value = row.profile((2 * (i + 0.5)) / (100 * kBins) - 1);
      expected[static_cast<std::size_t>(i / 100)] += value, total += value;
    }
    for (std::size_t bin = 0; bin < kBins; ++bin)
      EXPECT_NEAR(sums[bin] / all, expected[bin] / total, 2e-3) << row.name << " " << bin;
  }
}

TEST(PixelFilter, TheUsualBoxIsThePixel) {
  EXPECT_TRUE(PixelFilter(FilterKind::box, 0).isPixel());
  EXPECT_FALSE(PixelFilter(FilterKind::box, 1).isPixel());
  EXPECT_EQ(PixelFilter(FilterKind::box, 0).sample({0, 0.75}).place, (Vec2{-0.5, 0.25}));
}

}  // namespace
}  // namespace trace
