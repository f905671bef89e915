#include <emscripten.h>
#include <emscripten/html5.h>
#include <imgui.h>

#include <filesystem>
#include <utility>

#include "base/error.h"
#include "studio/host.h"

namespace trace::studio::host {
namespace {

std::function<bool()> step;  // which the page calls for each of its frames
std::vector<std::string> opened;
std::vector<Touch> touches;
std::vector<InputEvent> typed;
std::string clipboard;  // as the page knows it
std::function<std::string()> answer;
std::function<Kept()> keep;

void callStep() {
  if (step()) return;
  emscripten_cancel_main_loop();
  step = nullptr;
}

/// The text stays until the next one.
const char* handed(std::string text) {
  static std::string last;
  last = std::move(text);
  return last.c_str();
}

}  // namespace

extern "C" {
// Called by the page (web/page.js).
EMSCRIPTEN_KEEPALIVE void traceOpened(const char* file) { opened.emplace_back(file); }
EMSCRIPTEN_KEEPALIVE const char* traceState() { return handed(answer ? answer() : ""); }
/// The kind is one of Touch::Kind.
EMSCRIPTEN_KEEPALIVE void traceTouched(int kind, int finger, double x, double y) {
  touches.push_back({static_cast<Touch::Kind>(kind), finger, x, y});
}
EMSCRIPTEN_KEEPALIVE void traceCharacter(unsigned character) {
  typed.push_back({.kind = InputEvent::Kind::character, .character = character});
}
/// A key of the screen's keyboard, by GLFW's code.
EMSCRIPTEN_KEEPALIVE void traceKey(int key) {
  for (const bool down : {true, false})
    typed.push_back({.kind = InputEvent::Kind::key, .code = key, .writes = key, .down = down});
}
EMSCRIPTEN_KEEPALIVE void tracePasted(const char* text) { clipboard = text; }
/// Draws what a touch changed at once: some browsers show the keyboard only while they handle it.
EMSCRIPTEN_KEEPALIVE void traceFrames(int count) {
  for (; count > 0 && step; --count) callStep();
}
/// Lines: a file with the scene as it is now, the file's own name, and the pixel. Empty if no scene is open.
EMSCRIPTEN_KEEPALIVE const char* traceKept() {
  try {
    const Kept kept = keep ? keep() : Kept{};
    return handed(kept.name.empty() ? "" : kept.text + "\n" + kept.name + "\n" + kept.pixel);
  } catch (const Error&) {  // no room for it
    return handed("");
  }
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
std::vector<Touch> takeTouches() { return std::exchange(touches, {}); }
std::vector<InputEvent> takeTyped() { return std::exchange(typed, {}); }
void wantText(bool wanted) {
  static bool before = false;
  if (std::exchange(before, wanted) != wanted) EM_ASM({ tracePage.type($0); }, wanted);
}
void connectClipboard() {
  ImGuiIO& io = ImGui::GetIO();
  io.GetClipboardTextFn = [](void*) { return clipboard.c_str(); };
  io.SetClipboardTextFn = [](void*, const char* text) {
    clipboard = text;
    EM_ASM({ tracePage.copy(UTF8ToString($0)); }, text);
  };
}
void copyLink(const std::string& scene, const std::string& pixel) {
  EM_ASM({ tracePage.copyLink(UTF8ToString($0), UTF8ToString($1)); }, scene.c_str(), pixel.c_str());
}
void answerWith(std::function<std::string()> state) { answer = std::move(state); }
void keepWith(std::function<Kept()> scene) { keep = std::move(scene); }
bool isPage() { return true; }
std::string examples() { return "/scenes"; }

}  // namespace trace::studio::host
