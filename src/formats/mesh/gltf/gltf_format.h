// Scenes as glTF 2.0 files, text (.gltf) and binary (.glb): meshes in a hierarchy of nodes, with materials,
// the first camera, and lights of KHR_lights_punctual (Khronos, glTF 2.0 specification, 2021).
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/model.h"
#include "formats/scene_time.h"

namespace trace {

/// The magic of a binary file; or a JSON object that has an "asset".
bool recognisesGltf(std::string_view bytes);

/// One object for each triangle primitive of each node, as the first animation has it at the time; nodes with
/// the same mesh share it. Throws Error(Fault::scene).
Model readGltf(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time);

}  // namespace trace
