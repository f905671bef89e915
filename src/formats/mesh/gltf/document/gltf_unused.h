// Parts of a glTF file that the shown scene does not use.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

namespace trace {

/// Puts sound and empty things in the place of all that the scene does not use, and returns how many: what
/// nothing uses never refuses a file. Precondition: the root is an object.
std::size_t dropUnusedGltf(nlohmann::json& root);

}  // namespace trace
