// Sources: Khronos Group, glTF 2.0 Specification, sections 3.8 and 3.9, and the extensions named below; RFC
// 3986, section 2.1.
#include "formats/mesh/gltf/gltf_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "formats/mesh/gltf/document/gltf_numbers.h"
#include "formats/mesh/gltf/document/gltf_values.h"
#include "formats/mesh/gltf/gltf_material.h"
#include "math/elementary.h"
#include "shading/materials/principled.h"
#include "shading/textures/image_map.h"

namespace trace {
namespace {

using namespace gltf_extension;

/// "%20" as a blank, and so on.
std::string decodedUri(std::string_view uri) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    const int code = coded ? 16 * digit(uri[i + 1]) + digit(uri[i + 2]) : 0;
    text += code > 0 ? static_cast<char>(code) : uri[i];
    if (code > 0) i += 2;
  }
  return text;
}

/// A texture that an extension of a material names.
tinygltf::TextureInfo textureIn(const tinygltf::Material& from, const char* extension, const char* field) {
  tinygltf::TextureInfo info;
  const tinygltf::Value* said = extensionValue(from.extensions, extension, field);
  if (!said) return info;
  const auto whole = [&](const char* key, int otherwise) {
    return said->Has(key) && said->Get(key).IsNumber() ? said->Get(key).GetNumberAsInt() : otherwise;
  };
  info.index = whole("index", -1);
  info.texCoord = whole("texCoord", 0);
  if (said->Has("extensions") && said->Get("extensions").IsObject())
    info.extensions = said->Get("extensions").Get<tinygltf::Value::Object>();
  return info;
}

/// T R S of KHR_texture_transform, where v grows downward, as Trace sees it.
std::array<Real, 6> placementOf(const Vec2& offset, Real radians, const Vec2& scale) {
  const Real c = radians == 0 ? 1 : math::cos(radians), s = radians == 0 ? 0 : math::sin(radians);
  const Real uu = c * scale.x, uv = s * scale.y, vu = -s * scale.x, vv = c * scale.y;
  return {uu, 0 - uv, uv + offset.x, 0 - vu, vv, 1 - vv - offset.y};
}

void apply(const tinygltf::Sampler& sampler, ImageMap& map) {
  const auto wrap = [](int code) {
    return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
           : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                           : Wrap::repeat;
  };
  map.wrapU = wrap(sampler.wrapS);
  map.wrapV = wrap(sampler.wrapT);
  const int least = sampler.minFilter;
  if (least == TINYGLTF_TEXTURE_FILTER_NEAREST || least == TINYGLTF_TEXTURE_FILTER_LINEAR)
    map.filter = TexelFilter::bilinear;
  if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) map.filter = TexelFilter::nearest;
}

}  // namespace

std::string fileOf(const tinygltf::Image& image) { return decodedUri(image.uri); }

struct GltfLooks::Reader {
  const tinygltf::Model& gltf;
  const SourcePlace place;
  Messages& messages;
  using UvSets = GltfLooks::UvSets;
  std::vector<UvSets> uvSets{};    ///< uv sets of materials
  std::map<int, Pixels> inFile{};  ///< pictures in the file
  InsidePictures inside{};
  UnusedTextures unused{};

  // --- numbers ---

  Material materialOf(const tinygltf::Material& from, bool paints) {
    MetallicRoughness m;
    m.paintsPoints = paints;
    readNumbers(from, m);
    if (!isFinite(m.baseColor) || !isFinite(m.emissive) || !isFinite(m.sheen) || !isFinite(m.specularColor) ||
        !isFinite(m.attenuationColor)) {
      messages.warn(place, "material \"" + from.name + "\" has numbers that are not finite");
      m.baseColor = m.specularColor = m.attenuationColor = Color(1);
      m.emissive = m.sheen = Color();
    }
    readPictures(from, m);
    return checked(from, m, toMaterial(from.name, m));
  }

  /// Tells what the material says and its model has no place for.
  Material checked(const tinygltf::Material& from, const MetallicRoughness& m, Material material) {
    const bool principled = material.model.is<Principled>();
    if (m.metallicRoughnessMap && !principled && !textureOf(material.textures, "roughness"))
      note(from.pbrMetallicRoughness.metallicRoughnessTexture.index);
    const auto lacks = [&](bool has, const char* what) {
      if (has && !principled && !m.unlit)
        messages.warn(place,
                      "material \"" + from.name + "\" transmits light: its " + what + " is not rendered");
    };
    lacks(m.iridescence > 0, "iridescence");
    lacks(m.clearcoat > 0, "clear coat");
    lacks(!isBlack(m.sheen), "sheen");
    return material;
  }

  // --- pictures ---

  void readPictures(const tinygltf::Material& from, MetallicRoughness& m) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    UvSets sets;
    const auto picture = [&](const auto& info) { return pictureOf(info, sets); };
    const auto extra = [&](const char* name, const char* field) {
      return picture(textureIn(from, name, field));
    };
    const bool glossy = m.glossy.has_value();
    m.baseColorMap = glossy ? extra(kGlossiness, "diffuseTexture") : picture(pbr.baseColorTexture);
    if (glossy)
      m.glossyMap = extra(kGlossiness, "specularGlossinessTexture");
    else
      m.metallicRoughnessMap = picture(pbr.metallicRoughnessTexture);
    m.emissiveMap = picture(from.emissiveTexture);
    m.occlusionMap = picture(from.occlusionTexture);
    m.normalMap = picture(from.normalTexture);
    m.iridescenceMap = extra(kIridescence, "iridescenceTexture");
    m.filmMap = extra(kIridescence, "iridescenceThicknessTexture");
    m.clearcoatMap = extra(kClearcoat, "clearcoatTexture");
    m.clearcoatRoughnessMap = extra(kClearcoat, "clearcoatRoughnessTexture");
    if (m.clearcoat > 0) m.clearcoatNormalMap = extra(kClearcoat, "clearcoatNormalTexture");
    if (const tinygltf::Value* map = extensionValue(from.extensions, kClearcoat, "clearcoatNormalTexture");
        map && map->Has("scale") && map->Get("scale").IsNumber())
      m.clearcoatNormalScale = map->Get("scale").GetNumberAsDouble();
    m.sheenMap = extra(kSheen, "sheenColorTexture");
    m.sheenRoughnessMap = extra(kSheen, "sheenRoughnessTexture");
    note(textureIn(from, kAnisotropy, "anisotropyTexture").index);
    note(textureIn(from, kVolume, "thicknessTexture").index);
    m.specularMap = extra(kSpecular, "specularTexture");
    m.specularColorMap = extra(kSpecular, "specularColorTexture");
    m.transmissionMap = extra(kTransmission, "transmissionTexture");
    for (auto* colors : {&m.baseColorMap, &m.emissiveMap, &m.sheenMap, &m.specularColorMap, &m.glossyMap})
      if (*colors) (*colors)->srgb = true;
    m.normalScale = std::isfinite(from.normalTexture.scale) ? from.normalTexture.scale : 1;
    m.occlusionStrength = from.occlusionTexture.strength;
    if (!(m.occlusionStrength >= 0 && m.occlusionStrength <= 1)) m.occlusionStrength = 1;
    if (m.baseColorMap && m.alpha != MetallicRoughness::Alpha::opaque) {
      const Pixels& pixels = m.baseColorMap->file;
      m.hasAlphaMap =
          pixels.map ? pixels.map->hasAlpha() : kindOfPicture(place.file, pixels.file).transparent;
    }
    uvSets.push_back(sets);
  }

  /// Nothing, after a note, where the texture names no picture or needs a third set of coordinates.
  template <class Info>
  std::optional<ImageMap> pictureOf(const Info& info, UvSets& sets) {
    if (info.index < 0) return {};
    const auto& all = info.extensions;
    const int own = wholeOf(extension(all, kTransform, "texCoord", static_cast<double>(info.texCoord)));
    const int image = imageOf(info.index);
    const auto set =
        std::find_if(sets.begin(), sets.end(), [&](const auto& s) { return s.value_or(own) == own; });
    if (image < 0 || set == sets.end()) {
      note(info.index);
      return std::nullopt;
    }
    *set = own;
    ImageMap map = modelPicture(pixelsOf(image));
    map.secondUv = set != sets.begin();
    const int sampler = gltf.textures[static_cast<std::size_t>(info.index)].sampler;
    if (isIndex(sampler, gltf.samplers.size())) apply(gltf.samplers[static_cast<std::size_t>(sampler)], map);
    const Vec2 offset = extensionPair(all, kTransform, "offset", {0, 0}),
               scale = extensionPair(all, kTransform, "scale", {1, 1});
    map.transform = placementOf(offset, extension(all, kTransform, "rotation", 0), scale);
    return map;
  }

  /// The number of its picture: of a WebP one, if it has that too; where it has no other, of one that an
  /// extension names and nobody may be able to read. -1 if it has none.
  int imageOf(int texture) const {
    if (!isIndex(texture, gltf.textures.size())) return -1;
    const tinygltf::Texture& from = gltf.textures[static_cast<std::size_t>(texture)];
    int source = wholeOf(extension(from.extensions, "EXT_texture_webp", "source", -1));
    if (source < 0) source = from.source;
    for (const char* other : {"EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"})
      if (source < 0) source = wholeOf(extension(from.extensions, other, "source", -1));
    return isIndex(source, gltf.images.size()) ? source : -1;
  }

  /// The pixels of a file are loaded later; those of the bytes in this one are decoded now.
  Pixels pixelsOf(int number) {
    const tinygltf::Image& image = gltf.images[static_cast<std::size_t>(number)];
    if (!image.uri.empty()) return {fileOf(image), nullptr, place};
    const auto [found, fresh] = inFile.try_emplace(number);
    if (fresh)
      found->second = inside.decode(std::filesystem::path(place.file.str()).filename().generic_string() +
                                        "#images[" + std::to_string(number) + "]",
                                    {image.name, std::string(bytesOf(image))}, place);
    return found->second;
  }

  std::string_view bytesOf(const tinygltf::Image& image) const {
    const auto text = [](const std::vector<unsigned char>& bytes) {
      return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    if (image.bufferView < 0) return text(image.image);
    const tinygltf::BufferView& view = gltf.bufferViews[static_cast<std::size_t>(image.bufferView)];
    if (!isIndex(view.buffer, gltf.buffers.size())) return {};
    const std::string_view all = text(gltf.buffers[static_cast<std::size_t>(view.buffer)].data);
    return view.byteOffset <= all.size() ? all.substr(view.byteOffset, view.byteLength) : std::string_view();
  }

  /// Notes a texture that is not rendered, by the name of its file or, where it is in this one, by its own.
  void note(int texture) {
    if (texture < 0) return;
    const int number = imageOf(texture);
    const tinygltf::Image* image = number < 0 ? nullptr : &gltf.images[static_cast<std::size_t>(number)];
    if (image && !image->uri.empty()) return unused.note(image->uri, place);
    const std::string name =
        image && !image->name.empty() ? image->name : "texture " + std::to_string(texture);
    unused.note(name + " (inside the file)", place);
  }
};

GltfLooks::GltfLooks(const tinygltf::Model& gltf, const SourcePlace& place, Messages& messages)
    : reader_(std::make_unique<Reader>(Reader{gltf, place, messages})) {}
GltfLooks::~GltfLooks() = default;

std::vector<Material> GltfLooks::materials() {
  const tinygltf::Model& gltf = reader_->gltf;
  std::vector<bool> paints(gltf.materials.size());
  for (const tinygltf::Mesh& mesh : gltf.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      if (isIndex(primitive.material, paints.size()) && primitive.attributes.contains("COLOR_0"))
        paints[static_cast<std::size_t>(primitive.material)] = true;
  std::vector<Material> all;
  for (std::size_t i = 0; i < paints.size(); ++i)
    all.push_back(reader_->materialOf(gltf.materials[i], paints[i]));
  return all;
}

GltfLooks::UvSets GltfLooks::uvSets(int material) const {
  const auto& sets = reader_->uvSets;
  return isIndex(material, sets.size()) ? sets[static_cast<std::size_t>(material)] : UvSets{};
}

void GltfLooks::report() const {
  reader_->unused.report(reader_->messages);
  reader_->inside.report(reader_->messages);
}

}  // namespace trace
