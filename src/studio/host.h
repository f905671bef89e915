// The system that the studio runs on: the desktop (host_desktop.cpp) or a page in a browser
// (host_web.cpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/input/fingers.h"

struct GLFWwindow;

namespace trace::studio::host {

/// Calls the step until it is false. In a browser returns at once, and the page calls the step for each of
/// its frames.
void eachFrame(std::function<bool()> step);
/// Waits for events of the window, at most so many seconds; true if one came. In a browser they come between
/// the frames.
bool waitForEvents(double mostSeconds);
/// Why GLFW failed; "" if it does not say.
std::string glfwReason();
/// By which everything should be enlarged on the monitor of the window: 1 on a plain one, 2 on most 4K ones.
float contentScale(GLFWwindow* window);
/// The character that a key writes on the user's keyboard; 0 if that is none or not known.
char keyWrites(int key, int scancode);
/// In a page, files are the page's own until the person saves them: a file that was written is offered for
/// that.
void handOver(const std::string& file);
/// Asks for files of the person's computer, which takeOpened() then has. Nothing on the desktop, where all
/// files are at hand.
void askForFiles();
std::vector<std::string> takeOpened();
/// Changes of fingers on the screen of a page, and events of the screen's keyboard, since the last call.
/// Nothing on the desktop, where GLFW reports all input.
std::vector<Touch> takeTouches();
std::vector<InputEvent> takeTyped();
/// A field takes text, or none does: a page shows or hides the keyboard of the screen.
void wantText(bool wanted);
/// Gives Dear ImGui the clipboard of the page. On the desktop it has that of GLFW.
void connectClipboard();
/// Copies an address that holds the scene in this file and names a pixel, "X,Y" or "". Nothing on the
/// desktop.
void copyLink(const std::string& scene, const std::string& pixel);
/// The scene as it is now, which a page keeps when it is loaded again.
struct Kept {
  std::string text;   ///< the file that has it
  std::string name;   ///< the file that it is the new text of; "" if nothing is open
  std::string pixel;  ///< "X,Y", or "" if none is chosen
};
/// A page asks for it before it goes. Nothing on the desktop.
void keepWith(std::function<Kept()> scene);
/// A page may ask what the window shows, in words (script_state.h): so it is tested. Nothing on the desktop.
void answerWith(std::function<std::string()> state);
/// Whether this is a page in a browser.
bool isPage();

/// The folder of the scenes that come with Trace; "" if it is not found.
std::string examples();

}  // namespace trace::studio::host
