// The texts of a ray's row in the tables of the panel Rays.
#pragma once

#include <imgui.h>

#include <initializer_list>
#include <string>

#include "studio/studio.h"

namespace trace::studio {

inline constexpr ImGuiTableFlags kRayTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                             ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable |
                                             ImGuiTableFlags_PadOuterX;

ImVec4 rayColour(const Studio& studio, const TracedPixel& pixel, int ray);
const char* rayName(const TracedPixel& pixel, int ray);
/// The heads of the table's columns, with help.
void columnHeads(std::initializer_list<const char*> help, int most = 64);
/// A text that may be cut: the cursor on it shows the whole.
void cutText(const std::string& text);

/// The tab Tree.
void drawTree(Studio& studio, const TracedPixel& pixel);

}  // namespace trace::studio
