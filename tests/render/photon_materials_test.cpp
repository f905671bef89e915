// Each lobe of each material rests in one map of photons: photon is checked against bdpt over all models and
// roughnesses, and with media in glass.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/shapes/solids/cube.h"
#include "render/picture/agreement.h"
#include "shading/lights/point_light.h"
#include "shading/material_list.h"
#include "support/rooms.h"

namespace trace::test::photon_materials_test {
namespace {

struct Surface {
  std::string name;
  MaterialModel model;
};

/// Every model, as rough as each number says where it says how rough it is; as it is else. Sheets and bodies
/// let light through where they can.
std::vector<Surface> surfaces() {
  std::vector<Surface> all;
  forEachType<ModelList>([&]<class Model>(Model*) {
    Model usual;
    if constexpr (requires { usual.shadow; }) usual.shadow = 1;
    if constexpr (std::is_same_v<Model, Phong>) usual.diffuse = Color(0.3), usual.reflective = Color(0.6);
    bool isRough = false;
    for (const Real roughness : {0.0, 0.05, 0.1, 0.3, 1.0}) {
      Model model = usual;
      forEachField<Model>([&](const auto& field) {
        if constexpr (std::is_same_v<decltype(&(model.*field.member)), Real*>)
          if (field.keyword == "roughness") isRough = true, model.*field.member = roughness;
      });
      const std::string name = std::string(Model::kKeyword) + " " + std::to_string(roughness);
      all.push_back({name, model});
      if constexpr (requires { model.transmission; }) {
        model.transmission = 0.8;
        all.push_back({name + " a sheet", model});
      }
      if constexpr (requires { model.metallic; }) {
        Model metal = model;
        metal.metallic = 1, metal.transmission = 0;
        all.push_back({name + " metal", metal});
        metal.metallic = 0, metal.clearcoat = 1, metal.clearcoatRoughness = roughness;
        all.push_back({name + " clear coat", metal});
      }
      if (!isRough) break;
    }
  });
  return all;
}

void add(Scene& scene, Shape shape, const Affine& transform, const Material& material) {
  scene.materials.push_back(material);
  scene.objects.push_back(
      {"", std::move(shape), transform, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}
void add(Scene& scene, Shape shape, const Affine& transform, const MaterialModel& model) {
  add(scene, std::move(shape), transform, Material{"", model, {}});
}

/// A floor that is seen, which sees nothing of a lamp but what a body beside them throws or lets through.
enum class Light { lamp, point };
Scene sceneOf(const Material& material, Light light, bool through) {
  Scene scene;
  const Affine down = turned({1, 0, 0}, 0.5);
  add(scene, Square{}, turned({1, 0, 0}, -0.5) * Affine::scaling({8, 8, 1}), diffuse(0.7));
  scene.camera.position = {1.4, 1.1, 1.5}, scene.camera.viewdir = {-0.1, -1.1, -1.3};
  scene.camera.fov = 28;
  const Vec3 place{0, through ? 2 : 0.5, 0};
  if (light == Light::lamp)
    add(scene, Square{},
        Affine::translation(place) * (through ? down : turned({1, 0, 0}, -0.5)) * scaled(0.5),
        diffuse(0, 30));
  else
    scene.lights.push_back(
        {PointLight{.position = place + Vec3{0, through ? -0.05 : 0.05, 0}, .color = Color(4)}, {}});
  // Below the light, or above it, what is opaque.
  add(scene, Cube{}, Affine::translation({0, through ? 2.1 : 0.42, 0}) * Affine::scaling({0.8, 0.1, 0.8}),
      diffuse(0));
  if (through)  // around the light all around
    add(scene, Cube{}, Affine::translation({0, 1.9, 0}) * Affine::scaling({1.2, 1.2, 1.2}), material);
  else
    add(scene, Square{}, Affine::translation({0, 1.6, 0}) * down * scaled(3), material);
  return scene;
}

Settings settingsOf(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 8;
  settings.depth = 20, settings.spp = spp;
  settings.mediumDepth = 20;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  settings.photons = 20000, settings.photonPasses = 2;
  settings.threads = 2;
  return settings;
}

/// How much photons may blur tiles and change the mean.
struct Blur {
  double tile, mean;
};

/// Pictures by photons are those of another integrator: each tile by Welch's test, and the means, but for
/// blur. All tiles together reject one right program of a hundred (Bonferroni).
class Comparison {
 public:
  explicit Comparison(const Blur& blur) : blur_(blur) {}
  void compare(const std::string& name, const Scene& scene, const Settings& reference) {
    const Agreement a =
        agreement(scene, reference, settingsOf(IntegratorKind::photon, 4), kSeeds, kTile, blur_.tile);
    if (!(a.meanA > 1e-4) && !(a.meanB > 1e-4)) return;
    all_.push_back({name, a});
  }
  ~Comparison() {
    double tiles = 0;
    for (const auto& [name, a] : all_) tiles += static_cast<double>(a.p.size());
    for (const auto& [name, a] : all_) {
      const double least = *std::min_element(a.p.begin(), a.p.end());
      EXPECT_GT(least, kRejected / tiles) << name << ": a tile; " << a.meanB << " for " << a.meanA;
      EXPECT_NEAR(a.meanB, a.meanA, blur_.mean * a.meanA + kErrors * a.error) << name;
    }
  }
  std::size_t size() const { return all_.size(); }

 private:
  static constexpr int kSeeds = 8, kTile = 4;
  static constexpr double kRejected = 0.01;
  static constexpr double kErrors = 5;  ///< of so many pictures' mean, of hundreds
  Blur blur_;
  std::vector<std::pair<std::string, Agreement>> all_;
};

TEST(PhotonMaterials, EachLobeRestsInOneMap) {
  Comparison comparison({0.03, 0.01});
  for (const Surface& surface : surfaces())
    for (const bool through : {false, true}) {
      const bool passes = whitted(bsdfOf(surface.model, {})).transmits();
      if (through && !passes) continue;
      // Fibres give back other light than they get: paths from lights do not find the same as those from
      // eyes.
      const bool fibres = surface.model.is<Marschner>();
      for (const Light light : {Light::lamp, Light::point})
        comparison.compare(
            surface.name + (through ? " around" : " above") + (light == Light::lamp ? " a lamp" : " a light"),
            sceneOf({"", surface.model, {}}, light, through),
            fibres ? settingsOf(IntegratorKind::path, 256) : settingsOf(IntegratorKind::bdpt, 64));
    }
  EXPECT_GT(comparison.size(), 150u);
}

TEST(PhotonMaterials, LightThroughGlassFilledWithAMediumCountsOnce) {
  Comparison comparison({0.03, 0.01});
  for (const Real roughness : {0.0, 0.2})
    for (const bool clear : {false, true})
      for (const Light light : {Light::lamp, Light::point}) {
        RoughGlass glass;
        glass.roughness = roughness, glass.index = 1.5;
        glass.attenuationColor = {0.4, 0.6, 0.8};
        Material material{"", glass, {}};
        if (!clear) material.mediumDensity = 1, material.mediumScatters = {0.9, 0.7, 0.5};
        comparison.compare("roughness " + std::to_string(roughness) + (clear ? " clear" : " turbid") +
                               (light == Light::lamp ? " a lamp" : " a light"),
                           sceneOf(material, light, true), settingsOf(IntegratorKind::bdpt, 32));
      }
  EXPECT_EQ(comparison.size(), 8u);
}

}  // namespace
}  // namespace trace::test::photon_materials_test
