// The statistics of a render, for people (a table like POV-Ray's) and for programs (JSON).
//
// Keys of the JSON object. New ones may come, these stay as they are:
//   version                          of Trace, text
//   scene, output                    file names
//   width, height                    pixels
//   end                              "finished", "cancelled" or "timeLimit"
//   fraction                         of the picture that was rendered, 0 to 1
//   threads                          that traced
//   seconds                          from the program's start to the written picture
//   rays.{camera, reflection, refraction, shadow, all}             counts
//   meanDepth                        of all but shadow rays, a camera ray having depth 0; null without rays
//   raysPerSecond                    all rays / wall time of the phase "trace"; null when that is 0
//   shapes.NAME.{tests, hits}        per shape of the scene format, by keyword
//   nodes, nodesPerRay               of the hierarchies, visited; per ray null without rays
//   badSamples.count, badSamples.first[].{x, y, sample}
//   phases.{read, build, trace, write}.{wall, cpu}                 seconds
//   peakMemory                       bytes
//   settings.NAME                    value of each option that differs from its default, as text
#pragma once

#include <cstdint>
#include <string>

#include "app/session.h"

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
