#include "support/paths.h"

namespace trace::test {

std::string sourceFolder() { return TRACE_SOURCE; }
std::string sharedFolder() { return TRACE_SHARED; }
std::string rayProgram() { return TRACE_RAY_BINARY; }

}  // namespace trace::test
