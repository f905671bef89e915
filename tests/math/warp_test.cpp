// Numbers as places and directions: inside, evenly spread, the middle in the middle.
#include "math/warp.h"

#include <gtest/gtest.h>

#include <array>

namespace trace {
namespace {

constexpr int kSide = 64;  // of a grid of numbers

template <class Visit>
void forGrid(Visit&& visit) {
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) visit(Vec2{(i + 0.5) / kSide, (j + 0.5) / kSide});
}

TEST(Warp, DisksAndPolygonsAreFilledEvenly) {
  for (const int corners : {0, 3, 5, 6}) {
    const auto place = [&](const Vec2& u) { return corners ? toPolygon(u, corners, 0.3) : toDisk(u); };
    Real x = 0, y = 0, square = 0;
    forGrid([&](const Vec2& u) {
      const Vec2 p = place(u);
      EXPECT_LE(p.x * p.x + p.y * p.y, 1 + 1e-12);
      x += p.x, y += p.y, square += p.x * p.x + p.y * p.y;
    });
    constexpr Real kCount = kSide * kSide;
    EXPECT_NEAR(x / kCount, 0, 1e-3) << corners;
    EXPECT_NEAR(y / kCount, 0, 1e-3) << corners;
    // The polar moment over the area: 1/2, and (2 + cos(2 pi / n)) / 6 of a polygon.
    const Real expected = corners ? (2 + std::cos(2 * kPi / corners)) / 6 : 0.5;
    EXPECT_NEAR(square / kCount, expected, 2e-3) << corners;
  }
  EXPECT_EQ(toDisk(kCenter), (Vec2{0, 0}));
  EXPECT_EQ(toPolygon(kCenter, 5, 1), (Vec2{0, 0}));
}

TEST(Warp, ConesAreFilledEvenly) {
  const Vec3 axis = normalize(Vec3{1, -2, 0.5});
  for (const Real cosine : {0.999, 0.5, 0.0, -1.0}) {
    Real sum = 0, square = 0, length2 = 0;
    forGrid([&](const Vec2& u) {
      const Vec3 d = toCone(u, axis, cosine);
      EXPECT_GE(dot(d, axis), cosine - 1e-12);
      sum += dot(d, axis), square += dot(d, axis) * dot(d, axis), length2 += dot(d, d);
    });
    constexpr Real kCount = kSide * kSide;
    EXPECT_NEAR(sum / kCount, (1 + cosine) / 2, 1e-3);
    EXPECT_NEAR(square / kCount, (1 + cosine + cosine * cosine) / 3, 1e-3);
    EXPECT_NEAR(length2 / kCount, 1, 1e-12);
  }
  EXPECT_EQ(toCone(kCenter, {0, 0, 1}, 0.5), (Vec3{0, 0, 1}));
}

}  // namespace
}  // namespace trace
