// Media against closed forms, quadrature and Chandrasekhar's half space.
#include "render/media/media.h"

#include <gtest/gtest.h>

#include <set>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/medium.h"
#include "shading/textures/checker.h"
#include "shading/textures/gradient.h"
#include "shading/textures/noise.h"
#include "support/half_space.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::media_test {
namespace {

Settings small(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.width = settings.height = 4;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.spp = spp;
  return settings;
}
Real mean(const Scene& scene, const Settings& settings) {
  Real sum = 0;
  const Picture all = picture(scene, settings);
  for (const Color& c : all.pixels) sum += c.g;
  return sum / static_cast<Real>(all.pixels.size());
}

Explanation explained(const Scene& scene, const Settings& settings, int x, int y, int sample) {
  const World world = build(scene, settings);
  return explain(world, *integratorOf(world, settings), settings, pictureSize(settings, scene.camera), x, y,
                 sample);
}

Scene looking() {
  Scene scene;
  scene.camera.viewdir = {0, 0, -1};
  scene.camera.fov = 1e-4;
  return scene;
}

void addScreen(Scene& scene, Real z, const Phong& phong) {
  addObject(scene, Square{}, Affine::translation({0, 0, z}), phong);
}
Phong shining() {
  Phong phong;
  phong.emissive = Color(1);
  return phong;
}
Affine boxAt(Real z, Real depth) { return Affine::translation({0, 0, z}) * Affine::scaling({20, 20, depth}); }
/// Grows from 0 to 1 along z between the faces of a box.
Texture growing() {
  TextureNode node;
  node.model = Gradient{};
  node.model.edit<Gradient>()->a = Color(0);
  node.model.edit<Gradient>()->b = Color(1);
  node.placement.rotate = {0, -90, 0};  // x of the pattern is z
  node.placement.translate = {0, 0, -0.5};
  return node;
}

TEST(Media, SwallowLightByBeersLaw) {
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path})
    for (const Real depth : {0.1, 0.5, 1.0, 2.0}) {
      Scene scene = looking();
      addScreen(scene, -9, shining());
      Material& cloud = addCloud(scene, Cube{}, boxAt(-5, 2), depth / 2);
      cloud.mediumScatters = Color(0), cloud.mediumAbsorbs = {1, 1, 0.5};
      const Color seen = picture(scene, small(integrator, 1)).at(2, 2);
      EXPECT_NEAR(seen.g, std::exp(-depth), 1e-9) << depth;
      EXPECT_NEAR(seen.b, std::exp(-depth / 2), 1e-9) << depth;
    }
}

TEST(Media, SwallowTheLightOfALampAsThatOfARay) {
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path}) {
    Scene scene = looking();
    Phong white;
    white.diffuse = Color(1);
    addScreen(scene, -9, white);
    scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
    Material& cloud = addCloud(scene, Cube{}, boxAt(-5, 2), 0.5);
    cloud.mediumScatters = Color(0), cloud.mediumAbsorbs = Color(1);
    EXPECT_NEAR(mean(scene, small(integrator, 1)), std::exp(-2), 1e-9);
    EXPECT_TRUE(sumsUp(explained(scene, small(integrator, 1), 2, 2, 0).tree));
  }
}

TEST(Media, SwallowByTheirDensityWhereThatChanges) {
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path}) {
    Scene scene = looking();
    addScreen(scene, -9, shining());
    Material& cloud = addCloud(scene, Cube{}, boxAt(-5, 2), 1.5);
    cloud.mediumScatters = Color(0), cloud.mediumAbsorbs = Color(1);
    setTexture(cloud.textures, "medium_density", growing());
    EXPECT_NEAR(mean(scene, small(integrator, 4096)) / std::exp(-1.5), 1, 0.01);
  }
}

TEST(Media, GiveOffLightThatTheySwallowAgain) {
  for (const bool textured : {false, true})
    for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path}) {
      Scene scene = looking();
      Material& cloud = addCloud(scene, Cube{}, boxAt(-5, 2), 0.6);
      cloud.mediumScatters = Color(0), cloud.mediumAbsorbs = Color(1), cloud.mediumGlows = Color(3);
      if (textured) setTexture(cloud.textures, "medium_density", growing());
      const Real depth = textured ? 0.6 : 1.2;
      EXPECT_NEAR(mean(scene, small(integrator, textured ? 2048 : 1)) / (3 * (1 - std::exp(-depth))), 1,
                  textured ? 0.01 : 1e-9);
    }
}

/// The light of a point lamp at (1, 0, -3) that is scattered once to a ray along -z, in a big cloud.
TEST(Media, ScatterTheLightOfALampOnceByTheIntegral) {
  for (const bool textured : {false, true}) {
    Scene scene = looking();
    Material& cloud = addCloud(scene, Cube{}, boxAt(-5, 8), 0.3);
    cloud.mediumForward = 0.4, cloud.mediumAbsorbs = Color(0.5);
    if (textured) {
      TextureNode half;
      half.model = Checker{};
      half.model.edit<Checker>()->a = half.model.edit<Checker>()->b = Color(0.5);
      setTexture(cloud.textures, "medium_density", half);
    }
    scene.lights.push_back(
        {PointLight{.position = {1, 0, -3}, .color = Color(2), .constant = 0, .quadratic = 1}, {}});
    Settings rules = small(IntegratorKind::whitted, 2048);
    rules.limitAttenuation = false;
    const Real density = textured ? 0.15 : 0.3, loses = density * 1.5;
    Real expected = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      const Real z = 1 + 8 * (i + 0.5) / kSteps, away2 = 1 + (z - 3) * (z - 3), away = std::sqrt(away2);
      const Vec3 toLight = Vec3{1, 0, z - 3} / away;
      expected += density * std::exp(-loses * (z - 1 + away)) * 2 * kPi / away2 *
                  phase(0.4, dot(Vec3{0, 0, -1}, toLight)) * 8 / kSteps;
    }
    EXPECT_NEAR(mean(scene, rules) / expected, 1, 0.01) << textured;
    rules.integrator = IntegratorKind::path;
    rules.mediumDepth = 1;
    EXPECT_NEAR(mean(scene, rules) / expected, 1, 0.02) << textured;
  }
}

TEST(Media, AskTheLightsAtAsManyPlacesWhetherTheyChangeOrNot) {
  for (const bool cloud : {true, false})
    for (const bool foggy : {true, false}) {
      if (!cloud && !foggy) continue;
      Scene scene = looking();
      if (cloud) addCloud(scene, Cube{}, boxAt(-3, 4), 0.5);
      scene.lights.push_back({PointLight{.position = {0, 2, -3}, .color = Color(4)}, {}, {.name = "lamp"}});
      Settings settings = small(IntegratorKind::whitted, 1);
      settings.fog = foggy ? 0.3 : 0;
      settings.fogSamples = 8;
      const RayTree tree = explained(scene, settings, 1, 1, 0).tree;
      std::set<Real> places;
      for (std::size_t i = 1; i < tree.nodes.size(); ++i) {
        EXPECT_EQ(lightOf(tree, static_cast<int>(i)), 0u) << "the ray names its light";
        places.insert(tree.nodes[i].ray.origin.z);
      }
      EXPECT_GE(places.size(), cloud && foggy ? 6u : 8u) << "of both, some may be chosen twice";
    }
}

TEST(Media, MorePlacesAreLessNoiseWhereTheyAreTheSameEverywhere) {
  Scene scene = looking();
  addCloud(scene, Cube{}, boxAt(-3, 4), 0.5);
  scene.lights.push_back({PointLight{.position = {0, 1, -3}, .color = Color(4)}, {}});
  const auto noise = [&](int places) {
    Settings settings = small(IntegratorKind::whitted, 1);
    settings.width = settings.height = 32;
    settings.sampling = SampleKind::random;
    settings.fogSamples = places;
    Real sum = 0, squares = 0;
    const Picture all = picture(scene, settings);
    for (const Color& c : all.pixels) sum += c.g, squares += c.g * c.g;
    const Real n = static_cast<Real>(all.pixels.size());
    return std::sqrt(squares / n - sum / n * sum / n);
  };
  EXPECT_LT(noise(16), noise(1) / 6) << "each place in a part of its own";
}

TEST(Media, AreLitThroughGlassWherePhotonsGatherCaustics) {
  Scene scene = looking();
  addCloud(scene, Cube{}, boxAt(-3, 4), 0.5);
  Phong glass;
  glass.transmissive = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0, 3, -3}), glass);
  scene.lights.push_back({PointLight{.position = {0, 6, -3}, .color = Color(40)}, {}});
  Settings settings = small(IntegratorKind::whitted, 16);
  const Real without = mean(scene, settings);
  settings.caustics = 1000;
  EXPECT_NEAR(mean(scene, settings), without, 1e-12) << "photons are kept on surfaces alone";
  EXPECT_GT(without, 0.01);
}

TEST(Media, ScatterOftenAsAHalfSpaceDoes) {
  const HalfSpace half(0.9);
  Scene scene;
  scene.camera.position = {0, 0, 10}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 1e-4;
  Material& cloud = addCloud(scene, Cube{}, Affine::translation({0, 0, -500}) * scaled(1000), 1);
  cloud.mediumScatters = Color(0.9), cloud.mediumAbsorbs = Color(0.1);
  scene.lights.push_back({DirectionalLight{.direction = {0.6, 0, -0.8}, .color = Color(1)}, {}});
  EXPECT_NEAR(mean(scene, small(IntegratorKind::path, 1024)) / half.radiance(1, 0.8), 1, 0.02);
}

TEST(Media, ThatSwallowNothingVanishInAnEvenSky) {
  for (const bool textured : {false, true}) {
    Scene scene;
    scene.camera.position = {0, 0, 4}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 30;
    scene.background.gradient = {Color(0.7), Color(0.7)};
    Material& cloud = addCloud(scene, Sphere{}, Affine{}, 4);
    cloud.mediumForward = 0.6;
    if (textured) {
      TextureNode noise;
      noise.model = Noise{};
      noise.placement.scale = {0.4, 0.4, 0.4};
      setTexture(cloud.textures, "medium_density", noise);
    }
    Settings settings = small(IntegratorKind::path, 256);
    settings.mediumDepth = 10000;
    EXPECT_NEAR(mean(scene, settings), 0.7, 0.005) << textured;
  }
}

TEST(Media, FillGlassAndTheEyeInIt) {
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path})
    for (const NestedGlass nested : {NestedGlass::off, NestedGlass::on}) {
      Scene scene = looking();
      addScreen(scene, -9, shining());
      Material glass;
      Phong clear;
      clear.transmissive = Color(1), clear.index = 1.5;
      glass.model = clear;
      glass.mediumDensity = 0.2, glass.mediumScatters = Color(0), glass.mediumAbsorbs = Color(1);
      scene.materials.push_back(glass);
      scene.objects.push_back({"", Cube{}, boxAt(0, 8), 1, {}});  // from 4 to -4
      Settings settings = small(integrator, 16);
      settings.nestedGlass = nested;
      // With path, a ray in glass of constant Fresnel terms goes straight on.
      EXPECT_NEAR(mean(scene, settings), std::exp(-0.2 * 4), 1e-9);
      settings.fog = 0.3, settings.fogColor = Color(0);
      EXPECT_NEAR(mean(scene, settings), std::exp(-0.2 * 4 - 0.3 * 5), 1e-9) << "none of the fog is inside";
    }
}

TEST(Media, AreTheSameForAnyThreadsAndAsExplained) {
  Scene scene;
  scene.camera.position = {0, 0, 5}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 40;
  scene.background.gradient = {Color(0.2), Color(0.2)};
  Material& cloud = addCloud(scene, Sphere{}, Affine{}, 5);
  cloud.mediumGlows = {0.2, 0.1, 0};
  TextureNode noise;
  noise.model = Noise{};
  noise.placement.scale = {0.5, 0.5, 0.5};
  setTexture(cloud.textures, "medium_density", noise);
  Phong white;
  white.diffuse = Color(0.8);
  addObject(scene, Square{}, Affine::translation({0, 0, -2}) * Affine::scaling({5, 5, 1}), white);
  addObject(scene, Sphere{}, Affine::translation({2, 2, 0}) * scaled(0.3), shining());
  scene.lights.push_back({DirectionalLight{.direction = {-1, -1, -1}, .color = Color(1)}, {}});
  for (const IntegratorKind integrator : {IntegratorKind::whitted, IntegratorKind::path}) {
    Settings settings = small(integrator, 4);
    settings.width = settings.height = 24;
    settings.fog = 0.05;
    settings.threads = 1;
    const Picture one = picture(scene, settings);
    for (const int threads : {2, 7}) {
      settings.threads = threads;
      EXPECT_EQ(picture(scene, settings).pixels, one.pixels) << threads;
    }
    for (const int x : {8, 12, 15}) {
      const Explanation e = explained(scene, settings, x, 11, 1);
      EXPECT_TRUE(sumsUp(e.tree)) << x;
      EXPECT_EQ(e.pixel, one.at(x, 11)) << x;
    }
  }
}

TEST(Media, TheirPhaseIsChosenAsDenseAsItIs) {
  Random random(7);
  for (const Real forward : {-0.7, 0.0, 0.3, 0.9}) {
    constexpr int kCells = 20, kDraws = 200000;
    std::array<int, kCells> found{};
    Real sum = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Real cosine = phaseCosine(forward, random.uniform());
      sum += cosine;
      ++found[std::min<std::size_t>(kCells - 1, static_cast<std::size_t>((cosine + 1) / 2 * kCells))];
    }
    EXPECT_NEAR(sum / kDraws, forward, 0.005) << "the mean cosine";
    Real chi = 0;
    for (int cell = 0; cell < kCells; ++cell) {
      Real share = 0;
      for (int k = 0; k < 2000; ++k)
        share += 2 * kPi * phase(forward, -1 + 2 * (cell + (k + 0.5) / 2000) / kCells) * 2 / kCells / 2000;
      chi += (found[cell] - share * kDraws) * (found[cell] - share * kDraws) / (share * kDraws);
    }
    EXPECT_LT(chi, 45) << forward << ": of 19 degrees of freedom";
  }
}

}  // namespace
}  // namespace trace::test::media_test
