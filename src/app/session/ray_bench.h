// How fast a scene's rays are answered, kind by kind, on one thread and without shading: what `ray bench`
// tells. The rays are the same in every run, so that two programs or two settings can be compared.
//
//   primary   one through each pixel of the picture
//   bounce    one from each primary hit, cosine-distributed about its normal
//   shadow    from each primary hit to each light in front of it; any hit ends it
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

struct RayBench {
  struct Kind {
    std::string_view name;
    std::uint64_t rays = 0, hits = 0;
    double seconds = 0;           ///< seconds of CPU time for all of them: the median of the passes
    double nodes = 0, tests = 0;  ///< per ray: nodes of hierarchies visited; shapes and triangles tested
    double raysPerSecond() const { return seconds > 0 ? static_cast<double>(rays) / seconds : 0; }
  };
  double buildWall = 0, buildCpu = 0;      ///< seconds
  std::uint64_t triangles = 0, bytes = 0;  ///< triangles and bytes of all meshes; of the hierarchies
  std::vector<Kind> kinds;                 ///< those that the scene has rays of
};

/// Compiles the scene and measures, each kind of ray `passes` times. Throws Error as compile() does, and
/// Error(Fault::limit) if the rays are too many for the memory.
RayBench benchRays(const Scene& scene, const Settings& settings, int passes, Messages& messages);

}  // namespace trace
