#include "base/os/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <system_error>

#include "base/error.h"

#if defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

namespace trace::os {

void guardStreams() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is this one. Results are not lost in silence: stdout cannot be written to.
    const int opened = ::open("/dev/null", file == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != file) ::close(opened);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

std::vector<std::string> arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }

void keepWindowOpen() {}  // terminals here outlive what runs in them

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string ownFolder() {
  std::error_code ignored;
#if defined(__APPLE__)
  char path[4096];
  std::uint32_t size = sizeof path;
  if (::_NSGetExecutablePath(path, &size) != 0) return {};
  return std::filesystem::weakly_canonical(path, ignored).parent_path().string();
#else
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().string();
#endif
}

std::string programIn(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

ProgramAnswer answerOf(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += quotedForShell(word) + " ";
  std::FILE* const pipe = ::popen((line + "2>&1 </dev/null").c_str(), "r");
  if (!pipe) return {127, std::strerror(errno)};
  ProgramAnswer answer;
  char part[4096];
  while (const std::size_t length = std::fread(part, 1, sizeof part, pipe)) answer.text.append(part, length);
  const int status = ::pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  return answer;
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

bool hasDisplay() {
#if defined(__APPLE__)
  return true;
#else
  return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty();
#endif
}

void say(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody is left to hear it
}

void endAtOnce(std::string_view text, int code) {
  say(text);
  ::_exit(code);
}

double cpuSeconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t processNumber() { return static_cast<std::uint64_t>(::getpid()); }

}  // namespace trace::os
