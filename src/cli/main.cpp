// ray: the command line of Trace. See commands.cpp for what it can do.
#include "base/files/streams.h"
#include "cli/commands/commands.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

int main(int argc, char** argv) {
  trace::guardStreams();
#if defined(__GLIBC__)
  // Memory that reading has freed serves to build, and so on: memory that is given back and asked for anew
  // costs a page fault every 4 KiB.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
  return trace::cli::run({argv + 1, argv + argc});
}
