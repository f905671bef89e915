// Which Trace this is. The file that says commit() and sources() is written by each build
// (cmake/commit.cmake).
#pragma once

#include <string>
#include <string_view>

namespace trace {

/// The short name of the commit that it was built from, with a + if files differed from it; "" where there
/// was no git.
std::string_view commit();
/// A hash of the sources that it was built from: two programs of one commit differ in it where files were
/// changed.
std::string_view sources();

/// "commit 2093372+, sources 5f0c2a94c1d3e677": programs that say the same give the same samples.
inline std::string programText() {
  return (commit().empty() ? "" : "commit " + std::string(commit()) + ", ") + "sources " +
         std::string(sources());
}

/// "Trace 0.1.0, commit 2093372".
inline std::string versionText() {
  const std::string from(commit());
  return "Trace " TRACE_VERSION + (from.empty() ? "" : ", commit " + from);
}

}  // namespace trace
