// ray: the command line of Trace. See commands.cpp for what it can do.
#include "base/os/memory.h"
#include "base/os/process.h"
#include "cli/commands/commands.h"

int main(int argc, char** argv) {
  trace::os::guardStreams();
  trace::os::keepFreedMemory();
  const int code = trace::cli::run(trace::os::arguments(argc, argv));
  trace::os::keepWindowOpen();
  return code;
}
