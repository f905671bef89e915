// meshoptimizer's decoder, which only this file sees: it takes numbers that fit together for granted. Source:
// Khronos Group, EXT_meshopt_compression, and its appendix A (bitstream).
#include "formats/mesh/gltf/meshopt.h"

#include <meshoptimizer.h>

#include <stdexcept>
#include <string>

namespace trace {
namespace {

/// Throws if the library would not be safe with these numbers, or no data of so many bytes can hold them.
void checkMeshopt(std::string_view bytes, const MeshoptView& view) {
  const auto refuse = [](const std::string& what) { throw std::runtime_error(what); };
  const bool isAttributes = view.mode == "ATTRIBUTES", isTriangles = view.mode == "TRIANGLES";
  const std::string found = ", found " + std::to_string(view.stride);
  if (isAttributes && (view.stride == 0 || view.stride > 256 || view.stride % 4 != 0))
    refuse("expected a byteStride of 4, 8, 12 ... 256" + found);
  if (!isAttributes && view.stride != 2 && view.stride != 4)
    refuse("expected a byteStride of 2 or 4" + found);
  if (isTriangles && view.count % 3 != 0)
    refuse("expected three indices for each triangle, found a count of " + std::to_string(view.count));
  if (!isAttributes && view.filter != "NONE") refuse("only a view of the mode ATTRIBUTES has a filter");
  if (view.filter == "OCTAHEDRAL" && view.stride != 4 && view.stride != 8)
    refuse("expected a byteStride of 4 or 8 for the filter OCTAHEDRAL" + found);
  if (view.filter == "QUATERNION" && view.stride != 8)
    refuse("expected a byteStride of 8 for the filter QUATERNION" + found);
  // At best, 64 equal bytes of attributes take one, and so do a triangle and an index.
  const double mostPerByte = isAttributes ? 64.0 : static_cast<double>(view.stride) * (isTriangles ? 3 : 1);
  const double size = static_cast<double>(view.count) * static_cast<double>(view.stride);
  if (size > mostPerByte * static_cast<double>(bytes.size()))
    refuse(std::to_string(view.count) + " elements of " + std::to_string(view.stride) +
           " bytes do not fit into " + std::to_string(bytes.size()) + " compressed bytes");
}

}  // namespace

std::vector<unsigned char> decodeMeshopt(std::string_view bytes, const MeshoptView& view) {
  checkMeshopt(bytes, view);
  std::vector<unsigned char> decoded(view.count * view.stride);
  if (decoded.empty()) return decoded;
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  const Decode decode = view.mode == "TRIANGLES" ? static_cast<Decode>(meshopt_decodeIndexBuffer)
                        : view.mode == "INDICES" ? static_cast<Decode>(meshopt_decodeIndexSequence)
                                                 : static_cast<Decode>(meshopt_decodeVertexBuffer);
  if (decode(decoded.data(), view.count, view.stride, from, bytes.size()) != 0)
    throw std::runtime_error("the data are damaged, or of a newer version");
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
  return decoded;
}

}  // namespace trace
