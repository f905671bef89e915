// The system around the program: the terminal, signals, memory. The only file that knows POSIX.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trace::cli {

/// stderr is a terminal on which a line can be drawn again (TERM is not "dumb").
bool canRedraw();
/// ... and colours are welcome (https://no-color.org).
bool canColor();
/// Whether stdout is a terminal, for results.
bool canColorResult();
/// The width of the terminal, by COLUMNS or by asking it; 80 when neither tells.
int columns();

/// The folder that this program lies in; "" if the system does not tell.
std::string ownFolder();
/// Replaces this program by another, with its arguments. Throws Error(Fault::io) if that fails.
[[noreturn]] void becomeProgram(const std::vector<std::string>& words);

/// The most memory this process ever held, in bytes.
std::uint64_t peakMemory();

/// Thrown by Signals::look().
struct StoppedByUser {};

/// Turns signals into events for one thread that waits. Make one at a time.
///
/// Ctrl-C and SIGTERM: at first the process ends at once, with code 130 and a last line. After
/// preparingBegins() and finishingBegins() the first makes look() throw, after renderingBegins() it gives
/// Event::stop; the second ends the process. SIGUSR1 and SIGHUP give Event::save.
class Signals {
 public:
  enum class Event { none, stop, save };

  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  void preparingBegins();
  void renderingBegins();
  /// `stopped`: what was to be stopped so far has ended. If not, a stop that nobody took counts now.
  void finishingBegins(bool stopped);
  /// For the budget of a command, whose work then ends by itself: throws StoppedByUser if that is asked for
  /// while it prepares or finishes. From any thread.
  static void look();
  /// Whether signals may interrupt the calling thread and those it starts from now on. Threads that trace
  /// should not be, so that a signal is answered at once.
  static void receive(bool here);
  /// The next event; none when `milliseconds` are over or after wake().
  Event wait(int milliseconds);
  /// Ends a wait() of another thread.
  void wake();
};

}  // namespace trace::cli
