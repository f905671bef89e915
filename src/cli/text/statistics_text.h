// The statistics of a render, for people (a table like POV-Ray's) and for programs (JSON).
// docs/statistics.md has the keys: new ones may come, those that are there stay.
#pragma once

#include <cstdint>
#include <string>

#include "app/session/session.h"

namespace trace::cli {

struct Run {
  const Session& session;
  const RenderResult& result;
  std::string output;
  double fraction, seconds;
  std::uint64_t peakMemory;
};

std::string statisticsTable(const Run& run);
std::string statisticsJson(const Run& run);

}  // namespace trace::cli
