// Each trait of an integrator says what its pictures do: an experiment for each trait, by every integrator
// and with the options that add traits.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geometry/shapes/solids/sphere.h"
#include "scene/options.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/point_light.h"
#include "support/rooms.h"

namespace trace::test::traits_test {
namespace {

struct Variant {
  std::string name;
  Settings settings;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const IntegratorRow& row : integrators()) {
    Settings settings{
        .width = 8, .spp = 4, .sampling = SampleKind::sobol, .integrator = row.kind, .depth = 3};
    settings.threads = 1;
    settings.photons = settings.chainStarts = 2000;
    settings.photonPasses = 1;
    all.push_back({std::string(row.name), settings});
    if (!row.when) continue;
    settings.caustics = 2000;
    for (const Chains chains : {Chains::path, Chains::veach}) {
      settings.chains = chains;
      all.push_back({std::string(row.name) + " with chains " + std::to_string(static_cast<int>(chains)) +
                         " and caustics",
                     settings});
    }
  }
  return all;
}

bool showsLight(const Settings& settings) {
  return hasTrait(settings, Trait::asksAllLights) || hasTrait(settings, Trait::meetsLamps);
}

/// A room with ambient light and a light, and a lamp behind the camera.
Scene room(Real light = 1, Real ambient = 0.2, Real lamp = 1) {
  Scene scene = openRoom();
  for (Material& material : scene.materials) material.model.edit<Phong>()->ambient = Color(0.5);
  addObject(scene, Sphere{}, Affine::translation({0, 0, 7}), diffuse(0, lamp));
  scene.lights.push_back({PointLight{.position = {0.3, 0.7, 0.4}, .color = Color(light)}, {}});
  scene.lights.push_back({AmbientLight{.color = Color(ambient)}, {}});
  return scene;
}

/// A wall that fills the picture, with that many lights in front of it.
Scene wallWithLights(int lights) {
  Scene scene;
  addObject(scene, Square{}, scaled(20), diffuse(0.7));
  for (int i = 0; i < lights; ++i)
    scene.lights.push_back({PointLight{.position = {0.1 * i, 0, 3}, .color = Color(0.1)}, {}});
  scene.camera.position = {0, 0, 4};
  return scene;
}

std::uint64_t raysOf(const Statistics& statistics, RayKind kind) {
  return statistics.rays[static_cast<std::size_t>(kind)];
}

bool differ(const Scene& a, const Scene& b, const Settings& settings) {
  return picture(a, settings) != picture(b, settings);
}
bool differ(const Scene& scene, const Settings& a, const Settings& b) {
  return picture(scene, a) != picture(scene, b);
}

template <class Experiment>
void expectTrait(Trait trait, const Experiment& shows) {
  int have = 0;
  for (const Variant& variant : variants()) {
    SCOPED_TRACE(variant.name);
    EXPECT_EQ(shows(variant.settings), hasTrait(variant.settings, trait));
    have += hasTrait(variant.settings, trait);
  }
  EXPECT_GT(have, 0) << "the trait is some integrator's";
}

TEST(Traits, AsksAllLights) {
  constexpr int kLights = 40;  // more than integrators that choose one sample all of
  const Scene scene = wallWithLights(kLights);
  expectTrait(Trait::asksAllLights, [&](const Settings& settings) {
    Statistics statistics;
    picture(scene, settings, &statistics);
    return raysOf(statistics, RayKind::shadow) >= kLights * raysOf(statistics, RayKind::camera);
  });
}

TEST(Traits, AddsAmbient) {
  expectTrait(Trait::addsAmbient,
              [](const Settings& settings) { return differ(room(1, 0.2), room(1, 0.4), settings); });
}

TEST(Traits, MeetsLamps) {
  expectTrait(Trait::meetsLamps,
              [](const Settings& settings) { return differ(room(1, 0.2, 1), room(1, 0.2, 8), settings); });
}

TEST(Traits, Bounces) {
  expectTrait(Trait::bounces, [](const Settings& settings) {
    Settings once = settings;  // no surface of the room mirrors
    once.depth = 1;
    return differ(room(), settings, once);
  });
}

TEST(Traits, ScattersInMedia) {
  expectTrait(Trait::scattersInMedia, [](Settings settings) {
    if (changesPaths(settings)) return true;  // it knows no fog
    settings.fog = 0.4, settings.mediumDepth = 3;
    Settings once = settings;
    once.mediumDepth = 1;
    return differ(room(), settings, once);
  });
}

TEST(Traits, BringsCaustics) {
  Scene scene = room();
  Phong glass;
  glass.transmissive = Color(0.9), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0.2, 0, 0.2}) * scaled(0.6), glass);
  for (const Variant& variant : variants()) {
    if (!showsLight(variant.settings)) continue;
    SCOPED_TRACE(variant.name);
    Settings black = variant.settings;
    black.glassShadows = GlassShadows::black;
    const bool shadowRaysPass = differ(scene, variant.settings, black);
    EXPECT_NE(shadowRaysPass, hasTrait(variant.settings, Trait::bringsCaustics));
  }
}

TEST(Traits, JoinsEnds) {
  expectTrait(Trait::joinsEnds, [](const Settings& settings) {
    if (changesPaths(settings)) return false;  // its mutations join parts of a path
    Statistics statistics;
    picture(room(), settings, &statistics);
    return raysOf(statistics, RayKind::light) > 0;
  });
}

TEST(Traits, SplatsByChains) {
  const Scene scene = room();
  const auto rendered = [&](const Settings& settings, const auto& look) {
    const World world = build(scene, settings);
    const Size size = pictureSize(settings, scene.camera);
    Film film = makeFilm(settings, size.width, size.height);
    Job job;
    const RenderResult result = render(world, settings, film, job);
    EXPECT_EQ(result.end, End::finished) << result.failure;
    return look(film, result);
  };
  expectTrait(Trait::splats, [&](const Settings& settings) {
    return rendered(settings, [](const Film& film, const RenderResult&) {
      if (!film.takesSplats()) return false;
      for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
          if (!isBlack(film.ofSplats(x, y))) return true;
      return false;
    });
  });
  expectTrait(Trait::byChains, [&](const Settings& settings) {
    return rendered(settings,
                    [](const Film&, const RenderResult& result) { return result.brightnessError > 0; });
  });
}

TEST(Traits, Photons) {
  expectTrait(Trait::photons, [](const Settings& settings) {
    Settings more = settings;
    more.photons *= 2;
    return differ(room(), settings, more);
  });
}

TEST(Traits, ShowsData) {
  expectTrait(Trait::showsData, [](const Settings& settings) {
    Settings otherNoise = settings;
    otherNoise.sampling = SampleKind::grid;  // the same camera rays
    Settings otherSeed = otherNoise;
    otherSeed.seed = 1;
    return !differ(room(), otherNoise, otherSeed) && !differ(room(1), room(3), settings);
  });
}

TEST(Traits, OptionsNameTheIntegratorsThatTheyConcern) {
  const auto named = [](std::string_view option) {
    return namesOfIntegrators(findOption(option).integrators);
  };
  EXPECT_EQ(named("depth"), "all");
  EXPECT_EQ(named("glossy"), "whitted");
  EXPECT_EQ(named("ambient-occlusion"), "whitted");
  EXPECT_EQ(named("occlusion-reach"), "whitted, occlusion");
  EXPECT_EQ(named("caustics"), "whitted, photon");
  EXPECT_EQ(named("photons"), "photon");
  EXPECT_EQ(named("unweighted"), "bdpt");
  EXPECT_EQ(named("chains"), "mlt");
  EXPECT_EQ(named("medium-depth"), "path, bdpt, mlt, photon");
  EXPECT_EQ(named("firefly-limit"), "path, direct, bdpt, mlt, photon");
  EXPECT_EQ(named("fog"), "whitted, path, direct, bdpt, mlt, photon");
  EXPECT_EQ(named("smooth-terminator"), "whitted, path, direct, bdpt, mlt, photon, occlusion");
}

}  // namespace
}  // namespace trace::test::traits_test
