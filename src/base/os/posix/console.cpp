#include "base/os/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <string>

#include "base/os/process.h"

namespace trace::os {

bool isScreen(Stream stream) {
  const std::string term = variable("TERM");
  return ::isatty(stream == Stream::result ? STDOUT_FILENO : STDERR_FILENO) && !term.empty() &&
         term != "dumb";
}

int terminalColumns() {
  winsize size{};
  for (const int file : {STDERR_FILENO, STDOUT_FILENO})
    if (::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 0;
}

}  // namespace trace::os
