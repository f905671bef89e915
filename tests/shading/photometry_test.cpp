// Measured lights: intensities by direction, against formulas.
#include "shading/lights/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "shading/lights/goniometric_light.h"
#include "shading/lights/light.h"

namespace trace {
namespace {

constexpr Real kDegree = kPi / 180;
using Type = Photometry::Type;

std::vector<Real> steps(Real from, Real to, Real step) {
  std::vector<Real> list;
  for (int i = 0; from + i * step <= to + 1e-9; ++i) list.push_back(from + i * step);
  return list;
}

/// A lamp's list made from a function of the vertical and the horizontal angle.
Photometry made(Type type, const std::vector<Real>& vertical, const std::vector<Real>& horizontal,
                const std::function<Real(Real, Real)>& candelas) {
  std::vector<Real> list;
  for (const Real h : horizontal)
    for (const Real v : vertical) list.push_back(candelas(v, h));
  return {type, vertical, horizontal, list};
}

/// In the polar angle and the angle around z, from x to y.
Vec3 direction(Real off, Real around) {
  return {std::sin(off * kDegree) * std::cos(around * kDegree),
          std::sin(off * kDegree) * std::sin(around * kDegree), std::cos(off * kDegree)};
}

TEST(Photometry, LumensAreTheIntegralOfTheCandelas) {
  EXPECT_NEAR(made(Type::c, {0, 90, 180}, {0}, [](Real, Real) { return 100; }).lumens(), 400 * kPi, 1e-9);
  // A flat panel sends out pi times what it has straight ahead, a power of the cosine 2 pi / (n + 1).
  const auto power = [](int n) {
    return made(Type::c, steps(0, 90, 0.5), {0},
                [&](Real v, Real) { return std::pow(std::cos(v * kDegree), n); });
  };
  EXPECT_NEAR(power(1).lumens(), kPi, 2e-4);
  EXPECT_NEAR(power(3).lumens(), 2 * kPi / 4, 2e-4);
  EXPECT_NEAR(power(20).lumens(), 2 * kPi / 21, 2e-4);
  // In every system of angles the same light has the same lumens.
  const auto forward = [](const Vec3& d) { return d.z > 0 ? d.z * d.z * (1 + d.x) : 0; };
  const auto a = made(Type::a, steps(-90, 90, 1), steps(-90, 90, 1), [&](Real v, Real h) {
    return forward({std::sin(v * kDegree), -std::cos(v * kDegree) * std::sin(h * kDegree),
                    std::cos(v * kDegree) * std::cos(h * kDegree)});
  });
  const auto b = made(Type::b, steps(-90, 90, 1), steps(-90, 90, 1), [&](Real v, Real h) {
    return forward({std::cos(h * kDegree) * std::sin(v * kDegree), -std::sin(h * kDegree),
                    std::cos(h * kDegree) * std::cos(v * kDegree)});
  });
  const auto c = made(Type::c, steps(0, 90, 1), steps(0, 360, 1),
                      [&](Real v, Real h) { return forward(direction(v, h)); });
  EXPECT_NEAR(c.lumens(), 2 * kPi / 3, 1e-3);  // the part with x cancels out
  EXPECT_NEAR(a.lumens(), 2 * kPi / 3, 1e-3);
  EXPECT_NEAR(b.lumens(), 2 * kPi / 3, 1e-3);
  for (const Vec3& d : {direction(20, 10), direction(50, 100), direction(70, 200), direction(35, 333)}) {
    EXPECT_NEAR(a.at(d), forward(d), 1e-3);
    EXPECT_NEAR(b.at(d), forward(d), 1e-3);
    EXPECT_NEAR(c.at(d), forward(d), 1e-3);
  }
}

TEST(Photometry, BetweenAnglesItIsLinear) {
  const auto light =
      made(Type::c, {0, 10, 40}, {0, 90}, [](Real v, Real h) { return v == 10 ? 100 + h : 7; });
  EXPECT_NEAR(light.at(direction(5, 0)), (7 + 100) / 2.0, 1e-9);
  EXPECT_NEAR(light.at(direction(10, 45)), 145, 1e-9);
  EXPECT_NEAR(light.at(direction(25, 30)), (130 + 7) / 2.0, 1e-9);
  EXPECT_EQ(light.at(direction(41, 0)), 0) << "beyond the last angle";
  EXPECT_EQ(light.brightest(), 190);
  EXPECT_NEAR(light.widest(), 40 * kDegree, 1e-12);
}

TEST(Photometry, QuartersAndHalvesAreMirrored) {
  const auto slope = [](Real, Real h) { return 100 + h; };
  const auto quarter = made(Type::c, {0, 90}, {0, 45, 90}, slope);
  for (const Real around : {30.0, 150.0, 210.0, 330.0})
    EXPECT_NEAR(quarter.at(direction(60, around)), 130, 1e-9);
  const auto half = made(Type::c, {0, 90}, {0, 90, 180}, slope);
  EXPECT_NEAR(half.at(direction(60, 150)), 250, 1e-9);
  EXPECT_NEAR(half.at(direction(60, 210)), 250, 1e-9);
  const auto turned = made(Type::c, {0, 90}, {90, 180, 270}, slope);
  EXPECT_NEAR(turned.at(direction(60, 60)), 220, 1e-9);
  EXPECT_NEAR(turned.at(direction(60, 120)), 220, 1e-9);
  EXPECT_NEAR(turned.at(direction(60, 300)), 340, 1e-9);
  EXPECT_NEAR(turned.at(direction(60, 240)), 340, 1e-9);
  const auto whole =
      made(Type::c, {0, 90}, steps(0, 360, 90), [](Real, Real h) { return h == 360 ? 100 : 100 + h; });
  EXPECT_NEAR(whole.at(direction(60, 225)), 325, 1e-9);
  EXPECT_NEAR(whole.at(direction(60, 315)), (370 + 100) / 2.0, 1e-9);
  // In types A and B the sides are alike if the list begins at 0.
  const auto sides = made(Type::b, {0, 90}, {0, 90}, [](Real v, Real h) { return 180 - v - h / 2; });
  EXPECT_NEAR(sides.at(normalize(Vec3{0, 1, 1})), 180 - 22.5, 1e-9);
  EXPECT_NEAR(sides.at(normalize(Vec3{0, -1, 1})), 180 - 22.5, 1e-9);
  EXPECT_NEAR(sides.at(normalize(Vec3{1, 0, 1})), 135, 1e-9);
  EXPECT_EQ(sides.at({0, 0, -1}), 0) << "behind it";
}

TEST(Photometry, ALightHasItsDirectionAndItsUp) {
  // Brightest to where the horizontal angle is 0, then around.
  const auto file = std::make_shared<const Photometry>(
      made(Type::c, {0, 90, 180}, {0, 90, 180, 270, 360}, [](Real v, Real h) {
        return v == 90 ? (h == 0 || h == 360 ? 400 : h == 90 ? 300 : h == 180 ? 200 : 100) : 50;
      }));
  GoniometricLight light{.position = {1, 2, 3}, .direction = {0, -1, 0}, .color = Color(2)};
  light.file.data = file;
  light.up = {0, 0, 1};
  light.constant = 1, light.quadratic = 0;
  const auto at = [&](const Vec3& d) {
    const auto arriving = light.illuminate(light.position + d * 3, {});
    return arriving ? arriving->intensity().g : 0;
  };
  EXPECT_NEAR(at({0, 0, 1}), 2, 1e-9) << "the brightest direction has the colour";
  EXPECT_NEAR(at({0, -1, 0}), 2 * 50 / 400.0, 1e-9);
  // Seen along its direction, the angle grows to the left: looking down with +z upward, that is -x... +x.
  EXPECT_NEAR(at({1, 0, 0}) + at({-1, 0, 0}), 2 * 400 / 400.0, 1e-9);
  EXPECT_NEAR(at(cross(light.up, light.direction)), 2 * 300 / 400.0, 1e-9);
  EXPECT_NEAR(at({0, 0, -1}), 2 * 200 / 400.0, 1e-9);
  light.perCandela = 0.01;
  EXPECT_NEAR(at({0, 0, 1}), 2 * 4, 1e-9);
}

}  // namespace
}  // namespace trace
