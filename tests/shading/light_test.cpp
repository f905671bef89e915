// Lights with a size: what arrives of all of their places together, against formulas.
#include "shading/lights/light.h"

#include <gtest/gtest.h>

#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"

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

TEST(Light, ASmoothEdgeIsACubicOfTheCosine) {
  const SpotLight spot{
      .direction = {0, 0, -1}, .color = Color(1), .angle = 60, .fullAngle = 0, .edge = SpotEdge::smooth};
  const auto at = [&](Real degrees) {
    const Real a = degrees * kPi / 180;
    const auto arriving = spot.illuminate({std::sin(a), 0, -std::cos(a)}, {});
    return arriving ? arriving->attenuation : 0;
  };
  EXPECT_NEAR(at(0), 1, 1e-12);
  EXPECT_NEAR(at(std::acos(0.75) * 180 / kPi), 0.5, 1e-9) << "half way between the cosines 1 and 0.5";
  EXPECT_NEAR(at(std::acos(0.625) * 180 / kPi), 0.15625, 1e-9) << "3 t^2 - 2 t^3 of a quarter";
  EXPECT_NEAR(at(61), 0, 1e-12);
}

TEST(Light, GeometryIsThatOfTheFields) {
  for (const LightType& type : lightTypes()) {
    SCOPED_TRACE(type.keyword);
    const Light light(type);
    EXPECT_EQ(geometryOf(light).starts, type.starts);
    EXPECT_EQ(findValue<Real>(light, "radius") != nullptr, type.starts == LightOrigin::ball);
    EXPECT_EQ(findValue<bool>(light, "visible") != nullptr, type.seen != nullptr);
    if (type.starts == LightOrigin::none) EXPECT_FALSE(light.illuminate({0, 0, 1}, {}));
  }
  const LightGeometry spot = geometryOf(
      SpotLight{.position = {1, 2, 3}, .direction = {0, -2, 0}, .angle = 60, .fullAngle = 60, .radius = 0.5});
  EXPECT_EQ(spot.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(spot.radius, 0.5);
  ASSERT_TRUE(spot.cone);
  EXPECT_EQ(spot.cone->axis, (Vec3{0, -1, 0}));
  EXPECT_NEAR(spot.cone->cosine, 0.5, 1e-15);
  const LightGeometry panel = geometryOf(RectangleLight{.u = {3, 0, 0}, .v = {0, 0, 2}, .round = true});
  EXPECT_EQ(panel.u, (Vec3{3, 0, 0}));
  EXPECT_EQ(panel.v, (Vec3{0, 0, 2}));
  EXPECT_TRUE(panel.round && !panel.twoSided && !panel.cone);
}

TEST(Light, CopiesShareUntilOneIsEdited) {
  const Light first = PointLight{.color = Color(1)};
  Light second = first;
  EXPECT_EQ(second, first);
  EXPECT_EQ(second.as<PointLight>(), first.as<PointLight>());
  *editableValue<Real>(second, "radius") = 1;
  EXPECT_TRUE(second.hasSize() && !first.hasSize());
  EXPECT_FALSE(second == first);
  EXPECT_FALSE(second.as<SpotLight>() || second.edit<SpotLight>());
}

// --- Warn's light -------------------------------------------------------------------------------------

TEST(WarnLight, ItsLobeIsAPowerOfTheCosine) {
  for (const Real exponent : {0.0, 1.0, 2.5, 40.0}) {
    const WarnLight light{
        .position = {1, 2, 3}, .direction = {0, 0, -2}, .color = Color(1), .exponent = exponent};
    const auto at = [&](const Vec3& d) {
      const auto arriving = light.illuminate(light.position + d * 2, {});
      return arriving ? arriving->intensity().g : 0;
    };
    for (const Real off : {0.0, 0.3, 1.0, 1.5})
      EXPECT_NEAR(at({std::sin(off), 0, -std::cos(off)}), std::pow(std::cos(off), exponent), 1e-12);
    EXPECT_EQ(at({0, 0, 1}), 0) << "behind it";
    // Over the sphere it is 2 pi / (exponent + 1).
    constexpr int kRows = 20000;
    Real power = 0;
    for (int i = 0; i < kRows; ++i) {
      const Real z = (i + 0.5) / kRows;
      power += at({std::sqrt(1 - z * z), 0, -z}) * 2 * kPi / kRows;
    }
    EXPECT_NEAR(power, 2 * kPi / (exponent + 1), 1e-6) << exponent;
  }
}

TEST(WarnLight, FlapsAreHalfSpacesAndTheConeIsSharp) {
  WarnLight light{.position = {0, 5, 0}, .direction = {0, -1, 0}, .color = Color(1), .exponent = 0};
  light.xMin = -1, light.xMax = 0.5, light.zMax = 2;
  const auto lit = [&](const Vec3& p) { return light.illuminate(p, {}).has_value(); };
  const auto next = [](Real x) { return std::nextafter(x, kInfinity); };
  const auto before = [](Real x) { return std::nextafter(x, -kInfinity); };
  for (const Real z : {-3.0, 0.0, 2.0}) {
    EXPECT_TRUE(lit({0.5, 0, z}) && lit({-1, 0, z}));
    EXPECT_FALSE(lit({next(0.5), 0, z}) || lit({before(-1), 0, z}));
  }
  EXPECT_FALSE(lit({0, 0, next(2)}));
  EXPECT_TRUE(lit({0, 0, -100})) << "no flap there";
  light = {.position = {0, 5, 0}, .direction = {0, -1, 0}, .color = Color(1), .exponent = 3, .angle = 30};
  const auto at = [&](Real degrees) { return Vec3{std::tan(degrees * kPi / 180), 4, 0}; };
  EXPECT_TRUE(light.illuminate(at(29.999), {}));
  EXPECT_NEAR(light.illuminate(at(29.999), {})->intensity().r, std::pow(std::cos(kPi / 6), 3), 1e-4);
  EXPECT_FALSE(light.illuminate(at(30.001), {}));
}

// --- the projector ------------------------------------------------------------------------------------

/// Four texels: red, green above blue, white.
std::shared_ptr<const MipMap> slide() {
  Picture picture(2, 2);
  picture.at(0, 0) = {1, 0, 0}, picture.at(1, 0) = {0, 1, 0};
  picture.at(0, 1) = {0, 0, 1}, picture.at(1, 1) = Color(1);
  return std::make_shared<const MipMap>(picture);
}

TEST(Projector, ThrowsItsPictureUprightAndTheRightWayRound) {
  ProjectorLight light{.position = {0, 0, 5}, .direction = {0, 0, -1}, .color = Color(2)};
  light.file.map = slide();
  light.filter = TexelFilter::nearest;
  light.fov = 90;
  const auto at = [&](Real x, Real y) {
    const auto arriving = light.illuminate({x, y, 0}, {});
    return arriving ? arriving->intensity() : Color(-1);
  };
  // As seen from the projector, which looks along -z with x to the right.
  EXPECT_EQ(at(-2, 2), Color(2, 0, 0));
  EXPECT_EQ(at(2, 2), Color(0, 2, 0));
  EXPECT_EQ(at(-2, -2), Color(0, 0, 2));
  EXPECT_EQ(at(2, -2), Color(2));
  EXPECT_EQ(at(4.99, 4.99), Color(0, 2, 0)) << "it is 10 wide and high there";
  EXPECT_EQ(at(5.01, 0), Color(-1));
  EXPECT_EQ(at(0, -5.01), Color(-1));
  EXPECT_FALSE(light.illuminate({0, 0, 6}, {})) << "behind it";
  light.aspectRatio = 0.5;
  EXPECT_EQ(at(2.51, 0), Color(-1));
  EXPECT_EQ(at(2.49, 1), Color(0, 2, 0));
  light.filter = TexelFilter::bilinear;
  EXPECT_NEAR(at(0, 0).r, 2 * 0.5, 1e-12) << "the mean of four texels";
  EXPECT_NEAR(at(0, 0).g, 2 * 0.5, 1e-12);
  light.filter = TexelFilter::trilinear;
  light.blur = 1;
  EXPECT_NEAR(at(-1, 3).r, 2 * 0.5 * 0.5 * 0.7, 1e-9) << "all of it is blurred into one, its frame with it";
}

TEST(Projector, OutOfFocusItsFrameIsSoftAndItKeepsItsLight) {
  ProjectorLight light{.position = {0, 0, 5}, .direction = {0, 0, -1}, .color = Color(1)};
  light.fov = 90;  // 10 wide and high at z = 0
  const auto at = [&](Real x) {
    const auto arriving = light.illuminate({x, 0, 0}, {});
    return arriving ? arriving->intensity().g : 0;
  };
  Real sharp = 0, soft = 0;
  for (Real x = -7.995; x < 8; x += 0.01) sharp += at(x);
  light.blur = 0.2;
  EXPECT_NEAR(at(5), 0.5, 1e-12);
  EXPECT_NEAR(at(4.5), 0.75, 1e-12);
  EXPECT_NEAR(at(5.5), 0.25, 1e-12);
  EXPECT_NEAR(at(3.9), 1, 1e-12);
  EXPECT_EQ(at(6.01), 0);
  for (Real x = -7.995; x < 8; x += 0.01) soft += at(x);
  EXPECT_NEAR(soft / sharp, 1, 1e-3);
  EXPECT_GE(light.reach({}).around, std::atan(1.2)) << "a tree of lights knows of it";
}

TEST(Projector, NumbersOfSrgbBecomeLinear) {
  Picture grey(1, 1);
  grey.at(0, 0) = Color(0.5);
  ProjectorLight light{.position = {0, 0, 5}, .direction = {0, 0, -1}, .color = Color(1)};
  light.file.map = std::make_shared<const MipMap>(grey);
  EXPECT_NEAR(light.illuminate({}, {})->intensity().g, 0.5, 1e-6);
  light.srgb = true;
  EXPECT_NEAR(light.illuminate({}, {})->intensity().g, 0.2140, 1e-3);
}

// --- lights that are seen -----------------------------------------------------------------------------

TEST(Light, WhatIsSeenOfItIsWhatLights) {
  RectangleLight panel{.position = {0.2, 0, 3}, .u = {2, 0, 0}, .v = {0.5, -1, 0}, .color = Color(3)};
  PointLight ball{.position = {0.3, 0.2, 3}, .color = Color(5)};
  ball.radius = 0.5;
  const auto check = [](auto light) {
    EXPECT_FALSE(light.seen(Ray{{}, {0, 0, 1}}, {})) << "not asked for";
    light.visible = true;
    // The mean over directions of the radiance that is seen, by the cosine, is what a white surface gives
    // back.
    constexpr int kSide = 1500;
    Real seen = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Vec2 disk{2 * (i + 0.5) / kSide - 1, 2 * (j + 0.5) / kSide - 1};
        const Real r2 = disk.x * disk.x + disk.y * disk.y;
        if (r2 >= 1) continue;
        const Vec3 d{disk.x, disk.y, std::sqrt(1 - r2)};
        if (const auto met = light.seen(Ray{{}, d}, {})) seen += met->color.g * 4 / (kPi * kSide * kSide);
      }
    const Real lights = given(light, {0, 0, 1});
    EXPECT_NEAR(seen, lights, 0.002 * lights);
  };
  check(panel);
  check(ball);
  panel.visible = true;
  EXPECT_FALSE(panel.seen(Ray{{0, 0, 6}, {0, 0, -1}}, {})) << "from behind";
  panel.twoSided = true;
  EXPECT_EQ(panel.seen(Ray{{0, 0, 6}, {0, 0, -1}}, {})->t, 3);
}

}  // namespace
}  // namespace trace
