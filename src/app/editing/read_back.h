// A check of a scene before it is written: whether writing and reading it again gives the same scene.
#pragma once

#include <vector>

#include "formats/format.h"

namespace trace {

/// Reads what is to be written as `files`, of which the first is the scene in a format that keeps all of it,
/// at the moment `time`. Throws Error if it cannot be read, or is another scene than `wanted`: a message says
/// what differs and what to do. Names and the paths of files may differ, and the order of objects and
/// lights.
Scene readBack(const std::vector<NamedBytes>& files, const Scene& wanted, Real time);

}  // namespace trace
