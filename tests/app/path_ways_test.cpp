// The ways of bdpt that are read from a sample's rays.
#include "app/explain/path_ways.h"

#include <gtest/gtest.h>

#include <array>

#include "app/session/session.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// A floor, a ball that shines above it, and a light.
Scene lampOverFloor() {
  Scene scene;
  Phong shining, grey;
  shining.emissive = Color(4);
  grey.diffuse = Color(0.7);
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({8, 8, 1}), grey);
  addObject(scene, Square{}, Affine::translation({0, 2, -3}) * Affine::scaling({8, 8, 1}), grey);
  addObject(scene, Sphere{}, Affine::translation({0, 2, 0}) * Affine::scaling({0.3, 0.3, 0.3}), shining);
  scene.objects[2].name = "lamp";
  scene.camera.position = {0, 1, 6};
  return scene;
}

struct TracedWays {
  Session session;
  Explanation explained;
};
void traceWays(TracedWays& traced, int x, int y, IntegratorKind integrator, int sample = 3) {
  Settings settings;
  settings.width = 24;
  settings.depth = 4;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.spp = 64;
  traced.session.open(lampOverFloor(), settings);
  traced.session.build();
  traced.explained = traced.session.explain(x, y, sample);
}

TEST(PathWays, BringWhatTheSampleIs) {
  for (const auto& [x, y] : {std::array{12, 20}, std::array{5, 16}, std::array{12, 6}}) {
    TracedWays traced;
    traceWays(traced, x, y, IntegratorKind::bdpt);
    const RayTree& tree = traced.explained.tree;
    const std::vector<PathWay> ways = pathWays(tree);
    ASSERT_FALSE(ways.empty());
    Color sum;
    for (const PathWay& way : ways) sum += way.brings;
    const Color sample = tree.nodes.front().radiance * tree.nodes.front().weight;
    EXPECT_NEAR(sum.r, sample.r, 1e-12);
    EXPECT_NEAR(sum.b, sample.b, 1e-12);
  }
}

/// Holds each way to its numbers; how many of them were joined from both ends.
int checkedWays(const RayTree& tree) {
  const auto ray = [&](int i) -> const RayNode& { return tree.nodes[static_cast<std::size_t>(i)]; };
  int joined = 0;
  for (const PathWay& way : pathWays(tree)) {
    int fromCamera = 1, fromLight = way.light > 0 ? 1 : 0;
    for (int i = way.end; i >= 0; i = ray(i).parent) ++fromCamera;
    for (int i = way.start; i >= 0; i = ray(i).parent) ++fromLight;
    EXPECT_EQ(fromCamera, way.camera);
    EXPECT_EQ(fromLight, way.light);
    const std::vector<int> rays = raysOf(tree, way);
    EXPECT_EQ(static_cast<int>(rays.size()), way.places() - 1);
    if (way.camera == 1) {  // straight to the eye
      const Ray& seen = ray(way.between).ray;
      EXPECT_LT(length(seen.origin - ray(way.start).hit->surface.point), 1e-9);
      EXPECT_LT(length(seen.at(ray(way.between).tMost) - ray(0).ray.origin), 1e-3);
      EXPECT_EQ(way.brings, Color());
      continue;
    }
    EXPECT_EQ(rays.front(), 0);
    if (way.light < 2) continue;
    ++joined;
    // The ray between leads from the one end's last place to the other's.
    const Ray& between = ray(way.between).ray;
    EXPECT_LT(length(between.origin - ray(way.end).hit->surface.point), 1e-9);
    EXPECT_LT(length(between.at(ray(way.between).tMost) - ray(way.start).hit->surface.point), 1e-3);
  }
  return joined;
}

TEST(PathWays, HaveAsManyPlacesAsTheySay) {
  int joined = 0;
  for (int sample = 0; sample < 64; ++sample) {
    TracedWays traced;
    traceWays(traced, 12, 20, IntegratorKind::bdpt, sample);
    joined += checkedWays(traced.explained.tree);
  }
  EXPECT_GT(joined, 4);
}

TEST(PathWays, SomeAreSeenByTheCameraElsewhere) {
  int seen = 0;
  for (int sample = 0; sample < 16; ++sample) {
    TracedWays traced;
    traceWays(traced, 12, 20, IntegratorKind::bdpt, sample);
    for (const PathWay& way : pathWays(traced.explained.tree)) seen += way.camera == 1;
  }
  EXPECT_GT(seen, 4);
}

TEST(PathWays, AreOfBdptAlone) {
  TracedWays traced;
  traceWays(traced, 12, 20, IntegratorKind::path);
  EXPECT_TRUE(pathWays(traced.explained.tree).empty());
}

TEST(PathWays, SayWhatWasMetAndAsked) {
  TracedWays traced;
  traceWays(traced, 12, 6, IntegratorKind::bdpt);
  bool asked = false;
  for (const PathWay& way : pathWays(traced.explained.tree)) {
    const std::string text = sentence(way, traced.explained.tree, traced.session.scene());
    asked = asked || text == "asked lamp";
    EXPECT_FALSE(text.empty());
  }
  EXPECT_TRUE(asked);
}

TEST(PathWays, WhereThereAreNoneItIsSaidWhy) {
  TracedWays traced;
  traceWays(traced, 12, 20, IntegratorKind::bdpt);
  const RayTree& tree = traced.explained.tree;
  Settings settings = traced.session.settings();
  EXPECT_TRUE(hasTrait(settings, Trait::joinsEnds));
  EXPECT_EQ(whyNoWays(tree, settings), "No paths were joined in this sample. Another sample may have some.");
  settings.cameraVertices = 3;
  EXPECT_EQ(
      whyNoWays(tree, settings),
      "No paths were joined in this sample with 3 places from the camera's end, as camera-vertices says. "
      "Another sample may have some.");
  settings.lightVertices = 1;
  EXPECT_NE(
      whyNoWays(tree, settings).find("with 1 place from the light's end, as light-vertices says, and 3"),
      std::string::npos);
  RayTree sky = tree;
  sky.nodes.front().hit.reset();
  EXPECT_EQ(whyNoWays(sky, settings),
            "The camera ray hit nothing, so there is no vertex to connect with a light.");
  settings.integrator = IntegratorKind::path;
  EXPECT_FALSE(hasTrait(settings, Trait::joinsEnds));
}

}  // namespace
}  // namespace trace::test
