#include "studio/window.h"

#include "studio/widgets/gl.h"  // before GLFW
// clang-format off
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
// clang-format on
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
// For what lies under a finger.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <utility>

#include "app/view/magnifier.h"
#include "base/error.h"
#include "studio/host.h"

namespace trace::studio {

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<std::string> dropped;
  std::vector<KeyPress> keys;  // keys of this frame
  Fingers fingers;
  InputQueue queue;             // what Dear ImGui, which sees one state in each frame, has not heard of yet
  bool happened = false;        // anything, since the last look
  double touched = -1;          // when mouse or keyboard did something last
  double heard = 0, slack = 0;  // when events were asked for last, and how long they were not
  double clock = 0;             // clock of Dear ImGui
  ImVec2 pointer{-FLT_MAX, -FLT_MAX};
  std::array<bool, 5> buttons{};
  int width = 0, height = 0;  // width and height of the frame buffer
  int framesDue = 3;          // what happens in a frame may show only in the next

  void add(InputEvent event) {
    event.time = touched = glfwGetTime();
    event.slack = slack;
    queue.add(event);
    happened = true;
  }
};

namespace {

constexpr int kSettlingFrames = 3;
constexpr unsigned kPrivateUse = 0xE000;
constexpr double kDoubleClick = 0.3;  // seconds between its clicks, at most
constexpr double kLeastFrame = 1e-4;  // seconds: Dear ImGui's clock must not stand still

[[noreturn]] void failToOpen(const std::string& what) {
  const std::string reason = host::glfwReason();
  glfwTerminate();
  throw Error(Fault::io, what + (reason.empty() ? "" : ": " + reason),
              "the studio needs a display and OpenGL 3.3; \"ray SCENE\" renders without either");
}

void limitToMonitor(int& width, int& height) {
  if (const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor())) {
    width = std::min(width, mode->width);
    height = std::min(height, mode->height);
  }
}

/// A list or text that the wheel scrolls lies there.
bool scrollsAt(ImVec2 place) {
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
  for (int i = windows.Size; i-- > 0;) {
    const ImGuiWindow* window = windows[i];
    if (!window->WasActive || !window->OuterRectClipped.Contains(place) ||
        (window->Flags & ImGuiWindowFlags_NoMouseInputs))
      continue;
    for (; window; window = window->ParentWindow)
      if (window->ScrollMax.y > 0 && !(window->Flags & ImGuiWindowFlags_NoScrollWithMouse)) return true;
    return false;
  }
  return false;
}

}  // namespace

Window::Window(const std::string& title, int width, int height) : state_(std::make_unique<State>()) {
  glfwSetErrorCallback(nullptr);
  if (!glfwInit()) failToOpen("cannot open a window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  limitToMonitor(width, height);
  state_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!state_->window) failToOpen("cannot open a window");
  glfwMakeContextCurrent(state_->window);
  loadGl();
  glfwSwapInterval(1);
  listen();
  ImGui::CreateContext();
  ImGui_ImplGlfw_InitForOpenGL(state_->window, false);
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplOpenGL3_Init(kShaderVersion);
  host::connectClipboard();
}

void Window::listen() {
  GLFWwindow* window = state_->window;
  static constexpr auto stateOf = [](GLFWwindow* w) -> State& {
    return *static_cast<State*>(glfwGetWindowUserPointer(w));
  };
  using Kind = InputEvent::Kind;
  glfwSetWindowUserPointer(window, state_.get());
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    stateOf(w).dropped.insert(stateOf(w).dropped.end(), paths, paths + count);
    stateOf(w).happened = true;
  });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { stateOf(w).happened = true; });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { stateOf(w).happened = true; });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { stateOf(w).happened = true; });
  glfwSetWindowFocusCallback(
      window, [](GLFWwindow* w, int came) { stateOf(w).add({.kind = Kind::focus, .down = came != 0}); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    stateOf(w).add({.kind = Kind::pointer, .x = x, .y = y});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    if (!entered) stateOf(w).add({.kind = Kind::leave});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    stateOf(w).add({.kind = Kind::button, .code = button, .down = action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    stateOf(w).add({.kind = Kind::wheel, .x = x, .y = y});
  });
  glfwSetCharCallback(
      window, [](GLFWwindow* w, unsigned c) { stateOf(w).add({.kind = Kind::character, .character = c}); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int held) {
    InputEvent event{.kind = Kind::key, .code = key, .writes = key};
    if (const char written = host::keyWrites(key, scancode))
      event.writes = written == '+' ? '=' : std::toupper(static_cast<unsigned char>(written));
    event.down = action != GLFW_RELEASE;
    event.repeat = action == GLFW_REPEAT;
    event.modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
    event.control = (held & GLFW_MOD_CONTROL) != 0;
    event.shift = (held & GLFW_MOD_SHIFT) != 0;
    event.alt = (held & GLFW_MOD_ALT) != 0;
    stateOf(w).add(event);
  });
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(state_->window);
  glfwTerminate();
}

bool Window::wait(double mostSeconds) {
  State& state = *state_;
  state.slack = glfwGetTime() - state.heard;
  if (state.framesDue > 0 || !state.queue.empty()) {
    glfwPollEvents();
  } else {
    if (host::waitForEvents(mostSeconds)) state.happened = true;
  }
  takeFingers();
  state.heard = glfwGetTime();
  if (std::exchange(state.happened, false)) state.framesDue = kSettlingFrames;
  return state.framesDue > 0 || !state.queue.empty();
}

void Window::takeFingers() {
  constexpr double kSlip = 8, kLinesOfNotch = 5;  // pixels of a plain monitor; as Dear ImGui scrolls
  State& state = *state_;
  const Fingers::Lengths lengths{kSlip * contentScale(), std::max(1.0, kLinesOfNotch * ImGui::GetFontSize())};
  for (const Touch& touch : host::takeTouches())
    state.fingers.take(touch, scrollsAt({static_cast<float>(touch.x), static_cast<float>(touch.y)}), lengths);
  state.fingers.look(glfwGetTime());
  for (const InputEvent& event : state.fingers.events()) state.add(event);
  for (const InputEvent& event : host::takeTyped()) state.add(event);
}

void Window::hand(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  State& state = *state_;
  ImGuiIO& io = ImGui::GetIO();
  const bool dragging = std::find(state.buttons.begin(), state.buttons.end(), true) != state.buttons.end();
  switch (event.kind) {
    case Kind::pointer: state.pointer = {static_cast<float>(event.x), static_cast<float>(event.y)}; break;
    case Kind::leave:
      if (!dragging) state.pointer = {-FLT_MAX, -FLT_MAX};
      break;
    case Kind::button:
      if (event.code < 0 || event.code >= static_cast<int>(state.buttons.size())) break;
      state.buttons[static_cast<std::size_t>(event.code)] = event.down;
      // Two clicks may be that much nearer to each other than the frames that see them.
      io.MouseDoubleClickTime = static_cast<float>(kDoubleClick + event.slack);
      break;
    case Kind::wheel: ImGui_ImplGlfw_ScrollCallback(state.window, event.x, event.y); break;
    case Kind::focus: ImGui_ImplGlfw_WindowFocusCallback(state.window, event.down); break;
    case Kind::character: io.AddInputCharacter(event.character); break;
    case Kind::key:
      if (event.character) io.AddInputCharacter(event.character);
      // A key with Alt is no tap on Alt, which would go to the menu; a character that no field takes says so.
      if (event.alt && event.down && !event.modifier) io.AddInputCharacter(kPrivateUse);
      // Dear ImGui needs no key that only writes.
      if (!event.down || event.modifier || event.isCommand())
        ImGui_ImplGlfw_KeyCallback(state.window, event.code, 0, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
      if (event.down && !event.modifier)
        state.keys.push_back({event.writes, event.control, event.shift, event.alt});
      break;
  }
}

void Window::beginFrame() {
  State& state = *state_;
  if (state.framesDue > 0) --state.framesDue;
  state.keys.clear();
  glfwGetFramebufferSize(state.window, &state.width, &state.height);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  const std::vector<InputEvent> events = state.queue.takeFrame();
  for (const InputEvent& event : events) hand(event);
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = state.pointer;
  std::copy(state.buttons.begin(), state.buttons.end(), io.MouseDown);
  // The clock follows what happened, not how long it takes to see it.
  const double now = state.queue.empty() || events.empty() ? glfwGetTime() : events.back().time;
  const double clock = std::max(now, state.clock + kLeastFrame);
  io.DeltaTime = static_cast<float>(clock - state.clock);
  state.clock = clock;
  ImGui::NewFrame();
}

void Window::draw() const {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, state_->width, state_->height);
  const ImVec4& panel = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  glClearColor(panel.x, panel.y, panel.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::endFrame(int magnification) {
  ImGui::Render();
  ImDrawData& drawn = *ImGui::GetDrawData();
  const WindowPart part = magnified({drawn.DisplaySize.x, drawn.DisplaySize.y},
                                    {state_->pointer.x, state_->pointer.y}, magnification);
  const auto times = static_cast<float>(magnification);
  drawn.DisplayPos = {static_cast<float>(part.corner.x), static_cast<float>(part.corner.y)};
  drawn.DisplaySize = {static_cast<float>(part.size.x), static_cast<float>(part.size.y)};
  drawn.FramebufferScale = {drawn.FramebufferScale.x * times, drawn.FramebufferScale.y * times};
  draw();
  glfwSwapBuffers(state_->window);
  host::wantText(ImGui::GetIO().WantTextInput);
}

bool Window::quiet() {
  State& state = *state_;
  glfwPollEvents();
  if (std::exchange(state.happened, false)) state.framesDue = kSettlingFrames;
  return state.queue.empty() && state.framesDue == 0;
}
double Window::rested() const { return glfwGetTime() - state_->touched; }
bool Window::closing() const { return glfwWindowShouldClose(state_->window); }
void Window::keepOpen() { glfwSetWindowShouldClose(state_->window, GLFW_FALSE); }
void Window::hide() { glfwHideWindow(state_->window); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }
void Window::setSize(int width, int height) {
  limitToMonitor(width, height);
  glfwSetWindowSize(state_->window, width, height);
}
void Window::size(int& width, int& height) const { glfwGetWindowSize(state_->window, &width, &height); }

float Window::contentScale() const { return host::contentScale(state_->window); }

void Window::drop(const std::string& file) { state_->dropped.push_back(file); }
void Window::feed(const InputEvent& event) { state_->add(event); }
std::vector<std::string> Window::takeDropped() { return std::exchange(state_->dropped, {}); }

const std::vector<KeyPress>& Window::keys() const { return state_->keys; }

Bytes Window::screenshot() const {
  const auto width = static_cast<std::size_t>(state_->width),
             height = static_cast<std::size_t>(state_->height);
  std::vector<std::uint8_t> pixels(width * height * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  draw();  // once more: what the front buffer holds is up to the system
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, state_->width, state_->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  Bytes bytes{state_->width, state_->height, {}};
  bytes.rgb.reserve(width * height * 3);
  for (std::size_t y = height; y-- > 0;)  // OpenGL's row 0 is at the bottom
    for (const std::uint8_t *pixel = &pixels[y * width * 4], *end = pixel + width * 4; pixel < end;
         pixel += 4)
      bytes.rgb.insert(bytes.rgb.end(), pixel, pixel + 3);
  return bytes;
}

void Window::fontsChanged() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

}  // namespace trace::studio
