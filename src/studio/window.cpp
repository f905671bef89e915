#include "studio/window.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace trace::studio {

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<std::string> dropped;
  std::vector<KeyPress> keys;
  struct Release {
    int key, scancode, held;
  };
  std::vector<int> wentDown;      // since the last frame
  std::vector<Release> releases;  // of such keys: Dear ImGui 1.86 must not hear of them before the next frame
  int width = 0, height = 0;      // of the frame buffer
  int framesDue = 3;              // what happens in a frame may show only in the next
};

namespace {

constexpr int kSettlingFrames = 3;

[[noreturn]] void fail(const std::string& what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  const std::string because = reason ? std::string(": ") + reason : "";
  glfwTerminate();
  throw Error(Fault::io, what + because,
              "the studio needs a display and OpenGL 3.3; \"ray SCENE\" renders without either");
}

void limitToMonitor(int& width, int& height) {
  if (const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor()))
    width = std::min(width, mode->width), height = std::min(height, mode->height);
}

}  // namespace

Window::Window(const std::string& title, int width, int height) : state_(std::make_unique<State>()) {
  glfwSetErrorCallback(nullptr);
  if (!glfwInit()) fail("cannot open a window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  limitToMonitor(width, height);
  state_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!state_->window) fail("cannot open a window");
  glfwMakeContextCurrent(state_->window);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(state_->window, state_.get());
  glfwSetDropCallback(state_->window, [](GLFWwindow* window, int count, const char** paths) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    state.dropped.insert(state.dropped.end(), paths, paths + count);
  });
  // Set before those of Dear ImGui, which call it.
  glfwSetKeyCallback(state_->window, [](GLFWwindow* window, int key, int scancode, int action, int held) {
    if (action != GLFW_PRESS && action != GLFW_REPEAT) return;
    const char* name = glfwGetKeyName(key, scancode);  // of the user's keyboard
    if (name && name[0] && !name[1])
      key = *name == '+' ? '=' : std::toupper(static_cast<unsigned char>(*name));
    static_cast<State*>(glfwGetWindowUserPointer(window))
        ->keys.push_back(
            {key, (held & GLFW_MOD_CONTROL) != 0, (held & GLFW_MOD_SHIFT) != 0, (held & GLFW_MOD_ALT) != 0});
  });
  ImGui::CreateContext();
  ImGui_ImplGlfw_InitForOpenGL(state_->window, true);
  glfwSetKeyCallback(state_->window, [](GLFWwindow* window, int key, int scancode, int action, int held) {
    auto& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    const auto begin = state.wentDown.begin(), end = state.wentDown.end();
    if (action == GLFW_RELEASE && std::find(begin, end, key) != end)
      return state.releases.push_back({key, scancode, held});
    if (action == GLFW_PRESS) state.wentDown.push_back(key);
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, held);
  });
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(state_->window);
  glfwTerminate();
}

void Window::beginFrame(double mostSeconds) {
  state_->wentDown.clear();
  for (const State::Release& release : std::exchange(state_->releases, {}))
    ImGui_ImplGlfw_KeyCallback(state_->window, release.key, release.scancode, GLFW_RELEASE, release.held);
  if (state_->framesDue > 0) {
    --state_->framesDue;
    glfwPollEvents();
  } else {
    const double before = glfwGetTime();
    glfwWaitEventsTimeout(mostSeconds);
    if (glfwGetTime() - before < mostSeconds) state_->framesDue = kSettlingFrames;
  }
  glfwGetFramebufferSize(state_->window, &state_->width, &state_->height);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
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
std::vector<std::string> Window::takeDropped() { return std::exchange(state_->dropped, {}); }

std::vector<KeyPress> Window::takeKeys() { return std::exchange(state_->keys, {}); }

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
