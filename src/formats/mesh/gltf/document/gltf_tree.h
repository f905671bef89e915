// The nodes of a glTF file as a tree.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"

namespace trace {

/// Throws Error(Fault::scene) where a node stands below itself. Precondition: checkGltf() found its indices
/// sound.
void checkGltfTree(const nlohmann::json& root, const SourcePlace& place);

}  // namespace trace
