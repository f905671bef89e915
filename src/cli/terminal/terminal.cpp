#include "cli/terminal/terminal.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "base/error.h"
#include "base/os/console.h"
#include "base/os/memory.h"
#include "base/os/process.h"

namespace trace::cli {
namespace {

// The state that the handler of interrupts may touch: lock-free atomics and the bell.
std::atomic<os::Bell*> gBell{nullptr};
std::atomic<int> gStops{0};
std::atomic<std::int64_t> gFirstStop{0};  // nanoseconds of the steady clock
enum class Phase { starting, preparing, rendering, finishing };
std::atomic<Phase> gPhase{Phase::starting};
std::atomic<bool> gAsked{false};  // to stop, while preparing or finishing
constexpr const char* kNothingWritten = "\nnothing written: stopped at once by the user\n";
std::atomic<const char*> gLastLine{kNothingWritten};
static_assert(std::atomic<const char*>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Phase>::is_always_lock_free);

// `timeout` and others signal a program and then its group: that is one wish to stop.
constexpr std::int64_t kOneWish = 50'000'000;  // nanoseconds
constexpr int kStoppedAtOnce = 130;            // 128 + SIGINT, as shells report it

void post(char message) {
  if (os::Bell* bell = gBell) bell->ring(message);
}

void onInterrupt(os::Interrupt interrupt) {
  if (interrupt != os::Interrupt::stop) return post('w');
  const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
  const bool isFirst = gPhase != Phase::starting && gStops.fetch_add(1) == 0;
  if (isFirst) gFirstStop = now;
  if (!isFirst && gPhase != Phase::starting && now - gFirstStop < kOneWish) return;
  if (!isFirst) os::endAtOnce(gLastLine.load(), kStoppedAtOnce);
  gAsked = gPhase == Phase::preparing || gPhase == Phase::finishing;
  post('s');  // also for a render that begins right now
}

bool colorsAreWelcome() { return os::variable("NO_COLOR").empty(); }

[[noreturn]] void onTerminate() {
  os::liftMemoryLimit();
  bool lacksMemory = false;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    lacksMemory = true;
  } catch (...) {
  }
  if (lacksMemory)
    os::endAtOnce("error: out of memory\nnothing written: out of memory\n", static_cast<int>(Fault::limit));
  os::say("error: Trace failed in an unexpected way: please report this\n");
  std::abort();
}

}  // namespace

bool canRedraw() { return os::isScreen(os::Stream::messages); }
bool canColor() { return canRedraw() && colorsAreWelcome(); }
bool canColorResult() { return os::isScreen(os::Stream::result) && colorsAreWelcome(); }

int columns() {
  constexpr int kMost = 500, kUsual = 80;  // longest line that anyone can see
  const auto given = std::strtoll(os::variable("COLUMNS").c_str(), nullptr, 10);
  if (given > 0) return static_cast<int>(std::min<long long>(given, kMost));
  const int asked = os::terminalColumns();
  return asked > 0 ? std::min(asked, kMost) : kUsual;
}

void endWithMessage() { std::set_terminate(onTerminate); }

Signals::Signals() : handler_(onInterrupt) { gBell = &bell_; }

Signals::~Signals() {
  gBell = nullptr;
  gLastLine = kNothingWritten;
  gAsked = false;
  gStops = 0;
  gPhase = Phase::starting;
}

void Signals::preparingBegins() { gPhase = Phase::preparing; }

void Signals::renderingBegins() {
  gPhase = Phase::rendering;
  gAsked = false;
}

void Signals::finishingBegins(bool stopped) {
  gPhase = Phase::finishing;
  gAsked = !stopped && gStops > 0;
}

void Signals::lastLineIs(const std::string& line) {
  lines_.push_back("\n" + line + "\n");
  gLastLine = lines_.back().c_str();
}

void Signals::look() {
  if (gAsked) throw StoppedByUser{};
}

void Signals::receive(bool here) { os::receiveInterrupts(here); }

Signals::Event Signals::wait(int milliseconds) {
  const char message = bell_.wait(milliseconds);
  return message == 's' ? Event::stop : message == 'w' ? Event::save : Event::none;
}

void Signals::wake() { post('e'); }

}  // namespace trace::cli
