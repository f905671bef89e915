// The rays of a path, for those who show them.
#pragma once

#include "render/chains/path.h"

namespace trace::veach {

/// Casts the path's rays once more by a tracer that records them, as far as there are places. Its radiance is
/// what the path brings along its directions, whatever their density.
Color record(const Path& path, Tracer& tracer);

}  // namespace trace::veach
