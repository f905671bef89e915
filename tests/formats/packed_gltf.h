// A curved patch as glTF: as it is, and compressed by Draco and meshoptimizer, whose encoders only tests
// need.
#pragma once

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "gltf_square.h"

namespace trace::test {

inline constexpr const char *kDracoName = "KHR_draco_mesh_compression",
                            *kMeshoptName = "EXT_meshopt_compression";

/// Values of an attribute, point by point.
struct PatchAttribute {
  int componentType = 5126;  ///< of the accessor
  std::size_t components = 3;
  bool normalized = false;
  std::string bytes;

  std::size_t size() const { return bytes.size() / points; }
  std::size_t points = 1;
};

template <class T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A square of `side` times `side` points on a wave, with all attributes that Trace shows.
struct Patch {
  explicit Patch(int side = 5) : side_(side) {
    std::vector<float> places, normals, uvs, weights;
    std::vector<std::uint8_t> colors, joints;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float u = static_cast<float>(x) / static_cast<float>(side - 1),
                    v = static_cast<float>(y) / static_cast<float>(side - 1);
        places.insert(places.end(), {u, v, 0.25f * std::sin(3 * u) * v});
        const float slopeX = 0.75f * std::cos(3 * u) * v, slopeY = 0.25f * std::sin(3 * u);
        const float length = std::sqrt(1 + slopeX * slopeX + slopeY * slopeY);
        normals.insert(normals.end(), {-slopeX / length, -slopeY / length, 1 / length});
        uvs.insert(uvs.end(), {u, 1 - v});
        weights.insert(weights.end(), {1 - u, u, 0, 0});
        colors.insert(colors.end(), {static_cast<std::uint8_t>(17 * x), static_cast<std::uint8_t>(31 * y),
                                     static_cast<std::uint8_t>(200 - x * y), 255});
        joints.insert(joints.end(), {0, 1, 0, 0});
      }
    for (int y = 0; y + 1 < side; ++y)
      for (int x = 0; x + 1 < side; ++x) {
        const auto at = [&](int i, int k) { return static_cast<std::uint32_t>((y + k) * side + x + i); };
        corners.insert(corners.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
      }
    add("POSITION", 5126, 3, false, bytesOf(places));
    add("NORMAL", 5126, 3, false, bytesOf(normals));
    add("TEXCOORD_0", 5126, 2, false, bytesOf(uvs));
    add("COLOR_0", 5121, 4, true, bytesOf(colors));
    add("JOINTS_0", 5121, 4, false, bytesOf(joints));
    add("WEIGHTS_0", 5126, 4, false, bytesOf(weights));
  }

  std::size_t points() const { return static_cast<std::size_t>(side_ * side_); }
  void add(const std::string& name, int componentType, std::size_t components, bool normalized,
           std::string bytes) {
    attributes[name] = {componentType, components, normalized, std::move(bytes), points()};
  }

  std::map<std::string, PatchAttribute> attributes;
  std::vector<std::uint32_t> corners;

 private:
  int side_;
};

inline const char* typeOf(std::size_t components) {
  const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kTypes[components - 1];
}

/// A square whose primitive has the attributes of the patch, and no bytes behind them yet.
inline Square patchWithoutData(const Patch& patch) {
  Square square;
  square.primitive()["attributes"] = json::object();
  for (const auto& [name, a] : patch.attributes) {
    square.primitive()["attributes"][name] = square.root["accessors"].size();
    square.root["accessors"].push_back({{"componentType", a.componentType},
                                        {"count", a.points},
                                        {"type", typeOf(a.components)},
                                        {"normalized", a.normalized}});
  }
  square.primitive()["indices"] = square.root["accessors"].size();
  square.root["accessors"].push_back(
      {{"componentType", 5125}, {"count", patch.corners.size()}, {"type", "SCALAR"}});
  return square;
}

inline json& accessorOf(Square& square, const std::string& attribute) {
  const json& number =
      attribute == "indices" ? square.primitive()["indices"] : square.primitive()["attributes"][attribute];
  return square.root["accessors"][number.get<std::size_t>()];
}

/// The number of a new view of bytes in the square's buffer.
inline std::size_t addView(Square& square, const std::string& bytes) {
  square.bytes(bytes, 5121, static_cast<int>(bytes.size()), "SCALAR");
  square.root["accessors"].erase(square.root["accessors"].size() - 1);
  return square.root["bufferViews"].size() - 1;
}

inline Square plainPatch(const Patch& patch) {
  Square square = patchWithoutData(patch);
  for (const auto& [name, a] : patch.attributes)
    accessorOf(square, name)["bufferView"] = addView(square, a.bytes);
  accessorOf(square, "indices")["bufferView"] = addView(square, bytesOf(patch.corners));
  return square;
}

// --- Draco -------------------------------------------------------------------------------------------------

struct Dracoed {
  std::string bytes;
  std::map<std::string, int> ids;
};

/// `bits` of each component; 0 leaves floats as they are.
inline Dracoed dracoOf(const Patch& patch, bool edgebreaker, int bits) {
  using draco::GeometryAttribute;
  const std::map<std::string, GeometryAttribute::Type> kinds{{"POSITION", GeometryAttribute::POSITION},
                                                             {"NORMAL", GeometryAttribute::NORMAL},
                                                             {"TEXCOORD_0", GeometryAttribute::TEX_COORD},
                                                             {"COLOR_0", GeometryAttribute::COLOR}};
  draco::Mesh mesh;
  const auto points = static_cast<std::uint32_t>(patch.points());
  mesh.set_num_points(points);
  Dracoed result;
  std::vector<std::pair<int, bool>> added;
  for (const auto& [name, a] : patch.attributes) {
    GeometryAttribute attribute;
    const auto kind = kinds.find(name);
    attribute.Init(kind == kinds.end() ? GeometryAttribute::GENERIC : kind->second, nullptr,
                   static_cast<std::int8_t>(a.components),
                   a.componentType == 5126 ? draco::DT_FLOAT32 : draco::DT_UINT8, a.normalized,
                   static_cast<std::int64_t>(a.size()), 0);
    const int number = mesh.AddAttribute(attribute, true, points);
    for (std::uint32_t i = 0; i < points; ++i)
      mesh.attribute(number)->SetAttributeValue(draco::AttributeValueIndex(i), a.bytes.data() + i * a.size());
    result.ids[name] = static_cast<int>(mesh.attribute(number)->unique_id());
    added.emplace_back(number, a.componentType == 5126);
  }
  for (std::size_t i = 0; i < patch.corners.size(); i += 3)
    mesh.AddFace({draco::PointIndex(patch.corners[i]), draco::PointIndex(patch.corners[i + 1]),
                  draco::PointIndex(patch.corners[i + 2])});
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  for (const auto& [number, isFloat] : added)
    if (isFloat && bits > 0) encoder.SetAttributeQuantization(number, bits);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) throw std::runtime_error("Draco cannot encode the patch");
  result.bytes.assign(buffer.data(), buffer.size());
  return result;
}

/// The patch with these compressed bytes as its mesh.
inline Square dracoPatch(const Patch& patch, const Dracoed& draco) {
  Square square = patchWithoutData(patch);
  square.root["extensionsUsed"] = square.root["extensionsRequired"] = {kDracoName};
  square.primitive()["extensions"][kDracoName] = {{"bufferView", addView(square, draco.bytes)},
                                                  {"attributes", draco.ids}};
  return square;
}

// --- meshoptimizer -----------------------------------------------------------------------------------------

inline std::string meshoptVertices(const std::string& bytes, std::size_t stride) {
  const std::size_t count = bytes.size() / stride;
  std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                           bytes.data(), count, stride));
  return packed;
}
inline std::string meshoptTriangles(const std::vector<std::uint32_t>& corners, std::size_t points) {
  std::string packed(meshopt_encodeIndexBufferBound(corners.size(), points), '\0');
  packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                          corners.data(), corners.size()));
  return packed;
}
inline std::string meshoptIndices(const std::vector<std::uint32_t>& corners, std::size_t points) {
  std::string packed(meshopt_encodeIndexSequenceBound(corners.size(), points), '\0');
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                            corners.data(), corners.size()));
  return packed;
}

/// The number of a new view of compressed bytes. What programs without the extension would read is not there.
inline std::size_t addMeshoptView(Square& square, const std::string& packed, const char* mode,
                                  std::size_t count, std::size_t stride, const char* filter = "NONE") {
  const std::size_t number = addView(square, packed);
  json& view = square.root["bufferViews"][number];
  json extension = {{"buffer", 0},
                    {"byteOffset", view["byteOffset"]},
                    {"byteLength", packed.size()},
                    {"byteStride", stride},
                    {"count", count},
                    {"mode", mode},
                    {"filter", filter}};
  view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}};
  if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"][kMeshoptName] = std::move(extension);
  square.root["extensionsUsed"] = square.root["extensionsRequired"] = {kMeshoptName};
  return number;
}

/// Gives the file its two buffers, of which the second is only a name for decoded bytes. To be called last.
inline Square& withFallback(Square& square) {
  square.root["buffers"] = {
      {{"byteLength", square.data().size()}},
      {{"byteLength", std::size_t{1} << 30}, {"extensions", {{kMeshoptName, {{"fallback", true}}}}}}};
  return square;
}

/// Every attribute as it is, and triangles of whole numbers of that many bytes.
inline Square meshoptPatch(const Patch& patch, const char* mode, std::size_t indexBytes) {
  Square square = patchWithoutData(patch);
  for (const auto& [name, a] : patch.attributes)
    accessorOf(square, name)["bufferView"] =
        addMeshoptView(square, meshoptVertices(a.bytes, a.size()), "ATTRIBUTES", a.points, a.size());
  const bool isTriangles = std::string(mode) == "TRIANGLES";
  json& indices = accessorOf(square, "indices");
  indices["componentType"] = indexBytes == 2 ? 5123 : 5125;
  indices["bufferView"] = addMeshoptView(square,
                                         isTriangles ? meshoptTriangles(patch.corners, patch.points())
                                                     : meshoptIndices(patch.corners, patch.points()),
                                         mode, patch.corners.size(), indexBytes);
  return withFallback(square);
}

}  // namespace trace::test
