// Parts of the panel Picture around the picture.
#pragma once

#include <imgui.h>

#include "studio/studio.h"

namespace trace::studio {

inline bool sameSize(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height;
}

/// The bar has the switches for those who compare.
inline bool comparesPictures(const Studio& studio) {
  return studio.workspace.reference() || !isShown(studio, "Rays");
}

/// Buttons and switches above it.
void drawBar(Studio& studio);
/// Two lines below it: how far the render is, or the pixel x, y that the cursor is on; and how exact it is.
void drawStatus(Studio& studio, bool hovered, int x, int y);

}  // namespace trace::studio
