// The elements of an accessor of a glTF file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "base/error.h"
#include "formats/mesh/gltf_values.h"

namespace trace {

/// The elements of an accessor, checked to lie inside their buffer.
class GltfElements {
 public:
  GltfElements(const tinygltf::Model& model, int index, const Place& place) {
    const auto fail = [&](const char* what) {
      throw Error(Fault::scene, place, "accessor " + std::to_string(index) + ": " + what);
    };
    if (!isIndex(index, model.accessors.size())) fail("there is none");
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (accessor.sparse.isSparse) fail("sparse accessors are not read yet");
    if (!isIndex(accessor.bufferView, model.bufferViews.size())) fail("expected a buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    if (!isIndex(view.buffer, model.buffers.size())) fail("expected a view of a buffer");
    const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;

    type_ = accessor.componentType;
    normalized_ = accessor.normalized;
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type_));
    if (components < 1 || components > 4 || size < 1 || size > 4) fail("expected a scalar or a vector");
    components_ = static_cast<std::size_t>(components);
    size_ = static_cast<std::size_t>(size);
    stride_ = view.byteStride ? view.byteStride : components_ * size_;
    count_ = accessor.count;
    const bool viewFits = view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
    if (!viewFits || accessor.byteOffset > view.byteLength) fail("its buffer view is longer than the buffer");
    const std::size_t room = view.byteLength - accessor.byteOffset;
    if (count_ > 0 && (room < components_ * size_ || (room - components_ * size_) / stride_ < count_ - 1))
      fail("it is longer than its buffer view");
    first_ = data.data() + view.byteOffset + accessor.byteOffset;
  }

  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  std::size_t bytes() const { return count_ * components_ * size_; }

  double number(std::size_t i, std::size_t component) const {
    const unsigned char* from = first_ + i * stride_ + component * size_;
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_BYTE: return whole<std::int8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return whole<std::uint8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_SHORT: return whole<std::int16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return whole<std::uint16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_INT: return whole<std::int32_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return whole<std::uint32_t>(from);
    }
    return load<float>(from);
  }
  Vec3f vector(std::size_t i) const { return Vec3f(Vec3{number(i, 0), number(i, 1), number(i, 2)}); }

 private:
  template <class T>
  static T load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  template <class T>
  double whole(const unsigned char* from) const {
    const double value = load<T>(from);
    return normalized_ ? std::max(value / std::numeric_limits<T>::max(), -1.0) : value;
  }

  const unsigned char* first_ = nullptr;
  std::size_t count_ = 0, components_ = 1, size_ = 1, stride_ = 1;
  int type_ = 0;
  bool normalized_ = false;
};

}  // namespace trace
