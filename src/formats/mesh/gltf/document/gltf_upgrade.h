// glTF 1.0 as glTF 2.0: names become numbers, and materials of techniques the nearest metallic-roughness
// ones.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "base/error.h"

namespace trace {

/// Is it the tree of a file of version 1, whose lists are objects by name?
bool isGltf1(const nlohmann::json& root);

/// The tree as one of version 2.0, which checkGltf() can look at. Colours, which version 1 shows as they are,
/// become linear. Techniques, programs and shaders are left out, and so are animations and skins, which are
/// counted. Throws Error(Fault::scene) for a name of something that is not there.
nlohmann::json upgradedGltf(const nlohmann::json& root, const SourcePlace& place);

/// The upgraded tree and the body of the binary file `bytes`, if it is one, as a file of version 2.0.
std::string upgradedGltfFile(const nlohmann::json& upgraded, std::string_view bytes);

}  // namespace trace
