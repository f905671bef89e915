#include "studio/studio.h"

#include <imgui.h>
// For the place of the keyboard.
#include <imgui_internal.h>

#include "base/files/file.h"
#include "studio/panels.h"

namespace trace::studio {
namespace {

constexpr const char* kDockNames[] = {"left", "centre", "right", "bottom", "hidden"};

std::string preferencesFile(const Studio& studio) { return studio.configFolder + "/studio.txt"; }

}  // namespace

void showKeyboardCursor() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  context.NavDisableHighlight = false;
  context.NavDisableMouseHover = true;
}

void keepKeyboard(Studio& studio) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  const Studio::Keyboard& before = studio.keyboard;
  // Dear ImGui goes out of a panel with Esc, and nowhere.
  ImGuiWindow* window = ImGui::FindWindowByID(before.window);
  const bool left = context.NavId != before.item && !before.popup && context.OpenPopupStack.Size == 0;
  if (studio.pressed(KeyPress::kEscape) && left && before.item && window) {
    ImGui::FocusWindow(window);
    const std::array<float, 4>& at = before.place;
    ImGui::SetNavID(before.item, ImGuiNavLayer_Main, 0, {at[0], at[1], at[2], at[3]});
    context.NavDisableHighlight = before.hidden;
  }
  // Nor does Tab know where it is, but in a field that takes text: 0 means that it begins at the first.
  if (context.NavMoveScoringItems && (context.NavMoveFlags & ImGuiNavMoveFlags_Tabbing) &&
      context.NavTabbingDir == 0 && context.NavId != 0)
    context.NavTabbingDir = 1;
}

void escapeDrag(Studio& studio) {
  if (!studio.workspace.document.isOpen()) return;
  const bool escaped = studio.pressed(KeyPress::kEscape);
  if (escaped && (studio.editedItem || studio.rays.gizmo.held)) {
    if (studio.editedItem) studio.workspace.dropSince(studio.stepBefore);
    studio.editedItem = 0;
    studio.rays.gizmo.held.reset();
    ImGui::ClearActiveID();
    std::erase_if(studio.keys, [](const KeyPress& press) { return press.key == KeyPress::kEscape; });
  }
  if (!ImGui::IsAnyItemActive()) studio.editedItem = 0;
  if (!studio.editedItem) studio.stepBefore = studio.workspace.document.step();
}

void noteKeyboard(Studio& studio) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  // Where the keyboard is, is no field: then Tab goes to the first.
  if (context.NavMoveScoringItems && (context.NavMoveFlags & ImGuiNavMoveFlags_Tabbing) &&
      context.NavTabbingDir == 1 && context.NavTabbingCounter < 0)
    context.NavTabbingCounter = 1;
  studio.keyboard = {};
  studio.keyboard.popup = context.OpenPopupStack.Size > 0;
  studio.keyboard.hidden = context.NavDisableHighlight;
  if (!context.NavWindow || context.NavLayer != ImGuiNavLayer_Main) return;
  const ImRect& at = context.NavWindow->NavRectRel[ImGuiNavLayer_Main];
  studio.keyboard.item = context.NavId;
  studio.keyboard.window = context.NavWindow->ID;
  studio.keyboard.place = {at.Min.x, at.Min.y, at.Max.x, at.Max.y};
}

void enterPresses() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.IO.NavVisible && !context.IO.WantTextInput && context.ActiveId == 0)
    ImGui::ActivateItem(context.NavId);
}

void followScene(Studio& studio) {
  const Document& document = studio.workspace.document;
  if (!document.isOpen() || document.scene().file == studio.sceneFile) return;
  if (!studio.sceneFile.empty()) studio.picture.view = View::picture;  // the reference is of the other scene
  const bool another = !studio.sceneFile.empty();
  studio.sceneFile = document.scene().file;
  studio.picture.fit = true;
  studio.picture.pixel.clear();
  studio.selected = Studio::Selected::camera;
  studio.selectedIndex = 0;
  studio.rays.sample = 0;
  studio.rays.step = -1;
  studio.rays.pyramid.alone.reset();
  studio.keyboard = {};
  studio.editedItem = 0;
  if (another) studio.goTo("Picture");  // the keyboard was in a field, or at an entry, of the other scene
}

void restore(Studio& studio) {
  try {
    studio.preferences = Preferences::parse(readFile(preferencesFile(studio)));
  } catch (const Error&) {
    return;  // the first time
  }
  const Preferences& p = studio.preferences;
  studio.theme.light = p.get("theme") == "light";
  const auto share = [&](const char* key, double otherwise, double least, double most) {
    return static_cast<float>(std::clamp(p.number(key, otherwise), least, most));
  };
  studio.userScale = share("text-scale", 1, 0.5, 3);
  DockShares& shares = studio.layout.shares;
  for (const auto& [key, value] : {std::pair{"left", &shares.left}, std::pair{"right", &shares.right},
                                   std::pair{"bottom", &shares.bottom}})
    *value = share(key, *value, DockShares::kLeast, DockShares::kMost);
  studio.layout.drawer = p.get("drawer") == "open";
  studio.layout.arrangement = p.get("arrangement");
  studio.layout.list = share("list", studio.layout.list, Layout::kLeastList, Layout::kMostList);
  studio.workspace.automatic = p.get("automatic", "on") == "on";
  studio.workspace.setRecent(p.all("recent"));
  for (const Panel& panel : panels())
    for (std::size_t i = 0; i < std::size(kDockNames); ++i)
      if (p.get("dock-" + std::string(panel.name)) == kDockNames[i])
        studio.layout.docks[std::string(panel.name)] = static_cast<Dock>(i);
}

void remember(Studio& studio) {
  if (studio.configFolder.empty()) return;
  Preferences& p = studio.preferences;
  p.set("theme", studio.theme.light ? "light" : "dark");
  p.set("text-scale", studio.userScale);
  p.set("left", studio.layout.shares.left);
  p.set("right", studio.layout.shares.right);
  p.set("bottom", studio.layout.shares.bottom);
  p.set("drawer", studio.layout.drawer ? "open" : "closed");
  p.set("arrangement", studio.layout.arrangement);
  p.set("list", studio.layout.list);
  p.set("automatic", studio.workspace.automatic ? "on" : "off");
  p.setAll("recent", studio.workspace.recent());
  int width = 0, height = 0;
  studio.window.size(width, height);
  p.set("width", width);
  p.set("height", height);
  for (const Panel& panel : panels()) {
    const auto moved = studio.layout.docks.find(panel.name);
    const std::string key = "dock-" + std::string(panel.name);
    if (moved == studio.layout.docks.end())
      p.setAll(key, {});
    else
      p.set(key, kDockNames[static_cast<int>(moved->second)]);
  }
  try {
    writeFile(preferencesFile(studio), p.text());
  } catch (const Error&) {
    // Nobody is there to be told; the next start is as the last one was.
  }
}

}  // namespace trace::studio
