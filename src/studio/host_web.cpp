#include <emscripten.h>
#include <emscripten/html5.h>

#include <filesystem>
#include <utility>

#include "studio/host.h"

namespace trace::studio::host {
namespace {

std::function<bool()> step;  // which the page calls for each of its frames
std::vector<std::string> opened;
std::function<std::string()> answer;

void callStep() {
  if (step()) return;
  emscripten_cancel_main_loop();
  step = nullptr;
}

}  // namespace

extern "C" {
// Called by the page (web/page.js).
EMSCRIPTEN_KEEPALIVE void traceOpened(const char* file) { opened.emplace_back(file); }
EMSCRIPTEN_KEEPALIVE const char* traceState() {
  static std::string text;
  text = answer ? answer() : "";
  return text.c_str();
}
}

void eachFrame(std::function<bool()> each) {
  step = std::move(each);
  emscripten_set_main_loop(callStep, 0, false);
}

bool waitForEvents(double) { return false; }
std::string glfwReason() { return {}; }
float contentScale(GLFWwindow*) { return static_cast<float>(emscripten_get_device_pixel_ratio()); }
char keyWrites(int key, int) { return key >= ' ' && key < 127 ? static_cast<char>(key) : '\0'; }
void handOver(const std::string& file) {
  EM_ASM({ tracePage.save(UTF8ToString($0), UTF8ToString($1)); }, file.c_str(),
         std::filesystem::path(file).filename().c_str());
}
void askForFiles() {
  EM_ASM({ tracePage.askForFiles(); });
}
std::vector<std::string> takeOpened() { return std::exchange(opened, {}); }
void copyLink(const std::string& scene, const std::string& pixel) {
  EM_ASM({ tracePage.copyLink(UTF8ToString($0), UTF8ToString($1)); }, scene.c_str(), pixel.c_str());
}
void answerWith(std::function<std::string()> state) { answer = std::move(state); }
bool isPage() { return true; }
std::string examples() { return "/scenes"; }

}  // namespace trace::studio::host
