// Sources: Khronos Group, glTF 2.0 Specification, section 3.9 and appendix B, and its extensions
// KHR_materials_unlit, _transmission, _volume, _dispersion, _clearcoat, _sheen, _anisotropy, _specular,
// _iridescence and _pbrSpecularGlossiness.
#include "formats/mesh/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/match.h"
#include "formats/mesh/gltf/gltf_model.h"
#include "formats/model_textures.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/materials/thin_glass.h"
#include "shading/textures/image_map.h"
#include "shading/textures/mix.h"

namespace trace {
namespace {

using Alpha = MetallicRoughness::Alpha;

Texture channelOf(ImageMap map, Channel channel) {
  map.srgb = false;
  map.channel = channel;
  return TextureNode{.model = std::move(map)};
}

/// The reflectance where the base colour is textured: that of metals is their colour.
void textureMirror(Material& material, std::string_view field, Color& constant, const Color& plastic,
                   const MetallicRoughness& m, const Texture& base) {
  if (m.metallic == 0 || isBlack(constant)) return;
  const double polish = polishOf(m);
  TextureNode node{.model = Mix{.a = plastic * polish, .b = m.baseColor * polish, .amount = m.metallic}};
  setTexture(node.inputs, "b", base);
  setTexture(material.textures, field, std::move(node));
  constant = Color(1);
}

// --- its textures -----------------------------------------------------------------------------------

class Painted {
 public:
  Painted(std::string name, const MetallicRoughness& m) : m_(m), material_{std::move(name), modelOf(m), {}} {
    if (m.doubleSided) material_.sides = ShadedSides::both;
  }

  Material material() {
    if (m_.unlit)
      put(kEmissive, m_.baseColorMap);
    else
      paintLit();
    paintHoles();
    return std::move(material_);
  }

 private:
  Phong* phong() { return material_.model.edit<Phong>(); }
  bool isPrincipled() const { return material_.model.is<Principled>(); }
  bool isGlass() const { return material_.model.is<RoughGlass>() || material_.model.is<ThinGlass>(); }

  void put(std::string_view field, const Texture& texture) { setTexture(material_.textures, field, texture); }
  void put(std::string_view field, const std::optional<ImageMap>& map) {
    if (map) put(field, Texture(TextureNode{.model = *map}));
  }
  void put(std::string_view field, const std::optional<ImageMap>& map, Channel channel) {
    if (map) put(field, channelOf(*map, channel));
  }

  void putNormals(std::string_view field, std::optional<ImageMap> map) {
    if (map) map->relief = Relief::normals;
    put(field, map);
  }

  void paintLit() {
    put(kEmissive, m_.emissiveMap);
    std::optional<Texture> ambient;
    if (m_.baseColorMap) {
      const Texture base = TextureNode{.model = *m_.baseColorMap};
      if (!isGlass()) ambient = base;
      if (phong())
        paintPhong(base);
      else
        put(kColor, base);
    }
    if (m_.transmissionMap && phong()) paintPassage();
    if (m_.occlusionMap && !isGlass()) {
      Texture open = channelOf(*m_.occlusionMap, Channel::red);
      if (m_.occlusionStrength < 1) open = raised(open, 1 - m_.occlusionStrength);
      ambient = ambient ? product(*ambient, open) : open;
    }
    if (ambient) put(kAmbient, *ambient);
    if (material_.model.is<RoughGlass>()) put("roughness", m_.metallicRoughnessMap, Channel::green);
    if (isPrincipled()) paintPrincipled();
    putNormals("bump", m_.normalMap);
    if (m_.normalMap) material_.bump = m_.normalScale;
  }

  void paintPhong(const Texture& base) {
    put(kDiffuse, base);
    textureMirror(material_, "specular", phong()->specular, Color(0.2), m_, base);
    textureMirror(material_, "reflective", phong()->reflective, Color(0.04), m_, base);
    if (m_.transmission > 0) put("transmissive", base);
  }

  /// As much less is scattered as passes.
  void paintPassage() {
    const Texture passes = channelOf(*m_.transmissionMap, Channel::red);
    for (const std::string_view field : {kDiffuse, kAmbient}) {
      TextureNode node{.model = Mix{.a = Color(1), .b = Color(1 - m_.transmission), .amount = 1}};
      if (m_.baseColorMap)
        for (const char* part : {"a", "b"})
          setTexture(node.inputs, part, TextureNode{.model = *m_.baseColorMap});
      setTexture(node.inputs, "amount", passes);
      put(field, Texture(std::move(node)));
    }
    phong()->diffuse = m_.baseColor * (1 - m_.metallic);
    phong()->ambient = m_.baseColor;
    const Texture* base = textureOf(material_.textures, "transmissive");
    put("transmissive", base ? product(*base, passes) : passes);
  }

  void paintPrincipled() {
    put("metallic", m_.metallicRoughnessMap, Channel::blue);
    put("roughness", m_.metallicRoughnessMap, Channel::green);
    put("iridescence", m_.iridescenceMap, Channel::red);
    if (m_.filmMap && m_.filmMost > 0)
      put("iridescence_thickness",
          raised(channelOf(*m_.filmMap, Channel::green), m_.filmLeast / m_.filmMost));
    put("clearcoat", m_.clearcoatMap, Channel::red);
    put("clearcoat_roughness", m_.clearcoatRoughnessMap, Channel::green);
    putNormals("clearcoat_bump", m_.clearcoatNormalMap);
    put("transmission", m_.transmissionMap, Channel::red);
    put("sheen", m_.sheenMap);
    put("sheen_roughness", m_.sheenRoughnessMap, Channel::alpha);
    put("specular_strength", m_.specularMap, Channel::alpha);
    put("specular_color", m_.specularColorMap);
    if (!m_.glossyMap) return;
    put("specular_color", m_.glossyMap);
    TextureNode roughness{.model = Mix{.a = Color(1), .b = Color(m_.roughness), .amount = 1}};
    setTexture(roughness.inputs, "amount", channelOf(*m_.glossyMap, Channel::alpha));
    put("roughness", Texture(std::move(roughness)));
    material_.model.edit<Principled>()->roughness = 1;
  }

  void paintHoles() {
    material_.opacity = evenOpacity(m_);
    if (!m_.hasAlphaMap) return;
    const bool blends = m_.alpha == Alpha::blend;
    const Texture alpha = channelOf(*m_.baseColorMap, Channel::alpha);
    const Texture opacity = blends ? alpha
                                   : threshold(alpha, m_.opacity > 0  ? m_.cutoff / m_.opacity
                                                      : m_.cutoff > 0 ? 2
                                                                      : 0);
    cutOut(material_, opacity, blends ? m_.opacity : 1);
  }

  const MetallicRoughness& m_;
  Material material_;
};

}  // namespace

Material toMaterial(std::string name, const MetallicRoughness& m) {
  return Painted(std::move(name), m).material();
}

Color baseColorOf(const Material& material) {
  if (const auto* phong = material.model.as<Phong>()) return phong->diffuse;
  Color emissive;
  std::optional<Color> color;
  forEachField(material.model, [&]<class Value>(const ModelField& field, const Value& value) {
    if constexpr (std::is_same_v<Value, Color>) {
      if (field.keyword == kColor) color = value;
      if (field.keyword == kEmissive) emissive = value;
    }
  });
  return color.value_or(emissive);
}

}  // namespace trace
