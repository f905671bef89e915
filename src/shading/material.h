// THE list of material models, and a material as a scene keeps it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "base/match.h"
#include "shading/materials/phong.h"
#include "shading/texture.h"

namespace trace {

using MaterialModel = std::variant<Phong>;

struct Material {
  static constexpr std::string_view kKeyword = "material";

  std::string name;
  MaterialModel model;
  std::vector<FieldTexture> textures{};  ///< of its model's fields, and of its own
  Real bump = 0;                         ///< its texture bends the normal for shading

  /// What a material has whatever its model.
  static constexpr auto fields() {
    return std::tuple{Field{"bump", &Material::bump, "units of the object", -kNoLimit, kNoLimit,
                            "how high the surface seems to stand where the texture that it scales is white"}};
  }
  bool operator==(const Material&) const = default;
};

/// Changes every picture of the material's textures: change(Pixels&).
template <class Change>
void changePixels(Material& material, const Change& change) {
  for (FieldTexture& t : material.textures) t.texture = withPixels(t.texture, change);
}

/// As Phong's model says it, for formats and checks that know no other: its own values, or the nearest to
/// them.
inline Phong phongOf(const Material& material) {
  return match(material.model, [](const auto& model) -> Phong { return model.asPhong(); });
}

inline bool glows(const Material& material) { return !isBlack(phongOf(material).emissive); }

/// Its name, or "material 3" for the third of a scene.
inline std::string nameOf(const Material& material, std::size_t index) {
  return material.name.empty() ? "material " + std::to_string(index + 1) : material.name;
}

}  // namespace trace
