// The parts of scenes that can be switched off: see scene_features.h. Used by the options, which name them,
// and when a World is compiled. Source: the course of the University of Washington, 2015, which demands a
// switch for each extension.
#include "scene/scene_features.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/plain_lights.h"
#include "shading/medium.h"

namespace trace {
namespace {

constexpr std::string_view kMedium = "medium", kBump = "bump", kDisplacement = "displacement",
                           kCastsShadow = "casts_shadow";

constexpr SceneFeatureRow kParts[] = {
    {kMedium, "nothing is inside of objects", "mist.ray"},
    {kBump, "surfaces are smooth", "bumps.ray"},
    {kDisplacement, "meshes keep their points", "displacement.ray"},
    {kOpacity, "surfaces have no holes", "holes.ray"},
    {kCastsShadow, "everything casts a shadow", "shadowless.ray"},
    {"spot_light", "a point light", "caustics.ray"},
    {"warn_light", "a point light", "studio-lights.ray"},
    {"goniometric_light", "a point light", "studio-lights.ray"},
    {"projector_light", "a point light", "studio-lights.ray"},
};

bool isOff(std::string_view name, const EnumSet<SceneFeature>& off) {
  const std::span<const std::string_view> names = sceneFeatureNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return found != names.end() && off.has(static_cast<SceneFeature>(found - names.begin()));
}

}  // namespace

std::span<const SceneFeatureRow> sceneFeatures() {
  static const std::vector<SceneFeatureRow> kAll = [] {
    std::vector<SceneFeatureRow> all(std::begin(kParts), std::end(kParts));
    for (const std::string_view model : modelKeywords())
      if (model != Phong::kKeyword) all.push_back({model, "Phong's closest approximation", ""});
    return all;
  }();
  return kAll;
}

std::span<const std::string_view> sceneFeatureNames() {
  static const std::vector<std::string_view> kAll = [] {
    std::vector<std::string_view> all;
    for (const SceneFeatureRow& row : sceneFeatures()) all.push_back(row.name);
    return all;
  }();
  return kAll;
}

bool hasFeature(const Scene& scene, SceneFeature feature) {
  const EnumSet<SceneFeature> only{feature};
  return std::any_of(
             scene.materials.begin(), scene.materials.end(),
             [&](const Material& material) { return !(withoutFeatures(material, only) == material); }) ||
         std::any_of(scene.lights.begin(), scene.lights.end(),
                     [&](const LightSource& source) { return lightWithout(source.light, only).has_value(); });
}

Material asPhong(Material material) {
  const Phong nearest = phongOf(material.model);
  for (FieldTexture& texture : material.textures)
    if (texture.field == kColor) texture.field = kDiffuse;
  material = withModel(std::move(material), Phong{});
  material.model = nearest;
  return material;
}

Material withoutFeatures(Material material, const EnumSet<SceneFeature>& off) {
  if (off.empty()) return material;
  const auto dropTexture = [&](std::string_view field) {
    std::erase_if(material.textures, [&](const FieldTexture& texture) {
      return texture.field == field || (field == kMedium && MediumModel::has(texture.field));
    });
  };
  if (isOff(kMedium, off)) {
    material.mediumDensity = 0;
    dropTexture(kMedium);
  }
  if (isOff(kBump, off)) {
    material.bump = 0;
    dropTexture(kBump);
  }
  if (isOff(kDisplacement, off)) {
    material.displacement = 0;
    dropTexture(kDisplacement);
  }
  if (isOff(kOpacity, off)) {
    material.opacity = 1;
    dropTexture(kOpacity);
  }
  if (isOff(kCastsShadow, off)) material.castsShadow = true;
  return isOff(material.model.keyword(), off) ? asPhong(std::move(material)) : material;
}

bool castsShadows(const LightLinks& light, const EnumSet<SceneFeature>& off) {
  return light.castsShadows || isOff(kCastsShadow, off);
}

std::optional<Light> lightWithout(const Light& light, const EnumSet<SceneFeature>& off) {
  Light point;
  if (light.type().starts != LightOrigin::ball || light.keyword() == point.keyword() ||
      !isOff(light.keyword(), off))
    return {};
  takeFields(point, light);
  if (const auto* measured = light.as<GoniometricLight>())
    if (measured->perCandela > 0 && measured->file.data)
      *editableValue<Color>(point, "color") *= Color(measured->perCandela * measured->file.data->brightest());
  return point;
}

}  // namespace trace
