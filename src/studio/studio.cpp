#include "studio/studio.h"

#include <imgui.h>
// For the place of the keyboard.
#include <imgui_internal.h>

#include "base/file.h"
#include "studio/panels.h"

namespace trace::studio {
namespace {

constexpr const char* kDockNames[] = {"left", "centre", "right", "bottom", "hidden"};

std::string preferencesFile(const Studio& studio) { return studio.configFolder + "/studio.txt"; }

}  // namespace

void showKeyboardCursor() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  context.NavDisableHighlight = false, context.NavDisableMouseHover = true;
}

void enterPresses() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.IO.NavVisible && !context.IO.WantTextInput && context.ActiveId == 0)
    ImGui::ActivateItem(context.NavId);
}

void followScene(Studio& studio) {
  const Document& document = studio.workspace.document;
  if (!document.isOpen() || document.scene().file == studio.sceneFile) return;
  studio.sceneFile = document.scene().file;
  studio.picture.fit = true;
  studio.picture.pixel.clear();
  studio.selected = Studio::Selected::camera;
  studio.selectedIndex = 0;
  studio.rays.sample = 0;
  studio.rays.step = -1;
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
  studio.layout.left = share("left", studio.layout.left, 0.12, 0.6);
  studio.layout.right = share("right", studio.layout.right, 0.12, 0.6);
  studio.layout.bottom = share("bottom", studio.layout.bottom, 0.12, 0.6);
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
  p.set("left", studio.layout.left);
  p.set("right", studio.layout.right);
  p.set("bottom", studio.layout.bottom);
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
