// Whether what only Linux has may be used. With TRACE_OS_PLAIN_POSIX nothing of it is, as on other systems,
// so that their paths through this folder can be compiled and tested on Linux.
#pragma once

#if defined(__linux__) && !defined(TRACE_OS_PLAIN_POSIX)
#define TRACE_OS_LINUX
#endif
