#include "base/os/console.h"

#include "base/os/windows/api.h"

namespace trace::os {
namespace {

HANDLE handleOf(Stream stream) {
  return ::GetStdHandle(stream == Stream::result ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE);
}

}  // namespace

bool isScreen(Stream stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(handleOf(stream), &mode) &&
         ::SetConsoleMode(handleOf(stream),
                          mode | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

int terminalColumns() {
  CONSOLE_SCREEN_BUFFER_INFO info;
  for (const Stream stream : {Stream::messages, Stream::result})
    if (::GetConsoleScreenBufferInfo(handleOf(stream), &info))
      return info.srWindow.Right - info.srWindow.Left + 1;
  return 0;
}

}  // namespace trace::os
