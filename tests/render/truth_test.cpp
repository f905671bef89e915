// What integrators agree on beyond rooms: Veach's plates, glass by every Fresnel formula, a disk that shines,
// and conventions, which are rules of Whitted's tracer and of pictures, not of light.
#include <gtest/gtest.h>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/picture/agreement.h"
#include "scene/conventions.h"
#include "shading/lights/point_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/materials/conductor.h"
#include "support/rooms.h"

namespace trace::test::truth_test {
namespace {

Settings settingsOf(IntegratorKind integrator, int spp, int width = 16) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = width;
  settings.depth = 3, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  return settings;
}

void expectAgreement(const char* name, const Scene& scene, const Settings& a, const Settings& b) {
  const Agreement found = agreement(scene, a, b, 8, 4);
  EXPECT_GT(found.uniform, 1e-3) << name;
  EXPECT_NEAR(found.meanA, found.meanB, 3.5 * found.error) << name;
  EXPECT_LT(found.error, 0.03 * found.meanA) << name << ": or nothing is shown";
}

/// Veach's scene of 1995: four plates, from shiny to rough, mirror four balls of one power and many sizes.
Scene plates() {
  Scene scene;
  int number = 0;
  for (const Real roughness : {0.05, 0.12, 0.25, 0.5}) {
    Conductor metal;
    metal.roughness = roughness;
    scene.materials.push_back({"", metal, {}});
    const Real lean = -0.5 + 0.05 * (number + 2);
    const Affine place = Affine::translation({0, -0.9 + 0.3 * number, 0.8 - 0.5 * number}) *
                         turned({1, 0, 0}, lean) * Affine::scaling({3, 0.45, 1});
    scene.objects.push_back(
        {"", Square{}, place, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
    ++number;
  }
  number = 0;
  for (const Real radius : {0.03, 0.08, 0.2, 0.4}) {
    addObject(scene, Sphere{}, Affine::translation({-1.2 + 0.8 * number, 1.2, -0.6}) * scaled(radius),
              diffuse(Color(0), 0.4 / (radius * radius)));
    ++number;
  }
  addObject(scene, Square{}, Affine::translation({0, 0, -2}) * Affine::scaling({6, 6, 1}),
            diffuse(Color(0.4)));
  scene.camera.position = {0, 0.4, 4};
  scene.camera.fov = 40;
  return scene;
}

TEST(Truth, PlatesLookTheSameFromBothEnds) {
  expectAgreement("plates", plates(), settingsOf(IntegratorKind::path, 128),
                  settingsOf(IntegratorKind::bdpt, 64));
}

/// A cube open toward the camera, with a lamp and a ball of glass.
Scene glassRoom() {
  Scene scene;
  const Affine wall = Affine::translation({0, 0, 1}) * Affine::scaling({2, 2, 1});
  for (const auto& [axis, angle] : {std::pair{Vec3{0, 1, 0}, 1.0},
                                    {Vec3{0, 1, 0}, 0.5},
                                    {Vec3{0, 1, 0}, 1.5},
                                    {Vec3{1, 0, 0}, 0.5},
                                    {Vec3{1, 0, 0}, 1.5}})
    addObject(scene, Square{}, turned(axis, angle) * wall, diffuse(Color(0.6)));
  addObject(scene, Square{}, Affine::translation({0, 0.98, 0}) * turned({1, 0, 0}, 0.5) * scaled(1.2),
            diffuse(Color(0.5), 4));
  Phong glass;
  glass.transmissive = Color(0.9), glass.reflective = Color(0.2), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0.3, -0.4, 0.2}) * scaled(0.5), glass);
  scene.camera.position = {0, 0, 3.8};
  scene.camera.fov = 36;
  return scene;
}

TEST(Truth, GlassLooksTheSameFromBothEndsByEveryFormula) {
  for (const Fresnel fresnel : {Fresnel::constant, Fresnel::schlick, Fresnel::exact}) {
    Settings path = settingsOf(IntegratorKind::path, 128), bdpt = settingsOf(IntegratorKind::bdpt, 48);
    path.fresnel = bdpt.fresnel = fresnel;
    expectAgreement("glass", glassRoom(), path, bdpt);
  }
}

TEST(Truth, ManyLightsLookTheSameFromBothEnds) {
  // bdpt asks one of them by the tree, and starts paths at all.
  Scene scene = glassRoom();
  scene.objects.resize(5);
  for (int i = 0; i < 60; ++i)
    scene.lights.push_back(
        {PointLight{.position = {-0.8 + 0.16 * (i % 11), -0.7 + 0.25 * (i % 7), 0.1 * (i % 5)},
                    .color = Color(0.02 + 0.01 * (i % 3)),
                    .radius = i % 2 ? 0.0 : 0.03},
         {}});
  for (const int choices : {0, 3}) {
    Settings path = settingsOf(IntegratorKind::path, 96), bdpt = settingsOf(IntegratorKind::bdpt, 48);
    path.lightChoices = bdpt.lightChoices = choices;
    expectAgreement("lights", scene, path, bdpt);
  }
}

TEST(Truth, ADiskThatShinesLightsWhatIsUnderItByItsFormFactor) {
  // A disk of radius 1 and radiance 1 at height 1: pi / 2, of which a white floor gives back a part of pi.
  for (const IntegratorKind integrator :
       {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt}) {
    Scene scene;
    addObject(scene, Square{}, turned({1, 0, 0}, -0.5) * Affine::scaling({0.02, 0.02, 1}), diffuse(Color(1)));
    scene.lights.push_back({RectangleLight{.position = {0, 1, 0},
                                           .u = {2, 0, 0},
                                           .v = {0, 0, 2},
                                           .color = Color(1),
                                           .round = true,
                                           .twoSided = true},
                            {}});
    scene.camera.position = {3, 1, 0}, scene.camera.viewdir = {-3, -1, 0};
    scene.camera.fov = 0.02;
    Settings settings = settingsOf(integrator, 1024, 4);
    settings.sampling = SampleKind::sobol;
    settings.depth = 1;
    Real mean = 0;
    for (const Color& c : picture(scene, settings).pixels) mean += c.g / 16;
    EXPECT_NEAR(mean, 0.5, 0.001) << static_cast<int>(integrator);
  }
}

TEST(Truth, ConventionsChangeNoLight) {
  // Rules for the same words: where all words mean the same, light does. Pixels lie elsewhere by some.
  Scene scene = glassRoom();
  scene.objects.pop_back();
  for (const IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::bdpt}) {
    std::vector<double> means;
    for (const Convention& row : conventions()) {
      Settings settings = row.settings;
      const Settings wanted = settingsOf(integrator, 64, 12);
      settings.integrator = integrator;
      settings.sampling = wanted.sampling;
      settings.width = settings.height = wanted.width;
      settings.depth = wanted.depth, settings.spp = wanted.spp;
      settings.pixelPosition = PixelPosition::center;
      const Picture shown = picture(scene, settings);
      double mean = 0;
      for (const Color& c : shown.pixels) mean += c.g / static_cast<double>(shown.pixels.size());
      means.push_back(mean);
    }
    EXPECT_GT(means.size(), 5u);
    for (std::size_t i = 0; i < means.size(); ++i)
      EXPECT_NEAR(means[i], means[0], 1e-12) << conventions()[i].name << " " << static_cast<int>(integrator);
  }
}

}  // namespace
}  // namespace trace::test::truth_test
