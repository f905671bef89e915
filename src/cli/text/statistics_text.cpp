#include "cli/text/statistics_text.h"

#include <optional>
#include <string_view>

#include "app/advice/first_aid.h"
#include "app/session/json.h"
#include "base/parallel.h"
#include "cli/text/formatted.h"

namespace trace::cli {
namespace {

std::string_view nameOf(End end) {
  switch (end) {
    case End::finished: return "finished";
    case End::cancelled: return "cancelled";
    case End::timeLimit: return "timeLimit";
    case End::outOfMemory: return "outOfMemory";
    case End::failed: break;
  }
  return "failed";
}

/// Calls visit(keyword, tests, hits) for each shape of the list.
template <class Visit>
void forEachShape(const Statistics& statistics, Visit&& visit) {
  for (const ShapeType& type : shapeTypes())
    visit(type.keyword, statistics.tests[type.index], statistics.hits[type.index]);
}

std::optional<double> raysPerSecond(const Run& run) {
  for (const Phase& phase : run.session.phases())
    if (phase.name == "trace" && phase.wall > 0)
      return static_cast<double>(run.result.statistics.allRays()) / phase.wall;
  return {};
}

std::optional<PictureError> errorOf(const Session& session) {
  if (!session.hasFilm()) return {};
  return estimatedError(session.settings(), session.film());
}

std::optional<double> ratio(std::uint64_t a, std::uint64_t b) {
  if (b == 0) return {};
  return static_cast<double>(a) / static_cast<double>(b);
}

std::string orDash(const char* format, std::optional<double> value) {
  return value ? formatted(format, *value) : "-";
}

/// One line of five columns.
std::string row(std::string_view name, const std::string& a, const std::string& b = "",
                const std::string& c = "") {
  std::string line = formatted("  %-14.*s %16s %16s %10s", static_cast<int>(name.size()), name.data(),
                               a.c_str(), b.c_str(), c.c_str());
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string statisticsTable(const Run& run) {
  const Statistics& s = run.result.statistics;
  std::string text = row("rays", "count", "", "share");
  for (size_t i = 0; i < s.rays.size(); ++i)
    text += row(kRayLooks[i].kind, std::to_string(s.rays[i]), "",
                orDash("%.1f %%", ratio(100 * s.rays[i], s.allRays())));
  text += row("all", std::to_string(s.allRays()), "", "");
  text += row("mean depth", orDash("%.2f", ratio(s.depths, s.pathRays())));
  text += row("shapes", "tests", "hits", "hits/test");
  forEachShape(s, [&](std::string_view name, std::uint64_t tests, std::uint64_t hits) {
    if (tests > 0)
      text += row(name, std::to_string(tests), std::to_string(hits), orDash("%.3f", ratio(hits, tests)));
  });
  text += row("hierarchy", "nodes", "", "per ray");
  text +=
      row("visited", std::to_string(s.nodes.count), "", orDash("%.2f", ratio(s.nodes.count, s.allRays())));
  if (s.hasMoves()) text += row("chains", "moves", "kept", "kept/move");
  for (size_t i = 0; i < kMoveKinds; ++i)
    if (s.moves[i] > 0)
      text += row(kMoveLooks[i].name, std::to_string(s.moves[i]), std::to_string(s.movesKept[i]),
                  orDash("%.3f", ratio(s.movesKept[i], s.moves[i])));
  if (s.hasMoves())
    text += row("brightness", "", "", formatted("+-%.2g %%", 100 * run.result.brightnessError));
  if (const auto error = errorOf(run.session)) {
    text += row("levels of 255", "mean", "median", "9 of 10");
    text += row("error", formatted("%.3g", error->mean), formatted("%.3g", error->median),
                formatted("%.3g", error->ninth));
  }
  text += row("phases", "wall", "CPU");
  for (const Phase& phase : run.session.phases())
    text += row(phase.name, formatted("%.3f s", phase.wall), formatted("%.3f s", phase.cpu));
  const auto speed = raysPerSecond(run);
  text += row("speed", speed ? formatted("%.3f Mrays/s", *speed / 1e6) : "-");
  text += row("peak memory", formatted("%.1f MiB", static_cast<double>(run.peakMemory) / (1 << 20)));
  text.pop_back();
  return text;
}

std::string statisticsJson(const Run& run) {
  const auto orNull = [](std::optional<double> value) { return value ? Json(*value) : Json(); };
  const Session& session = run.session;
  const Statistics& s = run.result.statistics;
  const int threads = session.settings().threads;
  Json json;
  json["version"] = TRACE_VERSION;
  json["scene"] = session.scene().file;
  json["output"] = run.output;
  json["width"] = session.size().width;
  json["height"] = session.size().height;
  json["end"] = nameOf(run.result.end);
  json["fraction"] = run.fraction;
  json["threads"] = threads > 0 ? threads : hardwareThreads();
  json["seconds"] = run.seconds;
  for (size_t i = 0; i < s.rays.size(); ++i) json["rays"][kRayLooks[i].kind] = s.rays[i];
  json["rays"]["all"] = s.allRays();
  json["meanDepth"] = orNull(ratio(s.depths, s.pathRays()));
  json["raysPerSecond"] = orNull(raysPerSecond(run));
  forEachShape(s, [&](std::string_view name, std::uint64_t tests, std::uint64_t hits) {
    json["shapes"][name] = {{"tests", tests}, {"hits", hits}};
  });
  json["nodes"] = s.nodes.count;
  json["nodesPerRay"] = orNull(ratio(s.nodes.count, s.allRays()));
  for (size_t i = 0; i < kMoveKinds; ++i)
    if (s.moves[i] > 0)
      json["chains"][kMoveLooks[i].name] = {{"moves", s.moves[i]}, {"kept", s.movesKept[i]}};
  if (s.hasMoves()) json["chains"]["brightnessError"] = run.result.brightnessError;
  const auto error = errorOf(session);
  json["error"] = {{"mean", error ? Json(error->mean) : Json()},
                   {"median", error ? Json(error->median) : Json()},
                   {"ninth", error ? Json(error->ninth) : Json()}};
  json["badSamples"] = {{"count", s.badSamples}, {"first", Json::list()}};
  for (const BadSample& bad : run.result.badSamples)
    json["badSamples"]["first"].add({{"x", bad.x}, {"y", bad.y}, {"sample", bad.sample}});
  for (const Phase& phase : session.phases())
    json["phases"][phase.name] = {{"wall", phase.wall}, {"cpu", phase.cpu}};
  json["peakMemory"] = run.peakMemory;
  json["settings"] = Json::object();
  for (const Choice& choice : changedOptions(session.settings()))
    json["settings"][choice.option] = choice.value;
  return json.text(2);
}

}  // namespace trace::cli
