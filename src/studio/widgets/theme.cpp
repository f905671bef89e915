#include "studio/widgets/theme.h"

#include <cmath>
#include <filesystem>

namespace trace::studio {
namespace {

constexpr float kFontSize = 16;

/// The first that this machine has; Dear ImGui's own bitmap font otherwise.
constexpr const char* kFonts[] = {
    "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/roboto/unhinted/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/System/Library/Fonts/Helvetica.ttc",
    "C:/Windows/Fonts/segoeui.ttf",
    "C:/Windows/Fonts/arial.ttf",
};

ImVec4 rgb(unsigned code, float alpha = 1) {
  return {static_cast<float>(code >> 16 & 255) / 255, static_cast<float>(code >> 8 & 255) / 255,
          static_cast<float>(code & 255) / 255, alpha};
}

/// The shades that everything is made of.
struct Shades {
  unsigned text, muted, window, panel, frame, frameHovered, frameActive, border, accent, accentHovered,
      header;
};
constexpr Shades kDark{0xe4e6ea, 0x8d939e, 0x17191d, 0x1f2227, 0x2b2f36, 0x363b44,
                       0x414753, 0x343942, 0x4c8dff, 0x6ba1ff, 0x2f3c54};
constexpr Shades kLight{0x1d2127, 0x69707b, 0xdfe2e7, 0xf6f7f9, 0xe6e9ee, 0xd9dee6,
                        0xcbd2dc, 0xc4cad3, 0x1f66d6, 0x3a7ae0, 0xcfdff8};

void setColours(const Shades& s) {
  ImVec4* c = ImGui::GetStyle().Colors;
  const auto set = [&](unsigned code, std::initializer_list<int> which, float alpha = 1) {
    for (int i : which) c[i] = rgb(code, alpha);
  };
  set(s.text, {ImGuiCol_Text});
  set(s.muted, {ImGuiCol_TextDisabled, ImGuiCol_PlotLines});
  set(s.panel, {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_TitleBg, ImGuiCol_TitleBgActive,
                ImGuiCol_TitleBgCollapsed});
  set(s.window, {ImGuiCol_MenuBarBg});
  set(s.panel, {ImGuiCol_ChildBg, ImGuiCol_ScrollbarBg}, 0);
  set(s.border, {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight});
  set(s.frame,
      {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_TableHeaderBg, ImGuiCol_Tab, ImGuiCol_TabUnfocused});
  set(s.frameHovered, {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_ScrollbarGrab});
  set(s.frameActive, {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_ScrollbarGrabHovered,
                      ImGuiCol_ScrollbarGrabActive});
  set(s.header, {ImGuiCol_Header, ImGuiCol_HeaderActive, ImGuiCol_TabHovered, ImGuiCol_TabActive,
                 ImGuiCol_TabUnfocusedActive});
  set(s.frameHovered, {ImGuiCol_HeaderHovered});  // hovered and selected rows differ
  set(s.accent, {ImGuiCol_SliderGrab}, 0.4f);     // the number of a slider is written over it
  set(s.accent, {ImGuiCol_CheckMark, ImGuiCol_PlotHistogram, ImGuiCol_SeparatorHovered,
                 ImGuiCol_ResizeGripHovered, ImGuiCol_NavHighlight});
  set(s.accentHovered, {ImGuiCol_SliderGrabActive}, 0.6f);
  set(s.accentHovered, {ImGuiCol_SeparatorActive, ImGuiCol_ResizeGripActive});
  set(s.accent, {ImGuiCol_TextSelectedBg}, 0.35f);
  set(s.muted, {ImGuiCol_TableRowBgAlt}, 0.06f);
  set(0x000000, {ImGuiCol_TableRowBg}, 0);
  set(0x000000, {ImGuiCol_ModalWindowDimBg}, 0.45f);
}

bool& isLight() {
  static bool light = false;  // as Dear ImGui keeps the style
  return light;
}

}  // namespace

const Palette& palette(bool light) {
  static const Palette kDarkPalette{rgb(0x4c8dff), rgb(0x8d939e), rgb(0xffb454),
                                    rgb(0xf2c14e), rgb(0xff6b6b), rgb(0x62c987)};
  static const Palette kLightPalette{rgb(0x1f66d6), rgb(0x69707b), rgb(0xa85800),
                                     rgb(0x8a6100), rgb(0xc22f2f), rgb(0x1e7f45)};
  return light ? kLightPalette : kDarkPalette;
}

const Palette& palette() { return palette(isLight()); }

void apply(const Theme& theme) {
  isLight() = theme.light;
  ImGuiStyle& style = ImGui::GetStyle();
  style = {};
  setColours(theme.light ? kLight : kDark);
  style.WindowPadding = {10, 8};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 12;
  style.GrabMinSize = 10;
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = style.TabRounding = 4;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 1;
  style.ScaleAllSizes(theme.scale);

  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  const float size = std::round(kFontSize * theme.scale);
  for (const char* file : kFonts) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    if (atlas.AddFontFromFileTTF(file, size)) return;
  }
  ImFontConfig config;
  config.SizePixels = size;
  atlas.AddFontDefault(&config);
}

}  // namespace trace::studio
