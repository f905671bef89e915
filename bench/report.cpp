#include "report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <ostream>

namespace trace::bench {
namespace {

using Row = std::vector<std::string>;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[64];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

/// Markdown, which also reads well as it stands: the first `left` columns to the left, the others to the
/// right.
void print(std::ostream& out, const std::vector<Row>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows[0].size());
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string pad(widths[c] - rows[r][c].size(), ' ');
      out << "| " << (c < left ? rows[r][c] + pad : pad + rows[r][c]) << ' ';
    }
    out << "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c)
      out << '|' << std::string(widths[c] + 1, '-') << (c < left ? '-' : ':');
    out << "|\n";
  }
}

std::string rate(const Samples& mrays) { return text("%.2f (%.2f)", mrays.median(), mrays.spread()); }
std::string share(double value) { return value == 0 ? "0" : text("%.1e", value); }

template <class Quantity>
nlohmann::ordered_json perKernel(Quantity&& quantity) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < kKernelNames.size(); ++k) json[std::string(kKernelNames[k])] = quantity(k);
  return json;
}

nlohmann::ordered_json toJson(const Samples& samples) {
  return {{"median", samples.median()}, {"spread", samples.spread()}, {"values", samples.values}};
}

double ratio(const PerKernel<Samples>& samples) { return samples[world].median() / samples[embree].median(); }
/// The ratio of each side's best pass, which other work of the machine disturbed least.
double bestRatio(const PerKernel<Samples>& samples) {
  return samples[world].largest() / samples[embree].largest();
}

}  // namespace

void printTables(std::ostream& out, std::span<const MeshReport> meshes) {
  out << "Millions of rays per second of CPU time, one thread: median (largest / smallest of the passes)\n\n";
  std::vector<Row> rows{{"mesh", "rays", "thousands", "hit", "Trace", "Embree", "Embree robust",
                         "Trace / Embree", "best passes", "hit/miss differs", "distance differs",
                         "Embree: differs"}};
  for (const MeshReport& mesh : meshes)
    for (const KindReport& kind : mesh.kinds)
      rows.push_back({mesh.mesh, std::string(kind.kind), text("%.0f", static_cast<double>(kind.rays) / 1000),
                      text("%.1f%%", kind.hitShare * 100), rate(kind.mrays[world]), rate(kind.mrays[embree]),
                      rate(kind.mrays[robust]), text("%.3f", ratio(kind.mrays)),
                      text("%.3f", bestRatio(kind.mrays)), share(kind.hitsDiffer[world]),
                      share(kind.distancesDiffer[world]),
                      share(kind.hitsDiffer[embree] + kind.distancesDiffer[embree])});
  print(out, rows, 2);
  out << "\nWhat differs is the share of rays, against Embree robust; distances by more than 1e-4 of "
         "themselves.\n\n"
         "Build, one thread, CPU time; memory beside the mesh's own points and indices\n\n";
  rows = {{"mesh", "triangles", "Trace ms", "Embree ms", "Trace / Embree", "Trace B/tri", "Embree B/tri"}};
  for (const MeshReport& mesh : meshes)
    rows.push_back(
        {mesh.mesh, std::to_string(mesh.triangles), text("%.0f", mesh.buildSeconds[world].median() * 1e3),
         text("%.0f", mesh.buildSeconds[embree].median() * 1e3), text("%.2f", ratio(mesh.buildSeconds)),
         text("%.1f", mesh.bytesPerTriangle[world]), text("%.1f", mesh.bytesPerTriangle[embree])});
  print(out, rows, 1);
}

nlohmann::ordered_json toJson(std::span<const MeshReport> meshes, const Plan& plan) {
  nlohmann::ordered_json json{{"passes", plan.passes},
                              {"scale", plan.scale},
                              {"embree", plan.embree},
                              {"meshes", nlohmann::ordered_json::array()}};
  for (const MeshReport& mesh : meshes) {
    nlohmann::ordered_json entry{
        {"mesh", mesh.mesh},
        {"triangles", mesh.triangles},
        {"size", mesh.size},
        {"buildSeconds", perKernel([&](std::size_t k) { return toJson(mesh.buildSeconds[k]); })},
        {"buildRatio", ratio(mesh.buildSeconds)},
        {"bytesPerTriangle", perKernel([&](std::size_t k) { return mesh.bytesPerTriangle[k]; })},
        {"rays", nlohmann::ordered_json::object()}};
    for (const KindReport& kind : mesh.kinds)
      entry["rays"][std::string(kind.kind)] = {
          {"count", kind.rays},
          {"hitShare", kind.hitShare},
          {"ratio", ratio(kind.mrays)},
          {"bestRatio", bestRatio(kind.mrays)},
          {"mrays", perKernel([&](std::size_t k) { return toJson(kind.mrays[k]); })},
          {"hitsDiffer", perKernel([&](std::size_t k) { return kind.hitsDiffer[k]; })},
          {"distancesDiffer", perKernel([&](std::size_t k) { return kind.distancesDiffer[k]; })}};
    json["meshes"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace trace::bench
