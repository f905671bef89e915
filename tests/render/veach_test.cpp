// Chains that change paths place by place: every mutation shows what paths show, of lights, cameras and
// surfaces of every kind; moves there and back are as frequent; densities do not depend on how a path came
// about.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "image/srgb.h"
#include "render/chains/metropolis.h"
#include "render/picture/agreement.h"
#include "shading/lights/rectangle_light.h"
#include "shading/materials/conductor.h"
#include "shading/materials/oren_nayar.h"
#include "shading/materials/rough_glass.h"
#include "support/lights.h"
#include "support/quarters.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::veach_test {
namespace {

const Affine kUpward = turned({1, 0, 0}, -0.5), kDownward = turned({1, 0, 0}, 0.5);

/// A floor, a wall and a ball, seen from before them.
Scene corner(const MaterialModel& floor = diffuse(0.7), const MaterialModel& ball = diffuse(0.5)) {
  Scene scene;
  addObject(scene, Square{}, kUpward * Affine::scaling({4, 4, 1}), {});
  addObject(scene, Square{}, Affine::translation({0, 1, -1}) * Affine::scaling({4, 2, 1}), diffuse(0.6));
  addObject(scene, Sphere{}, Affine::translation({-0.4, 0.5, 0.3}) * Affine::scaling({0.4, 0.4, 0.4}), {});
  scene.materials[0].model = floor, scene.materials[2].model = ball;
  scene.camera.position = {0, 0.9, 2.6}, scene.camera.viewdir = {0, -0.2, -1};
  scene.camera.fov = 50;
  return scene;
}

/// The same with a lamp above it.
Scene lit(const MaterialModel& floor = diffuse(0.7), const MaterialModel& ball = diffuse(0.5)) {
  Scene scene = corner(floor, ball);
  addObject(scene, Square{}, Affine::translation({0.2, 1.8, 0.2}) * kDownward, diffuse(0.3, 6));
  return scene;
}

Phong glass() {
  Phong clear;
  clear.transmissive = clear.reflective = Color(1), clear.index = 1.5;
  return clear;
}
Phong mirror() {
  Phong phong;
  phong.reflective = Color(0.9);
  return phong;
}

Settings settingsOf(int spp = 80, int depth = 3) {
  Settings settings;
  settings.integrator = IntegratorKind::mlt;
  settings.chains = Chains::veach;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = 12;
  settings.depth = depth, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  settings.chainStarts = 2000;
  return settings;
}

/// Chains show the light of --integrator path, and no quarter is another one; the error of the mean is a part
/// `known` of it. What chains leave in a quarter is not spread normally: a few bright paths hold many of
/// them.
void expectTheLightOfPaths(const Scene& scene, const Settings& settings, Real known = 0.08) {
  Settings paths = settings;
  paths.integrator = IntegratorKind::path;
  const Agreement a = agreement(scene, paths, settings, 6, 6);
  EXPECT_NEAR(a.meanA, a.meanB, 4 * a.error) << "of " << a.meanA;
  EXPECT_LT(a.error, known * a.meanA) << "or nothing is shown";
  for (const double p : a.p) EXPECT_GT(p, 1e-5);
}

TEST(Veach, EveryMutationShowsTheLightOfPaths) {
  const std::vector<std::pair<const char*, EnumSet<Mutation>>> all{
      {"bidirectional", {Mutation::bidirectional}},
      {"lens", {Mutation::lens}},
      {"caustic", {Mutation::caustic}},
      {"multi-chain", {Mutation::multiChain}},
      {"all", Settings{}.mutations}};
  const std::vector<std::pair<const char*, Scene>> scenes{{"diffuse", lit()},
                                                          {"mirror", lit(diffuse(0.7), mirror())},
                                                          {"glass", lit(diffuse(0.7), glass())},
                                                          {"mirrors", lit(mirror(), mirror())}};
  for (const auto& [name, scene] : scenes)
    for (const auto& [what, mutations] : all) {
      SCOPED_TRACE(std::string(name) + ", " + what);
      Settings settings = settingsOf(160);
      settings.mutations = mutations;
      settings.moveAnywhere = mutations.has(Mutation::bidirectional) ? 0.05 : 0.2;
      expectTheLightOfPaths(scene, settings);
    }
}

TEST(Veach, LightComesThroughADoorAjar) {
  Scene scene = openRoom({0.6, 0.1, 0.1}, {0.1, 0.5, 0.1});
  scene.camera.position = {0, 0, 3.8}, scene.camera.fov = 36;
  addObject(
      scene, Cube{},
      Affine::translation({-0.5, 0, 0.1}) * turned({0, 1, 0}, 0.42) * Affine::scaling({0.05, 1.98, 1.3}),
      diffuse(0.6));
  addObject(scene, Square{},
            Affine::translation({-0.75, 0.8, -0.5}) * kDownward * Affine::scaling({0.4, 0.4, 1}),
            diffuse(0.5, 40));
  expectTheLightOfPaths(scene, settingsOf(200, 4));
}

TEST(Veach, LightsOfEveryKindAreShown) {
  std::vector<std::pair<const char*, Light>> lights = lightsOfEveryKind();
  lights.emplace_back("panel that is seen", RectangleLight{.position = {0.2, 1.1, -0.8},
                                                           .u = {0.5, 0, 0},
                                                           .v = {0, 0.5, 0},
                                                           .color = Color(3),
                                                           .twoSided = true,
                                                           .visible = true});
  for (const auto& [name, light] : lights)
    for (const bool withLamp : {false, true}) {
      SCOPED_TRACE(name);
      Scene scene = corner(diffuse(0.7), withLamp ? mirror() : glass());
      scene.lights.push_back({light, {}});
      if (withLamp)
        addObject(scene, Square{}, Affine::translation({1, 1, 0.2}) * turned({0, 1, 0}, 0.5),
                  diffuse(0.3, 2));
      expectTheLightOfPaths(scene, settingsOf());
    }
}

TEST(Veach, LampsOfEveryKindAreShown) {
  Random random(5);
  const std::vector<std::pair<const char*, Shape>> shapes{
      {"ball", Sphere{}}, {"mesh", Mesh{ballMesh(6, random)}}, {"box, which is met by chance", Cube{}}};
  for (const auto& [name, shape] : shapes) {
    SCOPED_TRACE(name);
    Scene scene = corner(diffuse(0.7), glass());
    addObject(scene, shape, Affine::translation({0.4, 1.3, 0.4}) * scaled(0.3), diffuse(0.2, 6));
    expectTheLightOfPaths(scene, settingsOf(200), 0.1);
  }
}

TEST(Veach, TheSkyIsShown) {
  Scene even = corner(diffuse(0.7), mirror());  // met by chance
  even.background.gradient = {{Color(1), Color(1)}};
  Scene bright = corner(diffuse(0.7), glass());  // asked for, too
  bright.background.gradient = {{Color(0.05), Color(0.05), Color(4)}};
  bright.background.elevations = {-90, 40, 90};
  for (const Scene& scene : {even, bright}) expectTheLightOfPaths(scene, settingsOf());
}

TEST(Veach, EveryCameraShowsIt) {
  const std::vector<std::pair<const char*, std::function<void(Settings&)>>> cameras{
      {"lens", [](Settings& s) { s.aperture = 0.3, s.focus = 2.4; }},
      {"blades", [](Settings& s) { s.aperture = 0.3, s.focus = 3, s.blades = 5; }},
      {"shift", [](Settings& s) { s.shiftX = 0.1, s.shiftY = -0.2; }},
      {"distortion", [](Settings& s) { s.distortion = 0.3; }},
      {"orthographic", [](Settings& s) { s.projection = Projection::orthographic, s.viewHeight = 1.8; }},
      {"fisheye", [](Settings& s) { s.projection = Projection::fisheye; }},
      {"panorama", [](Settings& s) { s.projection = Projection::panorama; }},
      {"cylinder", [](Settings& s) { s.projection = Projection::cylinder; }},
      {"filter", [](Settings& s) { s.filter = FilterKind::mitchell; }}};
  const Scene scene = lit(diffuse(0.7), glass());
  for (const auto& [name, change] : cameras) {
    SCOPED_TRACE(name);
    Settings settings = settingsOf();
    change(settings);
    expectTheLightOfPaths(scene, settings, 0.2);
  }
}

TEST(Veach, SurfacesOfEveryKindAreShown) {
  Phong shiny = diffuse(0.3);
  shiny.specular = Color(0.4), shiny.shininess = 12;
  Phong half = diffuse(0.4);
  half.reflective = Color(0.4);
  Phong pane = diffuse(0.2);
  pane.transmissive = Color(0.6), pane.index = 1.3;
  RoughGlass rough;
  rough.roughness = 0.6;
  const std::vector<std::pair<const char*, MaterialModel>> models{
      {"shiny", shiny},       {"half a mirror", half}, {"glass with paint", pane},
      {"metal", Conductor{}}, {"clay", OrenNayar{}},   {"rough glass", rough}};
  for (const auto& [name, model] : models) {
    SCOPED_TRACE(name);
    expectTheLightOfPaths(lit(model, model), settingsOf());
  }
  Settings coated = settingsOf();
  coated.varnish = true;
  Phong varnished = diffuse(0.6);
  varnished.index = 1.5;
  expectTheLightOfPaths(lit(varnished, varnished), coated);
}

TEST(Veach, NormalsBetweenVerticesKeepTheLight) {
  Random random(3);
  for (const Phong& phong : {diffuse(0.7), mirror(), glass()}) {
    Scene scene = lit();
    addObject(scene, Mesh{ballMesh(8, random)},
              Affine::translation({0.6, 0.6, 0.2}) * Affine::scaling({0.5, 0.5, 0.5}), phong);
    expectTheLightOfPaths(scene, settingsOf(200));
  }
}

TEST(Veach, WaterKeepsTheLight) {
  // A floor and a wall under water, so that paths are joined there.
  Scene scene;
  Phong water = glass();
  water.index = 1.33, water.attenuationColor = Color(0.8);
  addObject(scene, Cube{}, Affine::translation({0, 0.25, 0}) * Affine::scaling({5, 1.5, 5}), water);
  addObject(scene, Square{}, Affine::translation({0, -0.2, 0}) * kUpward * Affine::scaling({4, 4, 1}),
            diffuse(0.8));
  addObject(scene, Square{}, Affine::translation({0, 0.3, -1}) * Affine::scaling({4, 1, 1}), diffuse(0.8));
  addObject(scene, Square{}, Affine::translation({0, 2.5, 0}) * kDownward * Affine::scaling({3, 3, 1}),
            diffuse(0, 2));
  scene.camera.position = {0, 2.2, 1.8}, scene.camera.viewdir = {0, -1, -0.9};
  scene.camera.fov = 40;
  for (const Mutation mutation : {Mutation::bidirectional, Mutation::caustic, Mutation::multiChain}) {
    Settings settings = settingsOf(256, 5);
    settings.mutations = {mutation};
    expectTheLightOfPaths(scene, settings, 0.1);
  }
}

TEST(Veach, LightThatEntersWaterIsAsBrightFromBothEnds) {
  // From under water the camera sees places that a small lamp above it lights: nearly all of these paths come
  // from the lamp, and their density changes where they enter the water.
  Scene scene;
  Phong water = glass();
  water.index = 1.33;
  addObject(scene, Cube{}, Affine::translation({0, 0.25, 0}) * Affine::scaling({5, 1.5, 5}), water);
  addObject(scene, Square{}, Affine::translation({0, -0.2, 0}) * kUpward * Affine::scaling({4, 4, 1}),
            diffuse(0.8));
  addObject(scene, Square{}, Affine::translation({0, 1.8, 0}) * kDownward * Affine::scaling({0.6, 0.6, 1}),
            diffuse(0, 20));
  scene.camera.position = {0, 0.6, 0.6}, scene.camera.viewdir = {0, -1, -0.8};
  scene.camera.fov = 60;
  Settings settings = settingsOf(50, 2);
  settings.chainStarts = 100000;
  expectTheLightOfPaths(scene, settings, 0.06);
}

TEST(Veach, AWideCameraIsNotBrighterAtItsBorder) {
  // Pieces of the picture are small angles there, which the mutation of the lens has to know.
  Scene scene;
  addObject(scene, Square{}, Affine::translation({0, 0, -1}) * Affine::scaling({20, 20, 1}), diffuse(0, 1));
  scene.camera.fov = 130;
  Settings settings = settingsOf(4000);
  settings.mutations = {Mutation::lens};
  settings.moveAnywhere = 0.02, settings.moveSize = 0.05;
  const Picture shown = picture(scene, settings);
  Real middle = 0, corners = 0;
  for (const int x : {0, 1, 10, 11})
    for (const int y : {0, 1, 10, 11}) corners += luminanceOf(shown.at(x, y)) / 16;
  for (int x = 4; x < 8; ++x)
    for (int y = 4; y < 8; ++y) middle += luminanceOf(shown.at(x, y)) / 16;
  EXPECT_NEAR(corners, 1, 0.1);
  EXPECT_NEAR(middle, 1, 0.1);
}

// ------------------------------------------------------------------------------------------------------

TEST(Veach, MovesThereAndBackAreAsFrequent) {
  // A chain that starts as it goes on: of each kind of move those that cross a border are made as often one
  // way as the other. Borders lie between light and dark paths, and across the picture.
  Scene scene = corner(diffuse(0.7), glass());
  addObject(scene, Square{},
            Affine::translation({-0.2, 1.3, 0.3}) * kDownward * Affine::scaling({0.3, 0.3, 1}),
            diffuse(0, 20));
  Settings settings = settingsOf();
  settings.moveAnywhere = 0.05, settings.moveSize = 0.03, settings.chainStarts = 300000;
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const std::array moments{Moment{&world, integrator.get()}};
  Job job;
  const Metropolis chains(moments, settings, Size{12, 12}, job, {});
  PixelTracer tracer = chains.tracer();
  constexpr int kChains = 8000, kMoves = 80, kBorders = 3;
  Real net[kMoveKinds][kBorders]{}, squares[kMoveKinds][kBorders]{};
  for (std::uint64_t chain = 0; chain < kChains; ++chain) {
    Real crossed[kMoveKinds][kBorders]{};
    ChainMove at;
    chains.chain(tracer, mixBits(chain), kMoves, [&](const ChainMove& move, const OfferedSample&) {
      const auto sides = [](const ChainMove& m) { return std::array{m.light > 1, m.x > 3, m.y > 7}; };
      if (move.made && move.number >= 0)
        for (std::size_t b = 0; b < kBorders; ++b)
          crossed[static_cast<std::size_t>(move.kind)][b] += sides(move)[b] - sides(at)[b];
      if (move.made) at = move;
    });
    for (std::size_t k = 0; k < kMoveKinds; ++k)
      for (std::size_t b = 0; b < kBorders; ++b) {
        net[k][b] += crossed[k][b];
        squares[k][b] += crossed[k][b] * crossed[k][b];
      }
  }
  for (const MoveKind kind : {MoveKind::anywhere, MoveKind::bidirectional, MoveKind::lens, MoveKind::caustic,
                              MoveKind::multiChain}) {
    SCOPED_TRACE(look(kind).name);
    const auto k = static_cast<std::size_t>(kind);
    Real crossed = 0;
    for (std::size_t b = 0; b < kBorders; ++b) {
      EXPECT_LE(std::abs(net[k][b]), 4 * std::sqrt(squares[k][b])) << b;
      crossed += squares[k][b];
    }
    EXPECT_GT(crossed, 50);
  }
}

TEST(Veach, DensitiesDoNotDependOnHowAPathCameAbout) {
  // A path that many mutations have made piece by piece, and the same made at once.
  const Scene scene = lit(diffuse(0.7), glass());
  const Settings settings = settingsOf();
  const World world = build(scene, settings);
  const Size size{12, 12};
  const veach::Stage stage(world, settings, {0, 0, 12, 12}, size);
  const SampleRules rules(settings, size);
  Tracer tracer(world, settings);
  const veach::Paths paths(stage, tracer);
  veach::Numbers numbers(1);
  veach::Moves moves(paths, rules, numbers, 0.01);
  veach::Path path;
  const auto near = [](Real a, Real b) { return std::abs(a - b) <= 1e-5 * std::abs(a + b); };
  int compared = 0;
  for (int n = 0; n < 20000; ++n) {
    veach::Offer offer;
    if (!(path.brightness > 0) || n % 100 == 0) {
      offer.path = moves.anywhere();
      offer.ratio = 1;
    } else if (n % 4 == 0 && moves.hasLens(path)) {
      offer = moves.lens(path);
    } else if (n % 4 == 1 && moves.hasCaustic(path)) {
      offer = moves.caustic(path);
    } else if (n % 4 == 2 && moves.hasMultiChain(path)) {
      offer = moves.multiChain(path);
    } else {
      offer = moves.bidirectional(path);
    }
    if (!(offer.path.brightness > 0 && offer.ratio > 0)) continue;
    path = std::move(offer.path);
    veach::Path again;
    ASSERT_TRUE(paths.begin(again, path.film, path.lens));
    bool found = true;
    for (std::size_t i = 0; i < path.last() && found; ++i) {
      const bool toSurface = path.nodes[i + 1].vertex && i > 0;
      found = toSurface ? paths.follow(again, path.nodes[i].leaves, veach::targetOf(path.vertex(i + 1).hit))
                        : paths.follow(again, path.nodes[i].leaves, path.toLight(i));
    }
    if (!found || (path.end == veach::Path::End::lamp && !paths.endAtLamp(again))) continue;  // at an edge
    ASSERT_TRUE(paths.weigh(again, 0, again.last()));
    if (!near(again.brightness, path.brightness)) continue;
    ++compared;
    const std::size_t places = path.nodes.size();
    for (std::size_t a = 0; a <= places; ++a)
      for (std::size_t b = 0; a + b <= places; ++b)
        if (a + b > 0) {
          const Real one = moves.density(path, {a, b}, places + 1),
                     other = moves.density(again, {a, b}, places + 1);
          ASSERT_TRUE(near(one, other))
              << one << " " << other << " with " << a << ", " << b << " of " << places;
        }
  }
  EXPECT_GT(compared, 5000);
}

TEST(Veach, HasTheSameBitsForAnyNumberOfThreadsAndAfterAStop) {
  Settings settings = settingsOf(3);
  settings.width = settings.height = 40, settings.chainStarts = 3000;
  const Scene scene = lit(diffuse(0.7), glass());
  EXPECT_EQ(afterAStop(scene, settings, 1), sameForAnyThreads(scene, settings));
}

TEST(Veach, ShowsThingsThatMove) {
  const Scene before = lit();
  Scene after = before;
  after.objects[2].worldFromObject = Affine::translation({0.5, 0.5, 0.3}) * scaled(0.4);
  const auto pictureOf = [&](Settings settings, const std::vector<const Scene*>& scenes) {
    std::deque<World> worlds;
    std::vector<std::unique_ptr<const Integrator>> integrators;
    std::vector<Moment> moments;
    for (const Scene* scene : scenes) {
      integrators.push_back(integratorOf(worlds.emplace_back(build(*scene, settings)), settings));
      moments.push_back({&worlds.back(), integrators.back().get()});
    }
    Film film = makeFilm(settings, 12, 12);
    Job job;
    render(moments, settings, film, job);
    return film.picture();
  };
  const Settings settings = settingsOf(2000);
  Settings paths = settings;
  paths.integrator = IntegratorKind::path;
  const auto found = quarters(pictureOf(settings, {&before, &after})),
             wanted = quarters(pictureOf(paths, {&before, &after})),
             one = quarters(pictureOf(paths, {&before}));
  Real most = 0;
  for (std::size_t q = 0; q < 4; ++q) {
    EXPECT_NEAR(luminanceOf(found[q]) / luminanceOf(wanted[q]), 1, 0.1) << q;
    most = std::max(most, std::abs(luminanceOf(one[q]) / luminanceOf(wanted[q]) - 1));
  }
  EXPECT_GT(most, 0.15) << "or nothing has moved";
}

/// The box of Cornell, as in bench/cornell.ray: a small lamp just below the ceiling, and two boxes.
Scene cornell() {
  Scene scene = openRoom({0.63, 0.065, 0.05}, {0.14, 0.45, 0.091});
  addObject(scene, Square{}, Affine::translation({0, 0.998, 0}) * turned({1, 0, 0}, 0.5) * scaled(0.6),
            diffuse(0, 17));
  addObject(
      scene, Cube{},
      Affine::translation({-0.34, -0.4, -0.3}) * turned({0, 1, 0}, 0.1) * Affine::scaling({0.6, 1.2, 0.6}),
      diffuse(0.73));
  addObject(scene, Cube{}, Affine::translation({0.36, -0.7, 0.36}) * turned({0, 1, 0}, -0.1) * scaled(0.6),
            diffuse(0.73));
  return scene;
}

Settings ofCornell(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.integrator = integrator;
  settings.width = settings.height = 32;
  settings.depth = 7, settings.spp = spp;
  return settings;
}

TEST(Veach, ThePictureIsAsBrightAsByPathsWithEverySeed) {
  const Scene scene = cornell();
  Settings settings = ofCornell(IntegratorKind::path, 900);
  settings.sampling = SampleKind::sobol;
  const Real wanted = luminanceOf(meanColor(picture(scene, settings)));
  settings = ofCornell(IntegratorKind::mlt, 48);
  settings.chains = Chains::veach;
  for (settings.seed = 1; settings.seed <= 3; ++settings.seed) {
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    const std::array moments{Moment{&world, integrator.get()}};
    Film film = makeFilm(settings, settings.width, settings.height);
    Job job;
    const RenderResult result = render(moments, settings, film, job);
    EXPECT_LT(result.brightnessError, 0.005) << settings.seed;
    EXPECT_NEAR(luminanceOf(meanColor(film.picture())) / wanted, 1, 0.005) << settings.seed;
  }
}

// Samples that are taken on the way tell it as well: a bad guess at the start is forgotten.
TEST(Veach, TheMoreSamplesThereAreTheBetterTheBrightnessIsKnown) {
  const Scene scene = cornell();
  Settings settings = ofCornell(IntegratorKind::path, 4000);
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 8;
  const Real wanted = luminanceOf(meanColor(picture(scene, settings)));
  const auto error = [&](int spp) {  // root of the mean square
    Settings chains = settings;
    chains.integrator = IntegratorKind::mlt;
    chains.chains = Chains::veach;
    chains.chainStarts = 40, chains.spp = spp;
    Real squares = 0;
    constexpr int kSeeds = 6;
    for (chains.seed = 1; chains.seed <= kSeeds; ++chains.seed) {
      const Real off = luminanceOf(meanColor(picture(scene, chains))) / wanted - 1;
      squares += off * off / kSeeds;
    }
    return std::sqrt(squares);
  };
  const Real few = error(1), many = error(2000);
  EXPECT_GT(few, 0.03) << "or there is nothing to tell";
  EXPECT_LT(many, 0.03);
  EXPECT_LT(many, few / 2);
}

// What paths from the camera find by chance only is told by the other end.
TEST(Veach, TheBrightnessOfACausticIsKnownByPathsFromTheLight) {
  Scene scene = corner();
  scene.materials[2].model = glass();
  addObject(scene, Square{}, Affine::translation({-0.9, 2.2, 0.6}) * kDownward * scaled(0.05),
            diffuse(0, 2000));
  Settings settings = settingsOf(1, 4);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const Moment moment{&world, integrator.get()};
  Job job;
  settings.chainStarts = 10000;
  const Metropolis metropolis({&moment, 1}, settings, Size{12, 12}, job, [] {});
  EXPECT_LT(metropolis.brightnessError(), 0.02);
}

TEST(Veach, ARegionShowsItsPartOfThePicture) {
  Settings settings = settingsOf(200);
  settings.region = {3, 0, 9, 6};
  expectTheLightOfPaths(lit(diffuse(0.7), glass()), settings);
}

TEST(Veach, WhatIsNotKnownIsRefused) {
  const auto refused = [](const Scene& scene, const Settings& settings) -> std::string {
    try {
      const World world = build(scene, settings);
      integratorOf(world, settings);
    } catch (const Error& error) {
      return error.messages().front().what;
    }
    return "";
  };
  Settings settings = settingsOf();
  EXPECT_EQ(refused(lit(), settings), "");
  settings.fog = 0.1;
  EXPECT_EQ(refused(lit(), settings), "--chains veach does not know fog");
  settings = settingsOf();
  settings.wavelengths = 3;
  EXPECT_EQ(refused(lit(), settings), "--chains veach does not know light that glass splits (--wavelengths)");
  settings = settingsOf();
  Scene holes = lit();
  holes.materials[1].opacity = 0.5;
  EXPECT_EQ(refused(holes, settings),
            "--chains veach does not know surfaces that are there in part (opacity)");
  Scene cloud = lit();
  addCloud(cloud, Sphere{}, Affine::translation({0.5, 0.5, 0.5}) * scaled(0.3), 1);
  EXPECT_EQ(refused(cloud, settings), "--chains veach does not know media inside objects");
  settings.chains = Chains::bdpt;
  EXPECT_EQ(refused(cloud, settings), "");
}

}  // namespace
}  // namespace trace::test::veach_test
