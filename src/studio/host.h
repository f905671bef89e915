// What the studio asks of the system that it runs on: the desktop (host_desktop.cpp) or a page in a browser
// (host_web.cpp).
#pragma once

#include <functional>
#include <string>

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
/// The folder of the scenes that come with Trace; "" if it is not found.
std::string examples();

}  // namespace trace::studio::host
