#include "base/os/interrupts.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <iterator>
#include <system_error>

namespace trace::os {
namespace {

constexpr int kCaught[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};

std::atomic<void (*)(Interrupt)> handler{nullptr};
static_assert(std::atomic<void (*)(Interrupt)>::is_always_lock_free);

struct sigaction before[std::size(kCaught)];

void onSignal(int signal) {
  const int error = errno;
  if (const auto onInterrupt = handler.load())
    onInterrupt(signal == SIGINT || signal == SIGTERM ? Interrupt::stop : Interrupt::save);
  errno = error;
}

}  // namespace

InterruptHandler::InterruptHandler(void (*onInterrupt)(Interrupt)) {
  handler = onInterrupt;
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < std::size(kCaught); ++i) {
    ::sigaction(kCaught[i], nullptr, &before[i]);
    // Whoever started us with a signal ignored (nohup, a shell's background job) wants it so.
    if (before[i].sa_handler != SIG_IGN) ::sigaction(kCaught[i], &action, nullptr);
  }
}

InterruptHandler::~InterruptHandler() {
  for (std::size_t i = 0; i < std::size(kCaught); ++i) ::sigaction(kCaught[i], &before[i], nullptr);
  handler = nullptr;
}

void receiveInterrupts(bool here) {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : kCaught) ::sigaddset(&set, signal);
  ::pthread_sigmask(here ? SIG_UNBLOCK : SIG_BLOCK, &set, nullptr);
}

struct Bell::State {
  int ends[2] = {-1, -1};  // a pipe
};

Bell::Bell() : state_(std::make_unique<State>()) {
  if (::pipe(state_->ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  for (const int end : state_->ends) {
    ::fcntl(end, F_SETFL, O_NONBLOCK);
    ::fcntl(end, F_SETFD, FD_CLOEXEC);
  }
}

Bell::~Bell() {
  for (const int end : state_->ends) ::close(end);
}

void Bell::ring(char message) {
  if (::write(state_->ends[1], &message, 1) < 0) return;  // a full pipe has messages enough
}

char Bell::wait(int milliseconds) {
  pollfd file{state_->ends[0], POLLIN, 0};
  char message = 0;
  if (::poll(&file, 1, milliseconds) <= 0 || ::read(file.fd, &message, 1) != 1) return 0;
  return message;
}

}  // namespace trace::os
