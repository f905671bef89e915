// How texture coordinates and normals change along surfaces, and the footprints of rays: held against places
// and rays nearby.
#include "render/world/footprint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh/mesh_uv.h"
#include "geometry/shapes/solids/plane.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/explain.h"
#include "render/samples/pixel.h"
#include "render/world/world.h"
#include "shading/optics/optics.h"
#include "shading/textures/checker.h"
#include "shading/textures/image_map.h"
#include "support/random.h"
#include "support/shapes.h"

namespace trace::footprint_test {
namespace {

Scene sceneOf(const Shape& shape, const Affine& worldFromObject = {}) {
  Scene scene;
  scene.materials.emplace_back();  // with a texture that asks for footprints in u and v
  ImageMap map;
  map.filter = TexelFilter::trilinear;
  setTexture(scene.materials[0].textures, "diffuse", TextureNode{.model = map});
  Object object;
  object.shape = shape;
  object.worldFromObject = worldFromObject;
  scene.objects.push_back(object);
  return scene;
}

World worldOf(const Scene& scene) {
  Messages messages;
  return compile(scene, Settings{}, messages);
}

Shape smoothBall(bool normals) {
  test::Random random(7);
  MeshData data = withProjectedUvs(*test::ballMesh(20, random), UvProjection::spherical);
  if (normals) data = withGeneratedNormals(data, true);
  return Mesh{std::make_shared<const MeshData>(std::move(data))};
}

/// Two places that rays side by side meet on one part of the world's only object.
struct Pair {
  Hit a, b;
};
template <class Visit>
void forPairs(const World& world, const Box3& box, test::Random& random, int rays, Visit visit) {
  const Real size = maxComponent(box.size());
  Statistics statistics;
  for (int i = 0; i < rays; ++i) {
    const Vec3 direction = random.direction();
    const Vec3 target = box.center() + Vec3{box.size().x * random.uniform(-0.5, 0.5),
                                            box.size().y * random.uniform(-0.5, 0.5),
                                            box.size().z * random.uniform(-0.5, 0.5)};
    const Ray ray{target - direction * size * 2, direction};
    const Ray beside{ray.origin + random.direction() * size * 1e-5, direction};
    const auto a = world.closest(ray, Faces::both, statistics),
               b = world.closest(beside, Faces::both, statistics);
    if (!a || !b || a->part != b->part || std::abs(a->t - b->t) > size * 1e-3) continue;
    visit(Pair{Hit(world, ray, *a), Hit(world, beside, *b)});
  }
}

bool folded(const Shape& shape) {
  return shape.is<Julia>() || shape.is<Mandelbulb>() || shape.is<Mandelbox>();
}

/// Where uv or the normal are told within a hundredth of what they change.
struct Tally {
  int good = 0, all = 0;
  void add(bool ok) { good += ok, ++all; }
  double share() const { return all > 0 ? double(good) / all : 1; }
};

void checkSlopes(const Shape& shape, test::Random& random, int rays) {
  const Affine place = random.affine(3);
  const World world = worldOf(sceneOf(shape, place));
  const Box3 box = place * test::closeBoundsOf(prepare(shape));
  Tally uv, normal;
  forPairs(world, box, random, rays, [&](const Pair& pair) {
    const SurfaceSlopes slopes = world.slopes(pair.a);
    const Vec3 step = pair.b.surface.point - pair.a.surface.point;
    const Vec2 from = pair.a.surface.uv, to = pair.b.surface.uv;
    const auto close = [&](Real change, const Vec3& gradient) {
      change -= std::round(change);
      return std::abs(change - dot(gradient, step)) <= 0.01 * length(gradient) * length(step) + 1e-9;
    };
    uv.add(close(to.x - from.x, slopes.u) && close(to.y - from.y, slopes.v));
    const Vec3 turn = pair.b.surface.shading - pair.a.surface.shading, turned = slopes.normalAlong(step);
    const Real bend = length(slopes.normal[0]) + length(slopes.normal[1]);
    normal.add(length(turn - turned) <= 0.02 * bend * length(step) + 1e-9);

    // Places go by the same slopes.
    const Differentials along{step, step * 2, {}, {}};
    const TexturePlace seen = world.place(pair.a, &along);
    const Vec2 told{dot(slopes.u, step), dot(slopes.v, step)};
    const Real most = (length(slopes.u) + length(slopes.v)) * length(step);
    EXPECT_NEAR(seen.uvX.x, told.x, 1e-4 * most);
    EXPECT_NEAR(seen.uvX.y, told.y, 1e-4 * most);
    EXPECT_NEAR(seen.uvY.x, 2 * told.x, 1e-4 * most);

    // The frame is dual to the gradients.
    const auto [byU, byV] = slopes.frame();
    if (byU == Vec3{}) return;
    EXPECT_NEAR(dot(slopes.u, byU), 1, 1e-6);
    EXPECT_NEAR(dot(slopes.v, byV), 1, 1e-6);
    EXPECT_NEAR(dot(slopes.v, byU), 0, 1e-6 * length(slopes.v) * length(byU));
    EXPECT_NEAR(dot(byU, pair.a.surface.normal), 0, 1e-6 * length(byU));
  });
  if (folded(shape)) return;  // at the scale of a step it has no tangents
  constexpr int kTooFew = 20;  // pairs that have met a thin strand both
  if (uv.all < kTooFew) return;
  // The rest are rays to either side of an edge, and near poles.
  EXPECT_GE(uv.share(), 0.95) << uv.good << " of " << uv.all;
  EXPECT_GE(normal.share(), 0.95) << normal.good << " of " << normal.all;
}

TEST(Footprint, UvAndNormalsChangeAsTheSlopesSayOnEveryShape) {
  test::Random random(1);
  std::vector<Shape> shapes = test::analyticShapes();
  shapes.push_back(smoothBall(false));
  shapes.push_back(smoothBall(true));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    SCOPED_TRACE(test::nameOf(shapes[i]) + " " + std::to_string(i));
    checkSlopes(shapes[i], random, test::raysFor(shapes[i], 400));
  }
}

TEST(Footprint, MeshesInSolidsHaveSlopesToo) {
  test::Random random(2);
  checkSlopes(Difference{.objects = Operands({{"", smoothBall(true), {}, 0},
                                              {"", Cube{}, Affine::translation({0.7, 0, 0}), 0}})},
              random, 400);
}

/// u and v of a unit sphere are longitude and latitude.
TEST(Footprint, GradientsOfASphereAreThoseOfLongitudeAndLatitude) {
  const World world = worldOf(sceneOf(Sphere{}, Affine::scaling({2, 2, 2})));
  const Ray ray{{5, 0, 0.5}, {-1, 0, 0}};
  Statistics statistics;
  const Hit hit(world, ray, *world.closest(ray, Faces::both, statistics));
  const SurfaceSlopes slopes = world.slopes(hit);
  const Real latitude = std::asin(0.25), radius = 2 * std::cos(latitude);
  EXPECT_NEAR(length(slopes.u), 1 / (2 * kPi * radius), 1e-6);
  EXPECT_NEAR(slopes.u.y, 1 / (2 * kPi * radius), 1e-6);
  EXPECT_NEAR(length(slopes.v), 1 / (2 * kPi), 1e-6);
  EXPECT_NEAR(length(slopes.frame().u), 2 * kPi * radius, 1e-5);
  EXPECT_NEAR(length(slopes.normal[0]), 0.5, 1e-6);  // curvature 1 / radius
}

// --- rays ------------------------------------------------------------------------------------------------

/// A ball seen, mirrored or refracted once, and a wall behind.
struct Way {
  bool glass;
  const World world = worldOf(sceneOf(Sphere{}));

  /// Where the ray through (x, y) ends on the wall.
  Vec3 end(Real x, Real y, const Differentials* first, Differentials& last) const {
    const Ray ray{{0, 0, 5}, normalize({x, y, -1})};
    Statistics statistics;
    const Hit hit(world, ray, *world.closest(ray, Faces::both, statistics));
    const Vec3 normal = hit.surface.normal;
    const Vec3 out = glass ? *refracted(ray.direction, normal, 1 / 1.5) : mirrored(ray.direction, normal);
    const Vec3 wall = normalize({0.1, 0.2, 1});
    const Real t = dot(wall, wall * (glass ? -6 : 6) - hit.surface.point) / dot(wall, out);
    if (first) {
      const Differentials at = arrived(*first, ray.direction, hit.t, normal);
      const Footprint onward = glass ? refractedAt(world, hit, &at, ray.direction, out, normal, 1 / 1.5)
                                     : mirroredAt(world, hit, &at, ray.direction, normal);
      last = arrived(*onward.get(), out, t, wall);
    }
    return hit.surface.point + out * t;
  }
};

TEST(Footprint, MirroredAndRefractedRaysGoAsTheirNeighbours) {
  constexpr Real kStep = 1e-6;
  for (bool glass : {false, true})
    for (const Vec2& at : {Vec2{0, 0}, Vec2{0.05, 0.1}, Vec2{-0.15, 0.02}}) {
      const Way way{glass};
      const auto direction = [&](Real x, Real y) { return normalize({at.x + x, at.y + y, -1}); };
      const Vec3 middle = direction(0, 0);
      const Differentials first{{}, {}, direction(kStep, 0) - middle, direction(0, kStep) - middle};
      Differentials last, unused;
      const Vec3 end = way.end(at.x, at.y, &first, last);
      const Vec3 endX = way.end(at.x + kStep, at.y, nullptr, unused) - end,
                 endY = way.end(at.x, at.y + kStep, nullptr, unused) - end;
      EXPECT_LE(length(last.originX - endX), 1e-3 * length(endX)) << glass << " " << at.x;
      EXPECT_LE(length(last.originY - endY), 1e-3 * length(endY)) << glass << " " << at.x;
    }
}

/// A floor of black and white squares to the horizon, glowing as its picture does.
Scene floorScene(TexelFilter filter) {
  Picture picture(2, 2);
  picture.at(0, 0) = picture.at(1, 1) = Color(1);
  Scene scene = sceneOf(Plane{});
  Phong phong;
  phong.emissive = Color(1);
  phong.diffuse = phong.reflective = Color(0);
  ImageMap map;
  map.filter = filter;
  map.file.map = std::make_shared<const MipMap>(picture);
  TextureNode node;
  node.model = map;
  scene.materials[0].model = phong;
  scene.materials[0].textures = {{"emissive", node}};
  scene.camera.position = {0, 0, 1};
  scene.camera.viewdir = {0, 1, -0.5};
  scene.camera.updir = {0, 0, 1};
  return scene;
}

TEST(Footprint, AFloorBecomesGreyFarAway) {
  for (TexelFilter filter : {TexelFilter::trilinear, TexelFilter::ewa}) {
    const Scene scene = floorScene(filter);
    const World world = worldOf(scene);
    EXPECT_TRUE(world.wantsFootprints());
    Settings settings;
    Job job;
    const auto integrator = makeIntegrator(world, settings, job);
    PixelTracer tracer(world, *integrator, settings, {100, 100});
    const int belowHorizon = 5;
    for (int x = 0; x < 100; ++x) EXPECT_NEAR(tracer.sample(x, belowHorizon, 0).r, 0.5, 0.01) << x;
    double least = 1, most = 0;
    for (int x = 0; x < 100; ++x) {
      const double value = tracer.sample(x, 99, 0).r;
      least = std::min(least, value), most = std::max(most, value);
    }
    EXPECT_LT(least, 0.2);
    EXPECT_GT(most, 0.8);
  }
}

TEST(Footprint, NobodyAsksForItUnlessATextureIsFiltered) {
  EXPECT_FALSE(worldOf(floorScene(TexelFilter::bilinear)).wantsFootprints());
  Scene untextured = sceneOf(Sphere{});
  EXPECT_TRUE(worldOf(untextured).wantsFootprints());
  untextured.materials[0].textures.clear();
  EXPECT_FALSE(worldOf(untextured).wantsFootprints());
  TextureNode outer;
  outer.model = Checker{};
  outer.inputs.push_back(floorScene(TexelFilter::ewa).materials[0].textures[0]);
  EXPECT_TRUE(wantsFootprint(outer));
}

TEST(Footprint, WhatIsExplainedIsTheFilteredColour) {
  const Scene scene = floorScene(TexelFilter::ewa);
  const World world = worldOf(scene);
  Settings settings;
  Job job;
  const auto integrator = makeIntegrator(world, settings, job);
  const Explanation found = explain(world, *integrator, settings, {100, 100}, 50, 5, 0);
  ASSERT_TRUE(found.tree.nodes[0].bsdf);
  EXPECT_EQ(whitted(*found.tree.nodes[0].bsdf).emissive, found.pixel);
}

}  // namespace
}  // namespace trace::footprint_test
