// ray bench SCENE: how fast the scene's rays are answered, for people or as JSON.
// docs/statistics.md has the keys.
#include <array>

#include "app/session/json.h"
#include "app/session/ray_bench.h"
#include "app/session/session.h"
#include "cli/commands/commands.h"
#include "cli/text/formatted.h"

namespace trace::cli {
namespace {

constexpr int kPasses = 5;

std::string benchText(const Session& session, const RayBench& bench) {
  const Size size = session.size();
  std::string text = formatted("one thread, %d x %d pixels, CPU time, median of %d passes\n", size.width,
                               size.height, kPasses) +
                     formatted("  %-10s %10s %7s %9s %10s %10s\n", "rays", "count", "hit", "Mrays/s",
                               "nodes/ray", "tests/ray");
  for (const RayBench::Kind& kind : bench.kinds)
    text += formatted("  %-10s %10llu %6.1f%% %9.2f %10.2f %10.2f\n", std::string(kind.name).c_str(),
                      static_cast<unsigned long long>(kind.rays),
                      100 * static_cast<double>(kind.hits) / static_cast<double>(kind.rays),
                      kind.raysPerSecond() / 1e6, kind.nodes, kind.tests);
  text += formatted("  %-10s %10.3f s, CPU %.3f s\n", "build", bench.buildWall, bench.buildCpu);
  text += formatted("  %-10s %10.1f MiB", "hierarchy", static_cast<double>(bench.bytes) / (1 << 20));
  if (bench.triangles > 0)
    text += formatted(", %.1f bytes for each of %llu triangles",
                      static_cast<double>(bench.bytes) / static_cast<double>(bench.triangles),
                      static_cast<unsigned long long>(bench.triangles));
  return text + "\n";
}

std::string benchJson(const Session& session, const RayBench& bench) {
  Json json;
  json["scene"] = session.scene().file;
  json["width"] = session.size().width;
  json["height"] = session.size().height;
  json["build"] = {{"wall", bench.buildWall}, {"cpu", bench.buildCpu}};
  json["triangles"] = bench.triangles;
  json["bytes"] = bench.bytes;
  json["bytesPerTriangle"] = nullptr;
  if (bench.triangles > 0)
    json["bytesPerTriangle"] = static_cast<double>(bench.bytes) / static_cast<double>(bench.triangles);
  json["rays"] = Json::object();
  for (const RayBench::Kind& kind : bench.kinds)
    json["rays"][kind.name] = {{"count", kind.rays},        {"hits", kind.hits},
                               {"seconds", kind.seconds},   {"raysPerSecond", kind.raysPerSecond()},
                               {"nodesPerRay", kind.nodes}, {"testsPerRay", kind.tests}};
  return json.text(2) + "\n";
}

}  // namespace

int benchCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray bench: expected the name of one scene file, found " +
                    (arguments.files.empty() ? "none" : std::to_string(arguments.files.size())));
  const bool json = chosenFormat(arguments, "bench", kTextOrJson) == "json";
  Session session;
  session.open(arguments.files[0], arguments.choices, arguments.strict);
  Messages messages = session.messages();
  const RayBench measured = benchRays(session.scene(), session.settings(), kPasses, messages);
  messages.throwIfFailed(arguments.strict);
  console.warnings(messages.all());
  printResult(json ? benchJson(session, measured) : benchText(session, measured));
  return kDone;
}

}  // namespace trace::cli
