// What distribution ray tracing blurs, against what can be worked out: the disk of a lens, the penumbra of a
// panel, the mirror image of an edge (checks.md, E2 and E5; Cook, Porter and Carpenter 1984).
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "shading/lights/rectangle_light.h"
#include "shading/materials/conductor.h"
#include "support/scenes.h"

namespace trace::test::distribution_test {
namespace {

Phong ofColor(Real diffuse, Real emissive) {
  Phong phong;
  phong.diffuse = Color(diffuse), phong.emissive = Color(emissive);
  return phong;
}

Settings manySamples(int width, int spp) {
  Settings settings{.width = width, .height = width, .spp = spp, .sampling = SampleKind::sobol};
  settings.pixelPosition = PixelPosition::center;
  return settings;
}

/// A square that shines, two pixels wide in a picture of 200 pixels for each unit at distance 1.
Scene farPoint() {
  Scene scene;
  addObject(scene, Square{}, Affine::translation({0, 0, -4}) * Affine::scaling({0.04, 0.04, 1}),
            ofColor(0, 1));
  scene.objects.back().name = "lamp";
  scene.camera.fov = 2 * std::atan(40 / 200.0 / 2) * 180 / kPi;
  return scene;
}

struct Spot {
  Real light = 0, spread = 0, reach = 0;  ///< the mean square, and the most, of the distance from the middle
};
Spot spotOf(const Picture& picture) {
  Spot spot;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Real value = picture.at(x, y).g, middle = picture.width / 2.0;
      const Real away = std::hypot(x + 0.5 - middle, y + 0.5 - middle);
      spot.light += value;
      spot.spread += value * away * away;
      if (value > 0) spot.reach = std::max(spot.reach, away);
    }
  spot.spread /= spot.light;
  return spot;
}

TEST(DepthOfField, APointBecomesTheDiskOfItsCircleOfConfusionAndKeepsItsLight) {
  // D |1/F - 1/s| at distance 1: 0.4 |1/2 - 1/4| = 0.1, which is 20 pixels.
  const Scene scene = farPoint();
  Settings settings = manySamples(40, 512);
  const Spot sharp = spotOf(picture(scene, settings));
  settings.aperture = 0.4, settings.focus = 2;
  const Spot blurred = spotOf(picture(scene, settings));
  EXPECT_NEAR(sharp.light, 4, 0.05);
  EXPECT_NEAR(blurred.light, sharp.light, 0.03 * sharp.light);
  const Real own = sharp.spread;  // of the square and of the pixels
  EXPECT_NEAR(blurred.spread - own, 10.0 * 10 / 2, 1.5) << "the mean square of an even disk is r^2 / 2";
  EXPECT_LT(blurred.reach, 10 + 2.5);
}

TEST(DepthOfField, FocusOnAnObjectOrAPointIsFocusAtItsDistance) {
  const Scene scene = farPoint();
  Settings settings = manySamples(40, 16);
  settings.aperture = 0.4, settings.focus = 4;
  const Picture asked = picture(scene, settings);
  settings.focus = 0;
  settings.focusOn = {.object = "lamp"};
  EXPECT_LE(compareLevels(picture(scene, settings), asked).most, 1);
  EXPECT_NEAR(build(scene, settings).camera().optics.lens.focus, 4, 1e-12);
  settings.focusOn = {.object = {}, .point = Vec3{0.7, -2, -4}};
  EXPECT_EQ(picture(scene, settings), asked) << "the plane in focus goes through the point";
  settings.focusOn = {.object = {}, .point = Vec3{0, 0, 4}};
  EXPECT_THROW(build(scene, settings), Error) << "it lies behind";
  settings.focusOn = {.object = "lump"};
  try {
    build(scene, settings);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no object of the scene is called \"lump\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("lamp"), std::string::npos) << "did you mean";
  }
  settings.focusOn = {.object = std::string(scene.objects[0].shape.keyword())};
  try {
    build(scene, settings);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("give objects names"), std::string::npos) << error.what();
  }
}

TEST(DepthOfField, FocusOnLooksIntoGroups) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::translation({0, 0, -30}), ofColor(1, 0));
  Group tree{.name = "tree", .objects = {scene.objects[0]}};
  tree.objects[0].name = "leaf";
  tree.objects[0].worldFromObject = Affine();
  scene.groups.push_back(tree);
  const auto placed = [](Real z) { return GroupUse{.outFromGroup = Affine::translation({0, 0, z})}; };
  scene.uses.push_back(
      {0, std::make_shared<const GroupUses::List>(GroupUses::List{placed(5), placed(-9), placed(-6)})});
  scene.usePlaces.emplace_back();
  Settings settings;
  settings.aperture = 0.1;
  for (const char* name : {"tree", "leaf"}) {
    settings.focusOn = {.object = name};
    EXPECT_NEAR(build(scene, settings).camera().optics.lens.focus, 5, 1e-9)
        << "the nearest before the camera";
  }
  settings.focusOn = {.object = "leaves"};
  try {
    build(scene, settings);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no object of the scene is called \"leaves\""),
              std::string::npos);
  }
}

TEST(DepthOfField, FocusOnAnObjectIsOnWhatTheCameraSeesOfIt) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::translation({2, 0, -8}), ofColor(1, 0));
  addObject(scene, Sphere{}, Affine::translation({0, 0, -3}), ofColor(1, 0));  // in the middle, and nearer
  scene.objects[0].name = "ball";
  Settings settings;
  settings.aperture = 0.1, settings.focusOn = {.object = "ball"};
  const Real along = std::hypot(8.0, 2.0);
  EXPECT_NEAR(build(scene, settings).camera().optics.lens.focus, (along - 1) * 8 / along, 1e-12);
  settings.projection = Projection::panorama;
  EXPECT_NEAR(build(scene, settings).camera().optics.lens.focus, along - 1, 1e-12) << "spheres are in focus";
  settings.projection = Projection::orthographic;
  EXPECT_NEAR(build(scene, settings).camera().optics.lens.focus, 7, 1e-12);
  settings.projection = Projection::perspective, settings.tilt = 30;
  const CameraFrame tilted = build(scene, settings).camera();
  const Vec3 seen = normalize(Vec3{2, 0, -8}) * (along - 1);
  EXPECT_NEAR(tilted.focusOn(seen), tilted.optics.lens.focus, 1e-12);
}

TEST(SoftShadow, APanelBehindAnEdgeGivesTheIntegralOverWhatIsSeenOfIt) {
  // A narrow panel 4 above the floor, from x = -1 to 1; an edge 2 above it, over x = 0, hides what lies at
  // x > 0. From (x, 0, 0) the panel is seen up to -x, and each piece dx of it gives cos^2 / r^2.
  Scene scene;
  addObject(scene, Square{}, Affine::scaling({20, 20, 1}), ofColor(1, 0));
  addObject(scene, Square{}, Affine::translation({5, 0, 2}) * Affine::scaling({10, 10, 1}), ofColor(0, 0));
  const Real width = 0.02, color = 100;
  scene.lights.push_back(
      {RectangleLight{.position = {0, 0, 4}, .u = {2, 0, 0}, .v = {0, -width, 0}, .color = Color(color)},
       {}});
  const auto integral = [](Real u) { return (u / (u * u + 16) + std::atan(u / 4) / 4) / 2; };
  Settings settings = manySamples(1, 64);
  settings.lightSamples = 256;
  scene.camera.position = {-3, 0, 1}, scene.camera.updir = {0, 0, 1}, scene.camera.fov = 0.001;
  for (const Real x : {-1.5, -0.75, -0.25, 0.0, 0.25, 0.75, 1.25}) {
    scene.camera.viewdir = Vec3{x, 0, 0} - scene.camera.position;
    const Real end = std::clamp(-x, -1.0, 1.0);
    const Real expected = color * width / kPi * (integral(end - x) - integral(-1 - x));
    EXPECT_NEAR(picture(scene, settings).at(0, 0).g, expected, 1e-3 * color * width / kPi) << x;
  }
}

TEST(GlossyReflection, TheEdgeOfALampIsHalfAsBrightAsItsMiddle) {
  // Straight from above the lobe lies evenly around the normal: half of it meets a sky that is bright at x >
  // 0.
  const auto seen = [](bool half, Real roughness) {
    Scene scene;
    Conductor metal;
    metal.color = Color(1), metal.roughness = roughness;
    scene.materials.push_back({"", metal, {}});
    scene.objects.push_back({"", Square{}, Affine::scaling({0.1, 0.1, 1}), 0, {}});
    addObject(scene, Square{}, Affine::translation({half ? 5e4 : 0, 0, 10}) * Affine::scaling({1e5, 1e5, 1}),
              ofColor(0, 1));
    scene.camera.position = {0, 0, 5}, scene.camera.fov = 0.01;
    Settings settings = manySamples(2, 1024);
    settings.glossy = true;
    const Picture all = picture(scene, settings);
    return (all.at(0, 0).g + all.at(1, 0).g + all.at(0, 1).g + all.at(1, 1).g) / 4;
  };
  for (const Real roughness : {0.2, 0.5}) {
    const Real whole = seen(false, roughness);
    EXPECT_GT(whole, 0.8);
    EXPECT_NEAR(seen(true, roughness) / whole, 0.5, 0.01) << roughness;
  }
}

}  // namespace
}  // namespace trace::test::distribution_test
