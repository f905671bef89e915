// Metallic-roughness materials as those of Trace.
#pragma once

#include <optional>
#include <string>

#include "math/color.h"
#include "shading/material.h"

namespace trace {

/// What of a glTF material Trace uses, with the defaults of the specification.
struct MetallicRoughness {
  enum class Alpha { opaque, mask, blend };

  Color baseColor{1}, emissive;
  double opacity = 1;  ///< alpha of the base colour
  Alpha alpha = Alpha::opaque;
  double cutoff = 0.5;  ///< of a mask
  double metallic = 1, roughness = 1;
  double transmission = 0, index = 1.5;
  double iridescence = 0, filmIndex = 1.3;
  double filmLeast = 100, filmMost = 400;  ///< thickness in nanometres, where its map is black and white

  // Each is multiplied by its number above; colours are decoded.
  std::optional<ImageMap> baseColorMap, metallicRoughnessMap, emissiveMap, occlusionMap, normalMap,
      iridescenceMap, filmMap;
  double normalScale = 1;
  double occlusionStrength = 1;
  bool hasAlphaMap = false;  ///< the alpha of baseColorMap counts
};

/// The nearest Phong material, without the textures:
///   diffuse, ambient   base colour (1 - metallic)(1 - transmission) alpha
///   specular           (1 - roughness)^2 of the base colour for metals, of a fifth for others
///   shininess          2 / roughness^4 - 2, from 1 to 10000: the exponent whose lobe is as wide as that of
///                      a Beckmann distribution of roughness^2 (Walter et al. 2007, section 5.2)
///   reflective         (1 - roughness)^2 of the base colour for metals, of 0.04 for others
///   transmissive       base colour x transmission, and 1 - alpha
Phong toPhong(const MetallicRoughness& material);

/// Phong where it has no texture, or something is seen through it; otherwise principled, as is what has a
/// metallicRoughnessMap or iridesces, for which Phong's model has no place, unless it refracts.
Material toMaterial(std::string name, const MetallicRoughness& material);

}  // namespace trace
