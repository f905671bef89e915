// Meshes that Google's Draco compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace trace {

enum class DracoNumber { int8, uint8, int16, uint16, uint32, float32 };

/// An attribute by its number in the compressed data, and how its values are wanted.
struct DracoAttribute {
  std::uint32_t id = 0;
  DracoNumber number = DracoNumber::float32;
  std::size_t components = 3;
};

struct DracoMesh {
  std::size_t points = 0;
  std::vector<std::uint32_t> corners;              ///< three a triangle, below `points`
  std::vector<std::vector<unsigned char>> values;  ///< values of each requested attribute, point by point
};

/// The triangles in the bytes. Throws std::runtime_error with the reason if they are not a sound mesh with
/// those attributes, or claim to hold more triangles than so many bytes can; std::bad_alloc.
DracoMesh decodeDraco(std::string_view bytes, std::span<const DracoAttribute> attributes);

}  // namespace trace
