// A hard limit of memory for the process: what is beyond fails with std::bad_alloc, wherever it is asked for.
#pragma once

#include <cstdint>

namespace trace::cli {

/// From now on the process gets so much more memory than it has, and the stacks of so many threads. False
/// where the system has no such limit, or under a sanitizer, whose own memory counts too.
bool limitMemory(std::uint64_t bytes, int threads);
/// Takes the limit away, so that there is memory to say what happened.
void liftMemoryLimit();

/// Whatever ends the program in spite of all, such as a lack of memory that lasts, ends with a message and
/// an exit code. The message takes no memory.
void endWithMessage();

}  // namespace trace::cli
