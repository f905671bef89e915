// How the studio looks: two themes, one font, everything scaled together.
#pragma once

#include <imgui.h>

namespace trace::studio {

struct Theme {
  bool light = false;
  float scale = 1;  ///< scale of the monitor, times what the user chose
};

/// Colours with a meaning.
struct Palette {
  ImVec4 accent, muted, changed, warning, error, good;
};
const Palette& palette(bool light);
/// The scale of the theme that was set last.
const Palette& palette();

/// Sets style and fonts. Between frames; Window::fontsChanged() must follow.
void apply(const Theme& theme);

/// The scaled width of about this many characters.
inline float characters(float count) { return count * ImGui::GetFontSize() * 0.5f; }

}  // namespace trace::studio
