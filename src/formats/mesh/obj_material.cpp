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

/// Normals where they are given, or else the heights of `bump`, or else those of `disp`: exporters bake one
/// from the other.
template <class Map>
void addRelief(const tinyobj::material_t& mtl, const Map& map, const MtlPictures& pictures,
               Material& material) {
  const bool bumps = mtl.normal_texname.empty() && !mtl.bump_texname.empty();
  const bool moves = mtl.normal_texname.empty() && !bumps && !mtl.displacement_texname.empty();
  if (!mtl.normal_texname.empty()) {
    ImageMap normals = map(mtl.normal_texname, mtl.normal_texopt);
    normals.relief = Relief::normals;
    setTexture(material.textures, "bump", TextureNode{.model = std::move(normals)});
    material.bump = 1;
  } else if (bumps || moves) {
    const auto& option = bumps ? mtl.bump_texopt : mtl.displacement_texopt;
    setTexture(material.textures, "bump",
               TextureNode{.model = map(bumps ? mtl.bump_texname : mtl.displacement_texname, option)});
    const Real strength = option.bump_multiplier;
    material.bump = std::isfinite(strength) ? strength : 1;
  }
  if (!mtl.normal_texname.empty() && !mtl.bump_texname.empty()) pictures.unused(mtl.bump_texname);
  if (!moves && !mtl.displacement_texname.empty()) pictures.unused(mtl.displacement_texname);
}

/// Puts the pictures of the MTL material on it.
void addTextures(const tinyobj::material_t& mtl, const MtlPictures& pictures, Material& material) {
  const auto* phong = material.model.as<Phong>();
  const Color ambient = phongOf(material.model).ambient;
  const auto map = [&](const std::string& picture, const tinyobj::texture_option_t& option) {
    ImageMap made = toMap(pictures.nameOf(picture), option);
    made.file.place = pictures.placeOf(picture);
    return made;
  };
  const auto put = [&](std::string_view field, const std::string& picture,
                       const tinyobj::texture_option_t& option) {
    if (!picture.empty()) setTexture(material.textures, field, TextureNode{.model = map(picture, option)});
  };
  put(phong ? kDiffuse : kColor, mtl.diffuse_texname, mtl.diffuse_texopt);
  put("emissive", mtl.emissive_texname, mtl.emissive_texopt);
  if (phong) {
    put("specular", mtl.specular_texname, mtl.specular_texopt);
    put("shininess", mtl.specular_highlight_texname, mtl.specular_highlight_texopt);
    if (!isBlack(phong->reflective)) put("reflective", mtl.specular_texname, mtl.specular_texopt);
  } else if (material.model.is<RoughGlass>()) {
    put("roughness", mtl.roughness_texname, mtl.roughness_texopt);
    for (const std::string* other :
         {&mtl.sheen_texname, &mtl.specular_texname, &mtl.specular_highlight_texname})
      if (!other->empty()) pictures.unused(*other);
  } else {
    put("metallic", mtl.metallic_texname, mtl.metallic_texopt);
    put("roughness", mtl.roughness_texname, mtl.roughness_texopt);
    put("sheen", mtl.sheen_texname, mtl.sheen_texopt);
    put("specular_color", mtl.specular_texname, mtl.specular_texopt);
    if (!mtl.specular_highlight_texname.empty()) pictures.unused(mtl.specular_highlight_texname);
  }
  // A painted surface is painted in the ambient light too.
  if (!mtl.ambient_texname.empty())
    put("ambient", mtl.ambient_texname, mtl.ambient_texopt);
  else if (!isBlack(ambient))
    put("ambient", mtl.diffuse_texname, mtl.diffuse_texopt);

  addRelief(mtl, map, pictures, material);

  const bool own = !mtl.alpha_texname.empty();
  if (!own && mtl.diffuse_texname.empty()) return;
  ImageMap opacity =
      own ? map(mtl.alpha_texname, mtl.alpha_texopt) : map(mtl.diffuse_texname, mtl.diffuse_texopt);
  const bool oneChannel = own && opacity.channel != Channel::color;
  if (const bool transparent = pictures.isTransparent(opacity.file.file); !oneChannel && transparent)
    opacity.channel = Channel::alpha;
  else if (!own)
    return;
  cutOut(material, TextureNode{.model = std::move(opacity)}, material.opacity);
}

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
  addTextures(mtl, pictures, material);
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
