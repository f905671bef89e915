// Source: Khronos Group, glTF 2.0 Specification, section 3.9.
#include "formats/mesh/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/model_textures.h"

namespace trace {
namespace {

using Alpha = MetallicRoughness::Alpha;

/// The opacity of all of the surface; 1 where a picture has it.
double evenOpacity(const MetallicRoughness& m) {
  if (m.alpha == Alpha::opaque || m.hasAlphaMap) return 1;
  return m.alpha == Alpha::blend ? m.opacity : m.opacity >= m.cutoff;
}

double polishOf(const MetallicRoughness& m) { return (1 - m.roughness) * (1 - m.roughness); }

Texture channelOf(ImageMap map, Channel channel) {
  map.srgb = false;
  map.channel = channel;
  return TextureNode{.model = std::move(map)};
}

/// What is mirrored where the base colour is textured: that of metals is their colour.
void textureMirror(Material& material, std::string_view field, Color& constant, const Color& plastic,
                   const MetallicRoughness& m, const Texture& base) {
  if (m.metallic == 0 || isBlack(constant)) return;
  const double polish = polishOf(m);
  TextureNode node{.model = Mix{.a = plastic * polish, .b = m.baseColor * polish, .amount = m.metallic}};
  setTexture(node.inputs, "b", base);
  setTexture(material.textures, field, std::move(node));
  constant = Color(1);
}

Principled toPrincipled(const MetallicRoughness& m) {
  Principled model;
  model.color = model.ambient = m.baseColor;
  model.emissive = m.emissive;
  model.metallic = m.metallic;
  model.roughness = m.roughness;
  model.index = m.index;
  model.iridescence = m.iridescence;
  model.iridescenceIndex = m.filmIndex;
  model.iridescenceThickness = m.filmMost;
  return model;
}

}  // namespace

Phong toPhong(const MetallicRoughness& m) {
  const double polish = polishOf(m), opacity = evenOpacity(m);
  const double alpha = m.roughness * m.roughness;  // of the distribution, by the specification
  Phong phong;
  phong.diffuse = m.baseColor * ((1 - m.metallic) * (1 - m.transmission) * opacity);
  // Metals have no diffuse light to give back; without some ambient light a rough one would be black.
  phong.ambient = m.baseColor * ((1 - m.transmission) * opacity);
  phong.specular = lerp(m.metallic, Color(0.2), m.baseColor) * polish;
  phong.reflective = lerp(m.metallic, Color(0.04), m.baseColor) * polish;
  phong.emissive = m.emissive;
  phong.shininess = std::clamp(alpha > 0 ? 2 / (alpha * alpha) - 2 : 10000.0, 1.0, 10000.0);
  phong.transmissive = m.baseColor * (m.transmission * (1 - m.metallic) * opacity) + Color(1 - opacity);
  phong.index = m.transmission > 0 ? m.index : 1;
  return phong;
}

Material toMaterial(std::string name, const MetallicRoughness& m) {
  const bool textured = m.baseColorMap || m.metallicRoughnessMap || m.emissiveMap || m.occlusionMap;
  const bool hasHoles = m.hasAlphaMap || evenOpacity(m) < 1;
  const bool needed = m.metallicRoughnessMap || m.iridescence > 0;
  const bool principled = m.transmission == 0 && (needed || (textured && !hasHoles));
  Material material{std::move(name), {}, {}};
  const auto put = [&](std::string_view field, const Texture& texture) {
    setTexture(material.textures, field, texture);
  };
  if (principled) {
    material.model = toPrincipled(m);
    material.opacity = evenOpacity(m);
  } else {
    material.model = toPhong(m);
  }

  if (m.emissiveMap) put(kEmissive, TextureNode{.model = *m.emissiveMap});
  std::optional<Texture> ambient;
  if (m.baseColorMap) {
    const Texture base = TextureNode{.model = *m.baseColorMap};
    ambient = base;
    if (auto* phong = std::get_if<Phong>(&material.model)) {
      put(kDiffuse, base);
      textureMirror(material, "specular", phong->specular, Color(0.2), m, base);
      textureMirror(material, "reflective", phong->reflective, Color(0.04), m, base);
      if (m.transmission > 0 && evenOpacity(m) == 1) put("transmissive", base);
    } else {
      put(kColor, base);
    }
  }
  if (m.occlusionMap) {
    Texture open = channelOf(*m.occlusionMap, Channel::red);
    if (m.occlusionStrength < 1) open = raised(open, 1 - m.occlusionStrength);
    ambient = ambient ? product(*ambient, open) : open;
  }
  if (ambient) put(kAmbient, *ambient);
  if (m.metallicRoughnessMap && principled) {
    put("metallic", channelOf(*m.metallicRoughnessMap, Channel::blue));
    put("roughness", channelOf(*m.metallicRoughnessMap, Channel::green));
  }
  if (m.iridescenceMap && principled) put("iridescence", channelOf(*m.iridescenceMap, Channel::red));
  if (m.filmMap && principled && m.filmMost > 0)
    put("iridescence_thickness", raised(channelOf(*m.filmMap, Channel::green), m.filmLeast / m.filmMost));
  if (m.normalMap) {
    ImageMap normals = *m.normalMap;
    normals.relief = Relief::normals;
    put("bump", TextureNode{.model = std::move(normals)});
    material.bump = m.normalScale;
  }
  if (m.hasAlphaMap) {
    const bool blends = m.alpha == Alpha::blend;
    const Texture alpha = channelOf(*m.baseColorMap, Channel::alpha);
    const Texture opacity = blends ? alpha
                                   : threshold(alpha, m.opacity > 0  ? m.cutoff / m.opacity
                                                      : m.cutoff > 0 ? 2
                                                                     : 0);
    const Real share = blends ? m.opacity : 1;
    if (principled) {
      put(kOpacity, opacity);
      material.opacity = share;
    } else {
      cutOut(material, opacity, share);
    }
  }
  return material;
}

}  // namespace trace
