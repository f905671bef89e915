// Sources: Khronos Group, KHR_draco_mesh_compression and EXT_meshopt_compression.
#include "formats/mesh/gltf/gltf_unpack.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "formats/mesh/gltf/document/gltf_values.h"
#include "formats/mesh/gltf/draco.h"
#include "formats/mesh/gltf/meshopt.h"
#include "formats/warnings.h"

namespace trace {
namespace {

using tinygltf::Accessor, tinygltf::BufferView, tinygltf::Primitive;

class GltfUnpacker {
 public:
  GltfUnpacker(tinygltf::Model& model, const SourcePlace& place) : model_(model), place_(place) {
    for (const tinygltf::Buffer& buffer : model.buffers) allowance_ += kMostUses * buffer.data.size();
  }

  void unpack(Messages& messages) {
    lostViews_.resize(model_.bufferViews.size());
    for (std::size_t i = 0; i < lostViews_.size(); ++i) unpackView(i);
    dropUsersOfLostViews();
    for (std::size_t i = 0; i < model_.meshes.size(); ++i)
      for (std::size_t k = 0; k < model_.meshes[i].primitives.size(); ++k)
        unpackPrimitive(model_.meshes[i].primitives[k],
                        "meshes[" + std::to_string(i) + "].primitives[" + std::to_string(k) + "]");
    if (!firstLoss_.empty() && !hasMeshes()) throw Error(Fault::scene, place_, firstLoss_);
    warnings_.report(messages);
  }

 private:
  /// The number of times that the same compressed bytes may be named.
  static constexpr std::uint64_t kMostUses = 100;

  // --- EXT_meshopt_compression ---

  void unpackView(std::size_t number) {
    BufferView& view = model_.bufferViews[number];
    const tinygltf::ExtensionMap& extensions = view.extensions;
    if (!extensions.contains(kGltfMeshopt)) return;
    const auto size = [&](const char* field, double otherwise) {
      return static_cast<std::size_t>(extension(extensions, kGltfMeshopt, field, otherwise));
    };
    const auto word = [&](const char* field, const char* otherwise) {
      const tinygltf::Value* value = extensionValue(extensions, kGltfMeshopt, field);
      return value && value->IsString() ? value->Get<std::string>() : std::string(otherwise);
    };
    const std::string mode = word("mode", "ATTRIBUTES"), filter = word("filter", "NONE");
    try {
      const int from = wholeOf(extension(extensions, kGltfMeshopt, "buffer", -1));
      view.buffer = addBuffer(decodeMeshopt(bytesOf(from, size("byteOffset", 0), size("byteLength", 0)),
                                            {mode, filter, size("count", 0), size("byteStride", 0)}));
      view.byteOffset = 0;
      view.byteLength = model_.buffers.back().data.size();
    } catch (const std::runtime_error& reason) {
      lostViews_[number] = true;
      view.byteLength = 0;
      lose("bufferViews[" + std::to_string(number) + "]", kGltfMeshopt, reason.what(),
           "; meshes that use it are left out");
    }
  }

  bool isLost(int accessor) const {
    if (!isIndex(accessor, model_.accessors.size())) return false;
    const Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
    const auto lost = [&](int view) {
      return isIndex(view, lostViews_.size()) && lostViews_[static_cast<std::size_t>(view)];
    };
    return lost(a.bufferView) ||
           (a.sparse.isSparse && (lost(a.sparse.indices.bufferView) || lost(a.sparse.values.bufferView)));
  }

  void dropUsersOfLostViews() {
    if (std::find(lostViews_.begin(), lostViews_.end(), true) == lostViews_.end()) return;
    const auto anyLost = [&](const std::map<std::string, int>& accessors) {
      return std::any_of(accessors.begin(), accessors.end(),
                         [&](const auto& named) { return isLost(named.second); });
    };
    for (tinygltf::Mesh& mesh : model_.meshes)
      for (Primitive& primitive : mesh.primitives)
        if (isLost(primitive.indices) || anyLost(primitive.attributes) ||
            std::any_of(primitive.targets.begin(), primitive.targets.end(), anyLost))
          drop(primitive);
    for (tinygltf::Node& node : model_.nodes) {
      const bool isBent = isIndex(node.skin, model_.skins.size()) &&
                          isLost(model_.skins[static_cast<std::size_t>(node.skin)].inverseBindMatrices);
      const tinygltf::Value* copies =
          extensionValue(node.extensions, "EXT_mesh_gpu_instancing", "attributes");
      bool isCopied = false;
      if (copies && copies->IsObject())
        for (const std::string& name : copies->Keys()) isCopied |= isLost(copies->Get(name).GetNumberAsInt());
      if (isBent || isCopied) node.mesh = -1;
    }
  }

  // --- KHR_draco_mesh_compression ---

  void unpackPrimitive(Primitive& primitive, const std::string& path) {
    const tinygltf::Value* numbers = extensionValue(primitive.extensions, kGltfDraco, "attributes");
    if (!numbers || !numbers->IsObject() || primitive.attributes.empty()) return;
    std::vector<DracoAttribute> wanted;
    std::vector<std::string> names;
    bool hasCopy = hasData(primitive.indices);  // uncompressed
    try {
      for (const auto& [name, accessor] : primitive.attributes) {
        if (!numbers->Has(name) || !isIndex(accessor, model_.accessors.size())) continue;
        hasCopy = hasCopy && hasData(accessor);
        names.push_back(name);
        wanted.push_back(dracoAttribute(numbers->Get(name), accessor));
      }
      if (hasCopy) return;
      const int number = wholeOf(extension(primitive.extensions, kGltfDraco, "bufferView", -1));
      if (!isIndex(number, model_.bufferViews.size())) throw std::runtime_error("it has no buffer view");
      const BufferView& view = model_.bufferViews[static_cast<std::size_t>(number)];
      DracoMesh mesh = decodeDraco(bytesOf(view.buffer, view.byteOffset, view.byteLength), wanted);
      for (std::size_t i = 0; i < names.size(); ++i) {
        int& accessor = primitive.attributes[names[i]];
        accessor = addAccessor(model_.accessors[static_cast<std::size_t>(accessor)], mesh.points,
                               std::move(mesh.values[i]));
      }
      std::vector<unsigned char> corners(mesh.corners.size() * sizeof(std::uint32_t));
      if (!corners.empty()) std::memcpy(corners.data(), mesh.corners.data(), corners.size());
      Accessor indices;
      indices.type = TINYGLTF_TYPE_SCALAR;
      indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
      primitive.indices = addAccessor(indices, mesh.corners.size(), std::move(corners));
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
    } catch (const std::runtime_error& reason) {
      lose(path, kGltfDraco, reason.what(), "; it is left out");
      drop(primitive);
    }
  }

  bool hasData(int accessor) const {
    return isIndex(accessor, model_.accessors.size()) &&
           model_.accessors[static_cast<std::size_t>(accessor)].bufferView >= 0;
  }

  DracoAttribute dracoAttribute(const tinygltf::Value& number, int accessor) const {
    const Accessor& as = model_.accessors[static_cast<std::size_t>(accessor)];
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(as.type));
    if (components < 1 || components > 4)
      throw std::runtime_error("expected accessors of scalars or vectors");
    return {static_cast<std::uint32_t>(wholeOf(number.GetNumberAsDouble())), numberOf(as.componentType),
            static_cast<std::size_t>(components)};
  }
  static DracoNumber numberOf(int componentType) {
    switch (componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE: return DracoNumber::int8;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return DracoNumber::uint8;
      case TINYGLTF_COMPONENT_TYPE_SHORT: return DracoNumber::int16;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return DracoNumber::uint16;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return DracoNumber::uint32;
    }
    return DracoNumber::float32;
  }

  // --- both ---

  std::string_view bytesOf(int buffer, std::size_t offset, std::size_t length) {
    lookAtBudget();
    if (!isIndex(buffer, model_.buffers.size())) throw std::runtime_error("it has no buffer");
    const auto& data = model_.buffers[static_cast<std::size_t>(buffer)].data;
    if (offset > data.size() || length > data.size() - offset)
      throw std::runtime_error("the compressed data end behind their buffer");
    if (length > allowance_)
      throw Error(Fault::scene, place_, "the same compressed data are used too often, more than 100 times");
    allowance_ -= length;
    return {reinterpret_cast<const char*>(data.data()) + offset, length};
  }

  int addBuffer(std::vector<unsigned char> data) {
    model_.buffers.emplace_back();
    model_.buffers.back().data = std::move(data);
    return static_cast<int>(model_.buffers.size()) - 1;
  }

  /// The number of a new one like that, whose elements lie side by side in the data.
  int addAccessor(Accessor like, std::size_t count, std::vector<unsigned char> data) {
    BufferView view;
    view.byteLength = data.size();
    view.buffer = addBuffer(std::move(data));
    model_.bufferViews.push_back(view);
    like.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    like.byteOffset = 0;
    like.count = count;
    model_.accessors.push_back(std::move(like));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  void lose(const std::string& path, const char* extension, const std::string& reason, const char* then) {
    const std::string what = path + ": cannot be decompressed (" + extension + "): " + reason;
    if (firstLoss_.empty()) firstLoss_ = what;
    warnings_.warn(place_, what + then, {}, extension);
  }
  static void drop(Primitive& primitive) {
    primitive.attributes.clear();
    primitive.targets.clear();
    primitive.indices = -1;
  }
  bool hasMeshes() const {
    for (const tinygltf::Node& node : model_.nodes)
      if (isIndex(node.mesh, model_.meshes.size()))
        for (const Primitive& primitive : model_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
          if (primitive.attributes.contains("POSITION")) return true;
    return false;
  }

  tinygltf::Model& model_;
  const SourcePlace& place_;
  WarningsByKind warnings_;
  std::uint64_t allowance_ = 1 << 20;  ///< bytes of compressed data that may still be read
  std::vector<bool> lostViews_;
  std::string firstLoss_;  ///< what is wrong with the first part that cannot be decoded
};

}  // namespace

void unpackGltf(tinygltf::Model& model, const SourcePlace& place, Messages& messages) {
  GltfUnpacker(model, place).unpack(messages);
}

}  // namespace trace
