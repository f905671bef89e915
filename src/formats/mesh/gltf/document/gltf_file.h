// A glTF file as tinygltf's tree.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/input_files.h"

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace trace {

/// The magic of a binary file.
bool isBinaryGltf(std::string_view bytes);

/// Reads the file; findings of checkGltf() become messages. Files that it names are read, and noted in
/// `inputs`. Throws Error(Fault::scene). Every index and range of accessors and views has yet to be checked.
tinygltf::Model parsedGltf(const std::string& file, std::string_view bytes, const SourcePlace& place,
                           InputFiles& inputs, Messages& messages);

}  // namespace trace
