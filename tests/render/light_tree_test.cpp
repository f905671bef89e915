// The choice among many lights: its probabilities, and that no light is forgotten.
#include "render/world/light_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/square.h"
#include "render/lights/lamps.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::light_tree_test {
namespace {

/// Lights of every kind, of very different strength and size.
std::vector<Light> someLights(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    const Vec3 position = random.inCube(5), direction = random.direction();
    const Color color = Color(std::pow(10, random.uniform(-2, 2)));
    switch (i % 6) {
      case 0:
        lights.push_back(PointLight{.position = position, .color = color, .radius = random.coin() ? 0.3 : 0});
        break;
      case 1:
        lights.push_back(SpotLight{.position = position,
                                   .direction = direction,
                                   .color = color,
                                   .angle = random.uniform(5, 120),
                                   .fullAngle = 5,
                                   .exponent = random.coin() ? 3.0 : 0});
        break;
      case 2:
        lights.push_back(RectangleLight{.position = position,
                                        .u = random.direction(),
                                        .v = random.direction(),
                                        .color = color,
                                        .round = random.coin(),
                                        .twoSided = random.coin()});
        break;
      case 3:
        lights.push_back(WarnLight{.position = position,
                                   .direction = direction,
                                   .color = color,
                                   .exponent = random.uniform(0, 20),
                                   .angle = random.uniform(10, 90)});
        break;
      case 4: {
        ProjectorLight light{.position = position, .direction = direction, .color = color};
        light.fov = random.uniform(10, 120);
        lights.push_back(light);
        break;
      }
      default:
        if (i % 4 == 1)
          lights.push_back(DirectionalLight{.direction = direction, .color = color * 0.01});
        else
          lights.push_back(PointLight{.position = position, .color = Color(0)});  // switched off
    }
  }
  return lights;
}

std::vector<LightReach> reachesOf(const std::vector<Light>& lights) {
  std::vector<LightReach> reaches;
  for (const Light& light : lights) reaches.push_back(light.reach({}));
  return reaches;
}

TEST(LightTree, ProbabilitiesAddUpToOneAndAreThoseOfTheChoice) {
  Random random(1);
  for (const int count : {1, 2, 7, 64, 500}) {
    const LightTree tree(reachesOf(someLights(count, static_cast<std::uint64_t>(count))));
    for (int k = 0; k < 20; ++k) {
      const Vec3 from = random.inCube(8), normal = random.direction();
      const Vec3* facing = random.coin() ? &normal : nullptr;
      Real sum = 0;
      for (int i = 0; i < count; ++i) sum += tree.probability(from, facing, static_cast<std::uint32_t>(i));
      // Ways that end where nothing shines are lost.
      EXPECT_LE(sum, 1 + 1e-9);
      for (int n = 0; n < 50; ++n) {
        const auto chosen = tree.choose(from, facing, random.uniform());
        if (!chosen) continue;
        EXPECT_NEAR(chosen->probability / tree.probability(from, facing, chosen->light), 1, 1e-9);
      }
    }
  }
  // Where all shine to all sides none is lost.
  std::vector<Light> points;
  for (int i = 0; i < 300; ++i) points.push_back(PointLight{.position = random.inCube(3), .color = Color(1)});
  const LightTree tree(reachesOf(points));
  for (int k = 0; k < 50; ++k) {
    const Vec3 from = random.inCube(4);
    Real sum = 0;
    for (std::uint32_t i = 0; i < 300; ++i) sum += tree.probability(from, nullptr, i);
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST(LightTree, NoLightThatReachesAPlaceIsForgotten) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Light> lights = someLights(200, seed);
    const LightTree tree(reachesOf(lights));
    Random random(seed + 10);
    int lit = 0;
    for (int k = 0; k < 200; ++k) {
      const Vec3 from = random.inCube(8), normal = random.direction();
      for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const auto arriving = lights[i].illuminate(from, {});
        if (!arriving || isBlack(arriving->intensity())) continue;
        ++lit;
        EXPECT_GT(tree.probability(from, &normal, i), 0) << lights[i].keyword();
        EXPECT_GT(tree.probability(from, nullptr, i), 0) << lights[i].keyword();
      }
    }
    EXPECT_GT(lit, 5000);
  }
}

TEST(LightTree, ChoosesAsOftenAsItSays) {  // chi-square
  const std::vector<Light> lights = someLights(120, 9);
  const LightTree tree(reachesOf(lights));
  Random random(4);
  for (int place = 0; place < 4; ++place) {
    const Vec3 from = random.inCube(4), normal = random.direction();
    const int draws = kSanitized ? 20000 : 200000;
    std::vector<int> counts(lights.size() + 1);
    for (int n = 0; n < draws; ++n) {
      const auto chosen = tree.choose(from, &normal, random.uniform());
      ++counts[chosen ? chosen->light : lights.size()];
    }
    Real chi2 = 0, rare = 0, rareCount = 0, all = 0;
    int cells = 0;
    const auto cell = [&](Real expected, Real count) {
      chi2 += (count - expected) * (count - expected) / expected;
      ++cells;
    };
    for (std::uint32_t i = 0; i <= lights.size(); ++i) {
      const Real probability = i < lights.size() ? tree.probability(from, &normal, i) : 1 - all;
      all += probability;
      const Real expected = probability * draws;
      if (expected >= 5)
        cell(expected, counts[i]);
      else
        rare += expected, rareCount += counts[i];
    }
    if (rare >= 5) cell(rare, rareCount);
    // Beyond four standard deviations of the distribution's normal approximation.
    EXPECT_LT(chi2, cells - 1 + 4 * std::sqrt(2.0 * (cells - 1))) << cells;
  }
}

TEST(LightTree, CostsTheLogarithm) {
  Random random(3);
  std::vector<LightReach> reaches;
  for (int i = 0; i < 10000; ++i)
    reaches.push_back(PointLight{.position = random.inCube(10), .color = Color(1)}.reach({}));
  EXPECT_LE(LightTree(reaches).depth(), 28);  // 14 if it were balanced
  // Lights that stand in one place, and lights of which each is far beyond the ones before.
  EXPECT_LE(LightTree(std::vector<LightReach>(4096, reaches[0])).depth(), 12);
  std::vector<LightReach> apart;
  for (int i = 0; i < 300; ++i)
    apart.push_back(PointLight{.position = {std::pow(2, i), 0, 0}, .color = Color(1)}.reach({}));
  EXPECT_LE(LightTree(apart).depth(), 60);
  EXPECT_TRUE(LightTree(std::vector<LightReach>{}).empty());
}

// --- pictures -----------------------------------------------------------------------------------------

/// A floor under many lights.
Scene manyLights(int count) {
  Scene scene;
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({12, 12, 1}), {});
  Phong floor;
  floor.diffuse = {0.8, 0.7, 0.6};
  floor.specular = Color(0.2);
  floor.shininess = 20;
  scene.materials[0].model = floor;
  scene.camera.position = {0, 4, 9}, scene.camera.viewdir = {0, -4, -9};
  for (const Light& light : someLights(count, 2)) {
    Light raised = light;
    if (Vec3* position = editableValue<Vec3>(raised, "position")) position->y = std::abs(position->y) + 0.3;
    scene.lights.push_back({raised, {}});
  }
  return scene;
}

TEST(LightTree, ChosenLightsGiveThePictureOfAll) {
  Settings settings;
  settings.width = settings.height = 8;
  settings.sampling = SampleKind::sobol;
  settings.mirrorDefault = MirrorDefault::zero;
  settings.spp = 16;
  const Scene scene = manyLights(90);
  const Color all = meanColor(picture(scene, settings));
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::direct}) {
    settings.integrator = kind;
    settings.lightChoices = 1;
    settings.spp = 4096;
    const Color chosen = meanColor(picture(scene, settings));
    EXPECT_NEAR(chosen.g / all.g, 1, 0.01);
    EXPECT_NEAR(chosen.r / all.r, 1, 0.01);
  }
  settings.lightChoices = 0;  // direct asks one of that many
  settings.spp = 4096;
  EXPECT_NEAR(meanColor(picture(scene, settings)).g / all.g, 1, 0.01);
}

TEST(LightTree, FewLightsAreAllAskedUnlessChoicesAreWanted) {
  Settings settings;
  settings.width = settings.height = 6;
  const Scene scene = manyLights(20);
  settings.integrator = IntegratorKind::direct;
  settings.sampling = SampleKind::sobol;
  settings.spp = 4;
  const Picture before = picture(scene, settings);
  settings.seed = 3;
  settings.lightChoices = 2;
  EXPECT_NE(picture(scene, settings).pixels, before.pixels);
}

TEST(LightTree, ExplainSaysTheProbability) {
  Settings settings;
  settings.width = settings.height = 6;
  settings.lightChoices = 3;
  const Scene scene = manyLights(40);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  const Explanation explanation = explain(world, *integrator, settings, {6, 6}, 3, 4, 0);
  EXPECT_TRUE(sumsUp(explanation.tree));
  int lights = 0;
  for (const Term& term : explanation.tree.nodes.front().terms) {
    if (!term.light) continue;
    ++lights;
    EXPECT_LT(term.light->probability, 1);
    EXPECT_NEAR(term.light->share * term.light->probability * 3, 1, 1e-9);
  }
  EXPECT_GT(lights, 0);
  EXPECT_LE(lights, 3);
}

// --- lamps --------------------------------------------------------------------------------------------

/// A globe of triangles that shine above a floor.
Scene globe(int rings, int turns) {
  MeshData mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const Real a = kPi * (i + 0.5) / (rings + 1), b = 2 * kPi * j / turns;
      mesh.points.push_back(Vec3f{static_cast<float>(std::sin(a) * std::cos(b)),
                                  static_cast<float>(std::cos(a)),
                                  static_cast<float>(std::sin(a) * std::sin(b))});
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * turns + j % turns); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  Scene scene;
  Phong floor, lamp;
  floor.diffuse = Color(0.5);
  lamp.emissive = Color(2);
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({6, 6, 1}), floor);
  addObject(scene, Mesh{std::make_shared<const MeshData>(mesh)},
            Affine::translation({0.5, 1.5, 0}) * Affine::scaling({0.6, 0.9, 0.4}), lamp);
  scene.camera.position = {0, 3, 6}, scene.camera.viewdir = {0, -3, -6};
  return scene;
}

TEST(LightTree, DensitiesOfLampsIntegrateToOne) {
  const World world = build(globe(8, 12));
  const Lamps lamps(world, 1);
  Statistics statistics;
  Random random(2);
  for (const Vec3& from : {Vec3{0, 0.2, 0}, Vec3{2, 0.5, 1}, Vec3{-1, 3, 2}}) {
    // All of the directions of a place that is chosen meet the part, whatever is before it: so count each
    // triangle along the ray.
    Real sum = 0;
    const int rays = kSanitized ? 20000 : 200000;
    for (int n = 0; n < rays; ++n) {
      const Ray ray{from, random.direction()};
      world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
        if (found.object != 1) return false;
        const Hit hit(world, ray, found);
        sum += lamps.density(from, hit) * 4 * kPi / rays;
        return false;
      });
    }
    EXPECT_NEAR(sum, 1, kSanitized ? 0.1 : 0.03);
    // And a choice says the density of what it chose.
    for (int n = 0; n < 200; ++n) {
      const auto place = lamps.choose(from, random.uniform(), {random.uniform(), random.uniform()});
      if (!place) continue;
      const Ray ray{from, place->toLight};
      world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
        if (found.object != place->object || found.part != place->part) return false;
        const Hit hit(world, ray, found);
        EXPECT_NEAR(lamps.density(from, hit) / place->density, 1, 1e-4);
        return true;
      });
    }
  }
}

TEST(LightTree, AMeshOfManyTrianglesLightsAsOneOfFew) {
  Settings settings;
  settings.width = settings.height = 8;
  settings.sampling = SampleKind::sobol;
  settings.integrator = IntegratorKind::direct;
  settings.spp = 1024;
  const Color few = meanColor(picture(globe(2, 6), settings));  // 24 triangles: by their power
  // The same surface of 96 triangles, by the tree: each is cut in four by the middles of its sides.
  Scene finer = globe(2, 6);
  Phong shining;
  shining.emissive = Color(2);
  const Object lamp = finer.objects[1];
  finer.objects.pop_back();
  MeshData mesh = *lamp.shape.as<Mesh>()->data;
  const std::vector<Triangle> triangles = mesh.triangles;
  mesh.triangles.clear();
  for (const Triangle& t : triangles) {
    std::array<std::uint32_t, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a(mesh.points[t[i]]), b(mesh.points[t[(i + 1) % 3]]), m = (a + b) * 0.5;
      middle[i] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(Vec3f{static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.z)});
    }
    for (std::size_t i = 0; i < 3; ++i) mesh.triangles.push_back({t[i], middle[i], middle[(i + 2) % 3]});
    mesh.triangles.push_back({middle[0], middle[1], middle[2]});
  }
  addObject(finer, Mesh{std::make_shared<const MeshData>(mesh)}, lamp.worldFromObject, shining);
  EXPECT_NEAR(meanColor(picture(finer, settings)).g / few.g, 1, 0.01);
}

}  // namespace
}  // namespace trace::test::light_tree_test
