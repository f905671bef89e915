// The calls and loops of the language of scenes behind an object: for people who are shown one of many.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"

namespace trace {

/// The calls and turns of loops that made Scene::objects[object], the innermost first: "in gear(teeth = 12)
/// at scene.ray:7:1, in i = 3 at scene.ray:9:1". Reads the scene's file again, as it is at `time`. "" if the
/// file has the object itself, or if it cannot be said which of several was meant.
std::string callsThatMade(const Scene& scene, std::size_t object, Real time);

}  // namespace trace
