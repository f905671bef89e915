// The terminal that the program draws on, and how a person stops the program there.
#pragma once

#include <list>
#include <string>

#include "base/os/interrupts.h"

namespace trace::cli {

/// stderr is a terminal on which a line can be drawn again.
bool canRedraw();
/// ... and colours are welcome (https://no-color.org).
bool canColor();
/// Whether stdout is a terminal, for results.
bool canColorResult();
/// The width of the terminal, by COLUMNS or by asking it; 80 when neither tells.
int columns();

/// Whatever ends the program in spite of all, such as a lack of memory that lasts, ends with a message and
/// an exit code. The message takes no memory.
void endWithMessage();

/// Thrown by Signals::look().
struct StoppedByUser {};

/// Turns interrupts into events for one thread that waits. Make one at a time.
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
  /// The last line of a stop at once from now on, in place of "nothing written".
  void lastLineIs(const std::string& line);
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

 private:
  std::list<std::string> lines_;  // the handler may be reading an earlier one
  os::Bell bell_;
  os::InterruptHandler handler_;
};

}  // namespace trace::cli
