// Compressed meshes of a glTF file: KHR_draco_mesh_compression and EXT_meshopt_compression.
#pragma once

#include "base/error.h"

namespace tinygltf {
class Model;
}

namespace trace {

inline constexpr const char *kGltfDraco = "KHR_draco_mesh_compression",
                            *kGltfMeshopt = "EXT_meshopt_compression";

/// Adds what the compressed parts hold as buffers, views and accessors of their own, and lets primitives and
/// views name those: what reads the model sees an uncompressed one. A part that cannot be decoded costs the
/// primitives that need it, which lose their attributes, with a warning. Throws Error(Fault::scene) if that
/// leaves nothing, or if small parts name the same bytes again and again.
void unpackGltf(tinygltf::Model& model, const SourcePlace& place, Messages& messages);

}  // namespace trace
