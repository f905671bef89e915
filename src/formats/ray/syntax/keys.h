// Values of .ray files that change with time: `key((0, 1), (2, 5))` may stand wherever a number or a list of
// numbers may, and becomes its value at one moment before anything is made of the scene.
#pragma once

#include "formats/ray/syntax/syntax.h"
#include "formats/scene_time.h"

namespace trace::rayfile {

/// Replaces every `key(...)` of the tree by its value at `time`. Throws Error(Fault::scene) where one is not
/// of its form. Linear in the tree; free when there is none.
void settleKeys(Syntax& syntax, SceneTime& time);

}  // namespace trace::rayfile
