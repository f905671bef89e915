// All that the panels share: the workspace (app/editing/workspace.h has the logic), what is selected, how
// things are looked at. Panels and actions are rows of tables (panels.cpp, actions.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>

#include "app/editing/preferences.h"
#include "app/editing/workspace.h"
#include "app/view/arrangement.h"
#include "studio/picture/picture_view.h"
#include "studio/scene/additions_popup.h"
#include "studio/space/rays_view.h"
#include "studio/start_page.h"
#include "studio/widgets/file_dialog.h"
#include "studio/widgets/theme.h"
#include "studio/window.h"

namespace trace::studio {

/// Where the panels are. Kept in the preferences.
struct Layout {
  DockShares shares;
  bool drawer = false;        ///< the lower dock is open
  bool oneColumn = false;     ///< as in the last frame: panels of the left dock are in the right one
  std::string arrangement{};  ///< chosen last; "" before one is
  float list = 0.42f;         ///< share of the panel Scene
  static constexpr float kLeastList = 0.1f, kMostList = 0.8f;
  std::map<std::string, Dock, std::less<>> docks;  ///< where they differ from the table
  std::map<Dock, std::string> front;               ///< the panel shown; one that was asked for
  std::string ask;                                 ///< bring this panel to the front in the next frame
  bool opens = true;                               ///< and open the drawer if it is there
  bool focus = false;                              ///< and the keyboard to it
};

struct Studio {
  explicit Studio(Window& w) : window(w) {}

  Window& window;
  Workspace workspace;
  Preferences preferences;
  std::string configFolder;
  Theme theme;
  float userScale = 1;     ///< times the monitor's
  bool popupOpen = false;  ///< a menu or list was open in the last frame
  bool themeChanged = true;
  Layout layout;
  PictureView picture;
  RaysView rays;
  StartPage start;
  Previews previews;
  std::string raysTab;     ///< a tab of the panel Rays to bring to the front
  std::string menuToOpen;  ///< by its name, for the keyboard
  FileDialog dialog;
  std::vector<KeyPress> keys;  ///< keys of this frame
  struct Keyboard {            ///< where it was at the end of the last frame
    unsigned item = 0, window = 0;
    std::array<float, 4> place{};  ///< in the window
    bool popup = false;            ///< one was open
    bool hidden = true;            ///< the frame around it
  } keyboard;
  std::uint64_t frames = 0;  ///< drawn so far
  int scriptFrames = 0;      ///< frames that the current command of a script has seen
  Workspace::Pulse pulse{};  ///< as the last frame showed it
  bool modelling = false;    ///< the view in space gets new triangles
  std::string sceneFile;     ///< that the selection and the views belong to
  bool stage = false;        ///< picture and view in space alone, large
  int magnification = 1;     ///< the part around the pointer fills the window
  bool showHelp = false, showAbout = false, quit = false;

  // The scene panel's selection: what kind of thing, and its index.
  enum class Selected { camera, background, object, light, material, none };
  static constexpr std::string_view kSelectedNames[] = {"camera", "background", "object",
                                                        "light",  "material",   "none"};
  Selected selected = Selected::camera;
  std::size_t selectedIndex = 0;
  bool revealSelected = false;  ///< the list scrolls to it when it is drawn next
  void select(Selected kind, std::size_t index) {
    selected = kind;
    selectedIndex = index;
    revealSelected = true;
  }
  /// An error that the log has, over the panels until it is dismissed or the scene is another.
  struct Banner {
    std::string text{};
    std::shared_ptr<const Scene> scene{};
  } banner;
  unsigned editedItem = 0;       ///< the widget whose changes make one step until it is let go
  std::uint64_t stepBefore = 0;  ///< state of the document before it was taken hold of

  const Palette& palette() const { return studio::palette(theme.light); }
  bool pressed(int key) const {
    return std::any_of(keys.begin(), keys.end(), [&](const KeyPress& press) { return press.key == key; });
  }
  /// Does what loses the edits of the scene, after asking if there are any. `next` says it: "to quit".
  void leave(std::function<void()> then, const std::string& next) {
    if (!workspace.unsaved()) return then();
    leaving = std::move(then);
    leavingTo = next;
  }
  std::string leavingTo;          ///< what the question says of it
  std::function<void()> leaving;  ///< waits for an answer, or for a scene that is being saved
  /// Says in the log why a value that was typed or dragged went back; once while it is dragged on.
  void refuse(const std::string& why) {
    const auto& log = workspace.log();
    if (log.empty() || log.back().text != why) workspace.note(why);
  }
  void show(const std::string& panel) {
    layout.ask = panel;
    layout.opens = true;
  }
  /// Its tab comes to the front, and a closed drawer stays closed: the last message stands next to its tabs.
  void mention(const std::string& panel) {
    layout.ask = panel;
    layout.opens = false;
  }
  /// With the keyboard in it.
  void goTo(const std::string& panel) {
    show(panel);
    layout.focus = true;
  }
};

/// The state of the scene before is dropped when another is opened: the chosen pixel, the selection.
void followScene(Studio& studio);

/// Opens the scene; before that it asks about unsaved changes.
inline void leaveToOpen(Studio& studio, const std::string& file) {
  studio.leave([&studio, file] { studio.workspace.open(file); }, "to open " + file);
}
/// Esc leaves the keyboard where it was, and Tab continues from there. Called before anything is drawn.
void keepKeyboard(Studio& studio);
/// Esc gives back what a drag changed, and does nothing else then. Called before anything is drawn.
void escapeDrag(Studio& studio);
/// Called when all is drawn.
void noteKeyboard(Studio& studio);

/// The frame around what the keyboard is at is shown, as after an arrow key.
void showKeyboardCursor();

/// Enter uses what the keyboard is at, as Space does; Dear ImGui only begins to type with it.
void enterPresses();

/// Puts the panels where the arrangement has them.
void arrange(Studio& studio, const Arrangement& arrangement);
/// The panel is in a dock.
bool isShown(const Studio& studio, std::string_view panel);

/// One frame: menu, panels, dialogs.
void drawStudio(Studio& studio);

/// Reads and writes studio.preferences.
void restore(Studio& studio);
void remember(Studio& studio);

}  // namespace trace::studio
