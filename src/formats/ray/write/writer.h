// Scenes as .ray files. What is written reads back as an equal scene, unless fewer digits are asked for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/format.h"

namespace trace {

/// Throws Error(Fault::scene) for a number that is not finite.
std::vector<NamedBytes> writeRay(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages);

namespace rayfile {

/// The value of `material = ` for one of a scene's materials. `whole`: of an operand, which would inherit
/// from the whole.
using MaterialText = std::function<std::string(std::uint32_t material, bool whole)>;

/// Single parts of a scene, as they stand in a file.
std::string writtenObject(const Scene& scene, const Object& object, const MaterialText& material);
std::string writtenLight(const LightSource& light);

}  // namespace rayfile

}  // namespace trace
