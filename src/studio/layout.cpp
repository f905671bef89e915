// Tiles the window: left, centre and right columns, a strip below centre and right, splitters between, and in
// each dock a row of tabs. Dear ImGui 1.86 has no docking of its own.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "studio/actions.h"
#include "studio/dialogs.h"
#include "studio/panels.h"
#include "studio/stage.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/number_field.h"

namespace trace::studio {
namespace {

constexpr float kLeast = 0.12f, kMost = 0.6f;  // shares of the window that a dock may take

Dock dockOf(const Studio& studio, const Panel& panel) {
  const auto found = studio.layout.docks.find(panel.name);
  return found == studio.layout.docks.end() ? panel.dock : found->second;
}

bool occupied(const Studio& studio, Dock dock) {
  return std::any_of(panels().begin(), panels().end(),
                     [&](const Panel& panel) { return dockOf(studio, panel) == dock; });
}

void tabMenu(Studio& studio, const Panel& panel) {
  if (!ImGui::BeginPopupContextItem()) return;
  constexpr std::pair<Dock, const char*> kPlaces[] = {{Dock::left, "Move left"},
                                                      {Dock::centre, "Move to the centre"},
                                                      {Dock::right, "Move right"},
                                                      {Dock::bottom, "Move to the bottom"},
                                                      {Dock::hidden, "Hide"}};
  for (const auto& [dock, label] : kPlaces)
    if (ImGui::MenuItem(label, nullptr, dockOf(studio, panel) == dock)) {
      studio.layout.docks[std::string(panel.name)] = dock;
      if (dock != Dock::hidden) studio.show(std::string(panel.name));
    }
  ImGui::EndPopup();
}

void drawDock(Studio& studio, Dock dock, const char* name, ImVec2 position, ImVec2 size) {
  if (!occupied(studio, dock) || size.x < 1 || size.y < 1) return;
  ImGui::SetNextWindowPos(position);
  ImGui::SetNextWindowSize(size);
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;
  ImGui::Begin(name, nullptr, kFlags);
  if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip)) {
    for (const Panel& panel : panels()) {
      if (dockOf(studio, panel) != dock) continue;
      const bool asked = studio.layout.ask == panel.name;
      const bool open =
          ImGui::BeginTabItem(panel.name.data(), nullptr, asked ? ImGuiTabItemFlags_SetSelected : 0);
      landmark("panel " + std::string(panel.name));
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s (Alt+%c); right click to move", panel.help.data(), panel.key);
      tabMenu(studio, panel);
      if (!open) continue;
      studio.layout.front[dock] = panel.name;
      if (asked) studio.layout.ask.clear();
      if (asked && std::exchange(studio.layout.focus, false)) {
        ImGui::SetNextWindowFocus();
        showKeyboardCursor();
      }
      ImGui::BeginChild(panel.name.data(), {0, 0}, false, ImGuiWindowFlags_NoScrollWithMouse);
      panel.draw(studio);
      ImGui::EndChild();
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::End();
}

/// The quantity that a bar changes.
struct Shared {
  float& share;         ///< share of the whole that its dock may have
  float pixels, whole;  ///< that the dock has now, and the window
  float most;           ///< the share that leaves room for the other docks, which stay as they are
  float sign = 1;       ///< -1 where the dock lies beyond the bar
};

/// A bar that makes a dock larger and smaller when dragged.
void splitter(const char* name, ImVec2 position, ImVec2 size, const Shared& dock) {
  ImGui::SetNextWindowPos(position);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::InvisibleButton("bar", size);
  landmark(name);
  const bool tall = size.y > size.x;
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(tall ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemActive()    ? ImGuiCol_SeparatorActive
                                          : ImGui::IsItemHovered() ? ImGuiCol_SeparatorHovered
                                                                   : ImGuiCol_MenuBarBg);
  ImGui::GetWindowDrawList()->AddRectFilled(position, {position.x + size.x, position.y + size.y}, colour);
  if (ImGui::IsItemActive()) {
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    const float by = dock.sign * (tall ? moved.x : moved.y);
    if (by != 0)
      dock.share =
          std::clamp((dock.pixels + by) / dock.whole, kLeast, std::max(kLeast, std::min(kMost, dock.most)));
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

void drawStudio(Studio& studio) {
  forgetLandmarks();
  studio.rays.coarse = false;
  keepKeyboard(studio);
  followScene(studio);
  updateWays(studio);
  if (!ImGui::IsAnyItemActive()) studio.editedItem = 0;
  if (studio.stage && !studio.workspace.document.isOpen()) toggleStage(studio);
  if (studio.stage) {
    drawStage(studio);
    drawDialogs(studio);
    return noteKeyboard(studio);
  }
  drawMenu(studio);
  Layout& layout = studio.layout;
  if (!layout.ask.empty())  // a hidden panel that is asked for comes back to its first dock
    for (const Panel& panel : panels())
      if (panel.name == layout.ask && dockOf(studio, panel) == Dock::hidden)
        layout.docks[layout.ask] = panel.dock == Dock::hidden ? Dock::bottom : panel.dock;

  const ImGuiViewport& view = *ImGui::GetMainViewport();
  const ImVec2 at = view.WorkPos, all = view.WorkSize;
  const float bar = std::max(3.0f, std::round(4 * studio.theme.scale));
  const bool starts = !studio.workspace.document.isOpen() && occupied(studio, Dock::centre);
  const float left = occupied(studio, Dock::left) && !starts  // wide enough for names beside values
                         ? std::round(std::max(all.x * layout.left, std::min(characters(30), all.x * 0.32f)))
                         : 0;
  const float rest = all.x - left;
  float right = occupied(studio, Dock::right) && !starts ? std::round(all.x * layout.right) : 0;
  if (!occupied(studio, Dock::centre)) right = rest;
  right = std::min(right, rest - (right < rest ? all.x * kLeast : 0));
  const float low = occupied(studio, Dock::bottom) ? std::round(all.y * layout.bottom) : 0;
  const float high = all.y - low;

  drawDock(studio, Dock::left, "left", at, {left, all.y});
  drawDock(studio, Dock::centre, "centre", {at.x + left, at.y}, {rest - right, high});
  drawDock(studio, Dock::right, "right", {at.x + all.x - right, at.y}, {right, high});
  drawDock(studio, Dock::bottom, "bottom", {at.x + left, at.y + high}, {rest, low});
  const float half = bar / 2;
  const float others = right < rest ? right / all.x + kLeast : kLeast;
  if (left > 0)
    splitter("left bar", {at.x + left - half, at.y}, {bar, all.y}, {layout.left, left, all.x, 1 - others});
  if (right > 0 && right < rest)
    splitter("right bar", {at.x + all.x - right - half, at.y}, {bar, high},
             {layout.right, right, all.x, rest / all.x - kLeast, -1});
  if (low > 0)
    splitter("low bar", {at.x + left, at.y + high - half}, {rest, bar},
             {layout.bottom, low, all.y, kMost, -1});
  drawDialogs(studio);
  noteKeyboard(studio);
  std::vector<Message> remarks;
  for (std::string& remark : takeRemarks())
    remarks.push_back({.severity = Message::Severity::warning, .what = std::move(remark)});
  if (!remarks.empty()) {
    studio.workspace.report(remarks);
    studio.show("Log");
  }
}

}  // namespace trace::studio
