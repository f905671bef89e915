// Which commit the program was built from. The file that says it is written by each build
// (cmake/commit.cmake).
#pragma once

#include <string_view>

namespace trace {

/// The short name of the commit, with a + if files differed from it; "" where there was no git.
std::string_view commit();

}  // namespace trace
