// Surfaces that are there in part, or have holes: Material::opacity.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/material_list.h"
#include "shading/textures/checker.h"
#include "support/scenes.h"

namespace trace::test::holes_test {
namespace {

Affine at(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }

void add(Scene& scene, Shape shape, const Affine& transform, const MaterialModel& model, Real opacity = 1) {
  scene.materials.push_back({.name = "", .model = model, .opacity = opacity});
  scene.objects.push_back(
      {"", std::move(shape), transform, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}

Phong matt(Real diffuse, Real emissive = 0) {
  Phong phong;
  phong.diffuse = phong.ambient = Color(diffuse), phong.emissive = Color(emissive);
  return phong;
}

Settings smallSettings(IntegratorKind kind, int samples = 4) {
  Settings settings{.width = 12, .spp = samples, .integrator = kind, .depth = 8};
  settings.sampling = SampleKind::sobol;
  settings.threads = 1;
  settings.photons = settings.chainStarts = 2000;
  return settings;
}

/// A floor that a lamp of some size, a light and the surroundings light, past what is added.
Scene floorAndLamps() {
  Scene scene;
  add(scene, Square{}, at(0, 0, -4) * Affine::scaling({30, 30, 1}), matt(0.7));
  add(scene, Sphere{}, at(4, 3, 4), matt(0, 5));
  scene.lights.push_back({PointLight{.position = {-1, 0.5, 3}, .color = Color(0.8)}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0.2, 0.1, -1}, .color = Color(0.5)}, {}});
  scene.lights.push_back({AmbientLight{.color = Color(0.2)}, {}});
  scene.camera.position = {0, 0, 6};
  return scene;
}

/// Calls test(settings) for all integrators, without and with nested glass.
template <class Test>
void forEachIntegrator(const Test& test) {
  for (const IntegratorRow& row : integrators())
    for (const NestedGlass nested : {NestedGlass::off, NestedGlass::on}) {
      SCOPED_TRACE(std::string(row.name) + (nested == NestedGlass::on ? ", nested glass" : ""));
      Settings settings = smallSettings(row.kind);
      settings.nestedGlass = nested;
      settings.ambientOcclusion = 2;
      test(settings);
    }
}

TEST(Holes, WhatIsNotThereChangesNothingWhateverItsModel) {
  forEachType<ModelList>([]<class Model>(Model*) {
    SCOPED_TRACE(std::string(Model::kKeyword));
    const Bsdf bsdf = bsdfOf(MaterialModel(Model{}), {});
    const bool isTarget = whitted(bsdf).mirrors() || whitted(bsdf).transmits();  // photons are sent there
    forEachIntegrator([&](Settings settings) {
      for (const int photons : {0, 2000}) {
        settings.caustics = photons;
        if (photons > 0 && (isTarget || settings.integrator != IntegratorKind::whitted)) break;
        if (isTarget && settings.integrator == IntegratorKind::photon) break;
        if (settings.integrator == IntegratorKind::cost) break;  // which shows what it costs to look there
        if (settings.integrator == IntegratorKind::bdpt) break;  // its lights shine at the box around all
        Scene without = floorAndLamps();
        add(without, Sphere{}, at(1, 0, -2), Conductor{});
        Scene with = without;
        add(with, Square{}, at(0, 0, 1) * Affine::scaling({9, 9, 1}), Model{}, 0);
        add(with, Sphere{}, at(0, 0, -1) * Affine::scaling({3, 3, 1}), Model{}, 0);
        ASSERT_EQ(picture(with, settings), picture(without, settings)) << photons << " photons";
      }
    });
  });
}

TEST(Holes, WhatIsThereInPartLetsTheRestOfLightThrough) {
  // A veil above the floor, beside what the camera sees, and one before the camera; each alone, for light
  // that crosses both is weighed twice.
  const std::array veils{at(0, 0, 2) * Affine::scaling({9, 9, 1}), at(-0.6, 0.3, 1)};
  forEachType<ModelList>([&]<class Model>(Model*) {
    SCOPED_TRACE(std::string(Model::kKeyword));
    const auto shadows = [&](Real opacity) {
      Scene scene = floorAndLamps();
      scene.camera.position.z = -1;  // below the veil
      add(scene, Square{}, veils[0], Model{}, opacity);
      return picture(scene, smallSettings(IntegratorKind::whitted, 1));
    };
    const auto seen = [&](Real opacity) {
      Scene scene;
      add(scene, Square{}, at(0, 0, -4) * Affine::scaling({90, 90, 1}), matt(0, 0.6));
      scene.lights.push_back({PointLight{.position = {-1, 0.5, 3}, .color = Color(0.8)}, {}});
      scene.camera.position = {0, 0, 6};
      add(scene, Square{}, veils[1], Model{}, opacity);
      return picture(scene, smallSettings(IntegratorKind::whitted, 1));
    };
    const auto expectMean = [](const Picture& none, const Picture& part, const Picture& whole) {
      for (std::size_t i = 0; i < part.pixels.size(); ++i)
        ASSERT_NEAR(part.pixels[i].g, 0.7 * none.pixels[i].g + 0.3 * whole.pixels[i].g, 1e-12) << i;
    };
    expectMean(shadows(0), shadows(0.3), shadows(1));
    expectMean(seen(0), seen(0.3), seen(1));
  });
}

TEST(Holes, ChanceMeetsWhatIsThereInPartAsOftenAsItIsThere) {
  // Three veils that shine, one behind the other, before a wall: what is seen of each by their opacities.
  Scene scene;
  const Real opacity[3] = {0.25, 0.5, 0.2}, light[3] = {1, 7, 0.1};
  Real expected = 0, rest = 1;
  for (int i = 0; i < 3; ++i) {
    add(scene, Square{}, at(0, 0, -i) * Affine::scaling({90, 90, 1}), matt(0, light[i]), opacity[i]);
    expected += rest * opacity[i] * light[i];
    rest *= 1 - opacity[i];
  }
  add(scene, Square{}, at(0, 0, -4) * Affine::scaling({90, 90, 1}), matt(0, 3));
  expected += rest * 3;
  scene.camera.position = {0, 0, 6};
  const auto mean = [&](IntegratorKind kind, int samples) {
    const Picture p = picture(scene, smallSettings(kind, samples));
    Real sum = 0;
    for (const Color& c : p.pixels) sum += c.g;
    return sum / static_cast<Real>(p.pixels.size());
  };
  EXPECT_NEAR(mean(IntegratorKind::whitted, 1), expected, 1e-12);
  EXPECT_NEAR(mean(IntegratorKind::path, 64), expected, 0.02);
}

TEST(Holes, ALampIsSeenThroughAVeilByBothWaysToIt) {
  const auto brightness = [](Real opacity) {
    Scene scene;
    add(scene, Square{}, at(0, 0, -4) * Affine::scaling({30, 30, 1}), matt(0.7));
    add(scene, Sphere{}, at(0, 0, 5), matt(0, 20));
    scene.camera.position = {0, 0, -1};
    add(scene, Square{}, at(0, 0, 2) * Affine::scaling({90, 90, 1}), matt(0), opacity);
    const Picture p = picture(scene, smallSettings(IntegratorKind::path, 100));
    Real sum = 0;
    for (const Color& c : p.pixels) sum += c.g;
    return sum;
  };
  const Real clear = brightness(0);
  EXPECT_GT(clear, 0.1);
  EXPECT_NEAR(brightness(0.4) / clear, 0.6, 0.02);
}

TEST(Holes, PhotonsPassAsOftenAsTheSurfaceIsNotThere) {
  const auto caustics = [](Real opacity) {
    Scene scene;
    add(scene, Square{}, at(0, 0, -1) * Affine::scaling({20, 20, 1}), matt(0.7));
    Conductor mirror;
    mirror.roughness = 0;
    add(scene, Sphere{}, at(2, 0, 0), mirror);
    add(scene, Square{}, at(0, 0, 9) * Affine::scaling({90, 90, 1}), matt(0.5), opacity);
    scene.lights.push_back({DirectionalLight{.direction = {0.5, 0, -1}, .color = Color(1)}, {}});
    scene.camera.position = {0, 0, 4};
    Settings settings = smallSettings(IntegratorKind::whitted, 1);
    Real sum = 0;
    for (const int photons : {0, 40000}) {
      settings.caustics = photons;
      settings.causticRadius = 0.5;
      for (const Color& c : picture(scene, settings).pixels) sum += photons > 0 ? c.g : -c.g;
    }
    return sum;
  };
  const Real all = caustics(0);
  EXPECT_GT(all, 0.1);
  EXPECT_NEAR(caustics(0.4) / all, 0.6, 0.03);
}

TEST(Holes, ATextureCutsThem) {
  // A checker of holes: its squares are seen, and the shadow has the same squares.
  Scene scene;
  Material leaf{.name = "leaf", .model = matt(0, 1)};
  Checker checker;
  checker.a = Color(0), checker.b = Color(1);
  setTexture(leaf.textures, kOpacity, TextureNode{.model = checker});
  scene.materials.push_back(leaf);
  scene.objects.push_back({"", Square{}, Affine::scaling({8, 8, 1}), 0, {}});
  add(scene, Square{}, at(0, 0, -3) * Affine::scaling({90, 90, 1}), matt(0, 0.5));
  scene.camera.position = {0, 0, 6};
  forEachIntegrator([&](const Settings& settings) {
    const World world = build(scene, settings);
    Tracer tracer(world, settings);
    int holes = 0, places = 0;
    for (Real x = -3.9; x < 4; x += 0.5)
      for (Real y = -3.9; y < 4; y += 0.5) {
        const Ray ray{{x, y, 3}, {0, 0, -1}};
        Interfaces inside = tracer.interfacesAt(ray.origin);
        TexturePlace place;
        place.point = {x / 8, y / 8, 0};
        const bool whole = luminance(leaf.textures[0].texture.at(place)) > 0;
        const auto hit = tracer.cast(ray, RayKind::camera, inside);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->object, whole ? 0u : 1u) << x << " " << y;
        EXPECT_EQ(tracer.look(ray, RayKind::camera)->object, hit->object);
        holes += !whole, ++places;
        const Color light = tracer.visible({x, y, -1}, {0, 0, 1}, kInfinity, inside);
        EXPECT_EQ(light, Color(whole ? 0 : 1)) << x << " " << y;
      }
    EXPECT_GT(holes, places / 4);
    EXPECT_LT(holes, 3 * places / 4);
  });
}

TEST(Holes, MaterialsOfCornersCountByWhatIsThereOfThem) {
  auto mesh = std::make_shared<MeshData>();
  mesh->points = {{-50, -50, 0}, {50, -50, 0}, {0, 90, 0}};
  mesh->triangles = {{0, 1, 2}};
  mesh->materials = {0, 1, 1};
  Scene scene;
  scene.materials = {{.name = "", .model = matt(0, 4), .opacity = 0.25}, {.name = "", .model = matt(0, 1)}};
  scene.objects.push_back({"", Mesh{mesh}, {}, 0, {}});
  const World world = build(scene);
  Settings settings;
  Tracer tracer(world, settings);
  Interfaces inside;
  const auto hit = tracer.cast({{3, -7, 5}, {0, 0, -1}}, RayKind::camera, inside);
  ASSERT_TRUE(hit);
  const Real first = (90 - -7.) / 140 / 2 - 3. / 100;  // barycentric weight of the first corner
  EXPECT_NEAR(hit->opacity, 0.25 * first + (1 - first), 1e-12);
  const PlaceBsdf bsdf = world.shade(*hit);
  EXPECT_NEAR(whitted(*bsdf).emissive.g * hit->opacity, 0.25 * first * 4 + (1 - first), 1e-12);
}

TEST(Holes, AreExplained) {
  for (const IntegratorRow& row : integrators()) {
    if (row.traits.has(Trait::byChains) || row.kind == IntegratorKind::cost)
      continue;  // these are not sums of a pixel's rays
    SCOPED_TRACE(row.name);
    Scene scene = floorAndLamps();
    add(scene, Square{}, at(0, 0, 1) * Affine::scaling({9, 9, 1}), Conductor{}, 0.4);
    add(scene, Square{}, at(0, 0, 2) * Affine::scaling({9, 9, 1}), Conductor{}, 0);
    const Settings settings = smallSettings(row.kind);
    const Picture rendered = picture(scene, settings);
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    std::size_t passed = 0;
    for (int y = 0; y < 12; y += 3)
      for (int k = 0; k < 4; ++k) {
        const Explanation e = explain(world, *integrator, settings, {12, 12}, 5, y, k);
        if (!row.traits.has(Trait::splats)) {
          EXPECT_EQ(e.pixel, rendered.at(5, y));
        }
        EXPECT_TRUE(sumsUp(e.tree));
        for (const RayNode& node : e.tree.nodes)
          for (const Ignored& ignored : node.ignored) {
            EXPECT_LT(ignored.opacity, 1);
            EXPECT_NE(sentence(ignored, scene).find(ignored.opacity > 0 ? "opacity" : "a hole"),
                      std::string::npos);
            ++passed;
          }
      }
    EXPECT_GT(passed, 0u);
  }
}

TEST(Holes, DoNotDependOnTheHierarchyOrTheNumberOfThreads) {
  Random random(8);
  Scene scene = randomScene(random, 16);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    scene.materials[i].opacity = static_cast<Real>(i % 3) / 2;
  forEachIntegrator([&](Settings settings) {
    if (settings.integrator == IntegratorKind::cost) return;  // it shows what the hierarchy saves
    const Picture once = picture(scene, settings);
    settings.accel = Accel::none, settings.threads = 3;
    EXPECT_EQ(picture(scene, settings), once);
  });
}

}  // namespace
}  // namespace trace::test::holes_test
