// The contents of the window and the selection, in words: for scripts that test it.
#pragma once

#include <string>

#include "studio/studio.h"

namespace trace::studio {

/// Lines of a name and what it is; of landmarks where they are.
std::string state(const Studio& studio);

}  // namespace trace::studio
