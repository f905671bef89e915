// Camera, background and settings in the text of a .ray file: what a scene has once.
#pragma once

#include "formats/ray/write/edits.h"
#include "scene/scene.h"

namespace trace::rayfile {

/// Changes the text that says `from` where `to` differs in these.
void changeView(TextEdits& edits, const Scene& from, const Scene& to);

}  // namespace trace::rayfile
