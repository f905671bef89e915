#include "studio/window.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace trace::studio {

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<std::string> dropped;
  std::vector<KeyPress> keys;   // keys of this frame
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
  const char* reason = nullptr;
  glfwGetError(&reason);
  const std::string because = reason ? std::string(": ") + reason : "";
  glfwTerminate();
  throw Error(Fault::io, what + because,
              "the studio needs a display and OpenGL 3.3; \"ray SCENE\" renders without either");
}

void limitToMonitor(int& width, int& height) {
  if (const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor())) {
    width = std::min(width, mode->width);
    height = std::min(height, mode->height);
  }
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
  glfwSwapInterval(1);
  listen();
  ImGui::CreateContext();
  ImGui_ImplGlfw_InitForOpenGL(state_->window, false);
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplOpenGL3_Init("#version 330 core");
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
    const char* name = glfwGetKeyName(key, scancode);  // name of the user's keyboard
    if (name && name[0] && !name[1])
      event.writes = *name == '+' ? '=' : std::toupper(static_cast<unsigned char>(*name));
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
  const double before = glfwGetTime();
  state.slack = before - state.heard;
  state.happened = false;
  if (state.framesDue > 0 || !state.queue.empty()) {
    glfwPollEvents();
  } else {
    glfwWaitEventsTimeout(mostSeconds);
    if (glfwGetTime() - before < mostSeconds) state.happened = true;
  }
  state.heard = glfwGetTime();
  if (state.happened) state.framesDue = kSettlingFrames;
  return state.framesDue > 0 || !state.queue.empty();
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
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::endFrame() {
  ImGui::Render();
  draw();
  glfwSwapBuffers(state_->window);
}

bool Window::quiet() {
  State& state = *state_;
  state.happened = false;
  glfwPollEvents();
  if (state.happened) state.framesDue = kSettlingFrames;
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

float Window::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(state_->window, &x, &y);
  // X servers that say nothing of their monitor's density: by its height, in halves.
  const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor());
  const float byHeight = mode ? std::floor(static_cast<float>(mode->height) / 1080 * 2) / 2 : 1;
  return std::clamp(std::max({x, y, byHeight}), 1.0f, 4.0f);
}

void Window::drop(const std::string& file) { state_->dropped.push_back(file); }
void Window::feed(const InputEvent& event) { state_->add(event); }
std::vector<std::string> Window::takeDropped() { return std::exchange(state_->dropped, {}); }

const std::vector<KeyPress>& Window::keys() const { return state_->keys; }

Bytes Window::screenshot() const {
  const int width = state_->width, height = state_->height;
  const auto row = static_cast<std::size_t>(width) * 3;
  Bytes bytes{width, height, std::vector<std::uint8_t>(row * static_cast<std::size_t>(height))};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  draw();  // once more: what the front buffer holds is up to the system
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bytes.rgb.data());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height) / 2; ++y)  // OpenGL's row 0 is at the bottom
    std::swap_ranges(bytes.rgb.begin() + static_cast<std::ptrdiff_t>(y * row),
                     bytes.rgb.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     bytes.rgb.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
  return bytes;
}

void Window::fontsChanged() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

}  // namespace trace::studio
