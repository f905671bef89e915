#include <algorithm>
#include <cmath>

#include "base/os/process.h"
#include "studio/host.h"
#include "studio/start_page.h"
#include "studio/widgets/gl.h"

namespace trace::studio::host {

void eachFrame(std::function<bool()> step) {
  while (step()) {
  }
}

bool waitForEvents(double mostSeconds) {
  const double before = glfwGetTime();
  glfwWaitEventsTimeout(mostSeconds);
  return glfwGetTime() - before < mostSeconds;
}

std::string glfwReason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason ? reason : "";
}

float contentScale(GLFWwindow* window) {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  // X servers that say nothing of their monitor's density: by its height, in halves.
  const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor());
  const float byHeight = mode ? std::floor(static_cast<float>(mode->height) / 1080 * 2) / 2 : 1;
  return std::clamp(std::max({x, y, byHeight}), 1.0f, 4.0f);
}

char keyWrites(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  return name && name[0] && !name[1] ? name[0] : '\0';
}

void handOver(const std::string&) {}
void askForFiles() {}
std::vector<std::string> takeOpened() { return {}; }
std::vector<Touch> takeTouches() { return {}; }
std::vector<InputEvent> takeTyped() { return {}; }
void wantText(bool) {}
void connectClipboard() {}
void copyLink(const std::string&, const std::string&) {}
void keepWith(std::function<Kept()>) {}
void answerWith(std::function<std::string()>) {}
bool isPage() { return false; }

std::string examples() { return examplesFolder(os::programIn(os::ownFolder(), "ray-studio")); }

}  // namespace trace::studio::host
