// The windows over the window: files, help, about, and the question before a scene is left.
#pragma once

#include <functional>

#include "studio/studio.h"

namespace trace::studio {

void drawDialogs(Studio& studio);
/// One of them is open, and takes all keys.
bool modalIsOpen(const Studio& studio);

/// Asks for a file and saves the scene there; then does `then`, if any, what waits until the scene is saved.
/// If that fails, it is asked about again.
void saveSceneAsAnd(Studio& studio, std::function<void()> then);
/// The same over its file, where that is one of the studio's own.
void saveSceneAnd(Studio& studio, std::function<void()> then);

}  // namespace trace::studio
