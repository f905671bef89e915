// Vertices and indices that meshoptimizer compressed.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace trace {

/// A compressed buffer view, in the words of EXT_meshopt_compression.
struct MeshoptView {
  std::string_view mode = "ATTRIBUTES";  ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string_view filter = "NONE";      ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
  std::size_t count = 0, stride = 0;     ///< number of elements, and bytes of each
};

/// `count` times `stride` bytes. Throws std::runtime_error with the reason if the bytes do not hold so many
/// elements, or mode, filter and stride do not fit together; std::bad_alloc.
std::vector<unsigned char> decodeMeshopt(std::string_view bytes, const MeshoptView& view);

}  // namespace trace
