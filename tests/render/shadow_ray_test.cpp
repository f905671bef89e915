// Shadow rays through glass: one query finds everything in their way, and anything opaque ends it.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/solids/square.h"
#include "render/rays/tracer.h"
#include "support/scenes.h"

namespace trace::test::shadow_ray_test {
namespace {

constexpr int kPanes = 20;
const Ray kAlong{{0.1, 0.2, 0}, {0, 0, 1}};
constexpr Real kDistance = kPanes + 10;

/// Panes across the z axis at z = 1, 2, ..., each of which lets 0.9 through.
Scene panes() {
  Scene scene;
  Phong pane;
  pane.transmissive = Color(0.9);
  for (int i = 1; i <= kPanes; ++i) addObject(scene, Square{}, Affine::translation({0, 0, i * 1.0}), pane);
  return scene;
}

TEST(ShadowRay, AsksOnceForAllTheGlassInItsWay) {
  const Settings settings;
  const World world = build(panes(), settings);
  Tracer tracer(world, settings);
  const Color passed = tracer.visible(kAlong.origin, kAlong.direction, kDistance, Interfaces());
  EXPECT_NEAR(passed.r, std::pow(0.9, kPanes), 1e-12);

  Statistics once, fromPaneToPane;
  world.crossings(kAlong, kDistance, Faces::both, once, [](const Found&) { return false; });
  EXPECT_EQ(tracer.statistics().nodes, once.nodes);
  EXPECT_EQ(tracer.statistics().tests, once.tests);
  Ray ray = kAlong;
  while (const auto found = world.closest(ray, Faces::both, fromPaneToPane))
    ray = Hit(world, ray, *found).leave(ray.direction);
  EXPECT_GT(fromPaneToPane.nodes.count, 5 * once.nodes.count);
}

TEST(ShadowRay, EndsAtAnythingOpaqueWhateverGlassIsBefore) {
  const Settings settings;
  Scene scene = panes();
  addObject(scene, Square{}, Affine::translation({0, 0, kPanes + 1.0}), Phong{});
  const World world = build(scene, settings);
  Tracer tracer(world, settings);
  const auto blocked = [&](Real distance) {
    return tracer.visible(kAlong.origin, kAlong.direction, distance, Interfaces()) == Color(0);
  };
  EXPECT_TRUE(blocked(kDistance));
  EXPECT_FALSE(blocked(kPanes + 0.5)) << "it is behind the light";
}

}  // namespace
}  // namespace trace::test::shadow_ray_test
