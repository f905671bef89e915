// What Whitted's equation makes of panes, lobes, strands and outlines.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/surfaces/curves.h"
#include "render/integrators/whitted.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/materials/conductor.h"
#include "shading/materials/lambert.h"
#include "shading/materials/marschner.h"
#include "shading/materials/rough_glass.h"
#include "shading/materials/thin_glass.h"
#include "support/scenes.h"

namespace trace::test::models_test {
namespace {

Affine at(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }

void add(Scene& scene, Shape shape, const Affine& transform, const MaterialModel& model) {
  scene.materials.push_back({"", model, {}});
  scene.objects.push_back(
      {"", std::move(shape), transform, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}

Phong glowing(const Color& color) {
  Phong phong;
  phong.emissive = color;
  return phong;
}

/// Light of 1 from everywhere.
Scene furnace() {
  Scene scene;
  add(scene, Sphere{}, Affine::scaling({100, 100, 100}), glowing(Color(1)));
  return scene;
}

/// The mean of so many samples of one pixel whose camera rays are all `ray`.
Color mean(const Scene& scene, const Ray& ray, Settings settings, int samples = 1) {
  settings.spp = samples, settings.sampling = SampleKind::sobol;
  const World world = build(scene, settings);
  Tracer tracer(world, settings);
  const SampleRules rules(settings, {1, 1});
  Color sum;
  for (int k = 0; k < samples; ++k) {
    const CameraRay camera(ray, tracer.interfacesAt(ray.origin),
                           [&](Interfaces& inside) { return tracer.cast(ray, RayKind::camera, inside); });
    sum += Whitted().radiance(tracer, Sampler(rules, 0, 0, k), camera);
  }
  return sum / samples;
}

const Ray kDown{{0, 0, 10}, {0, 0, -1}};

TEST(ThinGlass, MirrorsAndPassesByItsFormulaWhateverFresnelSays) {
  for (const Real film : {0.0, 420.0})
    for (const Fresnel fresnel : {Fresnel::constant, Fresnel::exact})
      for (const NestedGlass nested : {NestedGlass::off, NestedGlass::on}) {
        ThinGlass glass;
        glass.film = film, glass.color = {0.5, 0.9, 1};
        Scene scene;
        add(scene, Square{}, Affine::scaling({50, 50, 1}), glass);
        add(scene, Square{}, at(0, 0, -5) * Affine::scaling({90, 90, 1}), glowing(Color(1)));
        const Settings settings{.nestedGlass = nested, .fresnel = fresnel};
        const Ray slanting{{0, 0, 3}, normalize(Vec3{0.6, 0, -0.8})};
        const Color passed = glass.shares(0.8).passed, seen = mean(scene, slanting, settings);
        EXPECT_NEAR(seen.r, passed.r, 1e-12);
        EXPECT_NEAR(seen.b, passed.b, 1e-12);
        // The light of a sun on the floor is filtered likewise.
        scene.objects.pop_back();
        Phong white;
        white.diffuse = Color(1);
        add(scene, Square{}, at(0, 0, -5) * Affine::scaling({90, 90, 1}), white);
        scene.lights.push_back({DirectionalLight{.direction = {0.6, 0, -0.8}, .color = Color(1)}, {}});
        const Color lit = mean(scene, {{0, 0, -1}, {0, 0, -1}}, settings);
        EXPECT_NEAR(lit.g, 0.8 * passed.g, 1e-12);
      }
}

TEST(ThinGlass, KeepsAllLightInAFurnaceAndBendsNone) {
  Scene scene = furnace();
  ThinGlass bubble;
  bubble.film = 300, bubble.index = 1.33;
  add(scene, Sphere{}, at(0.4, 0, 0), bubble);
  const Color seen = mean(scene, kDown, {.depth = 14});
  EXPECT_NEAR(seen.r, 1, 1e-6);
  EXPECT_NEAR(seen.b, 1, 1e-6);

  Scene target;  // a spot just where a straight line ends
  bubble.film = 0, bubble.index = 2;
  add(target, Sphere{}, at(0.7, 0, 0), bubble);
  add(target, Sphere{}, at(0, 0, -20) * Affine::scaling({0.01, 0.01, 0.01}), glowing(Color(1)));
  EXPECT_GT(mean(target, kDown, {}).g, 0.5);
}

TEST(Glossy, WhiteMetalVanishesInAFurnace) {
  Conductor metal;
  metal.color = Color(1), metal.roughness = 0.5;
  Scene scene = furnace();
  add(scene, Sphere{}, Affine{}, metal);
  const Ray ray{{0.6, 0, 10}, {0, 0, -1}};
  EXPECT_NEAR(mean(scene, ray, {.glossy = true}, 1024).g, 1, 0.01);
  const Real sharp = Microfacets::of(Distribution::ggx, 0.5).sharpShare();
  EXPECT_NEAR(mean(scene, ray, {}).g, sharp, 1e-9) << "off, the core of the lobe alone";
}

TEST(Glossy, RoughGlassLosesLittleInAFurnace) {
  RoughGlass glass;
  glass.roughness = 0.4;
  Scene scene = furnace();
  add(scene, Sphere{}, Affine{}, glass);
  const Ray ray{{0.5, 0, 10}, {0, 0, -1}};
  const Real seen = mean(scene, ray, {.depth = 40, .glossy = true}, 1024).g;
  EXPECT_GT(seen, 0.93);
  EXPECT_LT(seen, 1.01);
}

TEST(Glossy, GlassOfRoughnessZeroIsExactGlass) {
  RoughGlass glass;
  glass.roughness = 0;
  Scene scene = furnace();
  add(scene, Sphere{}, Affine{}, glass);
  const Ray ray{{0.5, 0, 10}, {0, 0, -1}};
  EXPECT_NEAR(mean(scene, ray, {.depth = 30, .airIndex = 1}).g, 1, 1e-6);
  Phong clear;
  clear.transmissive = Color(1), clear.index = 1.5;
  Scene other = furnace();
  add(other, Sphere{}, Affine{}, clear);
  EXPECT_EQ(mean(scene, ray, {.depth = 5}), mean(other, ray, {.depth = 5, .fresnel = Fresnel::exact}));
}

TEST(Marschner, LightFromBehindShinesThroughTheStrandButNotThroughOthers) {
  Marschner hair;
  hair.color = Color(0.9);
  Scene scene;
  add(scene, Conic{.bottomRadius = 1, .topRadius = 1}, Affine{}, hair);
  scene.lights.push_back({DirectionalLight{.direction = {1, 0, 0}, .color = Color(1)}, {}});
  const Ray ray{{10, 0.2, 0.5}, {-1, 0, 0}};  // towards the lamp
  const Real through = mean(scene, ray, {}).g;
  EXPECT_GT(through, 0.05);
  Phong black;
  add(scene, Sphere{}, at(-5, 0, 0.5) * Affine::scaling({2, 2, 2}), black);
  EXPECT_EQ(mean(scene, ray, {}).g, 0);
}

TEST(Marschner, LightShinesThroughAStrandOfCurvesAndOtherStrandsShadeIt) {
  Marschner hair;
  hair.color = Color(0.9), hair.angle = 0;
  const Curves::Strand front{{10, 0, -5, 2}, {10, 0, 5, 2}}, behind{{5, 0, -5, 4}, {5, 0, 5, 4}};
  const auto seen = [&](const std::vector<Curves::Strand>& strands) {
    Scene scene;
    add(scene, Curves{strands, Spline::linear, true}, Affine{}, hair);
    scene.lights.push_back({DirectionalLight{.direction = {1, 0, 0}, .color = Color(1)}, {}});
    return mean(scene, {{20, 0.2, 0.5}, {-1, 0, 0}}, {}).g;  // towards the lamp
  };
  EXPECT_GT(seen({front}), 0.05);
  EXPECT_EQ(seen({front, behind}), 0) << "another strand of the object";
}

TEST(Models, AreShownAsPhong) {
  Scene scene = furnace();
  Lambert matt;
  matt.diffuse = Color(0.5), matt.emissive = Color(0.25);
  add(scene, Square{}, Affine{}, matt);
  EXPECT_NEAR(mean(scene, kDown, {.models = Models::phong}).g, 0.25, 1e-12);
  scene.materials.back() = {"", matt, {{"emissive", pictureTexture("no.png")}}};
  EXPECT_NEAR(mean(scene, kDown, {.textures = false}).g, 0.25, 1e-12);
}

TEST(Outlines, LieWhereThingsEndAndAreExplained) {
  Scene scene;
  add(scene, Sphere{}, Affine{}, glowing(Color(1)));
  scene.camera.position = {0, 0, 10};
  const Settings settings{.width = 60, .outlines = 3};
  const World world = build(scene, settings);
  const Picture drawn = picture(world, settings, scene.camera);
  Settings without = settings;
  without.outlines = 0;
  const Picture plain = picture(world, without, scene.camera);
  EXPECT_EQ(drawn.at(30, 30), plain.at(30, 30)) << "the middle";
  EXPECT_EQ(drawn.at(2, 2), plain.at(2, 2)) << "nothing";
  int inked = 0;
  for (int x = 0; x < 60; ++x) {
    const Real ink = plain.at(x, 30).g - drawn.at(x, 30).g;
    EXPECT_GE(ink, 0);
    inked += ink > 0.2;
  }
  EXPECT_GE(inked, 2) << "both sides of the ball";
  EXPECT_LE(inked, 6);
  const auto integrator = integratorOf(world, settings);
  for (const int x : {20, 23, 24, 25, 30}) {
    const Explanation told = explain(world, *integrator, settings, {60, 60}, x, 30, 0);
    EXPECT_TRUE(sumsUp(told.tree));
    EXPECT_EQ(told.pixel, drawn.at(x, 30));
  }
}

}  // namespace
}  // namespace trace::test::models_test
