// Integrators against one another, tile by tile: rooms with an open lamp, a mirror, glass, and a lamp behind
// a door. `ray selftest` does the same with more.
#include "render/picture/agreement.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "support/rooms.h"

namespace trace::test::agreement_test {
namespace {

Scene room() {
  Scene scene = openRoom({0.6, 0.1, 0.1}, {0.1, 0.5, 0.1});
  scene.camera.position = {0, 0, 3.8};
  scene.camera.fov = 36;
  return scene;
}

void addLamp(Scene& scene, const Vec3& place, Real size, Real light) {
  addObject(scene, Square{},
            Affine::translation(place) * turned({1, 0, 0}, 0.5) * Affine::scaling({size, size, 1}),
            diffuse(Color(0.5), light));
}

struct Case {
  const char* name;
  Scene scene;
};
std::vector<Case> cases() {
  const Affine ball = Affine::translation({0.3, -0.5, 0.2}) * Affine::scaling({0.45, 0.45, 0.45});
  std::vector<Case> all{{"diffuse", room()}, {"mirror", room()}, {"glass", room()}, {"door", room()}};
  for (int i = 0; i < 3; ++i) addLamp(all[static_cast<std::size_t>(i)].scene, {0, 0.98, 0}, 0.8, 8);
  Phong mirror, glass;
  mirror.reflective = Color(0.9);
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  addObject(all[0].scene, Cube{}, ball * turned({0, 1, 0}, 0.1), diffuse(Color(0.6)));
  addObject(all[1].scene, Sphere{}, ball, mirror);
  addObject(all[2].scene, Sphere{}, ball, glass);
  addObject(
      all[3].scene, Cube{},
      Affine::translation({-0.5, 0, 0.1}) * turned({0, 1, 0}, 0.42) * Affine::scaling({0.05, 1.98, 1.3}),
      diffuse(Color(0.6)));
  addLamp(all[3].scene, {-0.75, 0.8, -0.5}, 0.4, 40);
  return all;
}

Settings settingsOf(IntegratorKind integrator, int spp, Chains chains = Chains::path) {
  Settings settings;
  settings.integrator = integrator;
  settings.chains = chains;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = 16;
  settings.depth = 3, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  settings.chainStarts = 20000;
  return settings;
}

TEST(Agreement, BidirectionalPathsShowWhatPathsShowInEveryTile) {
  for (const Case& c : cases()) {
    const Agreement a =
        agreement(c.scene, settingsOf(IntegratorKind::path, 64), settingsOf(IntegratorKind::bdpt, 24), 8, 4);
    EXPECT_EQ(a.p.size(), 16u);
    EXPECT_GT(a.uniform, 0.01) << c.name << " " << a.meanA << " " << a.meanB;
    EXPECT_NEAR(a.meanA, a.meanB, 3.5 * a.error) << c.name;
    EXPECT_LT(a.error, 0.05 * a.meanA) << c.name << ": or nothing is shown";
  }
}

TEST(Agreement, ChainsShowTheLightOfPaths) {
  for (const Case& c : cases())
    for (const Chains chains : {Chains::path, Chains::bdpt}) {
      // The brightness of all is known by the first samples only: tiles go up and down together.
      const Agreement a = agreement(c.scene, settingsOf(IntegratorKind::path, 48),
                                    settingsOf(IntegratorKind::mlt, 48, chains), 6, 8);
      EXPECT_NEAR(a.meanA, a.meanB, 3.5 * a.error) << c.name << " " << static_cast<int>(chains);
      EXPECT_LT(a.error, 0.08 * a.meanA) << c.name;
      for (const double p : a.p) EXPECT_GT(p, 1e-4) << c.name << " " << static_cast<int>(chains);
    }
}

TEST(Agreement, DifferentLightIsFound) {
  Scene darker = room(), brighter = room();
  addLamp(brighter, {0, 0.98, 0}, 0.8, 8);
  const Settings settings = settingsOf(IntegratorKind::path, 32);
  Settings shorter = settings;
  shorter.depth = 2;
  const Agreement a = agreement(brighter, settings, shorter, 8, 4);
  EXPECT_LT(a.uniform, 1e-4) << "one bounce less is another picture";
}

}  // namespace
}  // namespace trace::test::agreement_test
