#include "base/os/interrupts.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include "base/os/windows/api.h"

namespace trace::os {
namespace {

std::atomic<void (*)(Interrupt)> handler{nullptr};

/// Runs in a thread of its own.
BOOL WINAPI onControl(DWORD event) {
  const auto onInterrupt = handler.load();
  if (!onInterrupt) return FALSE;
  onInterrupt(Interrupt::stop);
  // After a window was closed the process ends with this function, or some seconds later: time to save.
  constexpr DWORD kTimeToSave = 10000;  // milliseconds
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(kTimeToSave);
  return TRUE;
}

}  // namespace

InterruptHandler::InterruptHandler(void (*onInterrupt)(Interrupt)) {
  handler = onInterrupt;
  ::SetConsoleCtrlHandler(onControl, TRUE);
}

InterruptHandler::~InterruptHandler() {
  ::SetConsoleCtrlHandler(onControl, FALSE);
  handler = nullptr;
}

void receiveInterrupts(bool) {}  // no thread of the program is interrupted

struct Bell::State {
  std::mutex mutex;
  std::condition_variable rung;
  std::string messages;
};

Bell::Bell() : state_(std::make_unique<State>()) {}
Bell::~Bell() = default;

void Bell::ring(char message) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->messages += message;
  }
  state_->rung.notify_one();
}

char Bell::wait(int milliseconds) {
  std::unique_lock lock(state_->mutex);
  const auto isRung = [this] { return !state_->messages.empty(); };
  if (!state_->rung.wait_for(lock, std::chrono::milliseconds(milliseconds), isRung)) return 0;
  const char message = state_->messages.front();
  state_->messages.erase(0, 1);
  return message;
}

}  // namespace trace::os
