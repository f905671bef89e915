// Scenes as .ray files. What is written reads back as an equal scene, unless fewer digits are asked for.
#pragma once

#include <string>
#include <vector>

#include "formats/format.h"

namespace trace {

/// Throws Error(Fault::scene) for a number that is not finite.
std::vector<NamedBytes> writeRay(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages);

}  // namespace trace
