// Which Trace this is. The file that says commit() is written by each build (cmake/commit.cmake).
#pragma once

#include <string>
#include <string_view>

namespace trace {

/// The short name of the commit that it was built from, with a + if files differed from it; "" where there
/// was no git.
std::string_view commit();

/// "Trace 0.1.0, commit 2093372".
inline std::string versionText() {
  const std::string from(commit());
  return "Trace " TRACE_VERSION + (from.empty() ? "" : ", commit " + from);
}

}  // namespace trace
