// Lights with a size: what arrives of all of their places together, against formulas.
#include "shading/lights/light.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

/// What a white Lambertian surface at the origin of that normal gives back of all the light, in the mean.
template <class L>
Real given(const L& light, const Vec3& normal, Vec3* direction = nullptr) {
  constexpr int kSide = 200;
  Real sum = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const auto arriving = light.illuminate({}, {}, {(i + 0.5) / kSide, (j + 0.5) / kSide});
      if (!arriving) continue;
      EXPECT_NEAR(length(arriving->toLight), 1, 1e-12);
      sum += std::max(0.0, dot(normal, arriving->toLight)) * arriving->intensity().r;
      if (direction) *direction = *direction + arriving->toLight * (1.0 / (kSide * kSide));
    }
  return sum / (kSide * kSide);
}

TEST(Light, ARectangleGivesItsFormFactor) {
  const Real a = 0.75, b = 1.25, c = 2, A = a / c, B = b / c;  // half its sides, and how far it is
  const auto part = [](Real p, Real q) {
    return p / std::sqrt(1 + p * p) * std::atan(q / std::sqrt(1 + p * p));
  };
  RectangleLight light{.position = {0, 0, c}, .u = {2 * a, 0, 0}, .v = {0, -2 * b, 0}, .color = Color(1)};
  EXPECT_NEAR(given(light, {0, 0, 1}), 2 / kPi * (part(A, B) + part(B, A)), 1e-5);
  light.v = {0, 2 * b, 0};
  EXPECT_EQ(given(light, {0, 0, 1}), 0) << "it shines to one side";
  light.twoSided = true;
  EXPECT_NEAR(given(light, {0, 0, 1}), 2 / kPi * (part(A, B) + part(B, A)), 1e-5);
}

TEST(Light, ADiskGivesItsFormFactor) {
  const RectangleLight light{
      .position = {0, 0, 2}, .u = {2, 0, 0}, .v = {0, -2, 0}, .color = Color(1), .round = true};
  EXPECT_NEAR(given(light, {0, 0, 1}), 1.0 / 5, 1e-5);  // r^2 / (r^2 + d^2)
}

TEST(Light, ABallIsSeenByItsSolidAngle) {
  PointLight light{.position = {0, 0, 2}, .color = Color(1), .constant = 1, .quadratic = 0};
  light.radius = 1;
  // The mean cosine of a cone whose sine is 1/2.
  EXPECT_NEAR(given(light, {0, 0, 1}), (1 + std::sqrt(0.75)) / 2, 1e-5);
  for (const Vec2& u : {Vec2{0.1, 0.7}, Vec2{0.9, 0.2}, kCenter}) {
    const auto arriving = light.illuminate({}, {}, u);
    EXPECT_NEAR(length(arriving->toLight * arriving->distance - light.position), 1, 1e-9) << "its surface";
  }
  EXPECT_EQ(light.illuminate({}, {}, kCenter)->toLight, (Vec3{0, 0, 1}));
  light.radius = 5;  // around the place
  EXPECT_EQ(light.illuminate({}, {}, {0.1, 0.7})->distance, 2);
}

TEST(Light, ASunCoversItsAngle) {
  DirectionalLight light{.direction = {0, -1, -1}, .color = Color(1)};
  light.size = 20;
  Vec3 mean;
  given(light, {0, 0, 1}, &mean);
  EXPECT_NEAR(length(mean), (1 + std::cos(10 * kPi / 180)) / 2, 1e-6);
  EXPECT_NEAR(dot(normalize(mean), normalize(Vec3{0, 1, 1})), 1, 1e-9);
}

TEST(Light, WithoutASizeItIsWhereItWas) {
  EXPECT_FALSE(PointLight{}.hasSize() || DirectionalLight{}.hasSize() || SpotLight{}.hasSize());
  const PointLight light{.position = {3, 0, 4}, .color = Color(1)};
  EXPECT_EQ(light.illuminate({}, {}, {0.1, 0.9})->toLight, light.illuminate({}, {}, {0.7, 0.3})->toLight);
}

}  // namespace
}  // namespace trace
