// Source: Khronos Group, glTF 2.0 Specification, and the extensions named below.
#include "formats/mesh/gltf/document/gltf_check_materials.h"

namespace trace {

void GltfMaterialCheck::checkMaterial(const Part& material) {
  known(material, {"alphaCutoff", "alphaMode", "doubleSided", "emissiveFactor", "emissiveTexture",
                   "normalTexture", "occlusionTexture", "pbrMetallicRoughness"});
  word(material, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
  number(material, "alphaCutoff", 0);
  numbers(material, "emissiveFactor", 3, 0, 1);
  for (const char* key : {"emissiveTexture", "normalTexture", "occlusionTexture"}) texture(material, key);
  object(material, "pbrMetallicRoughness", [&](const Part& pbr) {
    known(pbr, {"baseColorFactor", "baseColorTexture", "metallicFactor", "metallicRoughnessTexture",
                "roughnessFactor"});
    numbers(pbr, "baseColorFactor", 4, 0, 1);
    number(pbr, "metallicFactor", 0, 1);
    number(pbr, "roughnessFactor", 0, 1);
    for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) texture(pbr, key);
  });
  extension(material, "KHR_materials_ior", [&](const Part& e) {
    number(e, "ior", 0);
    if (const double ior = e.value.value("ior", 1.5); ior > 0 && ior < 1) inRange(e, "ior", ior, 1, kNoLimit);
  });
  extension(material, "KHR_materials_transmission", [&](const Part& e) {
    known(e, {"transmissionFactor", "transmissionTexture"});
    number(e, "transmissionFactor", 0, 1);
    texture(e, "transmissionTexture");
  });
  extension(material, "KHR_materials_iridescence", [&](const Part& e) {
    known(e, {"iridescenceFactor", "iridescenceTexture", "iridescenceIor", "iridescenceThicknessMinimum",
              "iridescenceThicknessMaximum", "iridescenceThicknessTexture"});
    number(e, "iridescenceFactor", 0, 1);
    number(e, "iridescenceIor", 1);
    number(e, "iridescenceThicknessMinimum", 0);
    number(e, "iridescenceThicknessMaximum", 0);
    for (const char* key : {"iridescenceTexture", "iridescenceThicknessTexture"}) texture(e, key);
  });
  extension(material, "KHR_materials_emissive_strength",
            [&](const Part& e) { number(e, "emissiveStrength", 0); });
  checkLayers(material);
  checkPassage(material);
}

void GltfMaterialCheck::checkLayers(const Part& material) {
  const auto textures = [&](const Part& e, std::initializer_list<const char*> keys) {
    for (const char* key : keys) texture(e, key);
  };
  extension(material, "KHR_materials_clearcoat", [&](const Part& e) {
    known(e, {"clearcoatFactor", "clearcoatTexture", "clearcoatRoughnessFactor", "clearcoatRoughnessTexture",
              "clearcoatNormalTexture"});
    number(e, "clearcoatFactor", 0, 1);
    number(e, "clearcoatRoughnessFactor", 0, 1);
    textures(e, {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"});
  });
  extension(material, "KHR_materials_sheen", [&](const Part& e) {
    known(e, {"sheenColorFactor", "sheenColorTexture", "sheenRoughnessFactor", "sheenRoughnessTexture"});
    numbers(e, "sheenColorFactor", 3, 0, 1);
    number(e, "sheenRoughnessFactor", 0, 1);
    textures(e, {"sheenColorTexture", "sheenRoughnessTexture"});
  });
  extension(material, "KHR_materials_anisotropy", [&](const Part& e) {
    known(e, {"anisotropyStrength", "anisotropyRotation", "anisotropyTexture"});
    number(e, "anisotropyStrength", 0, 1);
    number(e, "anisotropyRotation");
    textures(e, {"anisotropyTexture"});
  });
  extension(material, "KHR_materials_specular", [&](const Part& e) {
    known(e, {"specularFactor", "specularTexture", "specularColorFactor", "specularColorTexture"});
    number(e, "specularFactor", 0, 1);
    numbers(e, "specularColorFactor", 3, 0);
    textures(e, {"specularTexture", "specularColorTexture"});
  });
  extension(material, "KHR_materials_pbrSpecularGlossiness", [&](const Part& e) {
    known(e, {"diffuseFactor", "diffuseTexture", "specularFactor", "glossinessFactor",
              "specularGlossinessTexture"});
    numbers(e, "diffuseFactor", 4, 0, 1);
    numbers(e, "specularFactor", 3, 0, 1);
    number(e, "glossinessFactor", 0, 1);
    textures(e, {"diffuseTexture", "specularGlossinessTexture"});
  });
}

void GltfMaterialCheck::checkPassage(const Part& material) {
  extension(material, "KHR_materials_volume", [&](const Part& e) {
    known(e, {"thicknessFactor", "thicknessTexture", "attenuationDistance", "attenuationColor"});
    number(e, "thicknessFactor", 0);
    number(e, "attenuationDistance", 0);
    numbers(e, "attenuationColor", 3, 0, 1);
    texture(e, "thicknessTexture");
  });
  extension(material, "KHR_materials_dispersion", [&](const Part& e) { number(e, "dispersion", 0); });
}

void GltfMaterialCheck::texture(const Part& owner, std::string_view key) {
  object(owner, key, [&](const Part& info) {
    if (!info.find("index")) fail(info.path + ": expected an index");
    index(info, "index", "textures");
    if (const json* set = info.find("texCoord"); set && (!set->is_number_unsigned()))
      fail(info.pathOf("texCoord") + ": expected a whole number from 0, found " + found(*set));
    number(info, "strength", 0, 1);
    extension(info, "KHR_texture_transform", [&](const Part& e) {
      known(e, {"offset", "rotation", "scale", "texCoord"});
      numbers(e, "offset", 2);
      number(e, "rotation");
      numbers(e, "scale", 2);
      whole(e, "texCoord");
    });
  });
}

void GltfMaterialCheck::checkSampler(const Part& sampler) {
  known(sampler, {"magFilter", "minFilter", "wrapS", "wrapT"});
  code(sampler, "magFilter", {9728, 9729});
  code(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
  for (const char* key : {"wrapS", "wrapT"}) code(sampler, key, {10497, 33071, 33648});
}

void GltfMaterialCheck::code(const Part& owner, std::string_view key, std::initializer_list<int> codes) {
  const json* value = owner.find(key);
  if (!value || std::any_of(codes.begin(), codes.end(), [&](int code) { return *value == code; })) return;
  if (!value->is_number()) fail(owner.pathOf(key) + ": expected a number, found " + found(*value));
  std::string list;
  for (int code : codes) list += (list.empty() ? "" : ", ") + std::to_string(code);
  warn(owner.pathOf(key) + ": expected one of " + list + ", found " + found(*value), {},
       "code of " + std::string(key));
}

}  // namespace trace
