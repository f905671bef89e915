// Metallic-roughness materials as Phong materials.
#pragma once

#include "math/color.h"
#include "shading/materials/phong.h"

namespace trace {

/// The numbers of a glTF material that Trace uses, with the defaults of the specification.
struct MetallicRoughness {
  Color baseColor{1}, emissive;
  double alpha = 1;  ///< of the base colour, where the material is blended
  double metallic = 1, roughness = 1;
  double transmission = 0, index = 1.5;
};

/// The nearest Phong material:
///   diffuse, ambient   base colour (1 - metallic)(1 - transmission) alpha
///   specular           (1 - roughness)^2 of the base colour for metals, of a fifth for others
///   shininess          2 / roughness^4 - 2, from 1 to 10000: the exponent whose lobe is as wide as that of
///                      a Beckmann distribution of roughness^2 (Walter et al. 2007, section 5.2)
///   reflective         (1 - roughness)^2 of the base colour for metals, of 0.04 for others
///   transmissive       base colour x transmission, and 1 - alpha
Phong toPhong(const MetallicRoughness& material);

}  // namespace trace
