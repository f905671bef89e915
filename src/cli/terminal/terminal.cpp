#include "cli/terminal/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace trace::cli {
namespace {

// The state that a signal handler may touch: lock-free atomics and write().
std::atomic<int> gPipe[2]{-1, -1};
std::atomic<int> gStops{0};
enum class Phase { starting, preparing, rendering, finishing };
std::atomic<Phase> gPhase{Phase::starting};
std::atomic<bool> gAsked{false};  // to stop, while preparing or finishing
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Phase>::is_always_lock_free);

constexpr int kCaught[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};
constexpr int kStoppedAtOnce = 130;  // 128 + SIGINT, as shells report it

struct sigaction gBefore[std::size(kCaught)];

/// Ends the process from within a handler, with a last line.
[[noreturn]] void stopAtOnce() {
  constexpr char kText[] = "\nnothing written: stopped at once by the user\n";
  if (::write(STDERR_FILENO, kText, sizeof kText - 1) < 0) ::_exit(kStoppedAtOnce);
  ::_exit(kStoppedAtOnce);
}

void post(char byte) {
  const int pipe = gPipe[1];
  if (pipe >= 0 && ::write(pipe, &byte, 1) < 0) return;  // a full pipe has events enough
}

void onSignal(int signal) {
  const int error = errno;
  if (signal == SIGINT || signal == SIGTERM) {
    if (gPhase == Phase::starting || gStops.fetch_add(1) > 0) stopAtOnce();
    gAsked = gPhase == Phase::preparing || gPhase == Phase::finishing;
    post('s');  // also for a render that begins right now
  } else {
    post('w');
  }
  errno = error;
}

}  // namespace

namespace {

bool isScreen(int file) {
  const char* term = std::getenv("TERM");
  return ::isatty(file) && term && *term && std::strcmp(term, "dumb") != 0;
}
bool colorsAreWelcome() {
  const char* noColor = std::getenv("NO_COLOR");
  return !(noColor && *noColor);
}

}  // namespace

bool canRedraw() { return isScreen(STDERR_FILENO); }
bool canColor() { return canRedraw() && colorsAreWelcome(); }
bool canColorResult() { return isScreen(STDOUT_FILENO) && colorsAreWelcome(); }

std::string ownFolder() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().string();
}

void becomeProgram(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  ::execv(arguments[0], arguments.data());
  throw Error(Fault::io, "cannot start " + words.front() + ": " + std::strerror(errno));
}

int columns() {
  constexpr long kMost = 500;  // longest line that anyone can see
  if (const char* given = std::getenv("COLUMNS"))
    if (const long n = std::strtol(given, nullptr, 10); n > 0) return static_cast<int>(std::min(n, kMost));
  winsize size{};
  for (int file : {STDERR_FILENO, STDOUT_FILENO})
    if (::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
      return static_cast<int>(std::min<long>(size.ws_col, kMost));
  return 80;
}

std::uint64_t peakMemory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
#if defined(__APPLE__)
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

Signals::Signals() {
  int ends[2];
  if (::pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  for (int i = 0; i < 2; ++i) {
    ::fcntl(ends[i], F_SETFL, O_NONBLOCK);
    ::fcntl(ends[i], F_SETFD, FD_CLOEXEC);
    gPipe[i] = ends[i];
  }
  gStops = 0;
  gPhase = Phase::starting;
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  for (size_t i = 0; i < std::size(kCaught); ++i) {
    ::sigaction(kCaught[i], nullptr, &gBefore[i]);
    // Whoever started us with a signal ignored (nohup, a shell's background job) wants it so.
    if (gBefore[i].sa_handler != SIG_IGN) ::sigaction(kCaught[i], &action, nullptr);
  }
}

Signals::~Signals() {
  for (size_t i = 0; i < std::size(kCaught); ++i) ::sigaction(kCaught[i], &gBefore[i], nullptr);
  for (auto& end : gPipe) ::close(end.exchange(-1));
  gAsked = false;
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

void Signals::look() {
  if (gAsked) throw StoppedByUser{};
}

void Signals::receive(bool here) {
  sigset_t set;
  ::sigemptyset(&set);
  for (int signal : kCaught) ::sigaddset(&set, signal);
  ::pthread_sigmask(here ? SIG_UNBLOCK : SIG_BLOCK, &set, nullptr);
}

Signals::Event Signals::wait(int milliseconds) {
  pollfd file{gPipe[0], POLLIN, 0};
  if (::poll(&file, 1, milliseconds) <= 0) return Event::none;
  char byte = 0;
  if (::read(file.fd, &byte, 1) != 1) return Event::none;
  return byte == 's' ? Event::stop : byte == 'w' ? Event::save : Event::none;
}

void Signals::wake() { post('e'); }

}  // namespace trace::cli
