// Fog against closed forms and quadrature.
#include "render/rays/fog.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/scenes.h"

namespace trace::test::fog_test {
namespace {

Settings fogSettings(Real density, const Color& color = Color(1)) {
  Settings settings;
  settings.width = settings.height = 4;
  settings.fog = density;
  settings.fogColor = color;
  return settings;
}

Color middle(const Scene& scene, const Settings& settings) { return picture(scene, settings).at(2, 2); }

Scene looking() {
  Scene scene;
  scene.camera.viewdir = {0, 0, -1};
  scene.camera.fov = 1e-4;
  return scene;
}

/// The integral of f from a to b, by so many steps.
template <class F>
Real integral(Real a, Real b, F&& f, int steps = 20000) {
  Real sum = 0;
  for (int i = 0; i < steps; ++i) sum += f(a + (b - a) * (i + 0.5) / steps);
  return sum * (b - a) / steps;
}

TEST(Fog, SwallowsWhatASurfaceSends) {
  Scene scene = looking();
  Phong shining;
  shining.emissive = Color(1);
  addObject(scene, Square{}, Affine::translation({0, 0, -5}), shining);
  EXPECT_NEAR(middle(scene, fogSettings(0.3, Color(0))).g, std::exp(-1.5), 1e-9);
}

TEST(Fog, SwallowsTheLightOfALampOnItsWay) {
  Scene scene = looking();
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Square{}, Affine::translation({0, 0, -5}), white);
  scene.lights.push_back(
      {PointLight{.position = {0, 0, -2}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  EXPECT_NEAR(middle(scene, fogSettings(0.3, Color(0))).g, std::exp(-0.3 * (5 + 3)), 1e-6);
}

TEST(Fog, ShowsASunByItsPhaseFunction) {
  Scene scene = looking();
  scene.lights.push_back({DirectionalLight{.direction = {1, 0, 1}, .color = Color(2)}, {}});
  Settings settings = fogSettings(0.3, {1, 0.5, 0});
  for (const Real forward : {0.0, 0.7, -0.4}) {
    settings.fogForward = forward;
    // The light goes on along (1, 0, 1) and is seen from along (0, 0, -1): it turns by 45 degrees.
    const Real cosine = std::sqrt(0.5), base = 1 + forward * forward - 2 * forward * cosine;
    const Real phase = (1 - forward * forward) / (4 * kPi * std::pow(base, 1.5));
    const Color seen = middle(scene, settings);
    EXPECT_NEAR(seen.r, 2 * kPi * phase, 1e-6) << forward;
    EXPECT_NEAR(seen.g, kPi * phase, 1e-6);
    EXPECT_EQ(seen.b, 0);
  }
}

TEST(Fog, GivesBackTheAmbientLight) {
  Scene scene = looking();
  scene.lights.push_back({AmbientLight{.color = {0.2, 0.4, 0.6}}, {}});
  addObject(scene, Square{}, Affine::translation({0, 0, -5}), Phong{});
  const Color seen = middle(scene, fogSettings(0.3));
  EXPECT_NEAR(seen.b, 0.6 * (1 - std::exp(-1.5)), 1e-9);
  EXPECT_NEAR(seen.r, 0.2 * (1 - std::exp(-1.5)), 1e-9);
}

TEST(Fog, ThinsOutUpwardAsTheIntegralSays) {
  Settings settings = fogSettings(0.3);
  settings.fogHeight = 2;
  const Fog fog(settings);
  for (const Vec3& direction : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0.6, -0.8, 0}, Vec3{0.28, 0.96, 0}}) {
    const Ray ray{{0, 1.5, 0}, direction};
    const Real expected = integral(0, 3, [&](Real t) { return 0.3 * std::exp(-ray.at(t).y / 2); });
    EXPECT_NEAR(fog.depth(ray, 3) / expected, 1, 1e-6);
    EXPECT_NEAR(fog.distance(ray, fog.depth(ray, 3)), 3, 1e-9);
  }
  EXPECT_NEAR(fog.depth({{0, 0, 0}, {0, 1, 0}}, kInfinity), 0.6, 1e-12) << "upward it has an end";
  EXPECT_EQ(fog.distance({{0, 0, 0}, {0, 1, 0}}, 0.7), kInfinity);
  EXPECT_EQ(fog.depth({{0, 0, 0}, {0, -1, 0}}, kInfinity), kInfinity);
}

TEST(Fog, LiesOnTheGroundForAnEyeFarAboveToo) {
  Settings settings = fogSettings(0.5);
  settings.fogHeight = 1;
  const Fog fog(settings);
  for (const Real height : {5.0, 29.0, 31.0, 100.0, 2000.0}) {
    const Ray down{{0, height, 0}, {0, -1, 0}};
    EXPECT_NEAR(fog.depth(down, height), 0.5 * (1 - std::exp(-height)), 1e-9) << height;
    EXPECT_NEAR(fog.distance(down, 0.5 * (std::exp(-1.0) - std::exp(-height))), height - 1, 1e-9 * height)
        << height;
  }
}

TEST(Fog, ScattersAllLightSomewhere) {
  for (const Real forward : {-0.9, 0.0, 0.6}) {
    Settings settings = fogSettings(1);
    settings.fogForward = forward;
    const Fog fog(settings);
    const Real sum = integral(-1, 1, [&](Real cosine) { return 2 * kPi * phase(fog.forward(), cosine); });
    const Real mean = integral(-1, 1, [&](Real cosine) {
      // The light goes on with this cosine: from `direction` it is seen against the ray.
      return 2 * kPi * cosine * phase(fog.forward(), cosine);
    });
    EXPECT_NEAR(sum, 1, 1e-4);
    EXPECT_NEAR(mean, forward, 1e-4);
  }
}

TEST(Fog, IsLitByObjectsThatShine) {
  Scene scene = looking();
  Phong shining;
  shining.emissive = Color(50);
  const Real radius = 0.05;
  addObject(scene, Sphere{}, Affine::translation({1, 0, -3}) * Affine::scaling({radius, radius, radius}),
            shining);
  Settings settings = fogSettings(0.2);
  settings.integrator = IntegratorKind::path;
  settings.sampling = SampleKind::sobol;
  settings.spp = 4096;
  settings.depth = settings.mediumDepth = 1;
  const Real expected = integral(0, 60, [&](Real s) {
    const Real away2 = 1 + (s - 3) * (s - 3);
    const Real angle = 2 * kPi * (1 - std::sqrt(1 - radius * radius / away2));
    return 0.2 * std::exp(-0.2 * (s + std::sqrt(away2) - radius)) * 50 * angle / (4 * kPi);
  });
  EXPECT_NEAR(middle(scene, settings).g / expected, 1, 0.02);
}

TEST(Fog, GoesOnBehindAnOpenSheetOfGlass) {
  Phong shining, pane;
  shining.emissive = Color(1);
  pane.transmissive = Color(1);
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path}) {
    Scene scene = looking();
    addObject(scene, Square{}, Affine::translation({0, 0, -5}), shining);
    addObject(scene, Square{}, Affine::translation({0, 0, -2}), pane);
    Settings settings = fogSettings(0.3, Color(0));
    settings.integrator = integrator;
    EXPECT_NEAR(middle(scene, settings).g, std::exp(-1.5), 1e-9);
  }
}

TEST(Fog, IsNotMetByTheLastBounceOfDirectLight) {
  Scene scene = looking();
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Square{}, Affine::translation({0, 0, -5}) * Affine::scaling({9, 9, 1}), white);
  scene.lights.push_back(
      {PointLight{.position = {0, 0, -2}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  Settings settings = fogSettings(0.3, Color(0.8));
  settings.spp = 1024;
  settings.sampling = SampleKind::sobol;
  const Real whitted = middle(scene, settings).g;
  settings.integrator = IntegratorKind::direct;
  EXPECT_NEAR(middle(scene, settings).g / whitted, 1, 0.01);
}

TEST(Fog, ThatIsNextToNothingIsNothing) {
  Scene scene = looking();
  scene.lights.push_back(
      {PointLight{.position = {0, 2, -2}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  for (const Real density : {1e-100, 1e-160, 1e-290, 1e-310})
    EXPECT_TRUE(isFinite(middle(scene, fogSettings(density))));
}

TEST(Fog, HasTheSameBitsForAnyNumberOfThreads) {
  Scene scene = looking();
  scene.camera.fov = 40;
  addObject(scene, Sphere{}, Affine::translation({0, 0, -4}), Phong{});
  scene.lights.push_back({PointLight{.position = {1, 3, -4}, .color = Color(1), .radius = 0.3}, {}});
  Settings settings = fogSettings(0.2);
  settings.width = settings.height = 24;
  settings.spp = 4;
  settings.threads = 1;
  const Picture one = picture(scene, settings);
  settings.threads = 7;
  EXPECT_EQ(one, picture(scene, settings));
}

}  // namespace
}  // namespace trace::test::fog_test
