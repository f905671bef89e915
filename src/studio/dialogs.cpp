#include "studio/dialogs.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/session/version.h"
#include "studio/actions.h"
#include "studio/panels.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr const char *kHelpTitle = "Keys and mouse", *kAboutTitle = "About",
                     *kLeavingTitle = "The scene was edited";

void closeOnEscape(const Studio& studio) {
  if (studio.pressed(KeyPress::kEscape)) ImGui::CloseCurrentPopup();
}

void drawHelp(Studio& studio) {
  if (studio.showHelp) {
    ImGui::OpenPopup(kHelpTitle);
    studio.showHelp = false;
  }
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, {0.5f, 0.5f});
  const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const float rows = row * static_cast<float>(actions().size() + panels().size() + 4);
  ImGui::SetNextWindowSize({characters(96), std::min(rows, ImGui::GetMainViewport()->Size.y * 0.9f)},
                           ImGuiCond_Appearing);
  bool open = true;
  if (!ImGui::BeginPopupModal(kHelpTitle, &open)) return;
  closeOnEscape(studio);
  if (ImGui::BeginTable("keys", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
    const auto line = [&](const std::string& key, const std::string& what, const std::string& help) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(studio.palette().accent, "%s", key.c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what.c_str());
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", help.c_str());
    };
    for (const Action& action : actions())
      if (action.key) line(keyText(action), action.name, action.help);
    for (const Panel& panel : panels())
      line(std::string("Alt+") + static_cast<char>(panel.key), std::string(panel.name),
           std::string(panel.help));
    line("F10, Alt+F", "Open a menu",
         "Alt with its first letter; left and right go to the next; Esc closes it");
    line("wheel", "Zoom", "in the picture at the cursor; in the 3D view");
    line("drag", "Move", "the picture with the right or middle button");
    line("Ctrl+click", "Type a number", "on any slider; Enter takes it, Esc does not");
    line("Tab, arrows", "Go to a control", "Enter or Space uses it, Esc leaves a field");
    ImGui::EndTable();
  }
  ImGui::EndPopup();
}

void drawAbout(Studio& studio) {
  if (studio.showAbout) {
    ImGui::OpenPopup(kAboutTitle);
    studio.showAbout = false;
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  bool open = true;
  if (!ImGui::BeginPopupModal(kAboutTitle, &open, ImGuiWindowFlags_AlwaysAutoResize)) return;
  closeOnEscape(studio);
  ImGui::TextUnformatted((versionText() + ": the ray tracer you can see inside").c_str());
  ImGui::TextDisabled(
      "Made with Dear ImGui, GLFW, OpenGL, stb, OpenEXR,\nlibwebp, Draco and meshoptimizer. MIT licence.");
  ImGui::EndPopup();
}

void drawLeaving(Studio& studio) {
  if (studio.leaving && studio.workspace.saving()) return;  // then there may be nothing to ask
  if (studio.leaving && !studio.workspace.unsaved()) return std::exchange(studio.leaving, nullptr)();
  if (studio.leaving && !ImGui::IsPopupOpen(kLeavingTitle)) ImGui::OpenPopup(kLeavingTitle);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kLeavingTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  const Document& document = studio.workspace.document;
  const std::string name = std::filesystem::path(document.scene().file).filename().string();
  ImGui::Text(document.edited() ? "%s has unsaved changes." : "%s is no longer on the disk.", name.c_str());
  ImGui::TextDisabled("You asked %s.", studio.leavingTo.c_str());
  const ImVec2 size{characters(16), 0};
  const auto close = [&] {
    ImGui::CloseCurrentPopup();
    return std::exchange(studio.leaving, nullptr);
  };
  if (ImGui::Button("Save", size)) saveSceneAnd(studio, close());
  landmark("button Save");
  ImGui::SameLine();
  if (ImGui::Button("Save as...", size)) saveSceneAsAnd(studio, close());
  landmark("button Save as");
  ImGui::SameLine();
  if (ImGui::Button("Discard", size)) close()();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", size) || studio.pressed(KeyPress::kEscape)) close();
  ImGui::EndPopup();
}

}  // namespace

bool modalIsOpen(const Studio& studio) {
  return studio.dialog.isOpen() || ImGui::IsPopupOpen(kHelpTitle) || ImGui::IsPopupOpen(kAboutTitle) ||
         ImGui::IsPopupOpen(kLeavingTitle);
}

void saveSceneAsAnd(Studio& studio, std::function<void()> then) {
  studio.dialog.open("Save the scene", FileDialog::Purpose::write, studio.workspace.defaultSceneFile(),
                     {".ray"}, [&studio, then = std::move(then)](const std::string& file) {
                       studio.workspace.saveScene(file);
                       if (then) studio.leaving = then;
                     });
}

void saveSceneAnd(Studio& studio, std::function<void()> then) {
  if (!studio.workspace.document.savesOverItsFile()) return saveSceneAsAnd(studio, std::move(then));
  const std::uint64_t failures = studio.workspace.failures();
  studio.workspace.saveSceneOver();
  if (studio.workspace.failures() > failures) return studio.mention("Log");  // nobody leaves then
  if (then) studio.leaving = std::move(then);
}

void drawDialogs(Studio& studio) {
  studio.dialog.draw(studio.pressed(KeyPress::kEscape),
                     studio.pressed(KeyPress::kEnter) || studio.pressed(KeyPress::kKeypadEnter));
  drawLeaving(studio);
  drawHelp(studio);
  drawAbout(studio);
}

}  // namespace trace::studio
