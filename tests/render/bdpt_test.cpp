// Bidirectional paths: every single way to put a path together shows the same picture, for lights, cameras
// and surfaces of every kind; weighed, they sum up to it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "image/srgb.h"
#include "math/hypothesis.h"
#include "render/paths/path_place.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/materials/conductor.h"
#include "shading/materials/oren_nayar.h"
#include "shading/materials/rough_glass.h"
#include "support/lights.h"
#include "support/random.h"
#include "support/rooms.h"
#include "support/scenes.h"

namespace trace::test::bdpt_test {
namespace {

const Affine kUpward = turned({1, 0, 0}, -0.5), kDownward = turned({1, 0, 0}, 0.5);

/// A floor, a wall and a box-like block, seen from before them.
Scene corner(const Phong& floor = diffuse(0.7)) {
  Scene scene;
  addObject(scene, Square{}, kUpward * Affine::scaling({4, 4, 1}), floor);
  addObject(scene, Square{}, Affine::translation({0, 1, -1}) * Affine::scaling({4, 2, 1}), diffuse(0.6));
  addObject(scene, Sphere{}, Affine::translation({-0.5, 0.4, 0}) * Affine::scaling({0.4, 0.4, 0.4}),
            diffuse(0.5));
  scene.camera.position = {0, 0.9, 2.6}, scene.camera.viewdir = {0, -0.2, -1};
  scene.camera.fov = 50;
  return scene;
}

void addPanel(Scene& scene, Real light = 6) {
  addObject(scene, Square{}, Affine::translation({0.2, 1.8, 0.2}) * kDownward, diffuse(0, light));
}

Settings settingsOf(int spp, int depth = 3, int width = 12) {
  Settings settings;
  settings.integrator = IntegratorKind::bdpt;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = width;
  settings.depth = depth, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  return settings;
}

TEST(PathPlace, AnEvenSurfaceAnswersWithTheBitsOfAnySurface) {
  Random random(47);
  Scene scene = randomScene(random, 12);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    Phong phong = *scene.materials[m].model.as<Phong>();
    phong.specular = phong.reflective = phong.transmissive = Color(0);
    scene.materials[m].model = phong;
    if (m % 2 == 0) scene.materials[m].sides = ShadedSides::both;
  }
  const Settings settings = settingsOf(1);
  const World world = build(scene, settings);
  Tracer tracer(world, settings);
  int lit = 0;
  for (int n = 0; n < 30000; ++n) {
    const Ray ray{random.inCube(6), random.direction()};
    Interfaces inside = tracer.interfacesAt(ray.origin);
    const std::optional<Hit> hit = tracer.cast(ray, RayKind::bounce, inside);
    if (!hit) continue;
    const Interaction at(tracer, ray, *hit, nullptr, inside, 0);
    const PathPlace place(at);
    const Vec3 toLight = random.direction();
    for (const Vec3& toEye : {place.from(), random.direction()}) {
      EXPECT_EQ(place.scattered(toEye, toLight), scattered(at, toEye, toLight));
      EXPECT_EQ(place.scatteredOn(toEye, toLight, false), scatteredOn(at, toEye, toLight));
      EXPECT_EQ(place.density(toEye, toLight), density(at.bsdf(), frameToward(at, toEye), toEye, toLight));
      lit += !isBlack(place.scattered(toEye, toLight));
    }
  }
  EXPECT_GT(lit, 300);
}

/// The moments of the means of pictures by several seeds.
Moments meansOf(const Scene& scene, Settings settings, int seeds = 8) {
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const std::array moments{Moment{&world, integrator.get()}};
  std::vector<double> means;
  for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
    Film film = makeFilm(settings, settings.width, settings.height);
    Job job;
    render(moments, settings, film, job);
    means.push_back(mean(film.picture()));
  }
  return momentsOf(means);
}

/// The ways s = from, ... of paths with so many places show the same; the error is known to the part `known`.
void expectTheSameByAllWays(const Scene& scene, const Settings& settings, int places, int from, int to,
                            Real known = 0.12) {
  Moments first;
  for (int s = from; s <= to; ++s) {
    Settings one = settings;
    one.lightVertices = s, one.cameraVertices = places - s, one.unweighted = true;
    const Moments found = meansOf(scene, one);
    if (s == from) first = found;
    EXPECT_GT(found.mean, 0) << "s = " << s << " of " << places;
    EXPECT_GT(welch(first, found), 1e-4)
        << "s = " << s << " of " << places << ": " << found.mean << ", not " << first.mean;
    EXPECT_LT(std::sqrt(found.variance / found.count), known * found.mean) << "s = " << s << " of " << places;
  }
}

TEST(Bidirectional, EveryWayShowsTheLightOfALamp) {
  Scene scene = corner();
  addPanel(scene);
  expectTheSameByAllWays(scene, settingsOf(64), 3, 0, 2);
  expectTheSameByAllWays(scene, settingsOf(64), 4, 0, 3);
  expectTheSameByAllWays(scene, settingsOf(64), 5, 1, 4, 0.2);
}

TEST(Bidirectional, EveryWayShowsTheLightOfABallAndOfAMesh) {
  Scene ball = corner();
  addObject(ball, Sphere{}, Affine::translation({0.4, 1.2, 0.3}) * Affine::scaling({0.3, 0.3, 0.3}),
            diffuse(0, 6));
  expectTheSameByAllWays(ball, settingsOf(100), 3, 0, 2);
  expectTheSameByAllWays(ball, settingsOf(100), 4, 1, 3);
  Scene mesh = corner();
  MeshData data;
  data.points = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  data.triangles = {{0, 1, 2}, {0, 2, 3}};
  addObject(mesh, Mesh{std::make_shared<MeshData>(data)}, Affine::translation({0.2, 1.8, 0.2}) * kDownward,
            diffuse(0, 6));
  expectTheSameByAllWays(mesh, settingsOf(64), 3, 0, 2);
}

TEST(Bidirectional, EveryWayShowsTheLightsOfTheScene) {
  for (const auto& [name, light] : lightsOfEveryKind()) {
    SCOPED_TRACE(name);
    Scene scene = corner();
    scene.lights.push_back({light, {}});
    expectTheSameByAllWays(scene, settingsOf(64), 3, 1, 2);
    expectTheSameByAllWays(scene, settingsOf(64), 4, 1, 3);
  }
}

TEST(Bidirectional, EveryWayShowsTheLightOfTheSky) {
  Scene even = corner();
  even.background.gradient = {{Color(1), Color(1)}};
  Scene bright = corner();
  bright.background.gradient = {{Color(0.05), Color(0.05), Color(4)}};
  bright.background.elevations = {-90, 40, 90};
  expectTheSameByAllWays(bright, settingsOf(100), 3, 0, 2);
  expectTheSameByAllWays(bright, settingsOf(100), 4, 0, 3);
  // Places that the sky is not asked for: paths from both ends find it.
  for (const int s : {0, 2}) {
    Settings one = settingsOf(200);
    one.lightVertices = s, one.cameraVertices = 3 - s, one.unweighted = true;
    static Moments first;
    const Moments found = meansOf(even, one);
    if (s == 0) first = found;
    EXPECT_GT(welch(first, found), 1e-4) << found.mean << ", not " << first.mean;
  }
}

TEST(Bidirectional, EveryWayShowsItThroughEveryCamera) {
  const std::vector<std::pair<const char*, std::function<void(Settings&)>>> cameras{
      {"lens", [](Settings& s) { s.aperture = 0.3, s.focus = 2.4; }},
      {"blades", [](Settings& s) { s.aperture = 0.3, s.focus = 3, s.blades = 5; }},
      {"shift", [](Settings& s) { s.shiftX = 0.1, s.shiftY = -0.2; }},
      {"orthographic", [](Settings& s) { s.projection = Projection::orthographic, s.viewHeight = 1.8; }},
      {"fisheye", [](Settings& s) { s.projection = Projection::fisheye; }},
      {"panorama", [](Settings& s) { s.projection = Projection::panorama; }},
      {"cylinder", [](Settings& s) { s.projection = Projection::cylinder; }},
      {"filter", [](Settings& s) { s.filter = FilterKind::mitchell; }}};
  Scene scene = corner();
  addPanel(scene);
  for (const auto& [name, change] : cameras) {
    SCOPED_TRACE(name);
    Settings settings = settingsOf(64);
    change(settings);
    expectTheSameByAllWays(scene, settings, 3, 1, 2);
  }
}

TEST(Bidirectional, EveryWayShowsSurfacesOfEveryKind) {
  const auto with = [](const MaterialModel& model) {
    Scene scene = corner();
    scene.materials[0].model = model;
    addPanel(scene);
    return scene;
  };
  Phong shiny = diffuse(0.3);
  shiny.specular = Color(0.4), shiny.shininess = 12;
  for (const Highlight highlight : {Highlight::blinn, Highlight::phong}) {
    Settings settings = settingsOf(64);
    settings.highlight = highlight;
    expectTheSameByAllWays(with(shiny), settings, 3, 1, 2);
    expectTheSameByAllWays(with(shiny), settings, 4, 1, 3);
  }
  expectTheSameByAllWays(with(Conductor{}), settingsOf(100), 3, 1, 2);
  expectTheSameByAllWays(with(OrenNayar{}), settingsOf(64), 4, 1, 3);
  Settings coated = settingsOf(64);
  coated.varnish = true;
  Phong varnished = diffuse(0.6);
  varnished.index = 1.5;
  expectTheSameByAllWays(with(varnished), coated, 3, 1, 2);  // of more places some are met by mirrors only
}

TEST(Bidirectional, NormalsBetweenVerticesAndRoughGlassKeepTheLight) {
  Random random(3);
  Scene scene = corner();
  addPanel(scene);
  addObject(scene, Mesh{ballMesh(8, random)},
            Affine::translation({0.6, 0.5, 0.2}) * Affine::scaling({0.5, 0.5, 0.5}), diffuse(0.7));
  expectTheSameByAllWays(scene, settingsOf(64), 3, 1, 2);
  expectTheSameByAllWays(scene, settingsOf(64), 4, 1, 3);
}

TEST(Bidirectional, RoughGlassKeepsTheLightBothWays) {
  Scene scene = corner();
  addPanel(scene);
  RoughGlass glass;
  glass.roughness = 1;
  scene.materials[2].model = glass;
  expectTheSameByAllWays(scene, settingsOf(100), 4, 1, 3);
  expectTheSameByAllWays(scene, settingsOf(300), 5, 1, 4, 0.3);
}

TEST(Bidirectional, WaterKeepsTheLightBothWays) {
  // A floor and a wall under water: lamp, water, wall or floor, the other, water, camera. By chance, or
  // joined in the water.
  Scene scene;
  Phong water;
  water.transmissive = water.reflective = Color(1), water.index = 1.33, water.attenuationColor = Color(0.8);
  addObject(scene, Cube{}, Affine::translation({0, 0.25, 0}) * Affine::scaling({5, 1.5, 5}), water);
  addObject(scene, Square{}, Affine::translation({0, -0.2, 0}) * kUpward * Affine::scaling({4, 4, 1}),
            diffuse(0.8));
  addObject(scene, Square{}, Affine::translation({0, 0.3, -1}) * Affine::scaling({4, 1, 1}), diffuse(0.8));
  addObject(scene, Square{}, Affine::translation({0, 2.5, 0}) * kDownward * Affine::scaling({3, 3, 1}),
            diffuse(0, 2));
  scene.camera.position = {0, 2.2, 1.8}, scene.camera.viewdir = {0, -1, -0.9};
  scene.camera.fov = 40;
  Settings settings = settingsOf(256, 6);
  Moments found[2];
  for (const int i : {0, 1}) {
    settings.lightVertices = 3 * i, settings.cameraVertices = 6 - 3 * i, settings.unweighted = true;
    found[i] = meansOf(scene, settings);
    EXPECT_GT(found[i].mean, 0);
    EXPECT_LT(std::sqrt(found[i].variance / found[i].count), 0.06 * found[i].mean);
  }
  EXPECT_GT(welch(found[0], found[1]), 1e-4) << found[0].mean << " " << found[1].mean;
}

TEST(Bidirectional, WeighedWaysSumUpToThePicture) {
  Scene scene = corner();
  addPanel(scene);
  Phong glass;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0.7, 0.35, 0.4}) * Affine::scaling({0.3, 0.3, 0.3}), glass);
  Settings settings = settingsOf(16, 2);
  const Picture whole = picture(scene, settings);
  Picture sum(whole.width, whole.height);
  for (int places = 2; places <= 5; ++places)
    for (int s = 0; s < places; ++s) {
      settings.lightVertices = s, settings.cameraVertices = places - s;
      const Picture one = picture(scene, settings);
      for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += one.pixels[i];
    }
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    EXPECT_NEAR(sum.pixels[i].g, whole.pixels[i].g, 1e-9 * (1 + whole.pixels[i].g)) << i;
}

TEST(Bidirectional, GlassGathersTheLightOfAPoint) {
  // A pane that takes nothing away but what it mirrors: 12/13 of the light arrives, of all colours.
  const auto light = [](bool pane) {
    Scene scene;
    addObject(scene, Square{}, kUpward * Affine::scaling({2, 2, 1}), diffuse(0.7));
    if (pane) {
      Phong glass;
      glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
      addObject(scene, Cube{}, Affine::translation({0, 1.1, 0}) * Affine::scaling({4, 0.2, 4}), glass);
    }
    scene.lights.push_back({DirectionalLight{.direction = {0, -1, 0}, .color = Color(1)}, {}});
    scene.camera.position = {0, 0.8, 0}, scene.camera.viewdir = {0, -1, 0}, scene.camera.updir = {0, 0, 1};
    scene.camera.fov = 90;
    Settings settings = settingsOf(800, 20, 8);
    settings.sampling = SampleKind::sobol;
    return mean(picture(scene, settings));
  };
  EXPECT_NEAR(light(true) / light(false), 12.0 / 13, 0.04);
}

TEST(Bidirectional, IsExplainedAndHasTheSameBitsForAnyNumberOfThreads) {
  Scene scene = corner();
  addPanel(scene, 3);
  Phong glass = diffuse(0.1);
  glass.transmissive = glass.reflective = Color(0.5), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0.6, 0.35, 0.3}) * Affine::scaling({0.3, 0.3, 0.3}), glass);
  scene.lights.push_back({PointLight{.position = {1, 1, 1.5}, .color = Color(0.3)}, {}});
  Settings settings = settingsOf(3, 5, 40);
  settings.threads = 1;
  const World world = build(scene, settings);
  const Size size{40, 40};
  const auto integrator = integratorOf(world, settings);
  Film film = makeFilm(settings, 40, 40);
  Job job;
  render(world, settings, film, job);
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    EXPECT_EQ(picture(world, settings, scene.camera), film.picture());
  }
  std::size_t joined = 0, fromLights = 0;
  for (int y = 2; y < 40; y += 5)
    for (int x = 1; x < 40; x += 6) {
      const Explanation e = explain(world, *integrator, settings, size, x, y, 2);
      EXPECT_TRUE(sumsUp(e.tree));
      EXPECT_EQ(e.tree.nodes[0].radiance, e.samples[2]);
      EXPECT_EQ(e.pixel, film.ofSamples(x, y));
      for (const RayNode& node : e.tree.nodes) {
        fromLights += node.kind == RayKind::light;
        for (const Term& term : node.terms) joined += term.kind == Term::Kind::joined && term.connection;
      }
    }
  EXPECT_GT(joined, 10u);
  EXPECT_GT(fromLights, 50u);
}

}  // namespace
}  // namespace trace::test::bdpt_test
