#include "app/compare/scene_variants.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "geometry/mesh/mesh.h"
#include "math/elementary.h"
#include "render/rays/ray_tree.h"
#include "scene/conventions.h"
#include "scene/scene_features.h"

namespace trace {
namespace {

constexpr std::size_t kMostLights = 8, kMostObjects = 16;  // that are left out one by one
constexpr int kMostDepth = 10;                             // the deepest of those that are tried one by one

/// Gives the fields of that name and type the value, in all materials.
template <class Value>
void setFields(Scene& scene, std::string_view keyword, const Value& value) {
  for (Material& material : scene.materials)
    editEachField(material.model, [&](const auto& field, auto& held) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, Value>)
        if (field.keyword == keyword) held = value;
    });
}

/// Lets materials that mirror by their `specular` say so by their `reflective`.
void sayReflective(Scene& scene, const Settings& settings) {
  for (Material& material : scene.materials)
    if (Phong* phong = material.model.edit<Phong>(); phong && phong->mirrorsSpecular) {
      if (settings.mirrorDefault == MirrorDefault::specular) phong->reflective = phong->specular;
      phong->mirrorsSpecular = false;
    }
}

/// index = change(index), where a material refracts.
void changeIndices(Scene& scene, const std::function<Real(Real)>& change) {
  for (Material& material : scene.materials)
    editEachField(material.model, [&](const auto& field, auto& held) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, Real>)
        if (field.keyword == "index" && held > 0) held = change(held);
    });
}

void changeLights(Scene& scene, const std::function<void(Light&)>& change) {
  for (LightSource& source : scene.lights) change(source.light);
}

/// change(data) of all meshes, each data once.
void changeMeshes(Scene& scene, const std::function<void(MeshData&)>& change) {
  std::map<const MeshData*, std::shared_ptr<const MeshData>> changed;
  for (Object& object : scene.objects) {
    const Mesh* mesh = object.shape.as<Mesh>();
    if (!mesh) continue;
    std::shared_ptr<const MeshData>& made = changed[mesh->data.get()];
    if (!made) {
      MeshData data = *mesh->data;
      change(data);
      made = std::make_shared<const MeshData>(std::move(data));
    }
    object.shape = Mesh{made};
  }
}

void dropVertexNormals(MeshData& mesh) {
  mesh.normals.clear();
  mesh.generateNormals = false;
}

void invertNormals(MeshData& mesh) {
  for (Vec3f& normal : mesh.normals) normal = {-normal.x, -normal.y, -normal.z};
  for (MeshTangent& tangent : mesh.tangents) tangent.side = -tangent.side;
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

/// Mirrors the textures that lie in u and v.
void mirrorTextures(Scene& scene, Real Vec3::*axis) {
  for (Material& material : scene.materials)
    for (FieldTexture& texture : material.textures) {
      if (!wantsUv(texture.texture)) continue;
      TextureNode node = *texture.texture;
      node.placement.scale.*axis = -(node.placement.scale.*axis);
      node.placement.translate.*axis = 1 - node.placement.translate.*axis;
      texture.texture = Texture(std::move(node));
    }
}

Real scaledFov(Real degrees, Real factor) {
  return 2 * math::atan(math::tan(degrees * kPi / 360) * factor) * 180 / kPi;
}

class Variants {
 public:
  Variants(const Scene& scene, const Settings& settings) : scene_(scene), settings_(settings) {}

  std::vector<SceneVariant> all() {
    missingTerms();
    lightsAndObjects();
    conventionOptions();
    tracing();
    for (const Convention& row : conventions()) option("like", std::string(row.name));
    signsAndFactors();
    camera();
    return std::move(all_);
  }

 private:
  void edit(std::string text, std::function<void(Scene&)> apply) {
    Scene edited = scene_;
    apply(edited);
    if (!(edited == scene_))
      all_.push_back(
          {std::move(text), [apply = std::move(apply)](Scene& scene, Settings&) { apply(scene); }});
  }
  void set(std::string text, std::function<void(Settings&)> apply, bool isOption = false) {
    Settings changed = settings_;
    apply(changed);
    if (!(changed == settings_))
      all_.push_back({std::move(text),
                      [apply = std::move(apply)](Scene&, Settings& settings) { apply(settings); }, isOption});
  }

  /// The option with another value, as on the command line.
  void option(std::string_view name, const std::string& value) {
    const std::vector<Choice> layer{{std::string(name), value, {}}};
    set(
        "with --" + std::string(name) + " " + value,
        [layer](Settings& settings) {
          if (layer[0].option != "like") return findOption(layer[0].option).assign(settings, layer[0].value);
          const Settings given = resolve({layer});
          for (const Option& row : options())
            if (isConvention(row)) row.assign(settings, row.get(given));
        },
        true);
  }

  /// Each option of the group alone: its names, or the values that conventions give it.
  void conventionOptions() {
    for (const Option& row : options()) {
      if (!isConvention(row)) continue;
      std::vector<std::string> values(row.choices.begin(), row.choices.end());
      if (row.kind == Option::Kind::boolean) values = {"on", "off"};
      if (values.empty())
        for (const Convention& convention : conventions()) values.push_back(row.get(convention.settings));
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
      for (const std::string& value : values) option(row.name, value);
    }
  }

  /// Terms of the equation that are missing.
  void missingTerms() {
    const Settings& s = settings_;
    edit("without shadows", [](Scene& scene) { setFields<Real>(scene, "shadow", 0); });
    edit("without reflections", [](Scene& scene) {
      sayReflective(scene, {.mirrorDefault = MirrorDefault::zero});
      setFields(scene, "reflective", Color(0));
    });
    edit("without refraction", [](Scene& scene) { setFields(scene, "transmissive", Color(0)); });
    edit("without highlights", [s](Scene& scene) {
      sayReflective(scene, s);
      setFields(scene, "specular", Color(0));
    });
    set("without ambient light", [](Settings& settings) { settings.ambientScale = 0; });
    edit("without diffuse light", [](Scene& scene) { setFields(scene, "diffuse", Color(0)); });
    edit("without emission", [](Scene& scene) { setFields(scene, "emissive", Color(0)); });
    for (const std::string_view power : {"linear", "quadratic"})
      edit("without the " + std::string(power) + " attenuation of lights", [power](Scene& scene) {
        changeLights(scene, [&](Light& light) {
          if (Real* factor = editableValue<Real>(light, std::string(power) + "_attenuation_coeff"))
            *factor = 0;
        });
      });
    edit("without attenuation by distance", [](Scene& scene) {
      changeLights(scene, [](Light& light) {
        if (light.type().starts != LightOrigin::ball) return;
        *editableValue<Real>(light, "constant_attenuation_coeff") = 1;
        *editableValue<Real>(light, "linear_attenuation_coeff") = 0;
        *editableValue<Real>(light, "quadratic_attenuation_coeff") = 0;
      });
    });
    edit("with a black background", [](Scene& scene) { scene.background = {}; });
    option("textures", "off");
  }

  /// Signs and factors that are wrong.
  void signsAndFactors() {
    const Settings& s = settings_;
    edit("with glass that does not bend light",
         [s](Scene& scene) { changeIndices(scene, [&](Real) { return s.airIndex; }); });
    edit("with the ratio of the indices of refraction inverted", [s](Scene& scene) {
      changeIndices(scene, [&](Real index) { return s.airIndex * s.airIndex / index; });
    });
    edit("with directional lights from the opposite side", [](Scene& scene) {
      changeLights(scene, [](Light& light) {
        if (light.type().starts != LightOrigin::parallel) return;
        Vec3& direction = *editableValue<Vec3>(light, "direction");
        direction = -direction;
      });
    });
    edit("with flat triangles, without the normals of their corners",
         [](Scene& scene) { changeMeshes(scene, dropVertexNormals); });
    edit("with the normals of meshes inverted", [](Scene& scene) { changeMeshes(scene, invertNormals); });
    edit("with textures upside down", [](Scene& scene) { mirrorTextures(scene, &Vec3::y); });
    edit("with textures mirrored left to right", [](Scene& scene) { mirrorTextures(scene, &Vec3::x); });
  }

  void tracing() {
    const int depth = settings_.depth;
    for (int other = 0; other <= kMostDepth; ++other) option("depth", std::to_string(other));
    for (const int other : {depth - 1, depth + 1})
      if (other > kMostDepth && other <= 1000) option("depth", std::to_string(other));
    option("models", "phong");
    for (const Option& row : options())
      if (row.extra && row.concerns(settings_)) option(row.name, row.get(Settings{}));
    for (std::size_t i = 0; i < sceneFeatures().size(); ++i) withoutFeature(static_cast<SceneFeature>(i));
    for (std::size_t i = 0; i < shapeTypes().size(); ++i) {
      const auto isOfKind = [&](const Object& object) { return object.shape.type().index == i; };
      if (std::any_of(scene_.objects.begin(), scene_.objects.end(), isOfKind))
        set(
            "with --omit " + std::string(shapeTypes()[i].keyword),
            [i](Settings& settings) { settings.omit.add(static_cast<ShapeKind>(i)); }, true);
    }
  }

  void withoutFeature(SceneFeature feature) {
    if (hasFeature(scene_, feature))
      set(
          "with --without " + std::string(sceneFeatureNames()[static_cast<std::size_t>(feature)]),
          [feature](Settings& settings) { settings.switchedOff.add(feature); }, true);
  }

  void camera() {
    option("projection", "orthographic");
    const auto fov = [&](const std::string& text, Real degrees) {
      if (degrees > 0 && degrees < 180) edit(text, [degrees](Scene& scene) { scene.camera.fov = degrees; });
    };
    const Camera& camera = scene_.camera;
    fov("with the vertical field of view taken as the horizontal one",
        scaledFov(camera.fov, 1 / camera.aspectratio));
    fov("with half the field of view", camera.fov / 2);
    fov("with twice the field of view", camera.fov * 2);
    edit("with a square window in place of one of the picture's aspect ratio",
         [](Scene& scene) { scene.camera.aspectratio = 1; });
  }

  void lightsAndObjects() {
    for (std::uint32_t i = 0; i < scene_.lights.size() && scene_.lights.size() <= kMostLights; ++i)
      edit("without the light " + lightName(scene_, i),
           [i](Scene& scene) { scene.lights.erase(scene.lights.begin() + i); });
    for (std::uint32_t i = 0; i < scene_.objects.size() && scene_.objects.size() <= kMostObjects; ++i)
      edit("without the object " + objectName(scene_, i),
           [i](Scene& scene) { scene.objects.erase(scene.objects.begin() + i); });
  }

  const Scene& scene_;
  const Settings& settings_;
  std::vector<SceneVariant> all_;
};

}  // namespace

std::vector<SceneVariant> variantsOf(const Scene& scene, const Settings& settings) {
  return Variants(scene, settings).all();
}

}  // namespace trace
