// Runs the built `ray` as users do: in a folder of its own, with its streams kept apart.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::test {

using Variables = std::vector<std::pair<std::string, std::string>>;

/// A running `ray`. wait() for its end before the object goes.
class Program {
 public:
  Program(const std::string& folder, std::vector<std::string> words, const Variables& variables = {})
      : out_(folder + "/.stdout"), err_(folder + "/.stderr") {
    std::filesystem::remove(err_);  // so that nobody reads that of an earlier run
    words.insert(words.begin(), test::rayProgram());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    for (int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP})
      ::signal(signal, SIG_DFL);  // even in a background job
    for (const char* name : {"RAY_THREADS", "RAY_LOG", "NO_COLOR"}) ::unsetenv(name);
    ::setenv("COLUMNS", "200", 1);  // on a busy machine durations are long words: no line is cut for them
    for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
    const bool ready = ::chdir(folder.c_str()) == 0 && redirect("/dev/null", O_RDONLY, 0) &&
                       redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, 1) &&
                       redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, 2);
    if (ready) ::execv(arguments[0], arguments.data());
    ::_exit(99);
  }
  ~Program() {
    if (!ended_) kill(SIGKILL), wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void kill(int signal) const { ::kill(child_, signal); }
  /// Once more; sooner it would count as the signal before.
  void killAgain(int signal) const {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(signal);
  }

  /// The exit code; -signal if one ended it.
  int wait() {
    int status = 0;
    if (!ended_)
      ::waitpid(child_, &status, 0), code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    ended_ = true;
    return code_;
  }

  std::string out() const { return readFile(out_); }
  std::string err() const { return std::filesystem::exists(err_) ? readFile(err_) : ""; }
  std::string lastLine() const {
    std::string text = err();
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  }

  /// Waits until stderr contains the text so many times; false after a minute, or when the program has ended
  /// without it.
  bool says(const std::string& text, int times = 1) {
    const auto said = [&] {
      const std::string all = err();
      int count = 0;
      for (std::size_t at = 0; (at = all.find(text, at)) != std::string::npos; at += text.size()) ++count;
      return count >= times;
    };
    for (int i = 0; i < 6000; ++i) {
      if (said()) return true;
      siginfo_t state{};
      if (::waitid(P_PID, static_cast<id_t>(child_), &state, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          state.si_pid == child_)
        return said();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

 private:
  static bool redirect(const std::string& file, int flags, int as) {
    const int opened = ::open(file.c_str(), flags, 0600);
    return opened >= 0 && ::dup2(opened, as) == as;
  }

  std::string out_, err_;
  pid_t child_ = -1;
  bool ended_ = false;
  int code_ = -1;
};

/// A folder of its own for each test, with scenes in it.
class ProgramTest : public testing::Test {
 protected:
  // Inside a white ball: whatever is rendered is white.
  static constexpr const char* kWhite = R"(SBT-raytracer 1.0
camera { position=(0,0,0); viewdir=(0,0,-1); updir=(0,1,0); aspectratio=1.25; }
directional_light { direction=(0,0,-1); color=(1,1,1); }
scale(10, sphere { material={ emissive=(1,1,1); } })
)";

  ProgramTest() { write("white.ray", kWhite); }

  void write(const std::string& name, const std::string& text) const { writeFile(path(name), text); }
  std::string path(const std::string& name) const { return folder_ / name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  size_t files() const {  // without those of the streams
    size_t n = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      n += entry.path().filename().string()[0] != '.';
    return n;
  }

  struct Run {
    int code;
    std::string out, err, last;
  };
  Run run(std::vector<std::string> words, const Variables& variables = {}) const {
    Program program(folder_.path(), std::move(words), variables);
    const int code = program.wait();
    return {code, program.out(), program.err(), program.lastLine()};
  }

  const std::string& folder() const { return folder_.path(); }

 private:
  test::Folder folder_;
};

/// Whether `text` contains `part`, with both in the message if not.
inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in:\n" << text;
}

}  // namespace trace::test
