// The sentence that says why a pixel has its colour, the sum, and the cures.
#include "app/explain/pixel_why.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/session.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "shading/lights/ambient_light.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// A ball at the origin, seen from the front.
Scene ballOf(const Phong& material) {
  Scene scene;
  addObject(scene, Sphere{}, {}, material);
  scene.objects.back().name = "ball";
  scene.camera.position = {0, 0, 6};
  return scene;
}

PixelWhy whyOf(const Scene& scene, Settings settings, int x = 20, int y = 20) {
  settings.width = settings.height = 40;
  Session session;
  session.open(scene, settings);
  session.build();
  const Explanation explanation = session.explain(x, y, 0);
  return trace::whyOf(explanation.tree, session.scene(), 0);
}

Phong grey() {
  Phong grey;
  grey.diffuse = Color(0.7);
  return grey;
}

TEST(PixelWhy, GlassIsBlackForTheRayThatTheDepthDidNotSend) {
  Phong glass;
  glass.transmissive = Color(0.9), glass.index = 1.5;
  Scene scene = ballOf(glass);
  Phong sky;
  sky.emissive = Color(0.8);
  addObject(scene, Sphere{}, Affine::scaling({50, 50, 50}), sky);
  const PixelWhy why = whyOf(scene, {.depth = 1});
  EXPECT_EQ(why.sentence, "Black: the ray that should leave ball was not sent: depth limit 1.");
  EXPECT_EQ(why.ray, 1);
  ASSERT_EQ(why.cures.size(), 2u);
  EXPECT_EQ(why.cures[0].label, "depth 2");
  EXPECT_EQ(why.cures[1].option, "depth");
  EXPECT_EQ(why.cures[1].value, "5");
  // The cure cures.
  const PixelWhy cured = whyOf(scene, {.depth = 5});
  EXPECT_EQ(cured.ray, -1) << cured.sentence;
  EXPECT_TRUE(cured.cures.empty());
}

TEST(PixelWhy, AMirrorIsBlackForItsReflection) {
  Phong mirror;
  mirror.reflective = Color(0.9);
  const PixelWhy why = whyOf(ballOf(mirror), {.depth = 0});
  EXPECT_EQ(why.sentence, "Black: the ray that ball should reflect was not sent: depth limit 0.");
  EXPECT_EQ(why.cures.front().value, "1");
}

TEST(PixelWhy, TheLastOfManyBouncesIsNotToBlame) {
  Phong white;
  white.diffuse = Color(0.9), white.emissive = Color(0.05);
  Scene room;
  addObject(room, Cube{}, Affine::scaling({8, 8, 8}), white);
  room.objects.back().name = "room";
  room.camera.position = {0, 0, 2};
  const PixelWhy why = whyOf(room, {.integrator = IntegratorKind::path, .depth = 4});
  EXPECT_EQ(why.ray, -1) << why.sentence;
  EXPECT_EQ(why.sentence.find("depth limit"), std::string::npos) << why.sentence;
}

TEST(PixelWhy, AShadowNamesWhatBlocksTheLight) {
  Scene scene = ballOf(grey());
  addObject(scene, Cube{}, Affine::translation({0, 0, 8}), grey());
  scene.objects.back().name = "wall";
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  const PixelWhy why = whyOf(scene, {});
  EXPECT_EQ(why.sentence, "Black: wall blocks sun from ball.");
  EXPECT_GE(why.ray, 0);
  ASSERT_EQ(why.cures.size(), 1u);
  EXPECT_EQ(why.cures[0].label, "Select wall");
  EXPECT_EQ(why.cures[0].object, 1u);
}

TEST(PixelWhy, ASurfaceThatFacesAwaySaysSo) {
  Scene scene = ballOf(grey());
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, 1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  EXPECT_EQ(whyOf(scene, {}).sentence, "Black: ball faces away from sun.");
}

TEST(PixelWhy, WithoutALightNothingReachesIt) {
  EXPECT_EQ(whyOf(ballOf(grey()), {}).sentence, "Black: no light reaches ball.");
}

TEST(PixelWhy, ABackgroundIsNamed) {
  const PixelWhy why = whyOf(ballOf(grey()), {}, 0, 0);
  EXPECT_EQ(why.sentence.find("Black: left the scene"), 0u) << why.sentence;
  EXPECT_TRUE(why.cures.empty());
}

TEST(PixelWhy, TheSummandsAddUpToTheRadiance) {
  Phong material = grey();
  material.ambient = Color(0.3), material.reflective = Color(0.2);
  Scene scene = ballOf(material);
  scene.lights.push_back({AmbientLight{.color = Color(0.5)}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.lights.back().links.name = "sun";
  Settings settings{.width = 40, .height = 40, .depth = 3};
  Session session;
  session.open(scene, settings);
  session.build();
  const Explanation explanation = session.explain(20, 20, 0);
  const PixelWhy why = trace::whyOf(explanation.tree, session.scene(), 0);
  Color sum;
  for (const WhySummand& each : why.sum) sum = sum + each.color;
  const Color whole = explanation.tree.nodes.front().radiance;
  EXPECT_NEAR(sum.r, whole.r, 1e-12);
  // Ray by ray the sum grows to the whole.
  Real before = 0;
  for (int rays = 0; rays <= static_cast<int>(explanation.tree.nodes.size()); ++rays) {
    const Real after = sumAfter(why.sum, rays).r;
    EXPECT_GE(after, before) << rays;
    before = after;
  }
  EXPECT_EQ(sumAfter(why.sum, 0), Color(0));
  EXPECT_NEAR(before, whole.r, 1e-12);
  EXPECT_EQ(why.sentence, "ball shows mostly light sun.");
  const bool named = std::any_of(why.sum.begin(), why.sum.end(),
                                 [](const WhySummand& each) { return each.name == "ambient"; });
  EXPECT_TRUE(named);
}

TEST(PixelWhy, EveryRayHasAnEquation) {
  Phong mirror = grey();
  mirror.reflective = Color(0.5);
  Scene scene = ballOf(mirror);
  scene.lights.push_back({AmbientLight{.color = Color(0.2)}, {}});
  Session session;
  session.open(scene, {.width = 40, .height = 40});
  session.build();
  const RayTree tree = session.explain(20, 20, 0).tree;
  const std::string camera = equationOf(tree, session.scene(), 0);
  EXPECT_NE(camera.find(" = "), std::string::npos) << camera;
  EXPECT_NE(camera.find("reflection "), std::string::npos) << camera;
  for (int ray = 0; ray < static_cast<int>(tree.nodes.size()); ++ray) {
    Color sum;
    for (const WhySummand& each : sumOf(tree, session.scene(), ray)) sum = sum + each.color;
    if (rayAt(tree, ray).kind != RayKind::shadow) EXPECT_NEAR(sum.r, rayAt(tree, ray).radiance.r, 1e-12);
  }
}

}  // namespace
}  // namespace trace::test
