// What the light image brings a pixel is the rest of the picture's pixel.
#include "app/explain/light_landings.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// A ball of glass between a small lamp and the floor, seen from the side.
Scene glassOverFloor() {
  Scene scene;
  Phong shining, grey, glass;
  shining.emissive = Color(40, 30, 20);
  grey.diffuse = Color(0.7);
  glass.transmissive = Color(1);
  glass.index = 1.5;
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({8, 8, 1}), grey);
  addObject(scene, Sphere{}, Affine::translation({0, 3, 0}) * Affine::scaling({0.2, 0.2, 0.2}), shining);
  addObject(scene, Sphere{}, Affine::translation({0, 1, 0}) * Affine::scaling({0.6, 0.6, 0.6}), glass);
  scene.objects[0].name = "floor";
  scene.objects[2].name = "ball";
  scene.camera.position = {0, 1, 6};
  scene.camera.aspectratio = 1.2;
  return scene;
}

Settings settingsOf(IntegratorKind integrator = IntegratorKind::bdpt) {
  Settings settings;
  settings.width = 24;
  settings.height = 20;
  settings.depth = 5;
  settings.spp = 16;
  settings.integrator = integrator;
  return settings;
}

/// Somewhere on the floor.
constexpr int kX = 12, kY = 14;

LightLandings landingsOf(Session& session, const Settings& settings, const Region& region = {}) {
  session.open(glassOverFloor(), settings);
  session.build();
  Job job;
  return lightLandings(session, region, kX, kY, job);
}

TEST(LightLandings, AreTheRestOfThePixelBitForBit) {
  for (const auto filter : {FilterKind::box, FilterKind::mitchell})
    for (const int threads : {1, 2, 7}) {
      Settings settings = settingsOf();
      settings.filter = filter;
      settings.threads = threads;
      Session session;
      const LightLandings found = landingsOf(session, settings);
      session.renderPicture();
      const Color own = session.explain(kX, kY, 0).pixel, all = session.picture().at(kX, kY);
      EXPECT_EQ(own + found.image.value, all);
      EXPECT_EQ(found.image.value, session.film().ofSplats(kX, kY));
      EXPECT_GT(luminanceOf(found.image.value), 0);
      EXPECT_EQ(found.image.paths, 24 * 20 * 16);
    }
}

TEST(LightLandings, ThoseOfARegionComeFromTheWholePicture) {
  Settings settings = settingsOf();
  Session session;
  const LightLandings found = landingsOf(session, settings, {8, 12, 16, 16});
  EXPECT_EQ(found.image.paths, 24 * 20 * 16);
  EXPECT_EQ(found.image.value, landingsOf(session, settings).image.value);
  EXPECT_EQ(landingsOf(session, settings, {0, 0, 4, 4}).image.paths, 0) << "the pixel lies elsewhere";
  settings.region = {8, 12, 16, 16};
  session.open(glassOverFloor(), settings);
  session.build();
  session.renderPicture();
  EXPECT_EQ(found.image.value, session.film().ofSplats(kX, kY));
}

TEST(LightLandings, TellTheBrightestPathsAndTheirRoutes) {
  Session session;
  landingsOf(session, settingsOf());
  session.renderPicture();
  int x = 0, y = 0;  // where the light image is brightest: the ball gathers light there
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 24; ++u)
      if (luminanceOf(session.film().ofSplats(u, v)) > luminanceOf(session.film().ofSplats(x, y)))
        x = u, y = v;
  Job job;
  const LightLandings found = lightLandings(session, {}, x, y, job);
  ASSERT_GT(found.image.brightest.size(), 1u);
  ASSERT_EQ(found.routes.size(), found.image.brightest.size());
  EXPECT_LE(found.image.brightest.size(), static_cast<std::size_t>(found.image.landed));
  Real before = kInfinity;
  bool throughBall = false;
  for (std::size_t i = 0; i < found.routes.size(); ++i) {
    const Landing& landing = found.image.brightest[i];
    EXPECT_LE(luminanceOf(landing.brings), before);
    before = luminanceOf(landing.brings);
    EXPECT_TRUE(found.routes[i].ends_with("floor")) << found.routes[i];
    throughBall |= found.routes[i] == "from a light by ball, ball and floor" && landing.light == 4;
  }
  EXPECT_TRUE(throughBall) << found.routes[0] << "; " << found.routes[1];
}

TEST(LightLandings, ThereAreNoneWhereNothingIsThrown) {
  Session session;
  Settings settings = settingsOf();
  settings.cameraVertices = 3;
  EXPECT_EQ(landingsOf(session, settings).image.paths, 0);
  EXPECT_EQ(landingsOf(session, settingsOf(IntegratorKind::path)).image.value, Color(0));
}

}  // namespace
}  // namespace trace::test
