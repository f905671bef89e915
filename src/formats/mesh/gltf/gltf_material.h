// Materials of glTF as those of Trace.
#pragma once

#include <optional>
#include <string>

#include "math/color.h"
#include "shading/material.h"
#include "shading/textures/image_map.h"

namespace trace {

/// The parts of a glTF material that Trace uses, with the defaults of the specification.
struct MetallicRoughness {
  enum class Alpha { opaque, mask, blend };

  Color baseColor{1}, emissive;
  double opacity = 1;  ///< alpha of the base colour
  Alpha alpha = Alpha::opaque;
  double cutoff = 0.5;  ///< cutoff of a mask
  double metallic = 1, roughness = 1;
  std::optional<Color> glossy;  ///< what it mirrors, of KHR_materials_pbrSpecularGlossiness
  bool unlit = false;           ///< it shows its base colour in any light
  bool doubleSided = false;
  bool paintsPoints = false;  ///< some mesh has colours of points, which multiply the base colour

  // Transmission. A material that is not solid is a thin sheet, which does not refract.
  double transmission = 0, index = 1.5;
  bool solid = false;
  Color attenuationColor{1};
  double attenuationDistance = 0;  ///< 0: nothing is lost inside
  double abbe = 0;

  // Layers.
  double iridescence = 0, filmIndex = 1.3;
  double filmLeast = 100, filmMost = 400;  ///< thickness in nanometres, where its map is black and white
  double clearcoat = 0, clearcoatRoughness = 0;
  Color sheen;
  double sheenRoughness = 0;
  double anisotropy = 0, anisotropyAngle = 0;  ///< radians
  double specular = 1;
  Color specularColor{1};

  // Each is multiplied by its number above; colours are decoded.
  std::optional<ImageMap> baseColorMap, metallicRoughnessMap, glossyMap, emissiveMap, occlusionMap, normalMap,
      iridescenceMap, filmMap, clearcoatMap, clearcoatRoughnessMap, sheenMap, sheenRoughnessMap, specularMap,
      specularColorMap, transmissionMap, clearcoatNormalMap;
  double normalScale = 1, clearcoatNormalScale = 1;
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

/// Which model it becomes:
///   lambert       that only shines, where it is unlit
///   thin_glass    a smooth sheet through which all light passes
///   rough_glass   a body through which all light passes
///   principled    what has a texture, or needs one of its fields; it may be a sheet that light passes
///   phong         everything else
Material toMaterial(std::string name, const MetallicRoughness& material);

/// The colour by which colours of points are multiplied.
Color baseColorOf(const Material& material);

}  // namespace trace
