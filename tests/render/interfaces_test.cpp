// What a ray is inside of: nested and overlapping bodies of glass.
#include "render/world/interfaces.h"

#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_closed.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/integrators/whitted.h"
#include "render/rays/ray_tree.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/scenes.h"

namespace trace::test::interfaces_test {
namespace {

Filling body(std::uint32_t object, Real priority, Real index) {
  Filling filling;
  filling.object = filling.kind = object, filling.priority = priority, filling.index = index;
  return filling;
}

TEST(Interfaces, KnowOneBodyByTheRuleOfTheCourses) {
  Interfaces inside(1.0003);
  const Filling glass = body(0, 0, 1.5), water = body(1, 0, 1.333);
  EXPECT_EQ(inside.at(false, glass, true).before.index, 1.0003);
  EXPECT_EQ(inside.at(false, glass, true).behind.index, 1.5);
  inside.pass(false, glass, true);
  EXPECT_EQ(inside.at(false, water, true).before.index, 1.0003)
      << "bodies inside one another are not known of";
  inside.pass(false, water, true);
  EXPECT_EQ(inside.at(true, glass, true).before.index, 1.5);
  EXPECT_EQ(inside.at(true, glass, true).behind.index, 1.0003);
  inside.pass(true, water, true);
  EXPECT_EQ(inside.around().object, Filling::kAir);
}

TEST(Interfaces, TheHighestPriorityFillsAPlaceAndOfEqualsTheLastEntered) {
  Interfaces inside(1, true);
  const Filling glass = body(0, 2, 1.5), water = body(1, 1, 1.333), ice = body(2, 2, 1.31);
  EXPECT_EQ(inside.at(false, water, true).behind.object, 1u);
  inside.pass(false, water, true);
  EXPECT_EQ(inside.at(false, glass, true).before.object, 1u);
  inside.pass(false, glass, true);
  EXPECT_EQ(inside.around().object, 0u);
  EXPECT_TRUE(inside.at(true, water, true).alike()) << "the water ends inside the glass";
  EXPECT_EQ(inside.at(false, ice, true).behind.object, 2u) << "equal and entered later";
  inside.pass(false, ice, true);
  EXPECT_EQ(inside.around().object, 2u);
  EXPECT_TRUE(inside.at(true, glass, true).alike());
  inside.pass(true, ice, true);
  EXPECT_EQ(inside.around().object, 0u);
  inside.pass(true, glass, true);
  EXPECT_EQ(inside.around().object, 1u);
  inside.pass(true, water, true);
  EXPECT_EQ(inside.around().object, Filling::kAir);
  EXPECT_EQ(inside.at(true, ice, true).before.object, 2u) << "left without having been entered";
}

// --- scenes ---------------------------------------------------------------------------------------------

Phong glass(Real index, Real priority = 0) {
  Phong phong;
  phong.transmissive = {0.9, 0.95, 1}, phong.index = index, phong.priority = priority;
  phong.specular = Color(0.5), phong.shininess = 40, phong.reflective = Color(0.1);
  return phong;
}
Phong clear(Real index, Real priority = 0) {
  Phong phong;
  phong.transmissive = Color(1), phong.index = index, phong.priority = priority;
  return phong;
}
Affine ball(Real x, Real y, Real z, Real r) {
  return Affine::translation({x, y, z}) * Affine::scaling({r, r, r});
}

const Settings kNested{.width = 60, .depth = 8, .nestedGlass = NestedGlass::on};

/// A chequered wall, a lamp and a camera.
Scene stage() {
  Scene scene;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) {
      Phong tile;
      tile.ambient = (i + j) % 2 == 0 ? Color(0.9, 0.8, 0.3) : Color(0.1, 0.2, 0.6);
      tile.diffuse = Color(0.3);
      addObject(scene, Square{}, Affine::translation({Real(i), Real(j), -4}), tile);
    }
  scene.lights.push_back({AmbientLight{.color = Color(1)}, {}});
  scene.lights.push_back(
      {PointLight{.position = {3, 4, 6}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  scene.camera.position = {0, 0, 6};
  return scene;
}

Shape unionOf(std::vector<Operand> operands) { return Union{Operands(std::move(operands))}; }
Shape differenceOf(std::vector<Operand> operands) { return Difference{Operands(std::move(operands))}; }

TEST(NestedGlass, ABallInABallOfTheSameGlassIsInvisible) {
  Scene plain = stage();
  addObject(plain, Sphere{}, ball(0, 0, 0, 1.5), glass(1.5));
  const Picture one = picture(plain, kNested);
  Scene nested = plain;
  addObject(nested, Sphere{}, ball(0.3, -0.2, 0.1, 0.8), glass(1.5));
  EXPECT_EQ(picture(nested, kNested), one);
  Settings off = kNested;
  off.nestedGlass = NestedGlass::off;
  EXPECT_NE(picture(nested, off), one);

  Scene ofSolids = plain;  // a solid with a hole and edges, and one of a higher priority
  const std::uint32_t material = addMaterial(ofSolids, glass(1.5));
  addObject(ofSolids,
            differenceOf({{"", Sphere{}, ball(0, 0, 0, 1), material},
                          {"", Cube{}, Affine::scaling({0.6, 0.6, 3}), material}}),
            {}, glass(1.5));
  addObject(ofSolids, Cube{}, Affine::translation({0, 0.9, 0}) * Affine::scaling({0.3, 0.3, 0.3}),
            glass(1.5, 1));
  EXPECT_EQ(picture(ofSolids, kNested), one);
  EXPECT_NE(picture(ofSolids, off), one);
}

TEST(NestedGlass, OverlappingBallsOfTheSameGlassLookLikeTheirUnion) {
  Scene apart = stage(), whole = stage();
  addObject(apart, Sphere{}, ball(-0.6, 0, 0, 1), glass(1.5));
  addObject(apart, Sphere{}, ball(0.6, 0, 0, 1), glass(1.5));
  const std::uint32_t material = addMaterial(whole, glass(1.5));
  addObject(
      whole,
      unionOf({{"", Sphere{}, ball(-0.6, 0, 0, 1), material}, {"", Sphere{}, ball(0.6, 0, 0, 1), material}}),
      {}, glass(1.5));
  // Rounding differs, which long paths between the balls make visible in a few pixels.
  EXPECT_LE(compareLevels(picture(apart, kNested), picture(whole, kNested)).beyondOne, 30);
  Settings off = kNested;
  off.nestedGlass = NestedGlass::off;
  EXPECT_GT(compareLevels(picture(apart, off), picture(whole, off)).beyondOne, 300);
}

TEST(NestedGlass, TheOrderOfObjectsDoesNotMatterWherePrioritiesDiffer) {
  const auto made = [](bool swapped) {
    Scene scene = stage();
    const auto first = [&] { addObject(scene, Sphere{}, ball(-0.5, 0, 0, 1), glass(1.5, 2)); };
    const auto second = [&] { addObject(scene, Cube{}, ball(0.5, 0.1, 0, 1.4), glass(1.333, 1)); };
    swapped ? (second(), first()) : (first(), second());
    return scene;
  };
  const Picture a = picture(made(false), {.width = 80, .depth = 8}),
                b = picture(made(true), {.width = 80, .depth = 8});
  EXPECT_EQ(a, b);
  EXPECT_NE(a, picture(made(false), {.width = 80, .depth = 8, .nestedGlass = NestedGlass::off}));
}

TEST(NestedGlass, IsTheSameForAnyNumberOfThreadsAndWithoutTheHierarchy) {
  Random random(7);
  Scene scene = randomScene(random, 16);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Phong phong = phongOf(scene.materials[i]);
    phong.priority = Real(i % 3);
    scene.materials[i].model = phong;
  }
  const Picture one = picture(scene, {.width = 16, .depth = 3, .threads = 1});
  EXPECT_EQ(picture(scene, {.width = 16, .depth = 3, .threads = 7}), one);
  EXPECT_EQ(picture(scene, {.width = 16, .depth = 3, .threads = 2, .accel = Accel::none}), one);
}

// --- rays -----------------------------------------------------------------------------------------------

struct Traced {
  Color radiance;
  RayTree tree;
};
Traced traced(const Scene& scene, const Ray& ray, const Settings& settings) {
  const World world = build(scene, settings);
  Traced result;
  Tracer tracer(world, settings, &result.tree);
  const CameraRay camera(ray, tracer.interfacesAt(ray.origin),
                         [&](Interfaces& inside) { return tracer.cast(ray, RayKind::camera, inside); });
  const SampleRules rules(settings, {1, 1});
  result.radiance = Whitted().radiance(tracer, Sampler(rules, 0, 0, 0), camera);
  EXPECT_TRUE(sumsUp(result.tree));
  return result;
}

/// The indices at the surfaces that a ray comes through, one after the other.
std::vector<std::pair<Real, Real>> indicesAlong(const RayTree& tree) {
  std::vector<std::pair<Real, Real>> all;
  for (const RayNode& node : tree.nodes)
    if (node.kind != RayKind::shadow && node.hit && node.bsdf && whitted(*node.bsdf).transmits())
      all.emplace_back(node.indices.before, node.indices.behind);
  return all;
}
using Pairs = std::vector<std::pair<Real, Real>>;
const Settings kRays{.depth = 20, .nestedGlass = NestedGlass::on, .airIndex = 1};
const Ray kSlanted{{-6, 0, 12}, normalize(Vec3{0.5, 0, -1})};

TEST(NestedGlass, WaterInGlassRefractsAtFourSurfacesByTheirRatios) {
  Scene scene;
  addObject(scene, Cube{}, Affine::scaling({80, 80, 4}), clear(1.5));
  addObject(scene, Cube{}, Affine::scaling({60, 60, 2}), clear(1.333));
  const Traced t = traced(scene, kSlanted, kRays);
  EXPECT_EQ(indicesAlong(t.tree), (Pairs{{1, 1.5}, {1.5, 1.333}, {1.333, 1.5}, {1.5, 1}}));
  // Plane-parallel layers displace a ray and do not turn it; in each, index * sine is the same.
  const Real sine = kSlanted.direction.x;
  const Real in[]{1, 1.5, 1.333, 1.5, 1};
  ASSERT_EQ(t.tree.nodes.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(t.tree.nodes[std::size_t(i)].ray.direction.x * in[i], sine, 1e-13);
  Settings off = kRays;
  off.nestedGlass = NestedGlass::off;
  EXPECT_EQ(indicesAlong(traced(scene, kSlanted, off).tree),
            (Pairs{{1, 1.5}, {1, 1.333}, {1.333, 1}, {1.5, 1}}));
}

TEST(NestedGlass, AGlassWallOfHigherPriorityEndsTheWaterThatReachesIntoIt) {
  Scene scene;  // glass from z = 2 to 1 and from -1 to -2; water reaches into the middle of both
  addObject(scene, Cube{}, Affine::translation({0, 0, 1.5}) * Affine::scaling({80, 80, 1}), clear(1.5, 2));
  addObject(scene, Cube{}, Affine::translation({0, 0, -1.5}) * Affine::scaling({80, 80, 1}), clear(1.5, 2));
  addObject(scene, Cube{}, Affine::scaling({60, 60, 3}), clear(1.333, 1));
  scene.objects[0].name = "wall", scene.objects[2].name = "water";
  Settings byPriority = kRays;
  byPriority.nestedGlass = NestedGlass::byPriority;
  const Traced t = traced(scene, kSlanted, byPriority);
  EXPECT_EQ(indicesAlong(t.tree), (Pairs{{1, 1.5}, {1.5, 1.333}, {1.333, 1.5}, {1.5, 1}}));
  ASSERT_EQ(t.tree.nodes[1].ignored.size(), 1u);
  const std::string said = sentence(t.tree.nodes[1].ignored[0], scene);
  EXPECT_TRUE(said.starts_with("entering water at distance ")) << said;
  EXPECT_TRUE(said.ends_with(": it is wall on both sides, whose priority 2 is above 1")) << said;
}

TEST(NestedGlass, ACameraInsideSeesOutThroughEverySurface) {
  Scene scene;
  addObject(scene, Sphere{}, ball(0, 0, 0, 4), clear(1.5));
  addObject(scene, Sphere{}, ball(0, 0, 0, 2), clear(1.333));
  for (const Vec3& direction : {Vec3{0, 0, -1}, Vec3{1, 0, 0}, normalize(Vec3{1, 2, 3})})
    EXPECT_EQ(indicesAlong(traced(scene, {{0, 0, 0.5}, direction}, kRays).tree),
              (Pairs{{1.333, 1.5}, {1.5, 1}}));
  EXPECT_EQ(indicesAlong(traced(scene, {{0, 0, 3}, {0, 0, 1}}, kRays).tree), (Pairs{{1.5, 1}}));
}

TEST(NestedGlass, TheFirstOperandFillsADifference) {
  Scene scene;  // a block of glass with a hollow, whose wall has the material of the cutter
  const std::uint32_t block = addMaterial(scene, clear(1.5)), cutter = addMaterial(scene, clear(1.2));
  addObject(scene,
            differenceOf({{"", Cube{}, Affine::scaling({80, 80, 4}), block},
                          {"", Cube{}, Affine::scaling({60, 60, 2}), cutter}}),
            {}, clear(1.5));
  EXPECT_EQ(indicesAlong(traced(scene, kSlanted, kRays).tree),
            (Pairs{{1, 1.5}, {1.5, 1}, {1, 1.5}, {1.5, 1}}));
}

TEST(NestedGlass, OpenSurfacesEncloseNothing) {
  Scene scene;
  addObject(scene, Square{}, Affine::scaling({80, 80, 1}), clear(1.5));
  const Traced t = traced(scene, kSlanted, kRays);
  EXPECT_EQ(indicesAlong(t.tree), (Pairs{{1, 1}}));
  ASSERT_EQ(t.tree.nodes.size(), 2u);
  EXPECT_LT(length(t.tree.nodes[1].ray.direction - kSlanted.direction), 1e-15);

  Random random(1);
  const auto mesh = ballMesh(8, random);
  EXPECT_TRUE(closed(*mesh));
  MeshData open = *mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(closed(open));
  EXPECT_FALSE(closed(MeshData{}));
}

// --- Beer's law -----------------------------------------------------------------------------------------

TEST(NestedGlass, ViewRaysAndShadowRaysLoseTheSameInNestedBodies) {
  for (const Glass rule : {Glass::perCrossing, Glass::perDistance}) {
    Scene scene;  // layers of index 1, so that both kinds of rays run straight
    Phong glass = clear(1), water = clear(1), lamp, paper;
    glass.transmissive = {0.9, 0.8, 0.7}, glass.attenuationColor = {0.5, 0.9, 1},
    glass.attenuationDistance = 3;
    water.transmissive = {1, 0.9, 0.8}, water.attenuationColor = {0.2, 0.3, 0.9};
    lamp.emissive = Color(1), paper.diffuse = Color(1);
    addObject(scene, Cube{}, Affine::scaling({80, 80, 4}), glass);
    addObject(scene, Cube{}, Affine::scaling({60, 60, 2}), water);
    addObject(scene, Square{}, Affine::translation({0, 0, -3}) * Affine::scaling({90, 90, 1}), lamp);
    const Color seen = traced(scene, {{0, 0, 6}, {0, 0, -1}},
                              {.depth = 9, .nestedGlass = NestedGlass::on, .glass = rule, .airIndex = 1})
                           .radiance;
    scene.materials[2].model = paper;
    scene.lights.push_back(
        {PointLight{.position = {0, 0, 5}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
    const Color lit = traced(scene, {{0, 0, -2.5}, {0, 0, -1}},
                             {.depth = 9, .nestedGlass = NestedGlass::on, .glass = rule, .airIndex = 1})
                          .radiance;
    EXPECT_NEAR(seen.r, lit.r, 1e-15);
    EXPECT_NEAR(seen.g, lit.g, 1e-15);
    EXPECT_NEAR(seen.b, lit.b, 1e-15);
    // 1 + 1 units of glass and 2 of water.
    const auto expected = [&](Real transmissiveGlass, Real transmissiveWater, Real atThree, Real atOne) {
      const Real absorbed = std::pow(atThree, 2.0 / 3) * atOne * atOne;
      return absorbed * transmissiveGlass * transmissiveGlass * transmissiveWater * transmissiveWater;
    };
    EXPECT_NEAR(seen.r, expected(0.9, 1, 0.5, 0.2), 1e-14);
    EXPECT_NEAR(seen.b, expected(0.7, 0.8, 1, 0.9), 1e-14);
  }
}

TEST(Glass, BeersLawHoldsForViewAndShadowRaysWithoutNestingToo) {
  for (Real depth : {0.1, 0.5, 1.0, 2.0}) {
    Phong slab = clear(1), lamp, paper;
    slab.attenuationColor = Color(std::exp(-1)), lamp.emissive = Color(1), paper.diffuse = Color(1);
    Scene scene;
    addObject(scene, Cube{}, Affine::scaling({80, 80, depth}), slab);
    addObject(scene, Square{}, Affine::translation({0, 0, -3}) * Affine::scaling({90, 90, 1}), lamp);
    const Settings settings{.airIndex = 1};
    EXPECT_NEAR(traced(scene, {{0, 0, 6}, {0, 0, -1}}, settings).radiance.g, std::exp(-depth), 1e-15);
    scene.materials[1].model = paper;
    scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
    EXPECT_NEAR(traced(scene, {{0, 0, -2.5}, {0, 0, -1}}, settings).radiance.g, std::exp(-depth), 1e-15);
  }
}

TEST(NestedGlass, ALampInsideABodyShinesOutThroughIt) {
  Phong slab = clear(1), paper;
  slab.attenuationColor = Color(0.5), paper.diffuse = Color(1);
  Scene scene;
  addObject(scene, Cube{}, Affine::scaling({80, 80, 4}), slab);
  addObject(scene, Square{}, Affine::translation({0, 0, -3}) * Affine::scaling({90, 90, 1}), paper);
  scene.lights.push_back(
      {PointLight{.position = {0, 0, 1}, .color = Color(1), .constant = 1, .quadratic = 0}, {}});
  EXPECT_NEAR(traced(scene, {{0, 0, -2.5}, {0, 0, -1}}, kRays).radiance.g, 0.125, 1e-15);
}

// --- panes and prisms -----------------------------------------------------------------------------------

TEST(Glass, APaneMirrorsAndPassesWhatAllItsBouncesSumTo) {
  Scene scene;
  addObject(scene, Cube{}, Affine::scaling({80, 80, 1}), clear(1.5));
  Phong above, below;
  above.emissive = {1, 0, 0}, below.emissive = {0, 1, 0};
  addObject(scene, Square{}, Affine::translation({0, 0, 20}) * Affine::scaling({90, 90, 1}), above);
  addObject(scene, Square{}, Affine::translation({0, 0, -20}) * Affine::scaling({90, 90, 1}), below);
  const Color seen =
      traced(scene, {{0, 0, 6}, {0, 0, -1}}, {.depth = 24, .airIndex = 1, .fresnel = Fresnel::exact})
          .radiance;
  EXPECT_NEAR(seen.r, 0.0769231, 5e-8);
  EXPECT_NEAR(seen.g, 0.9230769, 5e-8);
}

/// A prism of 60 degrees along y; its edge is at the top, z.
Scene prism(const Phong& material) {
  const float h = std::sqrt(3.0f);
  MeshData mesh;
  mesh.points = {{-1, -9, 0}, {1, -9, 0}, {0, -9, h}, {-1, 9, 0}, {1, 9, 0}, {0, 9, h}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
  Scene scene;
  addObject(scene, Mesh{std::make_shared<const MeshData>(mesh)}, {}, material);
  return scene;
}

Real degreesBetween(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 180 / kPi;
}

TEST(Glass, APrismTurnsLightByItsLeastDeviation) {
  // In the prism the ray runs level.
  const Real out = std::asin(1.5 * 0.5), tilt = out - kPi / 6;
  const Vec3 direction{std::cos(tilt), 0, std::sin(tilt)};
  const Vec3 face{-0.5, 0, std::sqrt(3.0) / 2};
  const Traced t = traced(prism(clear(1.5)), {face - direction * 5, direction}, {.depth = 4, .airIndex = 1});
  ASSERT_EQ(t.tree.nodes.size(), 3u);
  EXPECT_NEAR(degreesBetween(t.tree.nodes[0].ray.direction, t.tree.nodes[2].ray.direction), 37.18076, 1e-5);
}

TEST(Glass, APrismOfBk7SendsEachWavelengthWhereItsIndexSays) {
  Phong bk7 = clear(1.5168);
  bk7.dispersion = Disperses::bk7;
  const Real entering = 50 * kPi / 180, tilt = entering - kPi / 6;
  const Vec3 direction{std::cos(tilt), 0, std::sin(tilt)}, face{-0.5, 0, std::sqrt(3.0) / 2};
  const Traced t =
      traced(prism(bk7), {face - direction * 5, direction}, {.depth = 4, .wavelengths = 12, .airIndex = 1});
  const Real d = sellmeier(Disperses::bk7)->index(kLineD);
  int seen = 0;
  Real before = 1e9;
  for (const RayNode& node : t.tree.nodes) {
    if (node.depth != 2) continue;
    ++seen;
    const Real n = 1.5168 + (sellmeier(Disperses::bk7)->index(node.wavelength) - d);
    const Real second = kPi / 3 - std::asin(std::sin(entering) / n);
    const Real deviation = (entering + std::asin(n * std::sin(second))) * 180 / kPi - 60;
    const Real turned = degreesBetween(direction, node.ray.direction);
    EXPECT_NEAR(turned, deviation, 1e-5) << node.wavelength;
    EXPECT_LT(turned, before) << "red is turned least";
    before = turned;
  }
  EXPECT_EQ(seen, 12);
  // One ray for all colours without the option.
  EXPECT_EQ(
      traced(prism(bk7), {face - direction * 5, direction}, {.depth = 4, .airIndex = 1}).tree.nodes.size(),
      3u);
}

TEST(Glass, WhiteSplitIntoWavelengthsIsWhiteAgain) {
  Phong glass = clear(1.7), lamp;
  glass.abbe = 20, lamp.emissive = Color(0.75);
  Scene scene;  // all around it is one brightness
  addObject(scene, Sphere{}, ball(0, 0, 0, 1), glass);
  addObject(scene, Sphere{}, ball(0, 0, 0, 50), lamp);
  for (const Vec3& direction : {Vec3{0, 0, -1}, normalize(Vec3{0.05, 0.08, -1})}) {
    const Color seen =
        traced(scene, {{0, 0, 6}, direction}, {.depth = 4, .wavelengths = 16, .airIndex = 1}).radiance;
    for (Real channel : {seen.r, seen.g, seen.b}) EXPECT_NEAR(channel, 0.75, 1e-15);
  }
}

TEST(Glass, VarnishMirrorsByItsIndexAndTakesThatFromWhatIsBelow) {
  Phong wood, lamp;
  wood.ambient = Color(0.5), wood.index = 1.5, lamp.emissive = {0, 0, 1};
  Scene scene;
  addObject(scene, Square{}, Affine::scaling({9, 9, 1}), wood);
  addObject(scene, Square{}, Affine::translation({0, 0, 20}) * Affine::scaling({9, 9, 1}), lamp);
  scene.lights.push_back({AmbientLight{.color = {1, 0, 0}}, {}});
  Settings settings{.varnish = true, .airIndex = 1};
  const Color seen = traced(scene, {{0, 0, 6}, {0, 0, -1}}, settings).radiance;
  EXPECT_NEAR(seen.r, 0.5 * 0.96, 1e-15);
  EXPECT_NEAR(seen.b, 0.04, 1e-15);
  settings.varnish = false;
  EXPECT_EQ(traced(scene, {{0, 0, 6}, {0, 0, -1}}, settings).radiance, Color(0.5, 0, 0));
}

}  // namespace
}  // namespace trace::test::interfaces_test
