// Sources: Khronos Group, glTF 2.0 Specification, section 3.9 and appendix B, and its extensions
// KHR_materials_unlit, _transmission, _volume, _dispersion, _clearcoat, _sheen, _anisotropy, _specular,
// _iridescence and _pbrSpecularGlossiness.
#include "formats/mesh/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/match.h"
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

// --- which model ------------------------------------------------------------------------------------

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
  return m.transmission == 0 && (needsPrincipled(m) || (textured && !hasHoles));
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
  model.iridescence = m.iridescence;
  model.iridescenceIndex = m.filmIndex;
  model.iridescenceThickness = m.filmMost;
  model.clearcoat = m.clearcoat;
  model.clearcoatRoughness = m.clearcoatRoughness;
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
    model.ambient = m.baseColor;
    return model;
  }
  return toPhong(m);
}

// --- its textures -----------------------------------------------------------------------------------

class Painted {
 public:
  Painted(std::string name, const MetallicRoughness& m) : m_(m), material_{std::move(name), modelOf(m), {}} {}

  Material material() {
    if (m_.unlit)
      put(kEmissive, m_.baseColorMap);
    else
      paintLit();
    paintHoles();
    return std::move(material_);
  }

 private:
  Phong* phong() { return std::get_if<Phong>(&material_.model); }
  bool isPrincipled() const { return std::holds_alternative<Principled>(material_.model); }
  bool isGlass() const {
    return std::holds_alternative<RoughGlass>(material_.model) ||
           std::holds_alternative<ThinGlass>(material_.model);
  }

  void put(std::string_view field, const Texture& texture) { setTexture(material_.textures, field, texture); }
  void put(std::string_view field, const std::optional<ImageMap>& map) {
    if (map) put(field, Texture(TextureNode{.model = *map}));
  }
  void put(std::string_view field, const std::optional<ImageMap>& map, Channel channel) {
    if (map) put(field, channelOf(*map, channel));
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
    if (std::holds_alternative<RoughGlass>(material_.model))
      put("roughness", m_.metallicRoughnessMap, Channel::green);
    if (isPrincipled()) paintPrincipled();
    if (m_.normalMap) {
      ImageMap normals = *m_.normalMap;
      normals.relief = Relief::normals;
      put("bump", TextureNode{.model = std::move(normals)});
      material_.bump = m_.normalScale;
    }
  }

  void paintPhong(const Texture& base) {
    put(kDiffuse, base);
    textureMirror(material_, "specular", phong()->specular, Color(0.2), m_, base);
    textureMirror(material_, "reflective", phong()->reflective, Color(0.04), m_, base);
    if (m_.transmission > 0 && evenOpacity(m_) == 1) put("transmissive", base);
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
    phong()->diffuse = m_.baseColor * ((1 - m_.metallic) * evenOpacity(m_));
    phong()->ambient = m_.baseColor * evenOpacity(m_);
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
    put("sheen", m_.sheenMap);
    put("sheen_roughness", m_.sheenRoughnessMap, Channel::alpha);
    put("specular_strength", m_.specularMap, Channel::alpha);
    put("specular_color", m_.specularColorMap);
    if (!m_.glossyMap) return;
    put("specular_color", m_.glossyMap);
    TextureNode roughness{.model = Mix{.a = Color(1), .b = Color(m_.roughness), .amount = 1}};
    setTexture(roughness.inputs, "amount", channelOf(*m_.glossyMap, Channel::alpha));
    put("roughness", Texture(std::move(roughness)));
    std::get<Principled>(material_.model).roughness = 1;
  }

  /// Phong's model lets light through in the way that older formats have.
  void paintHoles() {
    if (!phong()) material_.opacity = evenOpacity(m_);
    if (!m_.hasAlphaMap) return;
    const bool blends = m_.alpha == Alpha::blend;
    const Texture alpha = channelOf(*m_.baseColorMap, Channel::alpha);
    const Texture opacity = blends ? alpha
                                   : threshold(alpha, m_.opacity > 0  ? m_.cutoff / m_.opacity
                                                      : m_.cutoff > 0 ? 2
                                                                      : 0);
    const Real share = blends ? m_.opacity : 1;
    if (phong()) return cutOut(material_, opacity, share);
    put(kOpacity, opacity);
    material_.opacity = share;
  }

  const MetallicRoughness& m_;
  Material material_;
};

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
  phong.index = m.transmission > 0 && m.solid ? m.index : 1;
  if (m.transmission > 0) fill(phong, m);
  return phong;
}

Material toMaterial(std::string name, const MetallicRoughness& m) {
  return Painted(std::move(name), m).material();
}

Color baseColorOf(const Material& material) {
  if (const auto* phong = std::get_if<Phong>(&material.model)) return phong->diffuse;
  return match(material.model, [](const auto& said) {
    if constexpr (requires { said.color; })
      return said.color;
    else
      return said.emissive;
  });
}

}  // namespace trace
