#include "studio/actions.h"

#include <imgui.h>
// For the keyboard's way through menus.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "app/editing/first_scene.h"
#include "app/view/drawing.h"
#include "app/view/magnifier.h"
#include "app/view/ray_story.h"
#include "studio/dialogs.h"
#include "studio/host.h"
#include "studio/panels.h"
#include "studio/scene/selection.h"
#include "studio/stage.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kEscape = KeyPress::kEscape, kEnter = KeyPress::kEnter, kDelete = KeyPress::kDelete,
              kF1 = KeyPress::kF1, kF2 = kF1 + 1, kF3 = kF1 + 2, kF4 = kF1 + 3, kF5 = KeyPress::kF5,
              kF10 = KeyPress::kF10, kF11 = KeyPress::kF11;

bool always(const Studio&) { return true; }
bool hasScene(const Studio& studio) { return studio.workspace.document.isOpen(); }
bool hasPicture(const Studio& studio) { return studio.workspace.render.session() != nullptr; }
bool hasReference(const Studio& studio) { return studio.workspace.reference().has_value(); }
bool renders(const Studio& studio) { return const_cast<Studio&>(studio).workspace.render.state().working(); }

template <GizmoMode Mode>
void handlesDo(Studio& studio) {
  studio.rays.gizmo.mode = Mode;
}
template <GizmoMode Mode>
bool isHandle(const Studio& studio) {
  return studio.rays.gizmo.mode == Mode;
}

template <std::size_t Index>
bool isArranged(const Studio& studio) {
  return studio.layout.arrangement == arrangements()[Index].name;
}

std::vector<std::string> sceneSuffixes() {
  std::vector<std::string> suffixes;
  for (const SceneFormat& format : sceneFormats())
    suffixes.insert(suffixes.end(), format.suffixes.begin(), format.suffixes.end());
  return suffixes;
}

void openScene(Studio& studio) {
  studio.dialog.open("Open a scene", FileDialog::Purpose::read, studio.workspace.document.file(),
                     sceneSuffixes(), [&studio](const std::string& file) { leaveToOpen(studio, file); });
}
void newScene(Studio& studio) {
  studio.dialog.open("Write a new scene", FileDialog::Purpose::write, studio.workspace.newSceneFile(),
                     {".ray"}, [&studio](const std::string& file) {
                       studio.leave([&studio, file] { studio.workspace.startScene(file); },
                                    "for a new scene");
                     });
}
void newSmallScene(Studio& studio) {
  studio.dialog.open("Write a small scene", FileDialog::Purpose::write, studio.workspace.newSceneFile(),
                     {".ray"}, [&studio](const std::string& file) {
                       studio.leave([&studio, file] { studio.workspace.startScene(file, kSmallScene); },
                                    "for a new scene");
                     });
}
void openReference(Studio& studio) {
  const std::string near = studio.workspace.referenceFile().empty() ? studio.workspace.document.file()
                                                                    : studio.workspace.referenceFile();
  studio.dialog.open("Open a picture to compare with", FileDialog::Purpose::read, near,
                     pictureSuffixes(FileDialog::Purpose::read),
                     [&studio](const std::string& file) { studio.workspace.openReference(file); });
}
void exportPicture(Studio& studio) {
  studio.dialog.open("Export the picture", FileDialog::Purpose::write, studio.workspace.defaultPictureFile(),
                     pictureSuffixes(FileDialog::Purpose::write),
                     [&studio](const std::string& file) { studio.workspace.savePicture(file); });
}
void exportRays(Studio& studio) {
  const std::filesystem::path picture(studio.workspace.defaultPictureFile());
  studio.dialog.open("Export the rays", FileDialog::Purpose::write,
                     (picture.parent_path() / (picture.stem().string() + "-rays.svg")).string(),
                     kDrawingSuffixes, [&studio](const std::string& file) { saveRays(studio, file); });
}
void exportStory(Studio& studio) {
  const std::filesystem::path picture(studio.workspace.defaultPictureFile());
  studio.dialog.open("Export the view in space and the tree", FileDialog::Purpose::write,
                     (picture.parent_path() / (picture.stem().string() + "-tree.svg")).string(),
                     kStorySuffixes, [&studio](const std::string& file) { saveStory(studio, file); });
}
void saveSceneAs(Studio& studio) { saveSceneAsAnd(studio, nullptr); }
void saveScene(Studio& studio) { saveSceneAnd(studio, nullptr); }
void zoomText(Studio& studio, float factor) {
  studio.userScale = std::clamp(studio.userScale * factor, 0.5f, 3.0f);
  studio.themeChanged = true;
}

void copyLink(Studio& studio) {
  try {
    const host::Kept kept = keptScene(studio);
    host::copyLink(kept.text, kept.pixel);
  } catch (const Error& error) {
    studio.refuse(error.what());
    return studio.mention("Log");
  }
  studio.workspace.note("the link is copied");
}

constexpr std::array kActions{
    Action{"File", "New scene...", 'N', true, false, "write a first scene to a new file, and open it",
           newScene, always, nullptr},
    Action{"File", "New small scene...", 0, false, false,
           "write a scene for a course to a new file, and open it: a floor, a ball and a light, by Whitted's "
           "tracer",
           newSmallScene, always, nullptr},
    Action{"File", "Open scene...", 'O', true, false, "choose a scene file", openScene, always, nullptr},
    Action{"File", "Open from this computer...", 0, false, false,
           "choose files of your computer: a scene, what it needs, or a picture to compare with",
           [](Studio&) { host::askForFiles(); }, always, nullptr, true},
    Action{"File", "Copy link", 0, false, false,
           "an address that holds the scene as it is now, and the chosen pixel", copyLink, hasScene, nullptr,
           true},
    Action{"File", "Open reference...", 'R', true, true, "choose a picture to compare with", openReference,
           always, nullptr},
    Action{"File", "Close reference", 0, false, false, "compare no more",
           [](Studio& s) {
             s.workspace.closeReference();
             s.picture.view = View::picture;
           },
           hasReference, nullptr},
    Action{"File", "Background image...", 0, false, false, "choose a picture to be seen behind everything",
           [](Studio& s) { chooseFile(s, findOption("backdrop")); }, hasScene, nullptr},
    Action{"File", "Environment map...", 0, false, false,
           "choose a picture all around: a map, or one of the six faces of a cube",
           [](Studio& s) { chooseFile(s, findOption("environment")); }, hasScene, nullptr},
    Action{"File", "Save scene", 'S', true, false, "write the scene, as edited, to its .ray file", saveScene,
           hasScene, nullptr},
    Action{"File", "Save scene as...", 'S', true, true, "write the scene, as edited, to another .ray file",
           saveSceneAs, hasScene, nullptr},
    Action{"File", "Export picture...", 'E', true, false, "write the picture to a file", exportPicture,
           hasPicture, nullptr},
    Action{"File", "Export rays...", 0, false, false,
           "write a drawing of the pixel's rays, from the camera and from the side, as .svg or .png",
           exportRays, [](const Studio& s) { return shownPixel(s) != nullptr; }, nullptr},
    Action{
        "File", "Export view and tree...", 0, false, false,
        "write the view in space with its rays, their tree and the sum as .svg or .png, or as a film: .apng",
        exportStory, [](const Studio& s) { return shownPixel(s) != nullptr; }, nullptr},
    Action{"File", "Quit", 'Q', true, false, "close the studio",
           [](Studio& s) { s.leave([&s] { s.quit = true; }, "to quit"); }, always, nullptr},
    Action{"Edit", "Undo", 'Z', true, false, "take the last change back", undo,
           [](const Studio& s) { return !s.workspace.undoName().empty(); }, nullptr},
    Action{"Edit", "Redo", 'Y', true, false, "make the change again", redo,
           [](const Studio& s) { return s.workspace.document.canRedo(); }, nullptr},
    Action{"Edit", "Duplicate", 'D', true, false, "the selected object once more", duplicateSelected,
           canDuplicate, nullptr},
    Action{"Edit", "Delete", kDelete, false, false, "take the selected object or light out", deleteSelected,
           canDelete, nullptr},
    Action{"Edit", "Move with handles", 'M', false, false, "the selected object, in the view in space",
           handlesDo<GizmoMode::move>, canDuplicate, isHandle<GizmoMode::move>},
    Action{"Edit", "Turn with handles", 'T', false, false, "the selected object, in the view in space",
           handlesDo<GizmoMode::turn>, canDuplicate, isHandle<GizmoMode::turn>},
    Action{"Edit", "Scale with handles", 'S', false, false, "the selected object, in the view in space",
           handlesDo<GizmoMode::scale>, canDuplicate, isHandle<GizmoMode::scale>},
    Action{"Render", "Render", kF5, false, false, "render the scene as it is now",
           [](Studio& s) { s.workspace.startRender(); }, hasScene, nullptr},
    Action{"Render", "Stop", kEscape, false, false, "stop; finished parts stay",
           [](Studio& s) { s.workspace.render.stop(); }, renders, nullptr},
    Action{"Render", "Render after every change", 0, false, false, "the picture follows what you do",
           [](Studio& s) { s.workspace.automatic = !s.workspace.automatic; }, always,
           [](const Studio& s) { return s.workspace.automatic; }},
    Action{"View", "Fit the picture", 'F', false, false, "the whole picture",
           [](Studio& s) { s.picture.fit = true; }, hasPicture, nullptr},
    Action{"View", "Actual pixels", 'A', false, false, "one pixel of the picture to one of the screen",
           [](Studio& s) {
             s.picture.fit = false;
             s.picture.zoom = 1;
           },
           hasPicture, nullptr},
    Action{"View", "Next comparison", 'C', false, false,
           "picture, reference, side by side, swipe, difference, false colour",
           [](Studio& s) { s.picture.nextView(); }, hasReference, nullptr},
    Action{"View", "Brighter", '=', false, false, "exposure half a stop up",
           [](Studio& s) { s.picture.exposure += 0.5f; }, always, nullptr},
    Action{"View", "Darker", '-', false, false, "exposure half a stop down",
           [](Studio& s) { s.picture.exposure -= 0.5f; }, always, nullptr},
    Action{"View", "Play the rays", 'P', false, false,
           "the pixel's rays one after the other, in the order of tracing", playRays,
           [](const Studio& s) { return shownPixel(s) != nullptr; },
           [](const Studio& s) { return s.rays.playsAt >= 0; }},
    Action{"View", "Stage", kF11, false, false, "picture and view in space alone, large; space: the next ray",
           toggleStage, hasScene, [](const Studio& s) { return s.stage; }},
    Action{"View", "Magnify", 'Z', false, false,
           "what the pointer is at, twice as large, then four times, then as before",
           [](Studio& s) { s.magnification = nextMagnification(s.magnification); }, always,
           [](const Studio& s) { return s.magnification > 1; }},
    Action{"View", "Light theme", 'L', true, false, "dark letters on light, or light on dark",
           [](Studio& s) {
             s.theme.light = !s.theme.light;
             s.themeChanged = true;
           },
           always, [](const Studio& s) { return s.theme.light; }},
    Action{"View", "Larger text", '=', true, false, "enlarge everything",
           [](Studio& s) { zoomText(s, 1.125f); }, always, nullptr},
    Action{"View", "Smaller text", '-', true, false, "shrink everything",
           [](Studio& s) { zoomText(s, 1 / 1.125f); }, always, nullptr},
    Action{"View", "Look", kF2, false, false, "the picture, and the rays of a pixel",
           [](Studio& s) { arrange(s, arrangements()[0]); }, always, isArranged<0>},
    Action{"View", "Build", kF3, false, false, "options and scene, the picture, and the view in space",
           [](Studio& s) { arrange(s, arrangements()[1]); }, always, isArranged<1>},
    Action{"View", "Compare", kF4, false, false, "the picture alone, next to another one",
           [](Studio& s) { arrange(s, arrangements()[2]); }, always, isArranged<2>},
    Action{"Help", "Keys and mouse", kF1, false, false, "this list", [](Studio& s) { s.showHelp = true; },
           always, nullptr},
    Action{"Help", "About", 0, false, false, "version and licence", [](Studio& s) { s.showAbout = true; },
           always, nullptr},
};

/// A field that takes text undoes, copies and selects in it.
bool belongsToText(const KeyPress& press) {
  const bool edits = press.key > 0 && press.key < 128 &&
                     std::string_view("ACVXYZ").find(static_cast<char>(press.key)) != std::string_view::npos;
  const bool function = press.key >= kF1 && press.key <= kF11;
  return press.control ? edits && !press.alt : !press.alt && !function;
}

void recentMenu(Studio& studio) {
  const auto recent = studio.workspace.recent();  // a copy: opening one changes the list
  if (!ImGui::BeginMenu("Open recent", !recent.empty())) return;
  for (const std::string& file : recent) {
    if (ImGui::MenuItem(file.c_str())) leaveToOpen(studio, file);
    landmark("recent " + std::filesystem::path(file).filename().generic_string());
  }
  ImGui::EndMenu();
}

/// Left and right in an open menu, where no entry takes them, open the one beside it, round the bar. Called
/// at the end of a menu.
void goToNextMenu(Studio& studio, std::string_view menu) {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const bool left = context.NavMoveDir == ImGuiDir_Left, right = context.NavMoveDir == ImGuiDir_Right;
  const ImGuiWindow* own = ImGui::GetCurrentWindow();
  const ImGuiWindow* at = context.NavWindow;
  while (at && at != own && (at->Flags & ImGuiWindowFlags_ChildMenu))
    at = at->ParentWindow;  // right in a submenu
  if (at != own || (!left && !right) || !ImGui::NavMoveRequestButNoResultYet()) return;
  std::vector<const char*> bar;
  for (const Action& action : kActions)
    if (bar.empty() || std::string_view(bar.back()) != action.menu) bar.push_back(action.menu);
  const auto here = static_cast<std::size_t>(std::find(bar.begin(), bar.end(), menu) - bar.begin());
  studio.menuToOpen = bar[(here + (left ? bar.size() - 1 : 1)) % bar.size()];
  ImGui::NavMoveRequestCancel();
}

/// The help of an entry that the cursor is on, beside the menu, so that it hides no other entry.
void menuTooltip(const char* help) {
  if (!ImGui::IsItemHovered()) return;
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
  ImGui::SetNextWindowPos({right + ImGui::GetStyle().ItemSpacing.x, ImGui::GetItemRectMin().y});
  ImGui::SetTooltip("%s", help);
}

}  // namespace

host::Kept keptScene(const Studio& studio) {
  const Document& document = studio.workspace.document;
  if (!document.isOpen()) return {};
  host::Kept kept{
      (std::filesystem::path(document.file()).parent_path() / "link.ray").string(), document.file(), {}};
  Document::write(document.saving(kept.text));
  if (studio.picture.pixel) {
    const auto& shown = studio.picture.shown;
    const auto [x, y] = studio.picture.pixel.in({shown.width, shown.height});
    kept.pixel = std::to_string(x) + "," + std::to_string(y);
  }
  return kept;
}

void takeKeys(Studio& studio) {
  if (studio.pressed(kEnter)) enterPresses();
  if (modalIsOpen(studio)) return;
  // Menus and lists take the plain keys; Dear ImGui closes them on Esc.
  constexpr ImGuiPopupFlags kAny = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  const bool popup = ImGui::IsPopupOpen("", kAny), text = ImGui::GetIO().WantTextInput;
  const bool closed = std::exchange(studio.popupOpen, popup) && !popup;  // by a key of this frame
  if (studio.workspace.opening()) return;  // the keys are meant for the scene that comes
  for (const KeyPress& press : studio.keys) {
    if (studio.stage && press.key == ' ') stepOnStage(studio);
    if (studio.stage && press.key == kEscape) toggleStage(studio);
    if ((text && belongsToText(press)) || (closed && press.key == kEscape) ||
        (popup && !press.control && !press.alt))
      continue;
    for (const Action& action : kActions)
      if (action.key == press.key && action.control == press.control &&
          (action.shift == press.shift || press.key == '=') &&  // where + is above =
          !press.alt && action.enabled(studio))
        action.run(studio);
    if (press.alt)
      for (const Panel& panel : panels())
        if (panel.key == press.key) studio.goTo(std::string(panel.name));
    for (const Action& action : kActions)
      if (press.alt ? action.menu[0] == press.key : press.key == kF10 && &action == kActions.data())
        studio.menuToOpen = action.menu;
  }
}

void chooseFile(Studio& studio, const Option& option) {
  const std::string name(option.name), now = option.get(studio.workspace.chosenSettings());
  const std::string near = now == "none" ? studio.workspace.document.file() : now;
  const std::string hint = name == "environment" ? ": a map, or any of the six faces of a cube" : "";
  studio.dialog.open("Choose the " + name + hint, FileDialog::Purpose::read, near,
                     pictureSuffixes(FileDialog::Purpose::read),
                     [&studio, name](const std::string& file) { studio.workspace.choose(name, file); });
}

std::span<const Action> actions() { return kActions; }

std::string keyText(const Action& action) {
  if (!action.key) return "";
  std::string text = action.control ? "Ctrl+" : "";
  if (action.shift) text += "Shift+";
  switch (action.key) {
    case kEnter: return text + "Enter";
    case kEscape: return text + "Esc";
    case kF1: return text + "F1";
    case kF2: return text + "F2";
    case kF3: return text + "F3";
    case kF4: return text + "F4";
    case kF5: return text + "F5";
    case kF11: return text + "F11";
    case kDelete: return text + "Delete";
    case '=': return text + "+";
    default: return text + static_cast<char>(action.key);
  }
}

namespace {

/// At the right of the bar: the arrangements, and the file.
void drawMenuEnd(Studio& studio) {
  const std::string& file = studio.workspace.document.file();
  const std::string name = std::filesystem::path(file).filename().generic_string(),
                    text = name + (studio.workspace.document.edited() ? " (edited)" : "");
  const float gap = characters(2);
  float width = ImGui::CalcTextSize(text.c_str()).x + gap;
  for (const Arrangement& each : arrangements()) width += ImGui::CalcTextSize(each.name.data()).x + gap;
  const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX();
  if (room < width - ImGui::CalcTextSize(text.c_str()).x) return;  // a narrow window: the menu has them too
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - width - gap));
  for (const Arrangement& each : arrangements()) {
    const bool now = studio.layout.arrangement == each.name;
    ImGui::PushStyleColor(ImGuiCol_Text, now ? studio.palette().accent : studio.palette().muted);
    const bool pressed = ImGui::Selectable(each.name.data(), false, 0, ImGui::CalcTextSize(each.name.data()));
    ImGui::PopStyleColor();
    landmark("arrangement " + std::string(each.name));
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s (F%d)", each.help.data(), static_cast<int>(&each - arrangements().data()) + 2);
    if (pressed) arrange(studio, each);
    ImGui::SameLine(0, gap);
  }
  ImGui::TextDisabled("%s", text.c_str());
  if (!file.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.c_str());
}

}  // namespace

void drawMenu(Studio& studio) {
  takeKeys(studio);
  if (!ImGui::BeginMainMenuBar()) return;
  if (const std::string asked = std::exchange(studio.menuToOpen, ""); !asked.empty()) {
    ImGui::OpenPopup(asked.c_str());
    showKeyboardCursor();
  }
  for (std::size_t i = 0; i < kActions.size();) {
    const char* menu = kActions[i].menu;
    const bool open = ImGui::BeginMenu(menu);
    if (!open) landmark("menu " + std::string(menu));
    for (; i < kActions.size() && std::string_view(kActions[i].menu) == menu; ++i) {
      const Action& action = kActions[i];
      if (!open || (action.inPage && !host::isPage())) continue;
      const bool checked = action.checked && action.checked(studio);
      if (ImGui::MenuItem(action.name, keyText(action).c_str(), checked, action.enabled(studio)))
        action.run(studio);
      landmark("action " + std::string(action.name));
      menuTooltip(action.help);
      if (action.key == 'O') recentMenu(studio);
    }
    if (!open) continue;
    if (std::string_view(menu) == "View") {
      ImGui::Separator();
      for (const Panel& panel : panels()) {
        const std::string key = std::string("Alt+") + static_cast<char>(panel.key);
        if (ImGui::MenuItem(panel.name.data(), key.c_str())) studio.goTo(std::string(panel.name));
      }
    }
    goToNextMenu(studio, menu);
    ImGui::EndMenu();
  }
  drawMenuEnd(studio);
  ImGui::EndMainMenuBar();
}

}  // namespace trace::studio
