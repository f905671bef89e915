// Which model a glTF material becomes. Sources: Khronos Group, glTF 2.0 Specification, section 3.9 and
// appendix B, and its extensions.
#include "formats/mesh/gltf/gltf_model.h"

#include <algorithm>
#include <cmath>

#include "shading/materials/lambert.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/materials/thin_glass.h"

namespace trace {

double evenOpacity(const MetallicRoughness& m) {
  using Cover = MetallicRoughness::Alpha;
  if (m.alpha == Cover::opaque || m.hasAlphaMap) return 1;
  return m.alpha == Cover::blend ? m.opacity : m.opacity >= m.cutoff;
}

double polishOf(const MetallicRoughness& m) { return (1 - m.roughness) * (1 - m.roughness); }

namespace {

bool passesAll(const MetallicRoughness& m) {
  return m.transmission == 1 && m.metallic == 0 && !m.transmissionMap && !m.unlit;
}
/// Only the principled model has a place for it.
bool needsPrincipled(const MetallicRoughness& m) {
  return m.metallicRoughnessMap || m.glossy || m.iridescence > 0 || m.clearcoat > 0 || !isBlack(m.sheen) ||
         m.anisotropy > 0 || m.specular < 1 || m.specularColor != Color(1) ||
         (m.paintsPoints && m.metallic > 0);
}
bool isPrincipled(const MetallicRoughness& m) {
  const bool textured = m.baseColorMap || m.emissiveMap || m.occlusionMap;
  const bool hasHoles = m.hasAlphaMap || evenOpacity(m) < 1;
  if (m.transmission > 0) return !m.solid && needsPrincipled(m);
  return needsPrincipled(m) || (textured && !hasHoles);
}

/// Trace draws the highlight out by the ratio of two widths whose geometric mean is that of its roughness
/// (Burley, section 5.4); the extension widens one of them.
void brush(Principled& model, const MetallicRoughness& m) {
  if (!(m.anisotropy > 0)) return;
  const double across = m.roughness * m.roughness,
               along = across + (1 - across) * m.anisotropy * m.anisotropy;
  model.roughness = std::sqrt(std::sqrt(across * along));
  model.anisotropy = std::min(1.0, (1 - across / along) / 0.9);
  model.angle = m.anisotropyAngle * 180 / kPi;
}

Principled toPrincipled(const MetallicRoughness& m) {
  Principled model;
  model.color = m.baseColor;
  model.metallic = m.metallic;
  model.roughness = m.roughness;
  model.index = m.index;
  model.transmission = m.transmission;
  model.iridescence = m.iridescence;
  model.iridescenceIndex = m.filmIndex;
  model.iridescenceThickness = m.filmMost;
  model.clearcoat = m.clearcoat;
  model.clearcoatRoughness = m.clearcoatRoughness;
  model.clearcoatApart = m.clearcoat > 0 && (m.normalMap || m.clearcoatNormalMap);
  if (m.clearcoatNormalMap) model.clearcoatBump = m.clearcoatNormalScale;
  model.sheen = m.sheen;
  model.sheenRoughness = m.sheenRoughness;
  model.specularStrength = m.specular;
  model.specularColor = m.specularColor;
  if (m.glossy) {  // as an index, and a tint of what that mirrors
    const double most = maxComponent(*m.glossy);
    model.index = indexMirroring(Color(most)).eta.g;
    model.specularColor = most > 0 ? *m.glossy * (1 / most) : Color(1);
  }
  brush(model, m);
  return model;
}

RoughGlass toGlass(const MetallicRoughness& m) {
  RoughGlass glass;
  glass.color = m.baseColor;
  glass.index = m.index;
  glass.roughness = m.roughness;
  return glass;
}

void fill(Interior& interior, const MetallicRoughness& m) {
  if (!m.solid) return;
  interior.abbe = m.abbe;
  if (!(m.attenuationDistance > 0)) return;
  interior.attenuationColor = m.attenuationColor;
  interior.attenuationDistance = m.attenuationDistance;
}

}  // namespace

MaterialModel modelOf(const MetallicRoughness& m) {
  const auto shining = [&](auto model) {
    model.emissive = m.emissive;
    return model;
  };
  if (m.unlit) {
    Lambert model;
    model.diffuse = Color();
    model.emissive = m.baseColor;
    return model;
  }
  if (passesAll(m) && m.solid) {
    RoughGlass glass = shining(toGlass(m));
    fill(glass, m);
    return glass;
  }
  if (passesAll(m) && m.roughness == 0 && !m.metallicRoughnessMap) {
    ThinGlass pane;
    pane.color = m.baseColor;
    pane.index = m.index;
    return shining(pane);
  }
  if (isPrincipled(m)) {
    Principled model = shining(toPrincipled(m));
    model.ambient = m.transmissionMap ? m.baseColor : m.baseColor * (1 - m.transmission);
    return model;
  }
  return toPhong(m);
}

Phong toPhong(const MetallicRoughness& m) {
  const double polish = polishOf(m);
  const double alpha = m.roughness * m.roughness;  // alpha of the distribution, by the specification
  Phong phong;
  phong.diffuse = m.baseColor * ((1 - m.metallic) * (1 - m.transmission));
  // Metals have no diffuse light to give back; without some ambient light a rough one would be black.
  phong.ambient = m.baseColor * (1 - m.transmission);
  phong.specular = lerp(m.metallic, Color(0.2), m.baseColor) * polish;
  phong.reflective = lerp(m.metallic, Color(0.04), m.baseColor) * polish;
  phong.emissive = m.emissive;
  phong.shininess = std::clamp(alpha > 0 ? 2 / (alpha * alpha) - 2 : 10000.0, 1.0, 10000.0);
  phong.transmissive = m.baseColor * (m.transmission * (1 - m.metallic));
  phong.index = m.transmission > 0 && m.solid ? m.index : 1;
  if (m.transmission > 0) fill(phong, m);
  return phong;
}

}  // namespace trace
