// Objects and lights that cast no shadow: Material::castsShadow and LightLinks::castsShadows.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/explain.h"
#include "scene/scene_features.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/rooms.h"

namespace trace::test::shadowless_test {
namespace {

Affine at(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }

void add(Scene& scene, Shape shape, const Affine& transform, const Phong& model, bool castsShadow = true) {
  scene.materials.push_back({.name = "", .model = model, .castsShadow = castsShadow});
  const auto material = static_cast<std::uint32_t>(scene.materials.size() - 1);
  scene.objects.push_back({"", std::move(shape), transform, material, {}});
}

Settings smallSettings(IntegratorKind kind, int samples) {
  Settings settings{.width = 8, .spp = samples, .integrator = kind, .depth = 4};
  settings.sampling = SampleKind::sobol;
  settings.threads = 1;
  settings.photons = 2000;
  settings.lampSamples = 1;
  return settings;
}

/// A floor that the camera sees from below all lights; `light` is what lights it.
enum class Lit { byPoint, bySun, byLamp };
Scene floorLit(Lit light) {
  Scene scene;
  add(scene, Square{}, at(0, 0, -4) * Affine::scaling({30, 30, 1}), diffuse(0.7));
  if (light == Lit::byLamp) add(scene, Sphere{}, at(0, 0, 3), diffuse(0, 6));
  if (light == Lit::byPoint)
    scene.lights.push_back({PointLight{.position = {-1, 0.5, 3}, .color = Color(0.8)}, {}});
  if (light == Lit::bySun)
    scene.lights.push_back({DirectionalLight{.direction = {0.2, 0.1, -1}, .color = Color(0.5)}, {}});
  scene.camera.position = {0, 0, -1};
  scene.camera.fov = 50;
  return scene;
}

/// A black pane above the camera, in the way of all light.
void addPane(Scene& scene, bool castsShadow) {
  add(scene, Square{}, at(0, 0, 0.5) * Affine::scaling({12, 12, 1}), diffuse(0), castsShadow);
}

/// Calls test(settings) for all integrators that show light.
template <class Test>
void forEachIntegrator(const Test& test) {
  for (const IntegratorRow& row : integrators()) {
    if (row.kind == IntegratorKind::normals || row.kind == IntegratorKind::cost) continue;
    SCOPED_TRACE(std::string(row.name));
    test(smallSettings(row.kind, row.kind == IntegratorKind::whitted ? 16 : 64));
  }
}

TEST(Shadowless, LightPassesAnObjectThatCastsNoShadow) {
  for (const Lit light : {Lit::byPoint, Lit::bySun, Lit::byLamp})
    forEachIntegrator([&](const Settings& settings) {
      SCOPED_TRACE(static_cast<int>(light));
      const Scene open = floorLit(light);
      Scene closed = open, passed = open;
      addPane(closed, true);
      addPane(passed, false);
      const Real without = mean(picture(open, settings));
      EXPECT_NEAR(mean(picture(passed, settings)), without, 0.02 * without);
      const Real rest = settings.integrator == IntegratorKind::occlusion ? 0.5 : 0.05;  // from the sides
      EXPECT_LT(mean(picture(closed, settings)), rest * without);
    });
}

TEST(Shadowless, NothingBlocksALightThatCastsNoShadows) {
  for (const Lit light : {Lit::byPoint, Lit::bySun})
    forEachIntegrator([&](const Settings& settings) {
      if (settings.integrator == IntegratorKind::occlusion) return;
      SCOPED_TRACE(static_cast<int>(light));
      const Scene open = floorLit(light);
      Scene passed = open;
      addPane(passed, true);
      passed.lights[0].links.castsShadows = false;
      const Real without = mean(picture(open, settings));
      EXPECT_NEAR(mean(picture(passed, settings)), without, 0.02 * without);
    });
}

TEST(Shadowless, TheSwitchMakesEverythingCastShadows) {
  const std::span<const std::string_view> names = sceneFeatureNames();
  Settings settings = smallSettings(IntegratorKind::whitted, 1);
  settings.switchedOff.add(
      static_cast<SceneFeature>(std::find(names.begin(), names.end(), "casts_shadow") - names.begin()));
  Scene scene = floorLit(Lit::bySun);
  addPane(scene, false);
  EXPECT_EQ(mean(picture(scene, settings)), 0);
  Scene shadowless = floorLit(Lit::bySun);
  addPane(shadowless, true);
  shadowless.lights[0].links.castsShadows = false;
  EXPECT_EQ(mean(picture(shadowless, settings)), 0);
}

TEST(Shadowless, CameraAndMirrorSeeIt) {
  for (const bool mirrored : {false, true}) {
    Scene scene;
    add(scene, Square{}, at(0, 0, mirrored ? 4 : -4) * Affine::scaling({90, 90, 1}), diffuse(0, 0.6), false);
    if (mirrored) {
      Phong mirror = diffuse(0);
      mirror.reflective = Color(1);
      add(scene, Square{}, at(0, 0, -4) * Affine::scaling({30, 30, 1}), mirror);
    }
    scene.lights.push_back({PointLight{.position = {0, 0, 1}, .color = Color(0)}, {}});
    for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt})
      EXPECT_NEAR(mean(picture(scene, smallSettings(kind, 4))), 0.6, 1e-9) << static_cast<int>(kind);
  }
}

TEST(Shadowless, ALampThatCastsNoShadowStillShines) {
  forEachIntegrator([&](const Settings& settings) {
    if (settings.integrator == IntegratorKind::occlusion) return;
    const Scene usual = floorLit(Lit::byLamp);
    Scene scene = usual;
    scene.materials.back().castsShadow = false;
    const Real expected = mean(picture(usual, settings));
    EXPECT_NEAR(mean(picture(scene, settings)), expected, 0.02 * expected);
  });
}

TEST(Shadowless, TheShadowRaySaysWhatItPassed) {
  Scene scene = floorLit(Lit::bySun);
  addPane(scene, false);
  const Settings settings = smallSettings(IntegratorKind::whitted, 1);
  const World world = build(scene, settings);
  Job job;
  const auto integrator = makeIntegrator(world, settings, job);
  const RayTree tree = explain(world, *integrator, settings, {8, 6}, 4, 4, 0).tree;
  const auto shadow = std::find_if(tree.nodes.begin(), tree.nodes.end(),
                                   [](const RayNode& node) { return node.kind == RayKind::shadow; });
  ASSERT_NE(shadow, tree.nodes.end());
  ASSERT_EQ(shadow->filters.size(), 1u);
  EXPECT_TRUE(shadow->filters[0].shadowless);
  EXPECT_EQ(shadow->radiance, Color(1));
}

}  // namespace
}  // namespace trace::test::shadowless_test
