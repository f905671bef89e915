// Interrupts of a process that runs, by a person or the system: Ctrl-C, and signals of POSIX.
#pragma once

#include <memory>

namespace trace::os {

enum class Interrupt {
  stop,  ///< Ctrl-C, SIGTERM; on Windows also Ctrl-Break, and a window that is closed
  save,  ///< SIGUSR1, SIGHUP; nothing on Windows
};

/// Calls a function for each interrupt while it lives. The function runs in a signal handler or beside all
/// threads: it may use lock-free atomics, Bell::ring() and endAtOnce(). Make one at a time.
class InterruptHandler {
 public:
  explicit InterruptHandler(void (*onInterrupt)(Interrupt));
  ~InterruptHandler();
  InterruptHandler(const InterruptHandler&) = delete;
  InterruptHandler& operator=(const InterruptHandler&) = delete;
};

/// Whether interrupts may interrupt the calling thread and those it starts from now on.
void receiveInterrupts(bool here);

/// Wakes a thread that waits, also from within an InterruptHandler's function. Throws std::system_error when
/// the system has none.
class Bell {
 public:
  Bell();
  ~Bell();
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;

  /// `message` is not 0. May be lost if hundreds of others were not heard yet.
  void ring(char message);
  /// The next message; 0 when the time is over.
  char wait(int milliseconds);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trace::os
