// What src/base/os/posix asks of the header of macOS, by its manual page dyld(3), so that systems_test.sh can compile the
// lines for __APPLE__ where there is none.
#pragma once

#include <cstdint>

extern "C" int _NSGetExecutablePath(char* buffer, std::uint32_t* size);  // 0, or -1 where the path is longer than size
