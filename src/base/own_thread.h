// A thread for work that a window must not wait for. Some systems give none: a page that a browser does not
// isolate from others. There the work is done in steps, between the frames of the window.
#pragma once

#include <system_error>
#include <thread>
#include <utility>

namespace trace {

/// Whether work for a window has a thread of its own, or none and is done between frames.
enum class Threads { own, none };

/// A thread that does the work; not joinable for Threads::none, or where the system gives no threads.
template <class Function>
std::thread ownThread(Threads threads, Function&& work) {
  if (threads == Threads::none) return {};
  try {
    return std::thread(std::forward<Function>(work));
  } catch (const std::system_error&) {
    return {};
  }
}

}  // namespace trace
