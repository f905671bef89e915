// Values of recursive ray tracing that can be worked out by hand.
#include "render/integrators/whitted.h"

#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/optics/optics.h"
#include "support/scenes.h"

namespace trace::test::whitted_test {
namespace {

Color trace(const Scene& scene, const Ray& ray, const Settings& settings = {},
            Statistics* statistics = nullptr) {
  const World world = build(scene, settings);
  Tracer tracer(world, settings);
  const CameraRay camera(ray, tracer.interfacesAt(ray.origin),
                         [&](Interfaces& inside) { return tracer.cast(ray, RayKind::camera, inside); });
  const SampleRules rules(settings, {1, 1});
  const Color color = Whitted().radiance(tracer, Sampler(rules, 0, 0, 0), camera);
  if (statistics) *statistics = tracer.statistics();
  return color;
}

Affine at(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }
LightSource sun(const Vec3& direction, Color color = Color(1)) {
  return {DirectionalLight{.direction = direction, .color = color}, {}};
}
const Ray kDown{{0, 0, 10}, {0, 0, -1}};

// --- materials, lights and cameras of other courses -----------------------------------------------------

/// A white square under a lamp at height 5, half of it behind a black one.
Scene shadowed(Real shadow) {
  Scene scene;
  Phong white;
  white.diffuse = Color(1), white.shadow = shadow;
  addObject(scene, Square{}, Affine::scaling({10, 10, 1}), white);
  addObject(scene, Square{}, at(2, 0, 3), {});
  scene.lights.push_back(sun({0, 0, -1}));
  return scene;
}

TEST(Whitted, AShadowTakesAwayTheShareThatTheReceiverSays) {
  const Ray lit{{-2, 0, 2}, {0, 0, -1}}, inShadow{{2, 0, 2}, {0, 0, -1}};
  for (Real shadow : {0.0, 0.25, 1.0}) {
    EXPECT_EQ(trace(shadowed(shadow), lit), Color(1));
    EXPECT_EQ(trace(shadowed(shadow), inShadow), Color(1 - shadow));
  }
}

TEST(Whitted, AnExtraHighlightIsAddedToTheLightsColor) {
  Scene scene;
  Phong shiny;
  shiny.diffuse = {0.5, 0.5, 0.5}, shiny.specular = {0.25, 0.5, 1}, shiny.shininess = 10;
  addObject(scene, Square{}, {}, shiny);
  PointLight light{.position = {0, 0, 4}, .color = {2, 4, 8}, .constant = 2, .quadratic = 0};
  light.extraHighlight = {6, -4, 0};
  scene.lights.push_back({light, {}});
  const Settings settings{.limitAttenuation = false};
  // Seen from the lamp, where cosines are 1: (2 * 0.5 + 8 * 0.25) / 2, and so on.
  EXPECT_EQ(trace(scene, {{0, 0, 4}, {0, 0, -1}}, settings), Color(1.5, 1, 6));
}

TEST(Whitted, ATwoSidedMeshIsLitFromBehindToo) {
  for (bool twoSided : {false, true}) {
    MeshData mesh;
    mesh.points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 2, 1}};  // its front looks down
    mesh.twoSided = twoSided;
    Scene scene;
    Phong white;
    white.diffuse = Color(1);
    addObject(scene, Mesh{std::make_shared<const MeshData>(mesh)}, {}, white);
    scene.lights.push_back(sun({0, 0, -1}));
    EXPECT_EQ(trace(scene, kDown), Color(twoSided ? 1 : 0));
  }
}

TEST(Whitted, CameraRaysSeeFromNearToFarAndOthersEverything) {
  Scene scene;
  Phong mirror;
  mirror.emissive = {1, 0, 0}, mirror.reflective = Color(1);
  addObject(scene, Square{}, {}, mirror);
  Phong lamp;
  lamp.emissive = {0, 0, 1};
  addObject(scene, Square{}, at(0, 0, 90), lamp);
  for (auto [near, far, seen] : {std::tuple{1.0, 20.0, true}, {11.0, 20.0, false}, {1.0, 9.0, false}}) {
    scene.camera.near = near, scene.camera.far = far;
    EXPECT_EQ(trace(scene, kDown), seen ? Color(1, 0, 1) : Color(0));
  }
}

TEST(Whitted, SchlicksGlassMirrorsMoreTheFlatterItIsSeen) {
  EXPECT_NEAR(schlick(1, 1, 1.5), 0.04, 1e-15);
  EXPECT_EQ(schlick(0, 1, 1.5), 1);
  EXPECT_EQ(schlick(0.5, 1.5, 1), 1) << "total internal reflection";
  EXPECT_NEAR(schlick(1, 1.5, 1), 0.04, 1e-15);
  const Real inside = 0.9, outside = std::sqrt(1 - 2.25 * (1 - inside * inside));
  EXPECT_NEAR(schlick(inside, 1.5, 1), schlick(outside, 1, 1.5), 1e-15) << "the same both ways";

  Scene scene;  // a sheet of glass between a red lamp above and a blue one below
  Phong glass, red, blue;
  glass.transmissive = Color(1), glass.index = 1.5;
  red.emissive = {1, 0, 0}, blue.emissive = {0, 0, 1};
  addObject(scene, Square{}, Affine::scaling({9, 9, 1}), glass);
  addObject(scene, Square{}, at(0, 0, 20), red);
  addObject(scene, Square{}, at(0, 0, -5), blue);
  const Color seen = trace(scene, kDown, {.airIndex = 1, .fresnel = Fresnel::schlick});
  EXPECT_NEAR(seen.r, 0.04, 1e-14);
  EXPECT_NEAR(seen.b, 0.96, 1e-14);
  EXPECT_EQ(trace(scene, kDown, {.airIndex = 1}), Color(0, 0, 1));
}

TEST(Whitted, GlassMayCastABlackShadow) {
  Scene scene;
  Phong white, glass;
  white.diffuse = Color(1), glass.transmissive = Color(0.5);
  addObject(scene, Square{}, Affine::scaling({10, 10, 1}), white);
  addObject(scene, Square{}, at(2, 0, 3), glass);
  scene.lights.push_back(sun({0, 0, -1}));
  const Ray below{{2, 0, 2}, {0, 0, -1}};
  EXPECT_EQ(trace(scene, below), Color(0.5));
  EXPECT_EQ(trace(scene, below, {.glassShadows = GlassShadows::black}), Color(0));
}

TEST(Whitted, TheBackgroundIsInBandsAndOnlyCameraRaysSeeIt) {
  Scene scene;
  scene.background = {{Color(1, 0, 0), Color(0, 1, 0), Color(0, 0, 1)}, {0.25, 0.5}};
  Phong mirror;
  mirror.reflective = Color(1);
  addObject(scene, Square{}, at(0, 0, -1000), mirror);
  const World world = build(scene);
  const auto seen = [&](Real x, Real y) { return trace(scene, world.camera().ray({x, y})); };
  EXPECT_EQ(seen(0.1, 0.9), Color(1, 0, 0));
  EXPECT_EQ(seen(0.9, 0.76), Color(1, 0, 0));
  EXPECT_EQ(seen(0.3, 0.74), Color(0, 1, 0));
  EXPECT_EQ(seen(0.3, 0.1), Color(0, 0, 1));
  EXPECT_EQ(seen(0.5, 0.5), Color(0)) << "the mirror looks back past the eye";
  scene.background.limits.clear();
  EXPECT_EQ(trace(scene, world.camera().ray({0.3, 0.4})), Color(0, 1, 0)) << "equal bands";
}

// --- checks.md E2 --------------------------------------------------------------------------------------

TEST(Optics, SnellAndTheReversedRay) {
  const Vec3 normal{0, 0, 1};
  for (auto [in, out] : {std::pair{30.0, 19.47122063}, {45.0, 28.12550570}, {60.0, 35.26438968}}) {
    const Vec3 d{std::sin(in * kPi / 180), 0, -std::cos(in * kPi / 180)};
    const auto t = refracted(d, normal, 1 / 1.5);
    ASSERT_TRUE(t);
    EXPECT_NEAR(std::asin(t->x) * 180 / kPi, out, 1e-7);
    EXPECT_NEAR(length(*t), 1, 1e-15);
    const auto back = refracted(-*t, -normal, 1.5);
    ASSERT_TRUE(back);
    EXPECT_LT(length(*back + d), 1e-14);
  }
}

TEST(Optics, CriticalAngle) {
  const Real critical = std::asin(1 / 1.5);
  EXPECT_NEAR(critical * 180 / kPi, 41.81031490, 1e-7);
  for (Real lean : {-1e-9, 1e-9}) {
    const Real a = critical + lean;
    EXPECT_EQ(refracted({std::sin(a), 0, -std::cos(a)}, {0, 0, 1}, 1.5).has_value(), lean < 0);
  }
}

TEST(Optics, MirroredKeepsLengthAndAngle) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = random.direction(), n = random.direction();
    const Vec3 r = mirrored(d, n);
    EXPECT_NEAR(length(r), 1, 1e-14);
    EXPECT_NEAR(dot(r, n), -dot(d, n), 1e-14);
  }
}

TEST(Whitted, APrismDeviatesLeastByTheKnownAngle) {
  // 60 degrees, n = 1.5: 37.18076 degrees. The ray meets both faces at the same angle.
  const Real in = std::asin(1.5 * std::sin(kPi / 6));
  const Vec3 left{-std::cos(kPi / 6), std::sin(kPi / 6), 0};  // normals of the two faces
  const Vec3 right{std::cos(kPi / 6), std::sin(kPi / 6), 0};
  const Vec3 across = Vec3{std::sin(kPi / 6), std::cos(kPi / 6), 0};  // up along the left face
  const Vec3 d = -left * std::cos(in) + across * std::sin(in);
  const auto inside = refracted(d, left, 1 / 1.5);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->y, 0, 1e-15);
  const auto out = refracted(*inside, -right, 1.5);
  ASSERT_TRUE(out);
  EXPECT_NEAR(std::acos(dot(d, *out)) * 180 / kPi, 37.18076, 1e-5);
}

TEST(Whitted, ABallLensFocusesWhereItShould) {
  // n = 1.5, radius 1: paraxial focus 1.5 from the centre. A thin ray parallel to the axis crosses it there.
  Settings settings{.depth = 3, .airIndex = 1};
  Scene scene;
  Phong glass;
  glass.transmissive = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, {}, glass);
  const World world = build(scene, settings);
  Statistics statistics;
  const Real h = 1e-4;
  Ray ray{{h, 0, 5}, {0, 0, -1}};
  for (int surface = 0; surface < 2; ++surface) {
    const auto found = world.closest(ray, Faces::both, statistics);
    ASSERT_TRUE(found);
    const SurfacePoint s = world.surface(ray, *found);
    const auto d = refracted(ray.direction, surface ? -s.normal : s.normal, surface ? 1.5 : 1 / 1.5);
    ray = spawnRay(s, *d);
  }
  EXPECT_NEAR(ray.origin.z + ray.direction.z * (-ray.origin.x / ray.direction.x), -1.5, 1e-6);
}

TEST(Whitted, AnObjectOfTheIndexOfAirIsInvisible) {
  Settings settings{.width = 60, .depth = 5, .airIndex = 1.25};
  Random random(2);
  Scene scene;
  Phong glow;
  glow.emissive = {0.2, 0.5, 0.9};
  addObject(scene, Cube{}, at(0, 0, -4) * Affine::rotation({0, 1, 0}, 0.5), glow);
  scene.camera.position = {0, 0, 4};
  const Picture plain = picture(scene, settings);
  Phong clear;
  clear.transmissive = Color(1), clear.index = 1.25;
  addObject(scene, Sphere{}, {}, clear);
  const Levels levels = compareLevels(plain, picture(scene, settings));
  EXPECT_EQ(levels.beyondOne, 0);
}

// --- local shading -------------------------------------------------------------------------------------

TEST(Whitted, LambertAndEmissiveAndAmbient) {
  Scene scene;
  Phong phong;
  phong.emissive = Color(0.125), phong.ambient = Color(0.5), phong.diffuse = {0.5, 0.25, 1};
  addObject(scene, Square{}, {}, phong);
  scene.lights = {sun({0, -1, -1}), {AmbientLight{Color(0.25)}, {}}, {AmbientLight{Color(0.25)}, {}}};
  const Color c = trace(scene, kDown);
  const Real cosine = std::sqrt(0.5);
  EXPECT_NEAR(c.r, 0.125 + 0.25 + 0.5 * cosine, 1e-15);
  EXPECT_NEAR(c.b, 0.125 + 0.25 + 1.0 * cosine, 1e-15);
}

TEST(Whitted, HighlightsOfBlinnAndPhong) {
  Scene scene;
  Phong phong;
  phong.specular = Color(1), phong.shininess = 10;
  addObject(scene, Square{}, {}, phong);
  const Real a = 0.3;  // the light leans by a: half-way vector by a / 2, mirrored light by a
  scene.lights = {sun({-std::sin(a), 0, -std::cos(a)})};
  EXPECT_NEAR(trace(scene, kDown, {.depth = 0}).r, std::pow(std::cos(a / 2), 10), 1e-14);
  EXPECT_NEAR(trace(scene, kDown, {.depth = 0, .highlight = Highlight::phong}).r, std::pow(std::cos(a), 10),
              1e-14);
  Random random(3);
  for (Highlight highlight : {Highlight::blinn, Highlight::phong}) {
    PhongBsdf p = phong.at({.highlight = highlight});
    if (highlight == Highlight::blinn) {
      EXPECT_EQ(p.scatter({0, 0, 1}, {0, 0, -1}, {0, 0, -1}).sum().r, 0);  // N.H < 0
    }
    p.shininess = 0;
    EXPECT_EQ(p.scatter({0, 0, 1}, {0, 1, 0}, {1, 0, 0}).sum().r, 1);  // pow(0, 0) = 1: covers everything
    for (int i = 0; i < 100; ++i) {                                    // light and eye may be swapped
      const Vec3 n = random.direction(), l = random.direction(), v = random.direction();
      p.shininess = 7;
      EXPECT_NEAR(p.scatter(n, l, v).sum().r, p.scatter(n, v, l).sum().r, 1e-12);
    }
  }
}

TEST(Whitted, AttenuationByDistance) {
  Scene scene;
  Phong phong;
  phong.diffuse = Color(1);
  addObject(scene, Square{}, {}, phong);
  const auto lit = [&](PointLight light, bool limit = true) {
    light.position = {0, 0, 2}, light.color = Color(1);
    scene.lights = {{light, {}}};
    return trace(scene, kDown, {.limitAttenuation = limit}).r;
  };
  EXPECT_DOUBLE_EQ(lit({}), 0.25);  // no coefficients: 1 / d^2
  EXPECT_DOUBLE_EQ(lit({.constant = 1, .linear = 0.5, .quadratic = 0.25}), 1 / 3.0);
  EXPECT_DOUBLE_EQ(lit({.constant = 0.25, .quadratic = 0}), 1);  // never more than 1
  EXPECT_DOUBLE_EQ(lit({.constant = 0.25, .quadratic = 0}, false), 4);
  EXPECT_DOUBLE_EQ(lit({.constant = 0, .linear = 0, .quadratic = 0}), 1);
}

// --- shadows -------------------------------------------------------------------------------------------

Scene floorAndSun() {
  Scene scene;
  Phong phong;
  phong.diffuse = Color(1);
  addObject(scene, Square{}, Affine::scaling({10, 10, 1}), phong);
  scene.lights = {sun({0, 0, -1})};
  return scene;
}
const Ray kAside{{4, 0, 5}, normalize({-4, 0, -5})};  // sees the floor's middle from the side

TEST(Whitted, OpaqueThingsCastShadows) {
  Scene scene = floorAndSun();
  EXPECT_NEAR(trace(scene, kAside).r, 1, 1e-15);
  addObject(scene, Sphere{}, at(0, 0, 10), {});
  EXPECT_EQ(trace(scene, kAside).r, 0);
  // A point light between floor and blocker is not shadowed by it.
  scene.lights = {{PointLight{.position = {0, 0, 3}, .color = Color(1), .constant = 1, .quadratic = 0}, {}}};
  EXPECT_NEAR(trace(scene, kAside).r, 1, 1e-15);
}

TEST(Whitted, ShadowsAreFilteredByEveryPaneInAnyOrder) {
  const Color tint{0.9, 0.5, 0.25}, other{0.5, 0.8, 1};
  for (int panes = 0; panes < 6; ++panes) {
    Scene scene = floorAndSun(), reversed = floorAndSun();
    Color expected(1);
    for (int i = 0; i < panes; ++i) {
      Phong pane;
      pane.transmissive = i % 2 ? tint : other;
      expected *= pane.transmissive;
      addObject(scene, Square{}, at(0, 0, 6 + i), pane);
      addObject(reversed, Square{}, at(0, 0, 20 - i), pane);
    }
    const Color c = trace(scene, kAside), d = trace(reversed, kAside);
    EXPECT_NEAR(c.r, expected.r, 1e-15);
    EXPECT_NEAR(c.g, expected.g, 1e-15);
    EXPECT_NEAR(c.b, expected.b, 1e-15);
    EXPECT_NEAR(c.b, d.b, 1e-15);
  }
}

TEST(Whitted, ASolidFiltersTwicePerCrossingOrByItsThickness) {
  Scene scene = floorAndSun();
  Phong glass;
  glass.transmissive = {0.5, 0.25, 1}, glass.index = 1.5;
  addObject(scene, Cube{}, at(0, 0, 9) * Affine::scaling({1, 1, 3}), glass);
  const Color crossing = trace(scene, kAside);
  EXPECT_NEAR(crossing.r, 0.25, 1e-15);
  EXPECT_NEAR(crossing.g, 0.0625, 1e-15);
  const Color distance = trace(scene, kAside, {.glass = Glass::perDistance});
  EXPECT_NEAR(distance.r, std::pow(0.5, 3), 1e-14);
  EXPECT_NEAR(distance.g, std::pow(0.25, 3), 1e-14);
  EXPECT_NEAR(distance.b, 1, 1e-14);
}

TEST(Whitted, BeerAlongTheViewRay) {
  for (Real thickness : {0.5, 1.0, 2.0}) {
    Scene scene;
    Phong glow, glass;
    glow.emissive = Color(1);
    glass.transmissive = Color(std::exp(-0.5)), glass.index = 1;
    addObject(scene, Square{}, at(0, 0, -5), glow);
    addObject(scene, Cube{}, Affine::scaling({1, 1, thickness}), glass);
    EXPECT_NEAR(trace(scene, kDown, {.glass = Glass::perDistance, .airIndex = 1}).r,
                std::exp(-0.5 * thickness), 1e-14);
    EXPECT_NEAR(trace(scene, kDown, {.airIndex = 1}).r, std::exp(-1.0), 1e-14);  // kt at each of two surfaces
  }
}

TEST(Whitted, AmbientSheetsOfGlassSeenInARow) {
  // Depth: a ray through k sheets needs depth k.
  Scene scene;
  Phong glow, sheet;
  glow.emissive = Color(1), sheet.transmissive = Color(0.5), sheet.index = 1.0003;
  addObject(scene, Square{}, at(0, 0, -1), glow);
  for (int i = 0; i < 4; ++i) addObject(scene, Square{}, at(0, 0, i), sheet);
  for (int depth = 0; depth <= 6; ++depth)
    EXPECT_NEAR(trace(scene, kDown, {.depth = depth}).r, depth >= 4 ? 0.0625 : 0, 1e-14) << depth;
}

// --- reflection ----------------------------------------------------------------------------------------

/// Two mirrors of weight 1/2 that glow with 1.
Scene facingMirrors() {
  Scene scene;
  Phong mirror;
  mirror.emissive = Color(1), mirror.reflective = Color(0.5);
  addObject(scene, Square{}, {}, mirror);
  addObject(scene, Square{}, at(0, 0, 20), mirror);
  return scene;
}

TEST(Whitted, ParallelMirrorsCountTheDepth) {
  // Depth k sums 1 + 1/2 + ... + 1/2^k.
  const Scene scene = facingMirrors();
  Real expected = 0;
  for (int depth = 0; depth <= 8; ++depth) {
    expected += std::pow(0.5, depth);
    Statistics statistics;
    EXPECT_NEAR(trace(scene, kDown, {.depth = depth}, &statistics).r, expected, 1e-15);
    EXPECT_EQ(statistics.rays[static_cast<size_t>(RayKind::reflection)], static_cast<std::uint64_t>(depth));
  }
}

TEST(Whitted, ThresholdStopsRaysThatAddLittle) {
  const Scene scene = facingMirrors();
  EXPECT_NEAR(trace(scene, kDown, {.depth = 50, .threshold = 0.2}).r, 1.75,
              1e-15);  // 1 + 1/2 + 1/4, 1/8 is less
  EXPECT_NEAR(trace(scene, kDown, {.depth = 50}).r, 2, 1e-12);
}

TEST(Whitted, MirrorDefaultFollowsTheConvention) {
  Scene scene;
  Phong shiny, glow;
  shiny.specular = Color(0.5), shiny.mirrorsSpecular = true, shiny.shininess = 1e9;
  glow.emissive = Color(1);
  addObject(scene, Square{}, {}, shiny);
  addObject(scene, Square{}, at(0, 0, 20), glow);
  EXPECT_NEAR(trace(scene, kDown).r, 0.5, 1e-15);
  EXPECT_EQ(trace(scene, kDown, {.mirrorDefault = MirrorDefault::zero}).r, 0);
}

TEST(Whitted, TotalInternalReflectionAddsNothing) {
  Scene scene;
  Phong glass, glow;
  glass.transmissive = Color(1), glass.index = 2;
  glow.emissive = Color(1);
  addObject(scene, Cube{}, Affine::scaling({4, 4, 4}), glass);
  addObject(scene, Sphere{}, at(0, 0, 9), glow);
  addObject(scene, Sphere{}, at(9, 0, 0), glow);
  const Ray inside{{0, 0, 0}, normalize({1, 0, 1.0001})};  // 45 degrees at the top face; critical angle 30
  Statistics statistics;
  EXPECT_EQ(trace(scene, inside, {.depth = 20}, &statistics).r, 0);
  EXPECT_EQ(statistics.allRays(), 1u);
}

TEST(Whitted, InsideOfAnOpaqueBoxIsBlack) {
  Scene scene;
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Cube{}, {}, white);
  scene.lights = {{PointLight{.position = {0.1, 0.2, 0.3}, .color = Color(1)}, {}}};
  EXPECT_EQ(trace(scene, {{0, 0, 0}, {1, 0, 0}}).r, 0);
}

TEST(Whitted, BackFacesOfMeshes) {
  Scene scene;
  auto mesh = std::make_shared<MeshData>();
  mesh->points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 2, 1}};  // its back is up
  Phong glow;
  glow.emissive = Color(1);
  addObject(scene, Mesh{mesh}, {}, glow);
  EXPECT_EQ(trace(scene, kDown).r, 1);
  EXPECT_EQ(trace(scene, kDown, {.backFaces = BackFaces::cullSeen}).r, 0);
  EXPECT_EQ(trace(scene, kDown, {.backFaces = BackFaces::cullAll}).r, 0);
  // Shadow rays that meet a back: cull-seen still blocks light, cull-all lets it through.
  auto flipped = std::make_shared<MeshData>(*mesh);
  flipped->triangles = {{0, 1, 2}};
  scene.objects[0].shape = Mesh{flipped};
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Square{}, at(0, 0, -2), white);
  scene.lights = {sun({0, 0, -1})};
  const Ray under{{3, 0, -1}, normalize({-3, 0, -1})};
  EXPECT_EQ(trace(scene, under, {.backFaces = BackFaces::cullSeen}).r, 0);
  EXPECT_NEAR(trace(scene, under, {.backFaces = BackFaces::cullAll}).r, 1, 1e-15);
}

TEST(Whitted, BackFacesOfMeshesAreThoseOfWhichTheFaceOrTheMixedNormalLooksAway) {
  Phong glow;
  glow.emissive = Color(1);
  for (const bool faceUp : {false, true})
    for (const bool normalUp : {false, true}) {
      Scene scene;
      auto mesh = std::make_shared<MeshData>();
      mesh->points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
      mesh->triangles = {faceUp ? Triangle{0, 1, 2} : Triangle{0, 2, 1}};
      const Vec3f normal{0.25f, 0, normalUp ? 1.0f : -1.0f};
      mesh->normals = {normal, normal, normal};
      addObject(scene, Mesh{mesh}, {}, glow);
      EXPECT_EQ(trace(scene, kDown, {.backFaces = BackFaces::both}).r, 1);
      EXPECT_EQ(trace(scene, kDown, {.backFaces = BackFaces::cullSeen}).r, faceUp && normalUp);
      EXPECT_EQ(trace(scene, kDown, {.backFaces = BackFaces::cullAll}).r, faceUp);
    }
}

TEST(Whitted, AmbientLightIsScaled) {
  Scene scene;
  Phong white;
  white.ambient = {0.5, 0.25, 1};
  addObject(scene, Square{}, {}, white);
  scene.lights = {{AmbientLight{.color = {0.5, 1, 0.25}}, {}}, {AmbientLight{.color = Color(0.5)}, {}}};
  EXPECT_EQ(trace(scene, kDown), (Color{0.5, 0.375, 0.75}));
  EXPECT_EQ(trace(scene, kDown, {.ambientScale = 0.5}), (Color{0.25, 0.1875, 0.375}));
  EXPECT_EQ(trace(scene, kDown, {.ambientScale = 0}), Color(0));
}

TEST(Whitted, VertexMaterialsAreMixed) {
  Scene scene;
  auto mesh = std::make_shared<MeshData>();
  mesh->points = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 1, 2}};
  Phong a, b, c;
  a.emissive = {1, 0, 0}, b.emissive = {0, 1, 0}, c.emissive = {0, 0, 1};
  mesh->materials = {addMaterial(scene, a), addMaterial(scene, b), addMaterial(scene, c)};
  addObject(scene, Mesh{mesh}, {}, {});
  const Color color = trace(scene, kDown);
  EXPECT_NEAR(color.r, 0.25, 1e-15);
  EXPECT_NEAR(color.g, 0.25, 1e-15);
  EXPECT_NEAR(color.b, 0.5, 1e-15);
}

// --- lights with a size ---------------------------------------------------------------------------------

TEST(Whitted, TheMiddleOfAPenumbraSeesHalfOfTheLamp) {
  Scene scene;
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Square{}, Affine::scaling({20, 20, 1}), white);
  addObject(scene, Square{}, at(5, 0, 2) * Affine::scaling({10, 10, 1}), {});  // its edge is over x = 0
  PointLight lamp{.position = {0, 0, 4}, .color = Color(1), .constant = 1, .quadratic = 0};
  lamp.radius = 1;
  scene.lights.push_back({lamp, {}});
  Settings settings;
  settings.spp = settings.lightSamples = 16;
  const auto seen = [&](Real x) {
    const Vec3 to = normalize(Vec3{x, 0, 0} - Vec3{-3, 0, 1});
    return trace(scene, {{-3, 0, 1}, to}, settings).r;
  };
  const Real cosine = (1 + std::sqrt(1 - 1.0 / 16)) / 2;  // the mean over the lamp
  settings.lightSamples = 1024;
  EXPECT_NEAR(seen(0), cosine / 2, 0.01);
  EXPECT_NEAR(seen(-1.6), cosine * 4 / std::sqrt(16 + 1.6 * 1.6), 0.02) << "it is all seen";
  EXPECT_EQ(seen(1.6), 0) << "nothing of it is seen";
  EXPECT_LT(seen(0.3), seen(0));
}

}  // namespace
}  // namespace trace::test::whitted_test
