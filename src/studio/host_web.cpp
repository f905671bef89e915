#include <emscripten.h>
#include <emscripten/html5.h>

#include <utility>

#include "studio/host.h"

namespace trace::studio::host {
namespace {

std::function<bool()> step;  // which the page calls for each of its frames

void frame() {
  if (step()) return;
  emscripten_cancel_main_loop();
  step = nullptr;
}

}  // namespace

void eachFrame(std::function<bool()> each) {
  step = std::move(each);
  emscripten_set_main_loop(frame, 0, false);
}

bool waitForEvents(double) { return false; }
std::string glfwReason() { return {}; }
float contentScale(GLFWwindow*) { return static_cast<float>(emscripten_get_device_pixel_ratio()); }
char keyWrites(int key, int) { return key >= ' ' && key < 127 ? static_cast<char>(key) : '\0'; }
std::string examples() { return "/scenes"; }

}  // namespace trace::studio::host
