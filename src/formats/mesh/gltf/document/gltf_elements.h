// The elements of an accessor of a glTF file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formats/mesh/gltf/document/gltf_values.h"

namespace trace {

/// The elements of an accessor, checked to lie inside their buffer.
class GltfElements {
 public:
  GltfElements(const tinygltf::Model& model, int index, const SourcePlace& place) {
    const auto fail = [&](const char* what) {
      throw Error(Fault::scene, place, "accessor " + std::to_string(index) + ": " + what);
    };
    if (!isIndex(index, model.accessors.size())) fail("there is none");
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    type_ = accessor.componentType;
    normalized_ = accessor.normalized;
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type_));
    const bool isMatrix = accessor.type == TINYGLTF_TYPE_MAT4;
    if (components < 1 || (components > 4 && !isMatrix) || size < 1 || size > 4)
      fail("expected a scalar, a vector or a matrix of 4 x 4");
    components_ = static_cast<std::size_t>(components);
    size_ = static_cast<std::size_t>(size);
    stride_ = components_ * size_;
    count_ = accessor.count;
    const bool isSparse = accessor.sparse.isSparse;
    if (accessor.bufferView >= 0) {
      const std::size_t step = stride_;
      first_ = elements(model, accessor.bufferView, accessor.byteOffset, count_, step, stride_, fail);
    } else if (count_ > kMostZeros) {
      fail("an accessor without a buffer view has at most 2^24 elements");
    } else if (!isSparse) {  // section 3.6.2.2
      own_ = std::make_shared<const std::vector<unsigned char>>(count_ * stride_);
      first_ = own_->data();
    }
    if (isSparse) setSparse(model, accessor.sparse, fail);
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
  static constexpr std::size_t kMostZeros = std::size_t{1} << 24;

  /// Where `count` elements of `size` bytes begin in a buffer view. `stride` becomes that of the view, if it
  /// has one.
  template <class Fail>
  static const unsigned char* elements(const tinygltf::Model& model, int bufferView, std::size_t offset,
                                       std::size_t count, std::size_t size, std::size_t& stride,
                                       const Fail& fail) {
    if (!isIndex(bufferView, model.bufferViews.size())) fail("expected a buffer view");
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(bufferView)];
    if (!isIndex(view.buffer, model.buffers.size())) fail("expected a view of a buffer");
    const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    stride = view.byteStride ? view.byteStride : size;
    const bool viewFits = view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
    if (!viewFits || offset > view.byteLength) fail("its buffer view is longer than the buffer");
    const std::size_t room = view.byteLength - offset;
    if (count > 0 && (room < size || (room - size) / stride < count - 1))
      fail("it is longer than its buffer view");
    return data.data() + view.byteOffset + offset;
  }

  /// Puts the values of the sparse elements over those of the buffer view, or over zeros (section 3.6.2.3).
  template <class Sparse, class Fail>
  void setSparse(const tinygltf::Model& model, const Sparse& sparse, const Fail& fail) {
    const std::size_t size = components_ * size_;
    const int type = sparse.indices.componentType;
    const int indexBytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    const bool isIndexType = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!isIndexType || sparse.count < 0) fail("expected sparse indices of a whole type");
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto indexSize = static_cast<std::size_t>(indexBytes);
    std::size_t indexStride = indexSize, valueStride = size;
    const unsigned char* const indices =
        elements(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                 indexSize, indexStride, fail);
    const unsigned char* const values =
        elements(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                 size, valueStride, fail);
    auto own = std::make_shared<std::vector<unsigned char>>(count_ * size);
    for (std::size_t i = 0; first_ && i < count_; ++i)
      std::memcpy(own->data() + i * size, first_ + i * stride_, size);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;
      for (std::size_t byte = indexSize; byte-- > 0;) index = index << 8 | indices[i * indexStride + byte];
      if (index >= count_) fail("a sparse index is beyond its elements");
      std::memcpy(own->data() + index * size, values + i * valueStride, size);
    }
    first_ = own->data();
    stride_ = size;
    own_ = std::move(own);
  }

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

  std::shared_ptr<const std::vector<unsigned char>> own_;  ///< values of a sparse accessor
  const unsigned char* first_ = nullptr;
  std::size_t count_ = 0, components_ = 1, size_ = 1, stride_ = 1;
  int type_ = 0;
  bool normalized_ = false;
};

}  // namespace trace
