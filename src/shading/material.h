// A material as a scene keeps it: a shading model of whatever type (material_list.h has the list), and what
// every material has besides.
#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/listed.h"
#include "shading/materials/phong.h"
#include "shading/texture.h"
#include "shading/textures/pattern.h"

namespace trace {

class Bsdf;

/// A field of a shading model and where its value lies.
struct ModelField : FieldValue<bool, int, Real, Color, ColorRamp> {};

/// A row of the table of shading models.
struct ModelType : ListedRow<ModelField> {
  bool reciprocal;   ///< light may go either way along a path (shading/scattering.h)
  bool keepsEnergy;  ///< no more light leaves than arrives
  Bsdf (*bsdf)(const void* model, const Rules& rules);
  /// At a place, with textures in place of fields.
  Bsdf (*bsdfAt)(const void* model, const std::vector<FieldTexture>& textures, const TexturePlace& place,
                 const Rules& rules);
  Phong (*asPhong)(const void* model);
};

std::span<const ModelType> modelTypes();
/// Null if no model has that keyword.
const ModelType* findModelType(std::string_view keyword);
std::vector<std::string_view> modelKeywords();
template <>
const ModelType& rowCalled<ModelType>(std::string_view keyword);

/// How a surface scatters light. Copies share their data.
class MaterialModel : public Listed<ModelType, ModelField> {
 public:
  using Listed::Listed;
  /// Phong's.
  MaterialModel() : Listed(modelTypes().front()) {}

 private:
  friend Bsdf bsdfOf(const MaterialModel& model, const Rules& rules);
  friend Bsdf bsdfAt(const MaterialModel& model, const std::vector<FieldTexture>& textures,
                     const TexturePlace& place, const Rules& rules);
  friend Phong phongOf(const MaterialModel& model);
};

/// Which sides of a surface reflect light. Of `front` the back is dark; `both` turns the normal to the
/// viewer's side first. It does not change the transmitted side: there the two sides differ.
enum class ShadedSides { front, both };
constexpr std::array<std::string_view, 2> names(ShadedSides) { return {"front", "both"}; }

/// The space that the patterns of a material lie in: with that of the object they move along.
enum class PatternSpace { object, world };
constexpr std::array<std::string_view, 2> names(PatternSpace) { return {"object", "world"}; }

struct Material {
  static constexpr std::string_view kKeyword = "material";

  std::string name;
  MaterialModel model;
  std::vector<FieldTexture> textures{};  ///< textures of its model's fields, and of its own
  Real bump = 0;                         ///< its texture bends the normal for shading
  Real opacity = 1;                      ///< share of the surface that is there
  ShadedSides sides = ShadedSides::front;
  bool castsShadow = true;  ///< off: light sampling passes it (render/rays/tracer.h)
  PatternSpace patternSpace = PatternSpace::object;
  Real displacement = 0;       ///< moves the points of meshes (scene/displacement.h)
  int displacementLevels = 0;  ///< / number of times each triangle is cut in four before
  // The medium inside (shading/medium.h).
  Real mediumDensity = 0;
  Color mediumScatters{1}, mediumAbsorbs{}, mediumGlows{};
  Real mediumForward = 0;

  /// The fields of a material whatever its model.
  static constexpr auto fields() {
    return Fields{Field{"bump", &Material::bump, "units of the object", -kNoLimit, kNoLimit,
                        "apparent height of the surface where its texture is white"},
                  Field{"opacity", &Material::opacity, "", 0, 1,
                        "coverage of the surface: light passes straight through the rest"},
                  Field{"sides", &Material::sides, "", -kNoLimit, kNoLimit,
                        "which sides of an opaque surface reflect light"},
                  Field{"casts_shadow", &Material::castsShadow, "", -kNoLimit, kNoLimit,
                        "off: rays to lights pass as if nothing were there"},
                  Field{"pattern_space", &Material::patternSpace, "", -kNoLimit, kNoLimit,
                        "object: patterns move with the object; world: objects share one block of stone"},
                  Field{"displacement", &Material::displacement, "units of the object", -kNoLimit, kNoLimit,
                        "how far the points of a mesh move along their normals; a texture of heights "
                        "scales it"},
                  Field{"displacement_levels", &Material::displacementLevels, "", 0, 10,
                        "number of subdivision levels before the points move"},
                  Field{"medium_density", &Material::mediumDensity, "per unit", 0, kNoLimit,
                        "density of the medium inside: smoke, cloud, flame, milk; 0: none. A texture is "
                        "clamped to 0 to 1"},
                  Field{"medium_scatters", &Material::mediumScatters, "", 0, kNoLimit,
                        "scattering coefficient per unit of length at density 1"},
                  Field{"medium_absorbs", &Material::mediumAbsorbs, "", 0, kNoLimit,
                        "absorption coefficient: soot, ink"},
                  Field{"medium_glows", &Material::mediumGlows, "", 0, kNoLimit, "emission: fire"},
                  Field{"medium_forward", &Material::mediumForward, "", -1, 1,
                        "mean cosine of the scattering angle; a cloud has 0.85, smoke 0.5"}};
  }
  bool operator==(const Material&) const = default;
};

/// Keywords of colours that models have in common: what a surface emits, its share of the ambient light,
/// and what it looks like, which is `color` where it is no diffuse reflectance.
inline constexpr std::string_view kEmissive = "emissive", kAmbient = "ambient", kDiffuse = "diffuse",
                                  kColor = "color";
/// The keywords that every material has, whatever its model.
inline constexpr std::string_view kOpacity = "opacity";
/// color = change(color) for those of the keywords that the model has.
void changeColors(MaterialModel& model, std::initializer_list<std::string_view> keywords,
                  const std::function<Color(const Color&)>& change);

/// Fields of the same keyword and type keep their values; the others get the defaults of model `to`.
MaterialModel converted(const MaterialModel& from, const MaterialModel& to);
/// The model of a material, whose textures stay where there still is a field for them.
Material withModel(Material material, const MaterialModel& to);

/// Changes every picture of the material's textures: change(Pixels&).
template <class Change>
void changePixels(Material& material, const Change& change) {
  for (FieldTexture& t : material.textures) t.texture = withPixels(t.texture, change);
}

/// As Phong's model says it, for formats and checks that know no other: its own values, or the nearest to
/// them.
Phong phongOf(const MaterialModel& model);
/// The Phong approximation of a material; one with holes transmits light.
Phong phongOf(const Material& material);
/// The Phong approximation for formats that have no holes: what a texture makes transparent in places is
/// opaque.
Phong phongWithoutTextures(const Material& material);

inline bool glows(const Material& material) { return !isBlack(phongOf(material).emissive); }

/// Its name, or "material 3" for the third of a scene.
inline std::string nameOf(const Material& material, std::size_t index) {
  return material.name.empty() ? "material " + std::to_string(index + 1) : material.name;
}

}  // namespace trace
