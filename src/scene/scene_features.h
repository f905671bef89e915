// THE table of the parts of a scene that can be switched off one by one: media, bumps, each shading model and
// each kind of light beyond those of the courses (the option switched-off, `--without NAME`).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "base/enum_set.h"
#include "scene/settings.h"
#include "shading/lights/light.h"
#include "shading/lights/light_links.h"
#include "shading/material.h"

namespace trace {

struct Scene;

struct SceneFeatureRow {
  std::string_view name;     ///< that of the light, of the shading model or of the field of materials
  std::string_view without;  ///< what takes its place, no full stop
  std::string_view scene;    ///< a file in scenes/ that shows it; "" for shading models
};

/// In the order of SceneFeature: fields of materials, lights, then all shading models but Phong's.
std::span<const SceneFeatureRow> sceneFeatures();
std::span<const std::string_view> sceneFeatureNames();

/// A material or a light of the scene has it.
bool hasFeature(const Scene& scene, SceneFeature feature);

/// The material without what is switched off: no medium, no bumps, no displacement, no holes; Phong's closest
/// approximation in place of a shading model.
Material withoutFeatures(Material material, const EnumSet<SceneFeature>& off);

/// Objects block the light.
bool castsShadows(const LightLinks& light, const EnumSet<SceneFeature>& off);

/// The point light that takes the place of a light that is switched off: its position, colour, size and
/// attenuation. None if it is not.
std::optional<Light> lightWithout(const Light& light, const EnumSet<SceneFeature>& off);

/// With Phong's closest approximation of its shading model.
Material asPhong(Material material);

}  // namespace trace
