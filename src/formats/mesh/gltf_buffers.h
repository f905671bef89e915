// The buffers and pictures of a glTF file, looked at before tinygltf reads them, which repeats their whole
// text where it is not sound.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"

namespace trace {

/// Throws Error(Fault::scene) for a buffer without a length, of which only the first may be without a uri, or
/// whose uri holds other than base64 of that length; and for a picture whose uri holds other than base64.
/// Pictures in the file itself that say another kind than tinygltf knows, such as image/webp, become plain
/// bytes: the content decides what they are. Whether there was one.
bool plainGltfPictures(nlohmann::json& root);
void checkGltfBuffers(const nlohmann::json& root, const Place& place);

}  // namespace trace
