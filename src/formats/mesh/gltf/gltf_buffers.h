// The buffers and pictures of a glTF file, looked at before tinygltf reads them, which repeats their whole
// text where it is not sound.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"

namespace trace {

/// Turns embedded pictures of a media type that tinygltf does not know, such as image/webp, into plain bytes:
/// their content decides their format. Returns whether there was one.
bool plainGltfPictures(nlohmann::json& root);

/// Makes one byte of each buffer that EXT_meshopt_compression has for programs that cannot read it: of those
/// that only compressed views name, and of those that say so and have no uri. Returns whether there was one.
bool dropGltfFallbacks(nlohmann::json& root);

/// Takes the indices from primitives of KHR_draco_mesh_compression that have none outside it: tinygltf
/// refuses indices without a view. Returns whether there were some.
bool dropDracoIndices(nlohmann::json& root);

/// Throws Error(Fault::scene) for a buffer without a length, of which only the first may be without a uri, or
/// whose uri holds other than base64 of that length; and for a picture whose uri holds other than base64.
void checkGltfBuffers(const nlohmann::json& root, const SourcePlace& place);

}  // namespace trace
