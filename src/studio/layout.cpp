// Tiles the window: left, centre and right columns, a strip below centre and right, splitters between, and in
// each dock a row of tabs. Dear ImGui 1.86 has no docking of its own.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "studio/actions.h"
#include "studio/dialogs.h"
#include "studio/panels.h"
#include "studio/stage.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/number_field.h"

namespace trace::studio {
namespace {

constexpr double kLeast = DockShares::kLeast, kMost = DockShares::kMost;

Dock dockOf(const Studio& studio, const Panel& panel) {
  const auto found = studio.layout.docks.find(panel.name);
  const Dock dock = found == studio.layout.docks.end() ? panel.dock : found->second;
  return studio.layout.oneColumn && dock == Dock::left ? Dock::right : dock;
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

/// The height of the lower dock while it is closed: its tabs.
float drawerHeight() { return ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y; }

/// The last message, next to the tabs of the closed drawer, and the button that opens or closes it.
void drawDrawerBar(Studio& studio) {
  bool& open = studio.layout.drawer;
  if (ImGui::TabItemButton(open ? "v" : "^", ImGuiTabItemFlags_Trailing)) open = !open;
  landmark("drawer");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip(open ? "close it" : "open it");
  const auto& log = studio.workspace.log();
  if (open || log.empty()) return;
  const ImVec2 at = ImGui::GetItemRectMax(), from = ImGui::GetItemRectMin();
  const ImVec2 end{ImGui::GetWindowPos().x + ImGui::GetWindowWidth(), at.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect({at.x, from.y}, end);
  list.AddText({at.x + characters(2), from.y + ImGui::GetStyle().FramePadding.y},
               ImGui::GetColorU32(ImGuiCol_TextDisabled), log.back().text.c_str());
  list.PopClipRect();
}

void drawDock(Studio& studio, Dock dock, const char* name, ImVec2 position, ImVec2 size) {
  if (!occupied(studio, dock) || size.x < 1 || size.y < 1) return;
  ImGui::SetNextWindowPos(position);
  ImGui::SetNextWindowSize(size);
  constexpr ImGuiWindowFlags kFlags =  // the window is cleared to the background of panels
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
      ImGuiWindowFlags_NoScrollWithMouse;
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
      if (dock == Dock::bottom && ((asked && studio.layout.opens) || ImGui::IsItemClicked()))
        studio.layout.drawer = true;
      tabMenu(studio, panel);
      if (!open) continue;
      studio.layout.front[dock] = panel.name;
      if (asked) studio.layout.ask.clear();
      if (asked && std::exchange(studio.layout.focus, false)) {
        ImGui::SetNextWindowFocus();
        showKeyboardCursor();
        studio.rays.focusTree = panel.draw == drawRays;
      }
      if (dock != Dock::bottom || studio.layout.drawer) {
        ImGui::BeginChild(panel.name.data(), {0, 0}, false, ImGuiWindowFlags_NoScrollWithMouse);
        panel.draw(studio);
        ImGui::EndChild();
      }
      ImGui::EndTabItem();
    }
    if (dock == Dock::bottom) drawDrawerBar(studio);
    ImGui::EndTabBar();
  }
  ImGui::End();
}

/// An error over the panels; its height.
float drawBanner(Studio& studio, ImVec2 at, float width) {
  Studio::Banner& banner = studio.banner;
  if (banner.text.empty()) return 0;
  const auto& document = studio.workspace.document;
  if (document.isOpen() && document.sharedScene() != banner.scene) {
    banner = {};
    return 0;
  }
  const float high = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().FramePadding.y;
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize({width, high});
  const ImVec4 error = studio.palette().error;
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(error.x, error.y, error.z, 0.25f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      {ImGui::GetStyle().WindowPadding.x, ImGui::GetStyle().FramePadding.y});
  ImGui::Begin("banner", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  bool close = ImGui::Button("x");
  landmark("banner close");
  ImGui::SameLine();
  if (ImGui::Button("Log")) {
    studio.goTo("Log");
    close = true;
  }
  landmark("banner log");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  rowName(banner.text);
  landmark("banner");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", banner.text.c_str());
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  if (close) banner = {};
  return high;
}

/// The quantity that a bar changes.
struct Shared {
  double& share;         ///< share of the whole that its dock may have
  double pixels, whole;  ///< that the dock has now, and the window
  double most;           ///< the share that leaves room for the other docks, which stay as they are
  double sign = 1;       ///< -1 where the dock lies beyond the bar
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
    const ImVec2 moved = dragged(ImGuiMouseButton_Left);
    const double by = dock.sign * (tall ? moved.x : moved.y);
    if (by != 0)
      dock.share = std::clamp<double>((dock.pixels + by) / dock.whole, kLeast,
                                      std::max<double>(kLeast, std::min<double>(kMost, dock.most)));
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

/// All docks in that part of the window, and the bars between them.
void drawDocks(Studio& studio, ImVec2 at, ImVec2 all, const DocksInUse& used) {
  Layout& layout = studio.layout;
  const DockSizes sizes =
      dockSizes(layout.shares, used, all.x, all.y, characters(1), layout.drawer ? 0 : drawerHeight());
  const auto left = static_cast<float>(sizes.left), right = static_cast<float>(sizes.right),
             low = static_cast<float>(sizes.bottom);
  const float rest = all.x - left, high = all.y - low;
  drawDock(studio, Dock::left, "left", at, {left, all.y});
  drawDock(studio, Dock::centre, "centre", {at.x + left, at.y}, {rest - right, high});
  drawDock(studio, Dock::right, "right", {at.x + all.x - right, at.y}, {right, high});
  drawDock(studio, Dock::bottom, "bottom", {at.x + left, at.y + high}, {rest, low});
  const float bar = std::max(3.0f, std::round(4 * studio.theme.scale)), half = bar / 2;
  const double others = right < rest ? right / all.x + kLeast : kLeast;
  if (left > 0)
    splitter("left bar", {at.x + left - half, at.y}, {bar, all.y},
             {layout.shares.left, left, all.x, 1 - others});
  if (right > 0 && right < rest)
    splitter("right bar", {at.x + all.x - right - half, at.y}, {bar, high},
             {layout.shares.right, right, all.x, rest / all.x - kLeast, -1});
  if (low > 0 && layout.drawer)
    splitter("low bar", {at.x + left, at.y + high - half}, {rest, bar},
             {layout.shares.bottom, low, all.y, kMost, -1});
}

/// All docks below each other.
void drawColumn(Studio& studio, ImVec2 at, ImVec2 all, const DocksInUse& used) {
  constexpr float kBar = 12, kLeastDrawer = 0.3f;
  Layout& layout = studio.layout;
  const float low = !used.bottom ? 0
                    : layout.drawer
                        ? std::round(all.y * std::max(kLeastDrawer, static_cast<float>(layout.shares.bottom)))
                        : drawerHeight();
  const float bar = used.centre && used.right ? std::round(kBar * studio.theme.scale) : 0;
  const float rest = all.y - low - bar;
  const float upper = !used.centre  ? 0
                      : !used.right ? rest
                                    : std::round(rest * static_cast<float>(layout.shares.upper));
  drawDock(studio, Dock::centre, "centre", at, {all.x, upper});
  if (bar > 0)
    splitter("column bar", {at.x, at.y + upper}, {all.x, bar}, {layout.shares.upper, upper, rest, kMost});
  drawDock(studio, Dock::right, "right", {at.x, at.y + upper + bar}, {all.x, rest - upper});
  drawDock(studio, Dock::bottom, "bottom", {at.x, at.y + all.y - low}, {all.x, low});
}

}  // namespace

void arrange(Studio& studio, const Arrangement& arrangement) {
  Layout& layout = studio.layout;
  layout.shares = arrangement.shares;
  layout.arrangement = arrangement.name;
  layout.docks.clear();
  for (const Arrangement::Place& place : arrangement.places)
    layout.docks[std::string(place.panel)] = place.dock;
}

bool isShown(const Studio& studio, std::string_view name) {
  return std::any_of(panels().begin(), panels().end(), [&](const Panel& panel) {
    return panel.name == name && dockOf(studio, panel) != Dock::hidden;
  });
}

void drawStudio(Studio& studio) {
  forgetLandmarks();
  studio.rays.coarse = false;
  escapeDrag(studio);
  keepKeyboard(studio);
  followScene(studio);
  updateWays(studio);
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
  ImVec2 at = view.WorkPos, all = view.WorkSize;
  if (layout.arrangement.empty()) arrange(studio, firstArrangement(all.x / characters(1)));
  const float banner = drawBanner(studio, at, all.x);
  at.y += banner;
  all.y -= banner;
  layout.oneColumn = hasOneColumn(all.x / characters(1), all.x, all.y);
  const bool starts = !studio.workspace.document.isOpen() && occupied(studio, Dock::centre);
  const DocksInUse used{.left = occupied(studio, Dock::left) && !starts,
                        .centre = occupied(studio, Dock::centre),
                        .right = occupied(studio, Dock::right) && !starts,
                        .bottom = occupied(studio, Dock::bottom)};
  layout.oneColumn ? drawColumn(studio, at, all, used) : drawDocks(studio, at, all, used);
  drawDialogs(studio);
  noteKeyboard(studio);
  std::vector<Message> remarks;
  for (std::string& remark : takeRemarks())
    remarks.push_back({.severity = Message::Severity::warning, .what = std::move(remark)});
  if (!remarks.empty()) {
    studio.workspace.report(remarks);
    studio.mention("Log");
  }
}

}  // namespace trace::studio
