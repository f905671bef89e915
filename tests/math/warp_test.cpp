// Numbers as places and directions: inside, evenly spread, the middle in the middle.
#include "math/warp.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/spherical_rectangle.h"

namespace trace {
namespace {

constexpr int kSide = 64;  // of a grid of numbers

template <class Visit>
void forGrid(Visit&& visit) {
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) visit(Vec2{(i + 0.5) / kSide, (j + 0.5) / kSide});
}

TEST(Warp, CirclesAreThoseOfTheLibraryButForRounding) {
  constexpr int kPlaces = 100000;
  for (int i = 0; i <= kPlaces; ++i) {
    const Real turns = static_cast<Real>(i) / kPlaces;
    const Vec2 p = onCircle(turns);
    EXPECT_NEAR(p.x, std::cos(2 * kPi * turns), 0x1p-50) << turns;
    EXPECT_NEAR(p.y, std::sin(2 * kPi * turns), 0x1p-50) << turns;
  }
  EXPECT_EQ(onCircle(0), (Vec2{1, 0}));
  EXPECT_EQ(onCircle(0.25).x, 0);
  EXPECT_EQ(onCircle(0.5).x, -1);
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

/// A square that is seen straight on, one that is near the eye's plane, one beside it, and a long one.
const std::array kRectangles{
    std::array{Vec3{-1, -1, 1}, Vec3{2, 0, 0}, Vec3{0, 2, 0}},
    std::array{Vec3{0.2, -0.5, 0.001}, Vec3{1, 0, 0}, Vec3{0, 1, 0}},
    std::array{Vec3{1, 2, -0.5}, Vec3{0, 0.6, 0.8}, Vec3{0, -0.4, 0.3}},
    std::array{Vec3{-20, 0.1, 0.2}, Vec3{40, 0, 0}, Vec3{0, 0.01, 0}},
};
const Vec3 kEye{3, -1, 2};

TEST(Warp, TheSolidAngleOfARectangle) {
  EXPECT_NEAR(
      SphericalRectangle(kEye, kEye + kRectangles[0][0], kRectangles[0][1], kRectangles[0][2]).solidAngle(),
      4 * kPi / 6, 1e-14);  // the side of a cube from its middle
  for (const auto& [corner, a, b] : kRectangles) {
    // Of a corner at x, y over a plane at z: atan(x y / (z r)).
    const Vec3 x = normalize(a), y = normalize(b);
    const Real z = std::abs(dot(corner, cross(x, y)));
    const auto to = [&](const Vec3& p) { return std::atan(dot(p, x) * dot(p, y) / (z * length(p))); };
    const Real expected = to(corner + a + b) - to(corner + a) - to(corner + b) + to(corner);
    const Real found = SphericalRectangle(kEye, kEye + corner, a, b).solidAngle();
    EXPECT_NEAR(found, expected, 4e-15 + 1e-12 * expected);
  }
}

TEST(Warp, RectanglesAreFilledEvenlyAsTheyAreSeen) {
  for (const auto& [at, right, up] : kRectangles) {
    const Vec3 corner = at, a = right, b = up;
    const SphericalRectangle rectangle(kEye, kEye + corner, a, b);
    // The mean direction, against the sum over the area.
    Vec3 mean, sum;
    constexpr Real kCount = kSide * kSide;
    const Vec3 normal = normalize(cross(a, b));
    forGrid([&](const Vec2& u) {
      const Vec3 to = rectangle.place(u) - kEye, within = to - corner;
      EXPECT_NEAR(dot(within, normal), 0, 1e-12);
      for (const Vec3& side : {a, b}) {
        EXPECT_GE(dot(within, side), -1e-9);
        EXPECT_LE(dot(within, side), dot(side, side) + 1e-9);
      }
      mean += normalize(to) * (1 / kCount);
    });
    constexpr int kFine = 2048;
    for (int i = 0; i < kFine; ++i)
      for (int j = 0; j < kFine; ++j) {
        const Vec3 to = corner + a * ((i + 0.5) / kFine) + b * ((j + 0.5) / kFine);
        const Real away = length(to);
        sum += to * (std::abs(dot(to, normal)) / (away * away * away * away));
      }
    sum = sum * (length(a) * length(b) / (kFine * kFine) / rectangle.solidAngle());
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      EXPECT_NEAR(dot(mean, axis), dot(sum, axis), 2e-3);
  }
}

}  // namespace
}  // namespace trace
