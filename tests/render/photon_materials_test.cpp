// Each lobe of each material rests in one map of photons: photon held to bdpt over all models and
// roughnesses.
#include <gtest/gtest.h>

#include "geometry/shapes/cube.h"
#include "render/agreement.h"
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
  forEachType<MaterialModel>([&]<class Model>(Model*) {
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

void add(Scene& scene, Shape shape, const Affine& transform, const MaterialModel& model) {
  scene.materials.push_back({"", model, {}});
  scene.objects.push_back(
      {"", std::move(shape), transform, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}

/// A floor that is seen, which sees nothing of a lamp but what a body beside them throws or lets through.
enum class Light { lamp, point };
Scene sceneOf(const MaterialModel& model, Light light, bool through) {
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
    add(scene, Cube{}, Affine::translation({0, 1.9, 0}) * Affine::scaling({1.2, 1.2, 1.2}), model);
  else
    add(scene, Square{}, Affine::translation({0, 1.6, 0}) * down * scaled(3), model);
  return scene;
}

Settings settingsOf(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 8;
  settings.depth = 20, settings.spp = spp;
  settings.airIndex = 1;
  settings.fresnel = Fresnel::exact;
  settings.photons = 20000, settings.photonPasses = 4;
  settings.threads = 2;
  return settings;
}

TEST(PhotonMaterials, EachLobeRestsInOneMap) {
  constexpr double kBlur = 0.06;  // and what bdpt finds rarely: light counted twice is 40 % and more
  int compared = 0;
  for (const Surface& surface : surfaces())
    for (const bool through : {false, true}) {
      // Fibres are no surfaces, and give back other light than they get. With sheets of thin glass bdpt
      // itself shows less than path does: nothing to be held to yet.
      if (surface.name.starts_with("marschner") || surface.name.starts_with("thin_glass")) continue;
      const bool passes = whitted(bsdfOf(surface.model, {})).transmits();
      if (through && !passes) continue;
      for (const Light light : {Light::lamp, Light::point}) {
        if (light == Light::point && !through) continue;  // which is what a lamp shows, and more slowly
        SCOPED_TRACE(surface.name + (through ? " around" : " above") +
                     (light == Light::lamp ? " a lamp" : " a light"));
        const Scene scene = sceneOf(surface.model, light, through);
        const Agreement a = agreement(scene, settingsOf(IntegratorKind::bdpt, 128),
                                      settingsOf(IntegratorKind::photon, 4), 5, 4, kBlur);
        if (!(a.meanA > 1e-4) && !(a.meanB > 1e-4)) continue;
        ++compared;
        EXPECT_NEAR(a.meanB, a.meanA, kBlur * a.meanA + 4 * a.error);
      }
    }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace trace::test::photon_materials_test
