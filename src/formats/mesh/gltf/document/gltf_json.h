// The JSON of a glTF file, taken apart.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "base/error.h"

namespace trace {

/// `json` is a part of the file's `bytes`. Throws Error(Fault::scene) with what is wrong in it; with line and
/// column if the file is text.
nlohmann::json parseGltfJson(const SourcePlace& place, std::string_view bytes, std::string_view json);

}  // namespace trace
