// Requirements of the glTF specification on the JSON of a file, checked before anything is made of it:
// tinygltf takes many a wrong value for one that is missing.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"

namespace trace {

/// Throws Error(Fault::scene) where the specification forbids to continue: another version, an extension that
/// is required and not read, an index of something that is not there, a value of another type. Warns of
/// values out of their range, of properties that are not known, and of what is not read.
void checkGltf(const nlohmann::json& json, const SourcePlace& place, Messages& messages);

}  // namespace trace
