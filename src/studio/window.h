// The window: GLFW, OpenGL 3.3 and Dear ImGui's back ends behind a few calls. With texture.cpp and
// scene_drawer.cpp the only place that knows them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/input/input_queue.h"
#include "image/development/tone.h"

namespace trace::studio {

/// A key that went down, with those that were held.
struct KeyPress {
  static constexpr int kEscape = 256, kEnter = 257, kDelete = 261, kF1 = 290, kF5 = 294, kF10 = 299,
                       kF11 = 300, kKeypadEnter = 335;

  int key;  ///< what it writes, a capital letter for letters, '=' for plus; else GLFW's code
  bool control, shift, alt;
};

class Window {
 public:
  /// Throws Error(Fault::io) where no window can be opened.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits for something to happen, at most this long. True if a frame is to be drawn for it.
  bool wait(double mostSeconds);
  /// Hands the frame its share of what happened: the rest is for the next frames.
  void beginFrame();
  /// The part of the window around the pointer fills it, so many times as large.
  void endFrame(int magnification);
  /// Nothing that happened up to now waits for a frame.
  bool quiet();
  /// Seconds since mouse or keyboard did something.
  double rested() const;
  bool closing() const;
  void keepOpen();  ///< takes back the wish to close
  void hide();
  void setTitle(const std::string& title);
  void setSize(int width, int height);  ///< at most the monitor's
  void size(int& width, int& height) const;

  /// By which everything should be enlarged on this monitor: 1 on a plain one, 2 on most 4K ones.
  float contentScale() const;
  /// Files that were dropped onto the window since the last call.
  std::vector<std::string> takeDropped();
  /// As if the file were dropped onto the window.
  void drop(const std::string& file);
  /// As if it came from the mouse or the keyboard.
  void feed(const InputEvent& event);
  /// Keys that went down in this frame.
  const std::vector<KeyPress>& keys() const;
  /// The pixels of the last frame.
  Bytes screenshot() const;
  /// To be called after the fonts have changed, between frames.
  void fontsChanged();

 private:
  void draw() const;
  void listen();
  void takeFingers();
  void hand(const InputEvent& event);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trace::studio
