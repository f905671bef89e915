#include "base/os/process.h"

#include <fcntl.h>
#include <io.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/os/windows/api.h"

namespace trace::os {
namespace {

UINT inputCodePage = 0, outputCodePage = 0;  // those of the terminal, before us

void restoreCodePages() {
  ::SetConsoleCP(inputCodePage);
  ::SetConsoleOutputCP(outputCodePage);
}

/// As one word of a command line (CommandLineToArgvW): quotes, and the '\' before them, take a '\' each.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t slashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') text.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    text += c;
  }
  return text.append(slashes, L'\\') + L"\"";
}

double secondsOf(const FILETIME& time) {
  const auto ticks = static_cast<std::uint64_t>(time.dwHighDateTime) << 32 | time.dwLowDateTime;
  return 1e-7 * static_cast<double>(ticks);
}

}  // namespace

void guardStreams() {
  for (const int file : {0, 1, 2}) ::_setmode(file, _O_BINARY);
  _fmode = _O_BINARY;
  ::SetErrorMode(SEM_FAILCRITICALERRORS);  // no window asks for a disk
  inputCodePage = ::GetConsoleCP();
  outputCodePage = ::GetConsoleOutputCP();
  if (inputCodePage == 0 || outputCodePage == 0) return;  // no terminal
  ::SetConsoleCP(CP_UTF8);
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit(restoreCodePages);
}

std::vector<std::string> arguments(int, char**) {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> all;
  for (int i = 1; words && i < count; ++i) {
    all.push_back(narrow(words[i]));
    for (char& c : all.back())
      if (c == '\\') c = '/';
  }
  ::LocalFree(words);
  return all;
}

void keepWindowOpen() {
  DWORD processes[2];
  const bool alone = ::GetConsoleProcessList(processes, 2) == 1;
  if (!alone || !::_isatty(0) || !::_isatty(2)) return;
  say("\nEnter closes this window\n");
  std::getchar();
}

std::string variable(const char* name) {
  const wchar_t* value = ::_wgetenv(wide(name).c_str());
  return value ? narrow(value) : "";
}

std::string ownFolder() {
  wchar_t path[32768];  // the longest there is
  const DWORD length = ::GetModuleFileNameW(nullptr, path, static_cast<DWORD>(std::size(path)));
  return std::filesystem::path(narrow({path, length})).parent_path().generic_string();
}

std::string programIn(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".exe")).generic_string();
}

/// By the command interpreter, which takes the outer quotes away.
ProgramAnswer answerOf(const std::vector<std::string>& words) {
  std::wstring line = L"\"";
  for (const std::string& word : words) line += quoted(wide(word)) + L" ";
  std::FILE* const pipe = ::_wpopen((line + L"2>&1 <NUL\"").c_str(), L"rb");
  if (!pipe) return {127, "the system refused"};
  ProgramAnswer answer;
  char part[4096];
  while (const std::size_t length = std::fread(part, 1, sizeof part, pipe)) answer.text.append(part, length);
  answer.code = ::_pclose(pipe);
  return answer;
}

/// Windows cannot replace a program: this one waits for the other, and ends as it does.
void becomeProgram(const std::vector<std::string>& words) {
  std::wstring line;
  for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoted(wide(word));
  STARTUPINFOW start{};
  start.cb = sizeof start;
  PROCESS_INFORMATION process{};
  if (!::CreateProcessW(wide(words.front()).c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr,
                        &start, &process))
    throw Error(Fault::io, "cannot start " + words.front() + ": " + reasonOf(::GetLastError()));
  ::SetConsoleCtrlHandler(nullptr, TRUE);  // Ctrl-C is for the other
  ::WaitForSingleObject(process.hProcess, INFINITE);
  DWORD code = 1;
  ::GetExitCodeProcess(process.hProcess, &code);
  endAtOnce("", static_cast<int>(code));
}

bool hasDisplay() { return true; }

void say(std::string_view text) {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), text.data(), static_cast<DWORD>(text.size()), &written,
              nullptr);
}

void endAtOnce(std::string_view text, int code) {
  say(text);
  restoreCodePages();
  ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(code));
  std::abort();  // not reached
}

double cpuSeconds() {
  FILETIME begin, end, system, user;
  if (!::GetProcessTimes(::GetCurrentProcess(), &begin, &end, &system, &user)) return 0;
  return secondsOf(system) + secondsOf(user);
}

std::uint64_t processNumber() { return ::GetCurrentProcessId(); }

}  // namespace trace::os
