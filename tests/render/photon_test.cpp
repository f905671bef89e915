// Photons of all light, and the integrator that gathers by them, against path tracing and closed forms.
#include <gtest/gtest.h>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/square.h"
#include "render/photons/photons.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/materials/conductor.h"
#include "shading/materials/thin_glass.h"
#include "support/quarters.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::photon_test {
namespace {

Affine ceiling(Real size) {
  return Affine::translation({0, 0.98, 0}) * Affine::rotation({1, 0, 0}, kPi / 2) *
         Affine::scaling({size, size, 1});
}

Settings settingsOf(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 24;
  settings.depth = 8, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  return settings;
}

/// Photons that are seen at once, and those that rays find which look around.
void expectAlike(const Scene& scene, Real tolerance, int spp = 64) {
  const auto wanted = quarters(picture(scene, settingsOf(IntegratorKind::path, 16 * spp)));
  for (const bool gather : {false, true}) {
    Settings settings = settingsOf(IntegratorKind::photon, spp);
    settings.finalGather = gather;
    const auto found = quarters(picture(scene, settings));
    for (std::size_t q = 0; q < 4; ++q)
      for (const auto channel : {&Color::r, &Color::g, &Color::b}) {
        EXPECT_GT(wanted[q].*channel, 0.01);
        EXPECT_NEAR(found[q].*channel / wanted[q].*channel, 1, tolerance) << q << " " << gather;
      }
  }
}

TEST(Photon, APointLightLightsARoomAsPathsSay) {
  Scene scene = openRoom();
  scene.lights.push_back({PointLight{.position = {0.2, 0.3, 0.1}, .color = Color(1)}, {}});
  expectAlike(scene, 0.03);
}

TEST(Photon, ASunInARoomToo) {
  Scene scene = openRoom();
  scene.lights.push_back({DirectionalLight{.direction = {-0.4, -1, -2}, .color = Color(1)}, {}});
  expectAlike(scene, 0.03);
}

TEST(Photon, LampsOfEveryKindDo) {
  Scene scene = openRoom();
  addObject(scene, Square{}, ceiling(0.6), diffuse(Color(0.5), 6));
  addObject(scene, Sphere{}, Affine::translation({0.5, -0.5, 0.3}) * Affine::scaling({0.2, 0.2, 0.2}),
            diffuse(Color(0), 3));
  MeshData data;
  data.points = {{-0.9f, -0.5f, 0.2f}, {-0.5f, -0.5f, 0.2f}, {-0.9f, 0, 0.2f}};
  data.triangles = {{0, 1, 2}};
  addObject(scene, Mesh{std::make_shared<MeshData>(data)}, {}, diffuse(Color(0.2), 5));
  expectAlike(scene, 0.03);
}

TEST(Photon, ALampCloseUnderTheCeilingShinesThroughNeither) {
  // Between the two, photons are very dense: none of them may count below the lamp.
  Scene scene = openRoom();
  addObject(scene, Square{},
            Affine::translation({0, 0.995, 0}) * Affine::rotation({1, 0, 0}, kPi / 2) *
                Affine::scaling({0.5, 0.5, 1}),
            diffuse(Color(0.7), 6));
  expectAlike(scene, 0.03);
}

TEST(Photon, WhatIsAroundDoes) {
  Scene scene = openRoom();
  scene.background.gradient = {{Color(0.2, 0.3, 0.4), Color(0.9, 0.8, 0.7)}};
  expectAlike(scene, 0.03);
}

TEST(Photon, GlassAndMirrorsThrowTheLightOfALamp) {
  Scene scene = openRoom();
  Phong glass, mirror;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  mirror.reflective = Color(0.9);
  addObject(scene, Square{}, ceiling(1), diffuse(Color(0.5), 4));
  addObject(scene, Sphere{}, Affine::translation({-0.4, -0.55, 0}) * Affine::scaling({0.4, 0.4, 0.4}), glass);
  addObject(scene, Sphere{}, Affine::translation({0.5, -0.6, -0.3}) * Affine::scaling({0.3, 0.3, 0.3}),
            mirror);
  expectAlike(scene, 0.05, 128);
}

TEST(Photon, WhatMirrorsBroadlyGetsGatheredLightOnce) {
  // A floor of rough metal below a lamp and a mirror on the wall: its lobe meets the lamp in the mirror, too.
  Scene scene = openRoom();
  Conductor metal;
  metal.roughness = 0.6;
  scene.materials.push_back({"", metal, {}});
  scene.objects[3].material = scene.objects[4].material =
      static_cast<std::uint32_t>(scene.materials.size() - 1);
  Phong mirror;
  mirror.reflective = Color(0.9);
  addObject(scene, Square{}, ceiling(0.8), diffuse(Color(0.5), 4));
  addObject(scene, Square{}, Affine::translation({0, -0.4, -0.98}) * Affine::scaling({1.6, 1, 1}), mirror);
  expectAlike(scene, 0.03);
}

TEST(Photon, ARoomThatShinesHasTheSumOfItsBounces) {
  // Closed, and all of it sends out 1 and scatters half: 2 everywhere.
  Scene scene = openRoom();
  addObject(scene, Square{}, Affine::translation({0, 0, 1}) * Affine::scaling({2, 2, 1}), {});
  for (std::size_t i = 0; i < scene.materials.size(); ++i) scene.materials[i].model = diffuse(Color(0.5), 1);
  scene.camera.position = {0, 0, 0};
  Settings settings = settingsOf(IntegratorKind::photon, 64);
  settings.depth = 30;
  for (const Color& q : quarters(picture(scene, settings))) EXPECT_NEAR(q.g, 2, 0.05);
}

/// All photons of a point light in a closed room whose walls scatter so much.
PhotonMap mapOfARoom(bool gather, Real scattered) {
  Scene scene = openRoom();
  addObject(scene, Square{}, Affine::translation({0, 0, 1}) * Affine::scaling({2, 2, 1}), {});
  for (Material& material : scene.materials) material.model = diffuse(Color(scattered));
  scene.lights.push_back(
      {PointLight{.position = {0.3, 0.2, 0.1}, .color = Color(0.5), .constant = 0, .quadratic = 1}, {}});
  Settings settings = settingsOf(IntegratorKind::photon, 1);
  settings.photons = 50000, settings.finalGather = gather;
  settings.limitAttenuation = false;
  const World world = build(scene, settings);
  Job job;
  return globalMaps(world, settings, Lamps(world, 1), job).surfaces;
}
/// Relative to what the light sends: 4 pi times pi times its colour.
Real powerOf(const PhotonMap& map) {
  Real power = 0;
  for (const Photon& photon : map.photons()) power += photon.power.g;
  return power / (4 * kPi * kPi * 0.5);
}

TEST(Photon, TheMapHoldsThePowerOfItsLights) {
  EXPECT_NEAR(powerOf(mapOfARoom(true, 1e-9)), 1, 0.01) << "all lands once";
  EXPECT_EQ(powerOf(mapOfARoom(false, 1e-9)), 0) << "what comes straight is asked";
  Real bounces = 0;
  for (int n = 1; n <= 8; ++n) bounces += std::pow(0.5, n);  // as deep as the settings let them
  EXPECT_NEAR(powerOf(mapOfARoom(false, 0.5)), bounces, 0.02);
}

TEST(Photon, TheSameBitsForAnyNumberOfThreadsAndExplained) {
  Random random(5);
  Scene scene = randomScene(random, 12);
  addObject(scene, Square{}, ceiling(1), diffuse(Color(0.5), 4));
  Settings settings = settingsOf(IntegratorKind::photon, 4);
  settings.photons = kSanitized ? 20000 : 200000;  // so many that an estimate fits on the things of the scene
  for (const bool gather : {false, true}) {
    settings.finalGather = gather;
    const Picture one = sameForAnyThreads(scene, settings);
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    std::size_t photons = 0;
    for (int n = 0; n < 24 * 24; n += 3) {  // one gathering ray in fifty or so meets places with photons
      const Explanation e = explain(world, *integrator, settings, {24, 24}, n % 24, n / 24, n % 4);
      EXPECT_EQ(e.pixel, one.at(n % 24, n / 24)) << n;
      EXPECT_TRUE(sumsUp(e.tree)) << n;
      for (const RayNode& node : e.tree.nodes)
        for (const Term& term : node.terms)
          photons += term.kind == Term::Kind::photons ? term.photons->count : 0;
    }
    EXPECT_TRUE(kSanitized || photons > 0);
  }
}

TEST(Photons, APaneThatBendsNothingDoesNotCountTwice) {
  Scene scene = openRoom();
  scene.materials.push_back({"", ThinGlass{}, {}});
  scene.objects.push_back({"",
                           Square{},
                           Affine::translation({0, 0.2, 0}) * Affine::rotation({1, 0, 0}, kPi / 2) *
                               Affine::scaling({1.6, 1.6, 1}),
                           static_cast<std::uint32_t>(scene.materials.size() - 1),
                           {}});
  scene.lights.push_back({PointLight{.position = {0, 0.7, 0.2}, .color = Color(0.6)}, {}});
  expectAlike(scene, 0.05);
}

TEST(Photons, WhatLiesUnderWaterIsAsBrightAsPathsShowIt) {
  Scene scene = openRoom();
  Phong water;
  water.transmissive = water.reflective = Color(1), water.index = 1.33;
  addObject(scene, Cube{}, Affine::translation({0, -0.5, 0}) * Affine::scaling({2.5, 0.6, 2.5}), water);
  addObject(
      scene, Square{},
      Affine::translation({0, -0.6, 0}) * Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({2, 2, 1}),
      diffuse(Color(0.7)));
  addObject(scene, Square{}, ceiling(1.2), diffuse(Color(0), 3));
  scene.camera.position = {0, 0.6, 1.4}, scene.camera.viewdir = {0, -0.9, -1};
  expectAlike(scene, 0.06);
}

/// What a place beside an edge of light is lit by, on the average of that many maps, relative to the truth.
Real besideAnEdge(int passes) {
  constexpr int kPhotons = 4000;
  constexpr Real kAway = 0.03;
  Random random(7);
  Real sum = 0;
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<Photon> photons;
    for (int i = 0; i < kPhotons; ++i)
      photons.push_back({{random.uniform(-0.5, 0), random.uniform(-0.5, 0.5), 0},
                         {0, 0, -1},
                         {0, 0, 1},
                         Color(0.5 / kPhotons)});
    const auto nearest = static_cast<std::size_t>(areaOfPass(pass) * PhotonMap::kNearest + 0.5);
    const PhotonMap map(std::move(photons), 1, 1, nearest);
    const PhotonMap::Near near = map.near({-kAway, 0, 0}, {0, 0, 1});
    for (std::size_t i = 0; i < near.count; ++i) sum += near.photons[i]->power.g * near.perArea(i) / passes;
  }
  return sum;
}

TEST(Photons, TheBlurOfManyMapsIsLess) {
  EXPECT_EQ(areaOfPass(0), 1);
  EXPECT_NEAR(areaOfPass(1), (1 + 2.0 / 3) / 2, 1e-15);
  EXPECT_NEAR(areaOfPass(8000) / areaOfPass(1000), 0.5, 1e-3) << "it shrinks as n^(-1/3)";
  const Real one = 1 - besideAnEdge(8), many = 1 - besideAnEdge(1000);
  EXPECT_GT(one, 0.03) << "there is a blur";
  EXPECT_LT(std::abs(many), 0.5 * one);
}

TEST(Photons, WhereTooFewLieOnASmallThingThePathGoesOn) {
  Scene scene = openRoom();
  addObject(scene, Square{}, ceiling(1), diffuse(Color(0.5), 4));
  addObject(scene, Cube{}, Affine::translation({0, 0, -0.4}) * Affine::scaling({0.02, 0.02, 1.6}),
            diffuse(Color(0.8)));
  scene.camera.position = {0, 0, 0.9}, scene.camera.viewdir = {0, 0, -1};
  scene.camera.fov = 5;
  expectAlike(scene, 0.06);
}

TEST(Photons, EachSampleTakesTheNextMap) {
  Scene scene = openRoom();
  addObject(scene, Square{}, ceiling(0.5), diffuse(Color(0), 8));
  Settings settings = settingsOf(IntegratorKind::photon, 1);
  settings.photons = 5000;
  const Picture first = picture(scene, settings);
  settings.photonPasses = 3;
  EXPECT_EQ(picture(scene, settings), first) << "the first sample takes the first map";
  settings.spp = 4;
  const Picture three = picture(scene, settings);
  settings.threads = 3;
  EXPECT_EQ(picture(scene, settings), three);
  settings.photonPasses = 1000;
  settings.spp = 1;
  EXPECT_EQ(picture(scene, settings), first) << "no more maps than samples are made";
  settings.spp = 4, settings.photonPasses = 1;
  EXPECT_NE(picture(scene, settings), three);
}

}  // namespace
}  // namespace trace::test::photon_test
