// Source: Khronos Group, glTF 2.0 Specification, and the extensions named below.
#include "formats/mesh/gltf/document/gltf_check.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "formats/mesh/gltf/document/gltf_check_materials.h"
#include "formats/mesh/gltf/gltf_unpack.h"

namespace trace {
namespace {

using nlohmann::json;

/// Extensions that the reader takes into account, and those of pictures that it may not be able to read,
/// which it tells.
constexpr std::string_view kRead[] = {kGltfLights,
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
                                      kGltfDraco,
                                      kGltfMeshopt,
                                      "EXT_mesh_gpu_instancing",
                                      "KHR_texture_transform",
                                      "KHR_texture_basisu",
                                      "EXT_texture_webp",
                                      "EXT_texture_avif",
                                      "MSFT_texture_dds"};

class GltfCheck : private GltfMaterialCheck {
 public:
  GltfCheck(const json& file, const SourcePlace& place, Messages& messages)
      : GltfMaterialCheck(file, place), messages_(messages) {}

  void check() {
    checkVersion();
    checkExtensions();
    index(root, "scene", "scenes");
    each(root, "scenes", [&](const Part& scene) { indices(scene, "nodes", "nodes"); });
    each(root, "nodes", [&](const Part& node) { checkNode(node); });
    each(root, "meshes", [&](const Part& mesh) {
      each(mesh, "primitives", [&](const Part& primitive) { checkPrimitive(primitive); });
    });
    each(root, "skins", [&](const Part& skin) {
      known(skin, {"inverseBindMatrices", "joints", "skeleton"});
      indices(skin, "joints", "nodes");
      index(skin, "inverseBindMatrices", "accessors");
    });
    each(root, "animations", [&](const Part& animation) { checkAnimation(animation); });
    each(root, "cameras", [&](const Part& camera) { checkCamera(camera); });
    each(root, "materials", [&](const Part& material) { checkMaterial(material); });
    each(root, "textures", [&](const Part& texture) {
      index(texture, "source", "images");
      index(texture, "sampler", "samplers");
    });
    each(root, "samplers", [&](const Part& sampler) { checkSampler(sampler); });
    each(root, "images", [&](const Part& image) { index(image, "bufferView", "bufferViews"); });
    each(root, "accessors", [&](const Part& accessor) { checkAccessor(accessor); });
    each(root, "bufferViews", [&](const Part& view) {
      index(view, "buffer", "buffers");
      for (const char* key : {"byteOffset", "byteLength", "byteStride"}) whole(view, key);
      extension(view, kGltfMeshopt, [&](const Part& packed) { checkMeshopt(packed); });
    });
    if (const json* all = root.find("extensions"); all && all->is_object())
      object({*all, "extensions"}, kGltfLights, [&](const Part& lights) {
        each(lights, "lights", [&](const Part& light) { checkLight(light); });
      });
    checkWhatIsNotRead();
    warnings.report(messages_);
  }

 private:
  // --- the file ---

  void checkVersion() const {
    const json* asset = root.find("asset");
    if (!asset || !asset->is_object()) fail("expected an object \"asset\" with the version");
    const auto version = [&](const char* key) -> double {
      const json* value = Part{*asset, ""}.find(key);
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
    for (const std::string& name : names("extensionsRequired"))
      if (!isOneOf(name, kRead))
        fail("the file requires the extension " + inQuotes(name) + ", which is not read",
             "export the scene without it");
    std::string others;
    for (const std::string& name : names("extensionsUsed"))
      if (!isOneOf(name, kRead)) others += (others.empty() ? "" : ", ") + inQuotes(name);
    if (!others.empty()) warn("extensions that are not read: " + others.substr(0, 400));
  }
  std::vector<std::string> names(std::string_view key) const {
    std::vector<std::string> all;
    const json* list = root.find(key);
    if (!list) return all;
    if (!list->is_array()) fail(std::string(key) + ": expected a list of names, found " + found(*list));
    for (const json& name : *list) {
      if (!name.is_string()) fail(std::string(key) + ": expected a list of names, found " + found(name));
      all.push_back(name.get<std::string>());
    }
    return all;
  }

  void checkNode(const Part& node) {
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
    extension(node, kGltfLights, [&](const Part& light) { index(light, "light", "lights"); });
    extension(node, "EXT_mesh_gpu_instancing", [&](const Part& copies) {
      known(copies, {"attributes"});
      object(copies, "attributes", [&](const Part& attributes) {
        for (const auto& [key, value] : attributes.value.items()) {
          checkIndex(value, attributes.pathOf(key), "accessors");
          if (!key.starts_with('_') && key != "TRANSLATION" && key != "ROTATION" && key != "SCALE")
            warn("unknown attribute " + inQuotes(key) + " of " + attributes.path + " is ignored", {},
                 "unknown " + key.substr(0, 60));
        }
      });
    });
  }

  void checkAnimation(const Part& animation) {
    known(animation, {"channels", "samplers"});
    each(animation, "samplers", [&](const Part& sampler) {
      known(sampler, {"input", "interpolation", "output"});
      for (const char* key : {"input", "output"}) {
        if (!sampler.find(key)) fail(sampler.pathOf(key) + ": expected the number of an accessor");
        index(sampler, key, "accessors");
      }
      word(sampler, "interpolation", {"LINEAR", "STEP", "CUBICSPLINE"});
    });
    const json* samplers = animation.find("samplers");
    each(animation, "channels", [&](const Part& channel) {
      known(channel, {"sampler", "target"});
      const json* sampler = channel.find("sampler");
      if (!sampler || !sampler->is_number_unsigned() || !samplers ||
          sampler->get<std::uint64_t>() >= samplers->size())
        fail(channel.pathOf("sampler") + ": expected a number of one of its samplers");
      object(channel, "target", [&](const Part& target) {
        known(target, {"node", "path"});
        index(target, "node", "nodes");
        const json* path = target.find("path");
        if (path && *path != "pointer") word(target, "path", {"translation", "rotation", "scale", "weights"});
      });
    });
  }

  void checkPrimitive(const Part& primitive) {
    known(primitive, {"attributes", "indices", "material", "mode", "targets"});
    index(primitive, "material", "materials");
    index(primitive, "indices", "accessors");
    if (const json* mode = primitive.find("mode"))
      if (!mode->is_number_unsigned() || mode->get<std::uint64_t>() > 6)
        fail(primitive.pathOf("mode") + ": expected 0 to 6, found " + found(*mode));
    const json* attributes = primitive.find("attributes");
    if (!attributes || !attributes->is_object()) fail(primitive.path + ": expected an object \"attributes\"");
    const Part of{*attributes, primitive.pathOf("attributes")};
    for (const auto& [key, value] : attributes->items()) checkIndex(value, of.pathOf(key), "accessors");
    knownAttributes(of);
    if (!of.find("POSITION"))
      warn(primitive.path + " has no POSITION: there is nothing to see of it", {}, "no POSITION");
    extension(primitive, kGltfDraco, [&](const Part& packed) { checkDraco(packed, of); });
    each(primitive, "targets", [&](const Part& target) {
      for (const auto& [key, value] : target.value.items()) {
        checkIndex(value, target.pathOf(key), "accessors");
        const bool isShown = key == "POSITION" || key == "NORMAL" || key == "TANGENT" || key.starts_with('_');
        if (!isShown)
          warn("morph targets of " + inQuotes(key) + " are not shown", {}, "morph " + key.substr(0, 60));
      }
    });
  }
  /// Sets are counted, as in TEXCOORD_1, and programs may add names that begin with _.
  void knownAttributes(const Part& attributes) {
    constexpr std::string_view kNames[] = {"POSITION", "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                           "COLOR_0",  "JOINTS_0", "WEIGHTS_0"};
    for (const auto& [key, value] : attributes.value.items()) {
      if (key.starts_with('_')) continue;
      const std::size_t digits = key.find_last_not_of("0123456789") + 1;
      const bool counted = digits < key.size() && key.substr(0, digits).ends_with('_');
      if (key.starts_with("COLOR_") && key != "COLOR_0" && counted)
        warn(attributes.pathOf(key) + " is not shown: only COLOR_0 is", {}, "more colours");
      if (isOneOf(counted ? key.substr(0, digits) + "0" : key, kNames)) continue;
      warn("unknown attribute " + inQuotes(key) + " of " + attributes.path + " is ignored",
           didYouMean(key, kNames), "unknown " + key.substr(0, 60));
    }
  }
  void checkDraco(const Part& packed, const Part& attributes) {
    known(packed, {"bufferView", "attributes"});
    required(packed, "bufferView", "the number of a buffer view");
    index(packed, "bufferView", "bufferViews");
    required(packed, "attributes", "an object");
    object(packed, "attributes", [&](const Part& numbers) {
      for (const auto& [key, value] : numbers.value.items()) {
        whole(numbers, key);
        if (!attributes.find(key))
          warn(numbers.pathOf(key) + " is ignored, since the primitive has no such attribute", {},
               "compressed " + key.substr(0, 60));
      }
    });
  }
  void checkMeshopt(const Part& packed) {
    known(packed, {"buffer", "byteOffset", "byteLength", "byteStride", "count", "mode", "filter"});
    required(packed, "buffer", "the number of a buffer");
    index(packed, "buffer", "buffers");
    for (const char* key : {"byteLength", "byteStride", "count"}) {
      required(packed, key, "a whole number");
      whole(packed, key, 1);
    }
    whole(packed, "byteOffset");
    for (const char* key : {"byteOffset", "byteLength", "byteStride", "count"})  // tinygltf keeps an int
      if (const json* value = packed.find(key); value && value->get<std::uint64_t>() > kMostWhole)
        fail(packed.pathOf(key) + ": expected at most " + std::to_string(kMostWhole) + ", found " +
             found(*value));
    required(packed, "mode", "ATTRIBUTES, TRIANGLES or INDICES");
    word(packed, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    word(packed, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
  }
  static constexpr std::uint64_t kMostWhole = std::numeric_limits<int>::max();
  void required(const Part& owner, std::string_view key, const char* expected) const {
    if (!owner.find(key)) fail(owner.pathOf(key) + ": expected " + expected + ", found none");
  }

  void checkAccessor(const Part& accessor) {
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

  void checkCamera(const Part& camera) {
    word(camera, "type", {"perspective", "orthographic"});
    object(camera, "perspective", [&](const Part& p) {
      known(p, {"aspectRatio", "yfov", "zfar", "znear"});
      for (const char* key : {"aspectRatio", "yfov", "zfar", "znear"}) number(p, key, 0);
    });
  }

  void checkLight(const Part& light) {
    known(light, {"color", "intensity", "type", "range", "spot"});
    if (!light.find("type")) fail(light.path + ": expected a type, as in \"point\"");
    word(light, "type", {"directional", "point", "spot"});
    numbers(light, "color", 3, 0);
    number(light, "intensity", 0);
    number(light, "range", 0);
    if (light.find("range"))
      warn(light.pathOf("range") + " is ignored: it lights objects farther away too", {}, "range of lights");
    object(light, "spot", [&](const Part& spot) {
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

  void checkWhatIsNotRead() {
    if (const std::size_t n = countOf("scenes"); n > 1)
      warn("one scene is shown; others are left out: " + std::to_string(n - 1));
    if (const std::size_t n = countOf("animations"); n > 1)
      warn("the first animation is played; others are left out: " + std::to_string(n - 1));
  }

  Messages& messages_;
};

}  // namespace

void checkGltf(const json& root, const SourcePlace& place, Messages& messages) {
  GltfCheck(root, place, messages).check();
}

}  // namespace trace
