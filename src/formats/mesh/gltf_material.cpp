#include "formats/mesh/gltf_material.h"

#include <algorithm>
#include <cmath>

namespace trace {

Phong toPhong(const MetallicRoughness& m) {
  const double polish = (1 - m.roughness) * (1 - m.roughness);
  const double alpha = m.roughness * m.roughness;  // of the distribution, by the specification
  Phong phong;
  phong.diffuse = m.baseColor * ((1 - m.metallic) * (1 - m.transmission) * m.alpha);
  // Metals have no diffuse light to give back; without some ambient light a rough one would be black.
  phong.ambient = m.baseColor * ((1 - m.transmission) * m.alpha);
  phong.specular = lerp(m.metallic, Color(0.2), m.baseColor) * polish;
  phong.reflective = lerp(m.metallic, Color(0.04), m.baseColor) * polish;
  phong.emissive = m.emissive;
  phong.shininess = std::clamp(alpha > 0 ? 2 / (alpha * alpha) - 2 : 10000.0, 1.0, 10000.0);
  phong.transmissive = m.baseColor * (m.transmission * (1 - m.metallic) * m.alpha) + Color(1 - m.alpha);
  phong.index = m.transmission > 0 ? m.index : 1;
  return phong;
}

}  // namespace trace
