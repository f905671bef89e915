// Sources: the MTL material format of Wavefront's Advanced Visualizer, appendix B1, and the extension for
// physically based materials that exporters write.
#include "formats/mesh/obj_material.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "formats/model_textures.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

Color color(const tinyobj::real_t (&c)[3]) { return {c[0], c[1], c[2]}; }

/// Has it any of the statements that exporters of physically based materials write?
bool isPhysical(const tinyobj::material_t& mtl) {
  return mtl.roughness > 0 || mtl.metallic > 0 || mtl.sheen > 0 || mtl.clearcoat_thickness > 0 ||
         mtl.anisotropy > 0 || !mtl.roughness_texname.empty() || !mtl.metallic_texname.empty() ||
         !mtl.sheen_texname.empty();
}
/// Where only a picture says it, the number that it scales is 1.
Principled mtlPrincipled(const tinyobj::material_t& mtl) {
  const auto scaled = [](double number, const std::string& picture) {
    return number == 0 && !picture.empty() ? 1 : std::clamp(number, 0.0, 1.0);
  };
  Principled model;
  model.color = color(mtl.diffuse);
  model.ambient = color(mtl.ambient);
  model.emissive = color(mtl.emission);
  model.metallic = scaled(mtl.metallic, mtl.metallic_texname);
  model.roughness = scaled(mtl.roughness, mtl.roughness_texname);
  model.index = mtl.ior > 1 ? mtl.ior : 1.5;
  model.sheen = Color(scaled(mtl.sheen, mtl.sheen_texname));
  model.clearcoat = std::clamp<double>(mtl.clearcoat_thickness, 0, 1);
  model.clearcoatRoughness = std::clamp<double>(mtl.clearcoat_roughness, 0, 1);
  model.anisotropy = std::clamp<double>(mtl.anisotropy, 0, 1);
  model.angle = std::isfinite(mtl.anisotropy_rotation) ? 360 * mtl.anisotropy_rotation : 0;
  return model;
}

/// The glass that the statements describe, with the roughness that others add.
RoughGlass mtlGlass(const tinyobj::material_t& mtl) {
  RoughGlass glass;
  glass.color = color(mtl.transmittance);
  glass.emissive = color(mtl.emission);
  glass.index = mtl.ior > 1 ? mtl.ior : 1.5;
  glass.roughness = std::clamp<double>(mtl.roughness, 0, 1);
  return glass;
}

/// Illumination models: 1 has no highlight; from 3 on (but 8 and 9) rays are mirrored; 4, 6, 7, 9 are glass.
Material plainOf(const tinyobj::material_t& mtl) {
  const auto isOneOf = [&](std::initializer_list<int> models) {
    return std::find(models.begin(), models.end(), mtl.illum) != models.end();
  };
  Phong phong;
  phong.ambient = color(mtl.ambient);
  phong.diffuse = color(mtl.diffuse);
  phong.emissive = color(mtl.emission);
  phong.specular = mtl.illum == 1 ? Color() : color(mtl.specular);
  phong.reflective = isOneOf({3, 4, 5, 6, 7}) ? color(mtl.specular) : Color();
  phong.shininess = mtl.shininess;
  phong.index = mtl.ior > 0 ? mtl.ior : 1;
  // Exporters write Tf for opaque materials too: it counts only where something else says glass.
  const Color filter = isBlack(color(mtl.transmittance)) ? Color(1) : color(mtl.transmittance);
  const double opacity = std::clamp(static_cast<double>(mtl.dissolve), 0.0, 1.0);
  if (opacity < 1) {
    phong.transmissive = filter * (1 - opacity);
    phong.diffuse *= Color(opacity);
  } else if (isOneOf({4, 6, 7, 9}))
    phong.transmissive = color(mtl.transmittance);

  Material material{mtl.name, phong, {}};
  const bool metal = mtl.metallic > 0 || !mtl.metallic_texname.empty();
  if (isPhysical(mtl) && opacity == 1 && !metal && !isBlack(phong.transmissive)) {
    material.model = mtlGlass(mtl);
  } else if (isPhysical(mtl)) {
    material.model = mtlPrincipled(mtl);
    material.opacity = opacity;
  }
  return material;
}

/// The picture as the options of its statement place it. Decoded only where `-colorspace sRGB` says so.
ImageMap toMap(std::string file, const tinyobj::texture_option_t& option) {
  ImageMap map = modelPicture(std::move(file));
  const auto& s = option.scale;
  const auto& o = option.origin_offset;
  map.transform = {s[0], 0, o[0], 0, s[1], o[1]};
  for (Real& number : map.transform)
    if (!std::isfinite(number)) number = 0;
  if (option.clamp) map.wrapU = map.wrapV = Wrap::clamp;
  map.srgb = option.colorspace == "sRGB" || option.colorspace == "srgb";
  switch (option.imfchan) {
    case 'r': map.channel = Channel::red; break;
    case 'g': map.channel = Channel::green; break;
    case 'b': map.channel = Channel::blue; break;
    default: break;
  }
  return map;
}

/// A statement of a map: its keyword, and what it says.
struct MtlMap {
  std::string_view keyword;
  const std::string& picture;
  const tinyobj::texture_option_t& option;

  bool given() const { return !picture.empty(); }
};

/// Puts the pictures of an MTL material on one of Trace.
class MtlTextures {
 public:
  MtlTextures(const tinyobj::material_t& mtl, const MtlPictures& pictures, Material& material)
      : mtl_(mtl), pictures_(pictures), material_(material) {}

  void add() {
    const auto* phong = material_.model.as<Phong>();
    const Color ambient = phongOf(material_.model).ambient;
    put(phong ? kDiffuse : kColor, diffuse_);
    put("emissive", {"map_Ke", mtl_.emissive_texname, mtl_.emissive_texopt});
    if (phong) {
      put("specular", specular_);
      put("shininess", shininess_);
      if (!isBlack(phong->reflective)) put("reflective", specular_);
    } else if (material_.model.is<RoughGlass>()) {
      put("roughness", roughness_);
      for (const MtlMap& other : {sheen_, specular_, shininess_}) leaveOut(other);
    } else {
      put("metallic", {"map_Pm", mtl_.metallic_texname, mtl_.metallic_texopt});
      put("roughness", roughness_);
      put("sheen", sheen_);
      put("specular_color", specular_);
      leaveOut(shininess_);
    }
    // A painted surface is painted in the ambient light too.
    if (ambient_.given())
      put("ambient", ambient_);
    else if (!isBlack(ambient))
      put("ambient", diffuse_);
    addRelief();
    addHoles();
  }

 private:
  ImageMap pictureOf(const MtlMap& map) const {
    ImageMap made = toMap(pictures_.nameOf(map.picture), map.option);
    made.file.place = pictures_.placeOf(map.keyword, map.picture);
    return made;
  }
  void put(std::string_view field, const MtlMap& map) {
    if (map.given()) setTexture(material_.textures, field, TextureNode{.model = pictureOf(map)});
  }
  void leaveOut(const MtlMap& map) const {
    if (map.given()) pictures_.unused(map.keyword, map.picture);
  }

  /// Normals where they are given, or else the heights of `bump`, or else those of `disp`: exporters bake one
  /// from the other.
  void addRelief() {
    const MtlMap normals{"norm", mtl_.normal_texname, mtl_.normal_texopt},
        bump{"bump", mtl_.bump_texname, mtl_.bump_texopt},
        disp{"disp", mtl_.displacement_texname, mtl_.displacement_texopt};
    if (normals.given()) {
      ImageMap map = pictureOf(normals);
      map.relief = Relief::normals;
      setTexture(material_.textures, "bump", TextureNode{.model = std::move(map)});
      material_.bump = 1;
      leaveOut(bump);
      return leaveOut(disp);
    }
    const MtlMap& heights = bump.given() ? bump : disp;
    put("bump", heights);
    if (heights.given()) {
      const Real strength = heights.option.bump_multiplier;
      material_.bump = std::isfinite(strength) ? strength : 1;
    }
    if (bump.given()) leaveOut(disp);
  }

  void addHoles() {
    const MtlMap own{"map_d", mtl_.alpha_texname, mtl_.alpha_texopt};
    const MtlMap& map = own.given() ? own : diffuse_;
    if (!map.given()) return;
    ImageMap opacity = pictureOf(map);
    const bool oneChannel = own.given() && opacity.channel != Channel::color;
    if (!oneChannel && pictures_.isTransparent(opacity.file.file))
      opacity.channel = Channel::alpha;
    else if (!own.given())
      return;
    cutOut(material_, TextureNode{.model = std::move(opacity)}, material_.opacity);
  }

  const tinyobj::material_t& mtl_;
  const MtlPictures& pictures_;
  Material& material_;
  const MtlMap ambient_{"map_Ka", mtl_.ambient_texname, mtl_.ambient_texopt},
      diffuse_{"map_Kd", mtl_.diffuse_texname, mtl_.diffuse_texopt},
      specular_{"map_Ks", mtl_.specular_texname, mtl_.specular_texopt},
      shininess_{"map_Ns", mtl_.specular_highlight_texname, mtl_.specular_highlight_texopt},
      roughness_{"map_Pr", mtl_.roughness_texname, mtl_.roughness_texopt},
      sheen_{"map_Ps", mtl_.sheen_texname, mtl_.sheen_texopt};
};

bool isSound(const Material& material) {
  const Phong phong = phongOf(material);
  bool sound = true;
  forEachField<Phong>([&](const auto& field) {
    const auto& value = phong.*field.member;
    if constexpr (requires { value.r; })
      sound = sound && isFinite(value);
    else
      sound = sound && std::isfinite(static_cast<double>(value));
  });
  return sound;
}

}  // namespace

std::optional<Material> materialOf(const tinyobj::material_t& mtl, const MtlPictures& pictures) {
  Material material = plainOf(mtl);
  if (!isSound(material)) return {};
  MtlTextures(mtl, pictures, material).add();
  return material;
}

void scaleHeights(Material& material, Real longestSide) {
  constexpr Real kHeight = 0.005;  // where the picture is white
  const Texture* texture = textureOf(material.textures, "bump");
  const auto* map = texture ? (*texture)->model.as<ImageMap>() : nullptr;
  if (map && map->relief == Relief::heights) material.bump *= kHeight * longestSide;
}

Color paintedColor(const MaterialModel& model) {
  const auto* principled = model.as<Principled>();
  return principled ? principled->color : phongOf(model).diffuse;
}

}  // namespace trace
