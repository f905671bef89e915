// What lights of the scene do in pictures: which objects they light, how they are seen, the portals through
// which the sky is looked for, and the photons that they send.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/solids/square.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/lights/lamps.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/portal.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/warn_light.h"
#include "shading/materials/thin_glass.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::lights_test {
namespace {

const Affine kFlat = Affine::rotation({1, 0, 0}, -kPi / 2);

Settings settingsOf(IntegratorKind kind, int width, int spp) {
  Settings settings;
  settings.integrator = kind;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = width;
  settings.spp = spp;
  return settings;
}

// --- links --------------------------------------------------------------------------------------------

/// Two squares that face the camera, "left" and "right".
Scene twoWalls() {
  Scene scene;
  for (const Real x : {-1.0, 1.0}) {
    addObject(scene, Square{}, Affine::translation({x, 0, -4}) * Affine::scaling({2, 4, 1}), diffuse(0.5));
    scene.objects.back().name = x < 0 ? "left" : "right";
  }
  return scene;
}

TEST(LightLinks, ALightLightsWhatItNames) {
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::direct}) {
    Settings settings = settingsOf(kind, 8, 1);
    settings.pixelPosition = PixelPosition::center;
    const auto sides = [&](const LightLinks& links) {
      Scene scene = twoWalls();
      scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}, links});
      const Picture all = picture(scene, settings);
      return std::pair{all.at(1, 4).g, all.at(6, 4).g};
    };
    EXPECT_EQ(sides({}), (std::pair{0.5, 0.5}));
    EXPECT_EQ(sides({.name = "", .lights = {"left"}}), (std::pair{0.5, 0.0}));
    EXPECT_EQ(sides({.name = "", .lights = {}, .excludes = {"left"}}), (std::pair{0.0, 0.5}));
    EXPECT_EQ(sides({.name = "", .lights = {"left", "right"}, .excludes = {"right"}}), (std::pair{0.5, 0.0}));
    EXPECT_EQ(sides({.name = "", .lights = {"nobody"}}), (std::pair{0.0, 0.0}));
  }
}

TEST(LightLinks, AnObjectNamesTheLightsThatLightIt) {
  const Settings settings = settingsOf(IntegratorKind::whitted, 8, 1);
  const auto sides = [&](const ObjectLinks& left, const LightLinks& key = {.name = "key"}) {
    Scene scene = twoWalls();
    scene.objects[0].links = left;
    scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}, key});
    scene.lights.push_back(
        {DirectionalLight{.direction = {0, 0, -1}, .color = Color(0.5)}, {}, {.name = "fill"}});
    const Picture all = picture(scene, settings);
    return std::pair{all.at(1, 4).g, all.at(6, 4).g};
  };
  EXPECT_EQ(sides({}), (std::pair{0.75, 0.75}));
  EXPECT_EQ(sides({.litBy = {"key"}}), (std::pair{0.5, 0.75}));
  EXPECT_EQ(sides({.litBy = {"key", "fill"}, .notLitBy = {"key"}}), (std::pair{0.25, 0.75}));
  EXPECT_EQ(sides({.litBy = {"nobody"}}), (std::pair{0.0, 0.75}));
  EXPECT_EQ(sides({.litBy = {"key"}}, {.name = "key", .lights = {"right"}}), (std::pair{0.0, 0.75}))
      << "both have to agree";
}

// --- lights that are seen -----------------------------------------------------------------------------

/// A floor with a mirror in it before a panel that stands.
Scene panelRoom(bool visible) {
  Scene scene;
  addObject(scene, Square{}, kFlat * Affine::scaling({20, 20, 1}), diffuse(0.6));
  Phong mirror;
  mirror.reflective = Color(0.9);
  addObject(scene, Square{}, Affine::translation({0, 0.01, -1}) * kFlat, mirror);
  RectangleLight panel{.position = {0, 1.5, -4}, .u = {2, 0, 0}, .v = {0, 1, 0}, .color = {4, 3, 2}};
  panel.visible = visible;
  scene.lights.push_back({panel, {}});
  scene.camera.position = {0, 1.5, 4}, scene.camera.viewdir = {0, 0, -1};
  return scene;
}

TEST(SeenLights, CameraAndMirrorsSeeThemAndNothingElseChanges) {
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::direct}) {
    Settings settings = settingsOf(kind, 24, 16);
    settings.depth = 2;
    settings.mirrorDefault = MirrorDefault::zero;
    const Picture without = picture(panelRoom(false), settings), with = picture(panelRoom(true), settings);
    EXPECT_EQ(with.at(12, 12), Color(4, 3, 2));
    EXPECT_EQ(without.at(12, 12), Color(0));
    int same = 0, mirrored = 0;
    for (int y = 16; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        const bool equal = with.at(x, y) == without.at(x, y);
        same += equal;
        // What is new in the mirror is the panel's colour.
        const Color more = with.at(x, y) + without.at(x, y) * -1;
        if (!equal) {
          ++mirrored;
          EXPECT_NEAR(more.r / more.b, 2, 1e-6);
        }
      }
    EXPECT_GT(same, 150);
    if (kind != IntegratorKind::direct) {
      EXPECT_GT(mirrored, 2);
    }
  }
}

TEST(SeenLights, AreExplained) {
  const Settings settings = settingsOf(IntegratorKind::path, 24, 1);
  const Scene scene = panelRoom(true);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const Explanation e = explain(world, *integrator, settings, {24, 24}, 12, 12, 0);
  EXPECT_TRUE(sumsUp(e.tree));
  const RayNode& camera = e.tree.nodes.front();
  EXPECT_FALSE(camera.hit);
  EXPECT_EQ(sentence(camera, scene), "met rectangle_light at distance 8.00116");
}

// --- portals ------------------------------------------------------------------------------------------

/// A room with a window at its +z side under a sky, and the camera in it; before the window so many panes.
Scene roomWithWindow(bool portal, int panes = 0) {
  Scene scene;
  const auto wall = [&](const Affine& place) { addObject(scene, Square{}, place, diffuse(0.5)); };
  const auto turned = [](const Vec3& axis, Real quarters) {
    return Affine::rotation(axis, quarters * kPi / 2);
  };
  const Affine outward = Affine::translation({0, 0, 1}) * Affine::scaling({2, 2, 1});
  wall(turned({0, 1, 0}, 1) * outward);
  wall(turned({0, 1, 0}, 2) * outward);
  wall(turned({0, 1, 0}, 3) * outward);
  wall(turned({1, 0, 0}, 1) * outward);
  wall(turned({1, 0, 0}, 3) * outward);
  // Around a window of 0.4 x 0.4 in its middle.
  for (const Real side : {-1.0, 1.0}) {
    wall(Affine::translation({side * 0.6, 0, 1}) * Affine::scaling({0.8, 2, 1}));
    wall(Affine::translation({0, side * 0.6, 1}) * Affine::scaling({0.4, 0.8, 1}));
  }
  scene.background.gradient = {Color(2), Color(2)};
  if (portal) scene.lights.push_back({Portal{.position = {0, 0, 1}, .u = {0.4, 0, 0}, .v = {0, 0.4, 0}}, {}});
  if (panes > 0) scene.materials.push_back({"", ThinGlass{}, {}});
  for (int n = 0; n < panes; ++n)
    scene.objects.push_back({"",
                             Square{},
                             Affine::translation({0, 0, 1.01 + 0.01 * n}) * scaled(0.5),
                             static_cast<std::uint32_t>(scene.materials.size() - 1),
                             {}});
  scene.camera.position = {0, 0, 0.5}, scene.camera.viewdir = {0.2, -0.3, -1};
  return scene;
}

/// The mean square error of a path traced picture.
Real errorOf(const Scene& scene, const Settings& settings, const Picture& exact) {
  const Picture rough = picture(scene, settings);
  Real sum = 0;
  for (std::size_t i = 0; i < rough.pixels.size(); ++i)
    sum += std::pow(rough.pixels[i].g - exact.pixels[i].g, 2);
  return sum / static_cast<Real>(rough.pixels.size());
}

TEST(Portals, LightARoomThroughPanes) {
  Settings many = settingsOf(IntegratorKind::path, 8, 2048), few = many;
  many.depth = few.depth = 4;
  few.spp = 64, few.seed = 5;
  const Real open = errorOf(roomWithWindow(true), few, picture(roomWithWindow(true), many));
  for (const int panes : {1, 2}) {
    SCOPED_TRACE(panes);
    const Scene closed = roomWithWindow(true, panes);
    EXPECT_LT(errorOf(closed, few, picture(closed, many)), 2 * open);
  }
}

TEST(Portals, GiveTheSameLightWithLessNoise) {
  Settings settings = settingsOf(IntegratorKind::path, 8, 2048);
  settings.depth = 2;
  const Picture exact = picture(roomWithWindow(false), settings);
  EXPECT_NEAR(meanColor(picture(roomWithWindow(true), settings)).g / meanColor(exact).g, 1, 0.01);
  settings.spp = 64, settings.seed = 5;
  EXPECT_LT(errorOf(roomWithWindow(true), settings, exact),
            0.3 * errorOf(roomWithWindow(false), settings, exact));
}

TEST(Portals, DensitiesIntegrateToOne) {
  Scene scene = roomWithWindow(true);
  scene.lights.push_back({Portal{.position = {0.3, 1.2, 0.2}, .u = {1, 0, 0}, .v = {0, 0.2, 0.7}}, {}});
  const World world = build(scene);
  const Lamps lamps(world, 1);
  Random random(8);
  for (const Vec3& from : {Vec3{0, 0, 0}, Vec3{0.5, -0.5, -0.5}, Vec3{-1, 3, 2}}) {
    Real sum = 0;
    const int rays = kSanitized ? 40000 : 400000;
    // A portal that is far covers few of them: evenly spread ones tell it better than random ones.
    for (int n = 0; n < rays; ++n) {
      const Vec2 u = sobolPoint(static_cast<std::uint32_t>(n), 0);
      sum += lamps.density(Ray{from, sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y)}) * 4 * kPi / rays;
    }
    EXPECT_NEAR(sum, 1, 0.03);
    for (int n = 0; n < 100; ++n) {
      const auto place = lamps.choose(from, random.uniform(), {random.uniform(), random.uniform()});
      if (!place) continue;
      EXPECT_NEAR(lamps.density(Ray{from, place->toLight}) / place->density, 1, 1e-9);
    }
  }
}

// --- photons ------------------------------------------------------------------------------------------

TEST(LightPhotons, BringWhatTheLightsGive) {
  const auto picture2 = std::make_shared<const MipMap>([] {
    Picture slide(2, 1);
    slide.at(0, 0) = {1, 0.5, 0.2}, slide.at(1, 0) = {0.1, 0.2, 0.3};
    return slide;
  }());
  const auto measured = std::make_shared<const Photometry>(
      Photometry::Type::c, std::vector<Real>{0, 30, 60}, std::vector<Real>{0}, std::vector<Real>{100, 60, 0});
  WarnLight warn{.position = {0, 2, 0}, .direction = {0.3, 0, -1}, .color = Color(3), .exponent = 4};
  warn.yMin = 1;
  ProjectorLight projector{.position = {0, 2, 0}, .direction = {0, 0.1, -1}, .color = Color(4)};
  projector.file.map = picture2;
  GoniometricLight lamp{.position = {0, 2.5, -1}, .direction = {0, 0.2, -1}, .color = Color(6)};
  lamp.file.data = measured;
  for (const Light& light : {Light(warn), Light(projector), Light(lamp)}) {
    Scene scene;  // a floor that is lit by the wall behind it, on which the light shines
    addObject(scene, Square{}, kFlat * Affine::scaling({8, 8, 1}), diffuse(0.8));
    addObject(scene, Square{}, Affine::translation({0, 2.5, -3}) * Affine::scaling({6, 5, 1}), diffuse(0.8));
    scene.lights.push_back({light, {}});
    scene.camera.position = {0, 3, 2}, scene.camera.viewdir = {0, -3, -2};
    scene.camera.fov = 40;
    Settings settings = settingsOf(IntegratorKind::path, 8, 1024);
    settings.depth = 2;
    settings.limitAttenuation = false;
    settings.photons = 3200000;  // of a beam that lights little, few photons are noise
    const Color path = meanColor(picture(scene, settings));
    settings.integrator = IntegratorKind::photon;
    settings.depth = 1;  // where a path's first ray arrives, photons have one bounce more
    settings.spp = 256;
    const Color photons = meanColor(picture(scene, settings));
    EXPECT_GT(path.g, 0.01);
    EXPECT_NEAR(photons.r / path.r, 1, 0.04) << light.keyword();
    EXPECT_NEAR(photons.b / path.b, 1, 0.04) << light.keyword();
  }
}

}  // namespace
}  // namespace trace::test::lights_test
