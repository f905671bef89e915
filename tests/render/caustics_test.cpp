// Photons of caustics against what mirrors, panes and lenses do with light.
#include <gtest/gtest.h>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/square.h"
#include "render/photons/photons.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"
#include "support/scenes.h"

namespace trace::test::caustics_test {
namespace {

Affine turned(const Vec3& axis, Real angle) { return Affine::rotation(axis, angle); }

Phong white() {
  Phong phong;
  phong.diffuse = Color(1);
  return phong;
}

Phong glass(Real reflective) {
  Phong phong;
  phong.transmissive = Color(1);
  phong.reflective = Color(reflective);
  phong.index = 1.5;
  return phong;
}

Settings causticSettings(int photons) {
  Settings settings;
  settings.width = settings.height = 8;
  settings.caustics = photons;
  settings.causticRadius = 0.2;
  settings.airIndex = 1;
  settings.depth = 20;
  return settings;
}

/// The mean over a narrow view from `from` toward `to`.
Real seen(Scene scene, const Vec3& from, const Vec3& to, Settings settings) {
  scene.camera.position = from;
  scene.camera.viewdir = to - from;
  scene.camera.updir = {0, 0, 1};
  scene.camera.fov = 15;  // over many places, for 64 photons differ by some per cent
  settings.width = settings.height = 24;
  Real sum = 0;
  const Picture all = picture(scene, settings);
  for (const Color& c : all.pixels) sum += c.g;
  return sum / static_cast<Real>(all.pixels.size());
}

TEST(Caustics, AMirrorThrowsASunOnAWall) {
  Scene scene;
  Phong mirror;
  mirror.reflective = Color(0.8);
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({2, 2, 1}), mirror);
  addObject(scene, Square{},
            Affine::translation({3, 3, 0}) * turned({0, 1, 0}, -kPi / 2) * Affine::scaling({9, 9, 1}),
            white());
  scene.lights.push_back({DirectionalLight{.direction = {1, -1, 0}, .color = Color(1)}, {}});
  // The wall is lit by the sun and by its image, both aslant.
  const Real expected = std::sqrt(0.5) * (1 + 0.8);
  EXPECT_NEAR(seen(scene, {-2, 3, 0}, {3, 3, 0}, causticSettings(200000)) / expected, 1, 0.02);
  Settings none = causticSettings(0);
  EXPECT_NEAR(seen(scene, {-2, 3, 0}, {3, 3, 0}, none) / std::sqrt(0.5), 1, 1e-6);
}

TEST(Caustics, APartOfThePhotonsIsAsIfThatManyWereAskedFor) {
  Scene scene;
  addObject(scene, Square{}, Affine::translation({0, 0, -2}) * Affine::scaling({4, 4, 1}), white());
  addObject(scene, Cube{}, Affine::scaling({1, 1, 0.3}), glass(0.1));
  scene.lights.push_back({PointLight{.position = {0.2, 0.3, 3}, .color = Color(1)}, {}});
  scene.camera.position = {0, 4, 3}, scene.camera.viewdir = {0, -4, -5};
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::photon}) {
    Settings few = causticSettings(500), part = causticSettings(2000);
    few.integrator = part.integrator = kind;
    few.photons = 1000, part.photons = 4000;
    part.photonShare = 0.25;
    EXPECT_EQ(picture(scene, part), picture(scene, few));
    part.photonShare = 1;
    EXPECT_NE(picture(scene, part), picture(scene, few));
  }
}

TEST(Caustics, AMirrorThrowsALampAsItsImageWould) {
  Scene scene;
  Phong mirror;
  mirror.reflective = Color(1);
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({4, 4, 1}), mirror);
  addObject(scene, Square{},
            Affine::translation({0, 3, 0}) * turned({1, 0, 0}, kPi / 2) * Affine::scaling({9, 9, 1}),
            white());
  // A lamp that shines down only, so that the ceiling has nothing but the image, 2 + 3 below it.
  scene.lights.push_back(
      {SpotLight{
           .position = {0, 2, 0}, .direction = {0, -1, 0}, .color = Color(30), .constant = 0, .quadratic = 1},
       {}});
  EXPECT_NEAR(seen(scene, {0, 1, 0}, {0, 3, 0}, causticSettings(400000)) / (30.0 / 25), 1, 0.03);
  // Fog that scatters nothing takes its part of the way to the mirror, to the ceiling and to the eye.
  Settings foggy = causticSettings(400000);
  foggy.fog = 0.1;
  foggy.fogColor = Color(0);
  EXPECT_NEAR(seen(scene, {0, 1, 0}, {0, 3, 0}, foggy) / (30.0 / 25 * std::exp(-0.7)), 1, 0.03);
}

TEST(Caustics, APaneLetsThroughWhatFresnelSays) {
  Scene scene;
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({9, 9, 1}), white());
  addObject(scene, Cube{}, Affine::translation({0, 1, 0}) * Affine::scaling({3, 0.2, 3}), glass(1));
  scene.lights.push_back({DirectionalLight{.direction = {0, -1, 0}, .color = Color(1)}, {}});
  Settings settings = causticSettings(200000);
  settings.fresnel = Fresnel::exact;
  EXPECT_NEAR(seen(scene, {0.5, 0.8, 0}, {0, 0, 0}, settings) / (12.0 / 13), 1, 0.02);
}

TEST(Caustics, AllThatEntersALensArrives) {
  Scene scene;
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({50, 50, 1}), white());
  addObject(scene, Sphere{}, Affine::translation({0, 3, 0}), glass(0));
  scene.lights.push_back({DirectionalLight{.direction = {0, -1, 0}, .color = Color(1)}, {}});
  const Settings settings = causticSettings(50000);
  Messages messages;
  const World world = compile(scene, settings, messages);
  Job job;
  Real power = 0;
  const PhotonMap map = causticMap(world, settings, nullptr, job);
  for (const Photon& photon : map.photons()) power += photon.power.g;
  EXPECT_NEAR(power / kPi, kPi, 0.01 * kPi) << "the light of its cross-section";
}

TEST(Caustics, HaveTheSameBitsForAnyNumberOfThreads) {
  Scene scene;
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({9, 9, 1}), white());
  addObject(scene, Sphere{}, Affine::translation({0, 2, 0}), glass(0.3));
  scene.lights.push_back({PointLight{.position = {1, 5, 0}, .color = Color(9), .radius = 0.2}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0.2, -1, 0}, .color = Color(1), .size = 2}, {}});
  scene.camera.position = {0, 4, 8};
  scene.camera.viewdir = {0, -4, -8};
  Settings settings = causticSettings(20000);
  settings.width = settings.height = 32;
  settings.threads = 1;
  const Picture one = picture(scene, settings);
  settings.threads = 7;
  EXPECT_EQ(one, picture(scene, settings));
}

TEST(Caustics, MapsOfSurfacesGatherTheSameLightAsPhotonsNearby) {
  Scene scene;  // a lens above a table, and a wall that is seen from behind
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({4, 4, 1}), white());
  addObject(scene, Sphere{}, Affine::translation({0, 2.4, 0}), glass(0));
  scene.lights.push_back({DirectionalLight{.direction = {0, -1, 0}, .color = Color(1)}, {}});
  Settings settings = causticSettings(100000);
  const auto mean = [&](Real y) {  // over the whole table from above the ball or from below
    scene.camera.position = {0, y, 0.1};
    scene.camera.viewdir = {0, -y, -0.1};
    scene.camera.updir = {0, 0, -1};
    scene.camera.fov = 60;
    settings.width = settings.height = 48;
    Real sum = 0;
    for (const Color& c : picture(scene, settings).pixels) sum += c.g;
    return sum;
  };
  const Real above = mean(9), below = mean(-9);
  settings.causticTexels = 64;
  EXPECT_NEAR(mean(9) / above, 1, 0.01);
  EXPECT_EQ(mean(-9), below) << "the other side of the table has a map of its own";
  settings.caustics = 0;
  EXPECT_LT(mean(9) / above, 0.995) << "caustics are a part of the picture";
}

TEST(Caustics, AMapHasWhatFellOnItPerArea) {
  Scene scene;
  addObject(scene, Square{}, Affine::scaling({3, 2, 1}), white());
  const World world = build(scene);
  IlluminationMap map(16);
  std::uint64_t bits = 3;
  const auto next = [&] { return unitFromBits(bits = mixBits(bits)); };
  const auto met = [&](Real x, Real y) {
    const Ray ray{{x, y, 5}, {0, 0, -1}};
    Statistics statistics;
    return Hit(world, ray, *world.closest(ray, Faces::both, statistics));
  };
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Hit hit = met(3 * next() - 1.5, 2 * next() - 1);
    map.add(*map.place(world, {{}, {0, 0, -1}}, hit), Color(6.0 / count));
  }
  Real sum = 0;
  for (int i = 0; i < 400; ++i)
    sum += map.at(*map.place(world, {{}, {0, 0, -1}}, met(3 * next() - 1.5, 2 * next() - 1))).g;
  EXPECT_NEAR(sum / 400, 1, 0.02) << "six units of power on an area of six";
}

TEST(Caustics, NearFindsTheNearestPhotons) {
  std::vector<Photon> photons;
  std::uint64_t bits = 1;
  const auto next = [&] { return unitFromBits(bits = mixBits(bits)); };
  for (int i = 0; i < 3000; ++i)
    photons.push_back({{next(), next(), next()},
                       {0, -1, 0},
                       normalize(Vec3{next() - 0.5, next() - 0.5, next() - 0.5}),
                       Color(1)});
  const PhotonMap map(photons, 0.3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 point{next(), next(), next()}, normal = photons[static_cast<std::size_t>(i)].normal;
    std::vector<Real> expected;
    for (const Photon& photon : photons) {
      const Vec3 way = photon.point - point;
      if (!(dot(photon.normal, normal) < 0.8) && dot(way, way) < 0.09) expected.push_back(dot(way, way));
    }
    std::sort(expected.begin(), expected.end());
    const PhotonMap::Near near = map.near(point, normal);
    ASSERT_EQ(near.count, std::min(expected.size(), PhotonMap::kNearest));
    std::vector<Real> found(near.distance2.begin(), near.distance2.begin() + near.count);
    std::sort(found.begin(), found.end());
    for (std::size_t k = 0; k < near.count; ++k) EXPECT_EQ(found[k], expected[k]);
  }
}

}  // namespace
}  // namespace trace::test::caustics_test
