// The calls and loops of the language of scenes behind an object: for people who are shown one of many.
#pragma once

#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace trace {

/// The calls and loop iterations that made the object of that number (scene/groups.h), the innermost first:
/// "in gear(teeth = 12) at scene.ray:7:1, in i = 3 at scene.ray:9:1". For an object of a group: those that
/// made the outermost placement. Reads the scene's file again, as it is at `time`. "" if the file has the
/// object itself, or if several are possible.
std::string callsThatMade(const Scene& scene, std::uint32_t number, Real time);

}  // namespace trace
