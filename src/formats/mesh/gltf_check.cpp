// Source: Khronos Group, glTF 2.0 Specification, and the extensions named below.
#include "formats/mesh/gltf_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/text.h"
#include "formats/warnings.h"

namespace trace {
namespace {

using nlohmann::json;

constexpr std::string_view kDraco = "KHR_draco_mesh_compression", kMeshopt = "EXT_meshopt_compression",
                           kLights = "KHR_lights_punctual";
/// Extensions that the reader takes into account, and those of pictures that it may not be able to read,
/// which it tells.
constexpr std::string_view kRead[] = {kLights,
                                      "KHR_materials_ior",
                                      "KHR_materials_transmission",
                                      "KHR_materials_iridescence",
                                      "KHR_materials_emissive_strength",
                                      "KHR_materials_clearcoat",
                                      "KHR_materials_sheen",
                                      "KHR_materials_anisotropy",
                                      "KHR_materials_specular",
                                      "KHR_materials_volume",
                                      "KHR_materials_dispersion",
                                      "KHR_materials_unlit",
                                      "KHR_materials_pbrSpecularGlossiness",
                                      "KHR_mesh_quantization",
                                      "KHR_texture_transform",
                                      "KHR_texture_basisu",
                                      "EXT_texture_webp",
                                      "EXT_texture_avif",
                                      "MSFT_texture_dds"};

bool isOneOf(std::string_view word, std::span<const std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string inQuotes(std::string_view word) { return "\"" + std::string(word.substr(0, 60)) + "\""; }

/// The value as the file has it, short.
std::string found(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

/// An object of the file and where it stands, as in `materials[0].pbrMetallicRoughness`.
struct JsonPart {
  const json& value;
  std::string path;

  const json* find(std::string_view key) const {
    const auto at = value.find(key);
    return at == value.end() ? nullptr : &*at;
  }
  std::string pathOf(std::string_view key) const {
    return path.empty() ? std::string(key) : path + "." + std::string(key);
  }
};

class GltfCheck {
 public:
  GltfCheck(const json& root, const Place& place, Messages& messages)
      : root_{root, ""}, place_(place), messages_(messages) {}

  void check() {
    checkVersion();
    checkExtensions();
    index(root_, "scene", "scenes");
    each(root_, "scenes", [&](const JsonPart& scene) { indices(scene, "nodes", "nodes"); });
    each(root_, "nodes", [&](const JsonPart& node) { checkNode(node); });
    each(root_, "meshes", [&](const JsonPart& mesh) {
      each(mesh, "primitives", [&](const JsonPart& primitive) { checkPrimitive(primitive); });
    });
    each(root_, "cameras", [&](const JsonPart& camera) { checkCamera(camera); });
    each(root_, "materials", [&](const JsonPart& material) { checkMaterial(material); });
    each(root_, "textures", [&](const JsonPart& texture) {
      index(texture, "source", "images");
      index(texture, "sampler", "samplers");
    });
    each(root_, "samplers", [&](const JsonPart& sampler) { checkSampler(sampler); });
    each(root_, "images", [&](const JsonPart& image) { index(image, "bufferView", "bufferViews"); });
    each(root_, "accessors", [&](const JsonPart& accessor) { checkAccessor(accessor); });
    each(root_, "bufferViews", [&](const JsonPart& view) {
      index(view, "buffer", "buffers");
      for (const char* key : {"byteOffset", "byteLength", "byteStride"}) whole(view, key);
    });
    if (const json* all = root_.find("extensions"); all && all->is_object())
      object({*all, "extensions"}, kLights, [&](const JsonPart& lights) {
        each(lights, "lights", [&](const JsonPart& light) { checkLight(light); });
      });
    checkWhatIsNotRead();
    warnings_.report(messages_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, std::string hint = {}) const {
    throw Error(Fault::scene, place_, what, std::move(hint));
  }
  void warn(std::string what, std::string hint = {}, std::string_view kind = {}) {
    warnings_.warn(place_, std::move(what), std::move(hint), kind);
  }

  // --- parts and values ---

  template <class Visit>
  void each(const JsonPart& owner, std::string_view key, Visit&& visit) {
    const json* list = owner.find(key);
    if (!list) return;
    const std::string path = owner.pathOf(key);
    if (!list->is_array()) fail(path + ": expected a list, found " + found(*list));
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string place = path + "[" + std::to_string(i) + "]";
      if (!(*list)[i].is_object()) fail(place + ": expected an object, found " + found((*list)[i]));
      visit(JsonPart{(*list)[i], place});
    }
  }
  template <class Visit>
  void object(const JsonPart& owner, std::string_view key, Visit&& visit) {
    const json* value = owner.find(key);
    if (!value) return;
    if (!value->is_object()) fail(owner.pathOf(key) + ": expected an object, found " + found(*value));
    visit(JsonPart{*value, owner.pathOf(key)});
  }
  template <class Visit>
  void extension(const JsonPart& owner, std::string_view name, Visit&& visit) {
    object(owner, "extensions", [&](const JsonPart& all) { object(all, name, visit); });
  }

  /// The length of the top list of that name; lights stand in an extension.
  std::size_t countOf(std::string_view list) const {
    const json* all = root_.find(list);
    if (list == "lights") {
      all = root_.find("extensions");
      for (std::string_view key : {kLights, list})
        if (all && all->is_object()) all = JsonPart{*all, ""}.find(key);
    }
    return all && all->is_array() ? all->size() : 0;
  }
  void checkIndex(const json& value, const std::string& path, std::string_view list) const {
    const std::size_t count = countOf(list);
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < count) return;
    fail(path + ": expected a number of one of the " + std::to_string(count) + " " + std::string(list) +
             ", found " + found(value),
         count > 0 ? "they are counted from 0" : "");
  }
  void index(const JsonPart& owner, std::string_view key, std::string_view list) const {
    if (const json* value = owner.find(key)) checkIndex(*value, owner.pathOf(key), list);
  }
  void indices(const JsonPart& owner, std::string_view key, std::string_view list) const {
    const json* all = owner.find(key);
    if (!all) return;
    if (!all->is_array()) fail(owner.pathOf(key) + ": expected a list of numbers, found " + found(*all));
    for (const json& value : *all) checkIndex(value, owner.pathOf(key), list);
  }

  void inRange(const JsonPart& owner, std::string_view key, double value, double least, double most) {
    if (value >= least && value <= most) return;
    const std::string range =
        most == kNoLimit ? "at least " + toText(least) : toText(least) + " to " + toText(most);
    warn(owner.pathOf(key) + ": expected " + range + ", found " + toText(value), {},
         "range of " + std::string(key));
  }
  void number(const JsonPart& owner, std::string_view key, double least = -kNoLimit, double most = kNoLimit) {
    const json* value = owner.find(key);
    if (!value) return;
    if (!value->is_number()) fail(owner.pathOf(key) + ": expected a number, found " + found(*value));
    inRange(owner, key, value->get<double>(), least, most);
  }
  void whole(const JsonPart& owner, std::string_view key, std::uint64_t least = 0) const {
    const json* value = owner.find(key);
    if (!value || (value->is_number_unsigned() && value->get<std::uint64_t>() >= least)) return;
    const bool tooLarge = value->is_number_float() && value->get<double>() >= 1.8e19;
    fail(owner.pathOf(key) + ": expected a whole number " +
         (tooLarge ? "that 64 bits can hold" : "of at least " + std::to_string(least)) + ", found " +
         found(*value));
  }
  void numbers(const JsonPart& owner, std::string_view key, std::size_t count, double least = -kNoLimit,
               double most = kNoLimit) {
    const json* value = owner.find(key);
    if (!value) return;
    const bool good = value->is_array() && value->size() == count &&
                      std::all_of(value->begin(), value->end(), [](const json& n) { return n.is_number(); });
    if (!good)
      fail(owner.pathOf(key) + ": expected " + std::to_string(count) + " numbers, found " + found(*value));
    for (const json& n : *value) inRange(owner, key, n.get<double>(), least, most);
  }
  void word(const JsonPart& owner, std::string_view key, std::initializer_list<std::string_view> words) {
    const json* value = owner.find(key);
    if (!value) return;
    if (value->is_string() && isOneOf(value->get_ref<const std::string&>(), {words.begin(), words.size()}))
      return;
    std::string list;
    for (std::string_view w : words) list += (list.empty() ? "" : ", ") + std::string(w);
    fail(owner.pathOf(key) + ": expected one of " + list + ", found " + found(*value));
  }
  /// Warns of properties that the specification does not have there.
  void known(const JsonPart& owner, std::initializer_list<std::string_view> keys) {
    for (const auto& [key, value] : owner.value.items()) {
      if (key == "name" || key == "extensions" || key == "extras") continue;
      if (isOneOf(key, {keys.begin(), keys.size()})) continue;
      warn("unknown property " + inQuotes(key) + " of " + owner.path + " is ignored",
           didYouMean(key, {keys.begin(), keys.size()}), "unknown " + key.substr(0, 60));
    }
  }

  // --- the file ---

  void checkVersion() const {
    const json* asset = root_.find("asset");
    if (!asset || !asset->is_object()) fail("expected an object \"asset\" with the version");
    const auto version = [&](const char* key) -> double {
      const json* value = JsonPart{*asset, ""}.find(key);
      if (!value) return -1;
      const auto number = value->is_string() ? parseNumber(value->get_ref<const std::string&>())
                                             : std::optional<ParsedNumber>();
      if (!number || number->length != value->get_ref<const std::string&>().size())
        fail(std::string("asset.") + key + ": expected a version such as \"2.0\", found " + found(*value));
      return number->value;
    };
    const double of = version("version"), least = version("minVersion");
    if (of < 0) fail("asset.version: expected a version such as \"2.0\", found none");
    if (!(of >= 2 && of < 3) || least >= 2.1)
      fail("expected glTF of version 2.0, found version " + toText(std::max(of, least)),
           of < 2 ? "programs that read the old version write the new one too" : "");
  }

  void checkExtensions() {
    for (const std::string& name : names("extensionsRequired")) {
      if (name == kDraco || name == kMeshopt) failOfCompression(name);
      if (!isOneOf(name, kRead))
        fail("the file requires the extension " + inQuotes(name) + ", which is not read",
             "export the scene without it");
    }
    std::string others;
    for (const std::string& name : names("extensionsUsed"))
      if (!isOneOf(name, kRead) && name != kDraco && name != kMeshopt)
        others += (others.empty() ? "" : ", ") + inQuotes(name);
    if (!others.empty()) warn("extensions that are not read: " + others.substr(0, 400));
  }
  std::vector<std::string> names(std::string_view key) const {
    std::vector<std::string> all;
    const json* list = root_.find(key);
    if (!list) return all;
    if (!list->is_array()) fail(std::string(key) + ": expected a list of names, found " + found(*list));
    for (const json& name : *list) {
      if (!name.is_string()) fail(std::string(key) + ": expected a list of names, found " + found(name));
      all.push_back(name.get<std::string>());
    }
    return all;
  }
  [[noreturn]] void failOfCompression(std::string_view name) const {
    fail("compressed meshes (" + std::string(name) + ") are not read",
         "export the scene without compression");
  }

  void checkNode(const JsonPart& node) {
    known(node,
          {"camera", "children", "skin", "matrix", "mesh", "rotation", "scale", "translation", "weights"});
    index(node, "mesh", "meshes");
    index(node, "camera", "cameras");
    index(node, "skin", "skins");
    indices(node, "children", "nodes");
    numbers(node, "matrix", 16);
    numbers(node, "translation", 3);
    numbers(node, "scale", 3);
    numbers(node, "rotation", 4);
    if (const json* q = node.find("rotation")) {
      double square = 0;
      for (const json& n : *q) square += n.get<double>() * n.get<double>();
      constexpr double kClose = 0.02;
      if (!(std::abs(square - 1) < kClose))
        warn(node.path + ".rotation: expected a quaternion of length 1, found one of length " +
                 toText(std::round(std::sqrt(square) * 1000) / 1000),
             {}, "length of rotation");
    }
    if (node.find("matrix"))
      for (const char* other : {"translation", "rotation", "scale"})
        if (node.find(other))
          warn(node.path + ": " + other + " is ignored, since matrix is given", {}, "matrix and others");
    extension(node, kLights, [&](const JsonPart& light) { index(light, "light", "lights"); });
  }

  void checkPrimitive(const JsonPart& primitive) {
    known(primitive, {"attributes", "indices", "material", "mode", "targets"});
    index(primitive, "material", "materials");
    index(primitive, "indices", "accessors");
    if (const json* mode = primitive.find("mode"))
      if (!mode->is_number_unsigned() || mode->get<std::uint64_t>() > 6)
        fail(primitive.pathOf("mode") + ": expected 0 to 6, found " + found(*mode));
    const json* attributes = primitive.find("attributes");
    if (!attributes || !attributes->is_object()) fail(primitive.path + ": expected an object \"attributes\"");
    const JsonPart of{*attributes, primitive.pathOf("attributes")};
    for (const auto& [key, value] : attributes->items()) checkIndex(value, of.pathOf(key), "accessors");
    knownAttributes(of);
    if (!of.find("POSITION"))
      warn(primitive.path + " has no POSITION: there is nothing to see of it", {}, "no POSITION");
    extension(primitive, kDraco,
              [&](const JsonPart&) {  // unless the file has the mesh a second time, as it is
                if (const json* points = of.find("POSITION"); points && !hasData(*points))
                  failOfCompression(kDraco);
              });
    morphs_ += primitive.find("targets") != nullptr;
  }
  /// Sets are counted, as in TEXCOORD_1, and programs may add names that begin with _.
  void knownAttributes(const JsonPart& attributes) {
    constexpr std::string_view kNames[] = {"POSITION", "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                           "COLOR_0",  "JOINTS_0", "WEIGHTS_0"};
    for (const auto& [key, value] : attributes.value.items()) {
      if (key.starts_with('_')) continue;
      const std::size_t digits = key.find_last_not_of("0123456789") + 1;
      const bool counted = digits < key.size() && key.substr(0, digits).ends_with('_');
      if (isOneOf(counted ? key.substr(0, digits) + "0" : key, kNames)) continue;
      warn("unknown attribute " + inQuotes(key) + " of " + attributes.path + " is ignored",
           didYouMean(key, kNames), "unknown " + key.substr(0, 60));
    }
  }
  bool hasData(const json& accessor) const {
    return (*root_.find("accessors"))[accessor.get<std::size_t>()].contains("bufferView");
  }

  void checkAccessor(const JsonPart& accessor) {
    index(accessor, "bufferView", "bufferViews");
    word(accessor, "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
    whole(accessor, "count", 1);
    whole(accessor, "byteOffset");
    if (const json* type = accessor.find("componentType"))
      if (!type->is_number_unsigned() || type->get<std::uint64_t>() < 5120 ||
          type->get<std::uint64_t>() > 5126)
        fail(accessor.pathOf("componentType") + ": expected 5120 to 5126, found " + found(*type));
  }

  // --- cameras, lights, materials ---

  void checkCamera(const JsonPart& camera) {
    word(camera, "type", {"perspective", "orthographic"});
    object(camera, "perspective", [&](const JsonPart& p) {
      known(p, {"aspectRatio", "yfov", "zfar", "znear"});
      for (const char* key : {"aspectRatio", "yfov", "zfar", "znear"}) number(p, key, 0);
    });
  }

  void checkLight(const JsonPart& light) {
    known(light, {"color", "intensity", "type", "range", "spot"});
    if (!light.find("type")) fail(light.path + ": expected a type, as in \"point\"");
    word(light, "type", {"directional", "point", "spot"});
    numbers(light, "color", 3, 0);
    number(light, "intensity", 0);
    number(light, "range", 0);
    object(light, "spot", [&](const JsonPart& spot) {
      known(spot, {"innerConeAngle", "outerConeAngle"});
      number(spot, "innerConeAngle", 0, 1.5708);
      number(spot, "outerConeAngle", 0, 1.5708);
      const double inner = spot.value.value("innerConeAngle", 0.0),
                   outer = spot.value.value("outerConeAngle", 0.7853981633974483);
      if (inner > outer)
        warn(spot.path + ": expected an innerConeAngle below the outerConeAngle, found " + toText(inner) +
                 " and " + toText(outer),
             {}, "inner above outer");
    });
  }

  void checkMaterial(const JsonPart& material) {
    known(material, {"alphaCutoff", "alphaMode", "doubleSided", "emissiveFactor", "emissiveTexture",
                     "normalTexture", "occlusionTexture", "pbrMetallicRoughness"});
    word(material, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
    number(material, "alphaCutoff", 0);
    numbers(material, "emissiveFactor", 3, 0, 1);
    for (const char* key : {"emissiveTexture", "normalTexture", "occlusionTexture"}) texture(material, key);
    object(material, "pbrMetallicRoughness", [&](const JsonPart& pbr) {
      known(pbr, {"baseColorFactor", "baseColorTexture", "metallicFactor", "metallicRoughnessTexture",
                  "roughnessFactor"});
      numbers(pbr, "baseColorFactor", 4, 0, 1);
      number(pbr, "metallicFactor", 0, 1);
      number(pbr, "roughnessFactor", 0, 1);
      for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) texture(pbr, key);
    });
    extension(material, "KHR_materials_ior", [&](const JsonPart& e) {
      number(e, "ior", 0);
      if (const double ior = e.value.value("ior", 1.5); ior > 0 && ior < 1)
        inRange(e, "ior", ior, 1, kNoLimit);
    });
    extension(material, "KHR_materials_transmission", [&](const JsonPart& e) {
      known(e, {"transmissionFactor", "transmissionTexture"});
      number(e, "transmissionFactor", 0, 1);
      texture(e, "transmissionTexture");
    });
    extension(material, "KHR_materials_iridescence", [&](const JsonPart& e) {
      known(e, {"iridescenceFactor", "iridescenceTexture", "iridescenceIor", "iridescenceThicknessMinimum",
                "iridescenceThicknessMaximum", "iridescenceThicknessTexture"});
      number(e, "iridescenceFactor", 0, 1);
      number(e, "iridescenceIor", 1);
      number(e, "iridescenceThicknessMinimum", 0);
      number(e, "iridescenceThicknessMaximum", 0);
      for (const char* key : {"iridescenceTexture", "iridescenceThicknessTexture"}) texture(e, key);
    });
    extension(material, "KHR_materials_emissive_strength",
              [&](const JsonPart& e) { number(e, "emissiveStrength", 0); });
    checkLayers(material);
    checkPassage(material);
  }
  void checkLayers(const JsonPart& material) {
    const auto textures = [&](const JsonPart& e, std::initializer_list<const char*> keys) {
      for (const char* key : keys) texture(e, key);
    };
    extension(material, "KHR_materials_clearcoat", [&](const JsonPart& e) {
      known(e, {"clearcoatFactor", "clearcoatTexture", "clearcoatRoughnessFactor",
                "clearcoatRoughnessTexture", "clearcoatNormalTexture"});
      number(e, "clearcoatFactor", 0, 1);
      number(e, "clearcoatRoughnessFactor", 0, 1);
      textures(e, {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"});
    });
    extension(material, "KHR_materials_sheen", [&](const JsonPart& e) {
      known(e, {"sheenColorFactor", "sheenColorTexture", "sheenRoughnessFactor", "sheenRoughnessTexture"});
      numbers(e, "sheenColorFactor", 3, 0, 1);
      number(e, "sheenRoughnessFactor", 0, 1);
      textures(e, {"sheenColorTexture", "sheenRoughnessTexture"});
    });
    extension(material, "KHR_materials_anisotropy", [&](const JsonPart& e) {
      known(e, {"anisotropyStrength", "anisotropyRotation", "anisotropyTexture"});
      number(e, "anisotropyStrength", 0, 1);
      number(e, "anisotropyRotation");
      textures(e, {"anisotropyTexture"});
    });
    extension(material, "KHR_materials_specular", [&](const JsonPart& e) {
      known(e, {"specularFactor", "specularTexture", "specularColorFactor", "specularColorTexture"});
      number(e, "specularFactor", 0, 1);
      numbers(e, "specularColorFactor", 3, 0);
      textures(e, {"specularTexture", "specularColorTexture"});
    });
    extension(material, "KHR_materials_pbrSpecularGlossiness", [&](const JsonPart& e) {
      known(e, {"diffuseFactor", "diffuseTexture", "specularFactor", "glossinessFactor",
                "specularGlossinessTexture"});
      numbers(e, "diffuseFactor", 4, 0, 1);
      numbers(e, "specularFactor", 3, 0, 1);
      number(e, "glossinessFactor", 0, 1);
      textures(e, {"diffuseTexture", "specularGlossinessTexture"});
    });
  }
  void checkPassage(const JsonPart& material) {
    extension(material, "KHR_materials_volume", [&](const JsonPart& e) {
      known(e, {"thicknessFactor", "thicknessTexture", "attenuationDistance", "attenuationColor"});
      number(e, "thicknessFactor", 0);
      number(e, "attenuationDistance", 0);
      numbers(e, "attenuationColor", 3, 0, 1);
      texture(e, "thicknessTexture");
    });
    extension(material, "KHR_materials_dispersion", [&](const JsonPart& e) { number(e, "dispersion", 0); });
  }
  void texture(const JsonPart& owner, std::string_view key) {
    object(owner, key, [&](const JsonPart& info) {
      if (!info.find("index")) fail(info.path + ": expected an index");
      index(info, "index", "textures");
      if (const json* set = info.find("texCoord"); set && (!set->is_number_unsigned()))
        fail(info.pathOf("texCoord") + ": expected a whole number from 0, found " + found(*set));
      number(info, "strength", 0, 1);
      extension(info, "KHR_texture_transform", [&](const JsonPart& e) {
        known(e, {"offset", "rotation", "scale", "texCoord"});
        numbers(e, "offset", 2);
        number(e, "rotation");
        numbers(e, "scale", 2);
        whole(e, "texCoord");
      });
    });
  }
  void checkSampler(const JsonPart& sampler) {
    known(sampler, {"magFilter", "minFilter", "wrapS", "wrapT"});
    code(sampler, "magFilter", {9728, 9729});
    code(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    for (const char* key : {"wrapS", "wrapT"}) code(sampler, key, {10497, 33071, 33648});
  }
  /// One of OpenGL's numbers.
  void code(const JsonPart& owner, std::string_view key, std::initializer_list<int> codes) {
    const json* value = owner.find(key);
    if (!value || std::any_of(codes.begin(), codes.end(), [&](int code) { return *value == code; })) return;
    if (!value->is_number()) fail(owner.pathOf(key) + ": expected a number, found " + found(*value));
    std::string list;
    for (int code : codes) list += (list.empty() ? "" : ", ") + std::to_string(code);
    warn(owner.pathOf(key) + ": expected one of " + list + ", found " + found(*value), {},
         "code of " + std::string(key));
  }

  void checkWhatIsNotRead() {
    if (const std::size_t n = countOf("animations")) warn("animations are not played: " + std::to_string(n));
    if (const std::size_t n = countOf("skins"))
      warn("skins are not applied, meshes stand as they were modelled: " + std::to_string(n));
    if (morphs_ > 0) warn("morph targets are left out: " + std::to_string(morphs_));
  }

  JsonPart root_;
  const Place& place_;
  Messages& messages_;
  WarningsByKind warnings_;
  std::size_t morphs_ = 0;  ///< primitives that have some
};

}  // namespace

void checkGltf(const json& root, const Place& place, Messages& messages) {
  GltfCheck(root, place, messages).check();
}

}  // namespace trace
