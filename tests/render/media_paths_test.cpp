// Light from the other end in media: paths from both ends and photons show in fog, in clouds and in bodies of
// glass what the path tracer shows there.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "math/warp.h"
#include "render/photons/photons.h"
#include "render/picture/agreement.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/textures/noise.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::media_paths_test {
namespace {

void addPanel(Scene& scene, Real light) {
  addObject(scene, Square{}, Affine::translation({0.2, 0.9, 0}) * turned({1, 0, 0}, 0.5) * scaled(0.8),
            diffuse(Color(0.2), light));
}
TextureNode lumps() {
  TextureNode noise;
  noise.model = Noise{};
  noise.placement.scale = {0.4, 0.4, 0.4};
  return noise;
}

Settings settingsOf(IntegratorKind integrator, int spp, int width = 12) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = width;
  settings.depth = 4, settings.mediumDepth = 6, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  return settings;
}

struct Place {
  const char* name;
  std::function<Scene()> scene;
  std::function<void(Settings&)> set = [](Settings&) {};
};
std::vector<Place> places() {
  return {
      {"a lamp in fog",
       [] {
         Scene scene = openRoom();
         addPanel(scene, 6);
         return scene;
       },
       [](Settings& s) {
         s.fog = 0.35, s.fogColor = {0.9, 0.8, 0.7}, s.fogForward = 0.3;
       }},
      {"a bulb in fog that lies on the ground",
       [] {
         Scene scene = openRoom();
         scene.lights.push_back({PointLight{.position = {0.2, 0.3, 0.1}, .color = Color(1)}, {}});
         return scene;
       },
       [](Settings& s) { s.fog = 0.3, s.fogHeight = 0.7; }},
      {"a ball of light in lumps of smoke",
       [] {
         Scene scene = openRoom();
         scene.lights.push_back(
             {PointLight{.position = {0.3, 0.6, 0.4}, .color = Color(1), .radius = 0.15}, {}});
         Material& cloud = addCloud(scene, Sphere{}, Affine::translation({-0.2, -0.1, 0}) * scaled(0.8), 3);
         cloud.mediumForward = 0.5, cloud.mediumAbsorbs = {0.1, 0.2, 0.4};
         setTexture(cloud.textures, "medium_density", lumps());
         return scene;
       }},
      {"a sun on a cloud",
       [] {
         Scene scene = openRoom();
         scene.lights.push_back({DirectionalLight{.direction = {-0.3, -0.6, -1}, .color = Color(1)}, {}});
         addCloud(scene, Cube{}, Affine::translation({0, -0.3, 0.2}) * scaled(0.9), 1.5);
         return scene;
       }},
      {"the sky through mist",
       [] {
         Scene scene = openRoom();
         scene.background.gradient = {{Color(0.2, 0.3, 0.4), Color(0.9, 0.8, 0.7)}};
         addCloud(scene, Cube{}, Affine::translation({0, -0.3, 0.2}) * scaled(1.2), 1);
         return scene;
       }},
      {"a lamp in a block of murky glass",
       [] {
         Scene scene = openRoom();
         addPanel(scene, 6);
         Material glass;
         Phong clear;
         clear.transmissive = clear.reflective = Color(1), clear.index = 1.3;
         clear.attenuationColor = {0.9, 0.8, 0.9};
         glass.model = clear;
         glass.mediumDensity = 0.8;
         scene.materials.push_back(glass);
         scene.objects.push_back(
             {"", Cube{}, scaled(3), static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
         return scene;
       }},
  };
}

Agreement agreementOf(const Place& place, Settings a, Settings b, int seeds = 8) {
  place.set(a), place.set(b);
  return agreement(place.scene(), a, b, seeds, 4);
}

TEST(MediaPaths, FromBothEndsShowWhatPathShows) {
  for (const Place& place : places()) {
    const Agreement found =
        agreementOf(place, settingsOf(IntegratorKind::path, 200), settingsOf(IntegratorKind::bdpt, 100));
    EXPECT_GT(found.meanA, 0.01) << place.name;
    EXPECT_LT(found.error, 0.03 * found.meanA) << place.name;
    EXPECT_LT(std::abs(found.meanB - found.meanA), 3.5 * found.error)
        << place.name << ": " << found.meanB << ", not " << found.meanA;
    EXPECT_GT(found.uniform, 1e-3) << place.name;
  }
}

TEST(MediaPaths, EveryWayShowsTheLightInFog) {
  Scene scene = openRoom();
  addPanel(scene, 6);
  const Place place{"", [&] { return scene; },
                    [](Settings& s) {
                      s.fog = 0.4, s.fogColor = {0.9, 0.8, 0.7}, s.fogForward = 0.4;
                    }};
  const auto meanOf = [&](int s, int t) {
    Settings one = settingsOf(IntegratorKind::bdpt, 200);
    one.lightVertices = s, one.cameraVertices = t, one.unweighted = true;
    const Agreement found = agreementOf(place, one, one, 6);  // the same twice
    return std::pair{found.meanA, found.error / std::sqrt(2.0)};
  };
  for (const int places : {3, 4}) {
    const auto [first, error] = meanOf(0, places);
    EXPECT_LT(error, 0.1 * first) << places;
    for (int s = 1; s < places; ++s) {
      const auto [mean, own] = meanOf(s, places - s);
      EXPECT_LT(std::abs(mean - first), 4 * std::hypot(error, own))
          << "s = " << s << " of " << places << ": " << mean << ", not " << first;
    }
  }
}

TEST(MediaPaths, PhotonsShowWhatPathShows) {
  // Within the blur of their maps: near walls a part of the ball in which photons are counted is empty.
  constexpr Real kBlur = 0.03;
  for (const Place& place : places()) {
    Settings photons = settingsOf(IntegratorKind::photon, 50);
    photons.photons = 50000;
    const Agreement found = agreementOf(place, settingsOf(IntegratorKind::path, 200), photons, 4);
    EXPECT_LT(std::abs(found.meanB - found.meanA), kBlur * found.meanA + 3 * found.error)
        << place.name << ": " << found.meanB << ", not " << found.meanA;
  }
}

TEST(MediaPaths, PhotonsCountScatteringsAsPathDoes) {
  // From the eye the last one that is allowed is lit by lights alone: a lamp, or a point that shadow rays
  // ask.
  for (const int most : {1, 2})
    for (const bool isLamp : {false, true}) {
      const Place place{
          "",
          [&] {
            Scene scene = openRoom();
            if (isLamp)
              addPanel(scene, 6);
            else
              scene.lights.push_back(
                  {PointLight{.position = {0.2, 0.5, 0.1}, .color = Color(1), .constant = 1}, {}});
            return scene;
          },
          [&](Settings& s) { s.fog = 0.5, s.fogColor = Color(0.9), s.mediumDepth = most; }};
      Settings photons = settingsOf(IntegratorKind::photon, 40);
      photons.photons = 50000;
      const Agreement found = agreementOf(place, settingsOf(IntegratorKind::path, 150), photons, 3);
      EXPECT_LT(std::abs(found.meanB - found.meanA), 0.02 * found.meanA + 3 * found.error)
          << most << (isLamp ? " lamp: " : " point: ") << found.meanB << ", not " << found.meanA;
    }
}

TEST(MediaPaths, PhotonsInAnEvenMediumAreAsDenseAsItsLight) {
  // A white medium in a white furnace: the fluence is 4 pi times the radiance everywhere.
  Scene scene;
  scene.background.gradient = {{Color(1), Color(1)}};
  addCloud(scene, Cube{}, scaled(2), 1);
  Settings settings = settingsOf(IntegratorKind::photon, 1);
  settings.mediumDepth = 100;
  settings.photons = 200000;
  const World world = build(scene, settings);
  Job job;
  const PhotonMap map = globalMaps(world, settings, Lamps(world, 1), job).media;
  // What comes straight is asked for, not kept: what of a direction gets through the cube to the place.
  Random random(3);
  Real found = 0, expected = 0;
  constexpr int kPlaces = 300, kDirections = 400;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 at{random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)};
    for (int n = 0; n < kDirections; ++n) {
      const Vec3 d = sphericalDirection(random.uniform(-1, 1), random.uniform(0, 2 * kPi));
      Real out = kInfinity;
      for (int axis = 0; axis < 3; ++axis) out = std::min(out, ((d[axis] > 0 ? 1 : -1) - at[axis]) / d[axis]);
      expected += 4 * kPi * -std::expm1(-out) / (kPlaces * kDirections);
    }
    const PhotonMap::Near near = map.around(at);
    ASSERT_GT(near.count, 50u);
    for (std::size_t k = 0; k < near.count; ++k)
      found += near.photons[k]->power.g * near.perVolume(k) / kPlaces;
  }
  EXPECT_NEAR(found / expected, 1, 0.02);
}

/// How bright the front of a block of turbid glass is by photons. A point or a lamp as strong lights its top;
/// the front mirrors neither.
Real turbidGlass(bool lamp) {
  Scene scene;
  scene.camera.position = {0, 0, 6}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 10;
  Material glass;
  Phong clear;
  clear.transmissive = Color(1), clear.index = 1.5;
  glass.model = clear;
  glass.mediumDensity = 2;
  scene.materials.push_back(glass);
  scene.objects.push_back({"", Cube{}, scaled(2), 0, {}});
  const Vec3 at{0.2, 3, 0.3};
  constexpr Real kRadius = 0.3, kLight = 36;
  if (lamp)
    addObject(scene, Sphere{}, Affine::translation(at) * scaled(kRadius), diffuse(Color(0), kLight));
  else
    scene.lights.push_back({PointLight{.position = at, .color = Color(kLight * kRadius * kRadius)}, {}});
  Settings settings = settingsOf(IntegratorKind::photon, 16);
  settings.photons = 100000;
  return mean(picture(scene, settings));
}

TEST(MediaPaths, PhotonsBringTheLightOfAPointIntoGlassAsThatOfALamp) {
  // Shadow rays straight through the glass would bring it too, and 2.25 times as much: rays that leave glass
  // keep radiance over the square of the index.
  const Real lamp = turbidGlass(true);
  EXPECT_GT(lamp, 0.005);
  EXPECT_NEAR(turbidGlass(false) / lamp, 1, 0.05);
}

TEST(MediaPaths, FogInTheSunScattersWhatFallsOnIt) {
  // The sun lights all of the ball around the scene. What is scattered there goes on to where it is scattered
  // again: 1 / density away on the average.
  Scene scene;
  for (const Real side : {-1.0, 1.0})
    addObject(scene, Sphere{}, Affine::translation(Vec3{side, side, side}) * scaled(0.01), diffuse(Color(0)));
  scene.lights.push_back({DirectionalLight{.direction = {0.2, -1, 0.1}, .color = Color(1)}, {}});
  Settings settings = settingsOf(IntegratorKind::photon, 1);
  settings.fog = 0.5, settings.fogColor = Color(0.8), settings.mediumDepth = 2;
  settings.photons = 20000;
  const World world = build(scene, settings);
  Job job;
  Real fluence = 0;
  const GlobalMaps maps = globalMaps(world, settings, Lamps(world, 1), job);
  for (const Photon& photon : maps.media.photons()) fluence += photon.power.g;
  const Real radius = std::sqrt(3.0) * 1.01, volume = 4.0 / 3 * kPi * radius * radius * radius;
  EXPECT_NEAR(fluence / (kPi * 0.8 * volume), 1, 0.01);
}

TEST(MediaPaths, AreExplainedAndHaveTheSameBitsForAnyNumberOfThreads) {
  Scene scene = openRoom();
  addPanel(scene, 5);
  scene.lights.push_back({PointLight{.position = {0.3, 0.6, 0.4}, .color = Color(1), .radius = 0.15}, {}});
  Material& cloud = addCloud(scene, Sphere{}, scaled(0.7), 3);
  setTexture(cloud.textures, "medium_density", lumps());
  for (const IntegratorKind integrator : {IntegratorKind::bdpt, IntegratorKind::photon}) {
    Settings settings = settingsOf(integrator, 3, 24);
    settings.fog = 0.2, settings.photons = 20000;
    const Picture one = sameForAnyThreads(scene, settings);
    const World world = build(scene, settings);
    const auto made = integratorOf(world, settings);
    int scattered = 0, photons = 0;
    for (int at = 1; at < 24; at += 2) {
      const Explanation e = explain(world, *made, settings, {24, 24}, at, at, at % 3);
      EXPECT_TRUE(sumsUp(e.tree)) << at;
      EXPECT_EQ(e.tree.nodes[0].radiance, e.samples[static_cast<std::size_t>(at % 3)]);
      for (const RayNode& node : e.tree.nodes)
        for (const Term& term : node.terms) {
          scattered += term.medium && term.medium->what == MediumTerm::What::follows;
          photons += term.medium && term.photons;
        }
    }
    EXPECT_GT(scattered, 3);
    EXPECT_EQ(photons > 0, integrator == IntegratorKind::photon);
  }
}

}  // namespace
}  // namespace trace::test::media_paths_test
