// bench_kernels: our World against Embree, ray by ray, on one thread. See rays.h for the kinds of rays,
// view.h for the cameras, measure.h for the method.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "base/files/file.h"
#include "report.h"

namespace trace::bench {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(TRACE_SHARED) / "meshes";

/// The meshes meant by `names`: files, folders, or names of meshes in the shared folder.
std::vector<std::string> meshFiles(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    const fs::path path = fs::exists(name) ? fs::path(name) : kFolder / (name + ".ply");
    if (fs::is_directory(path)) {
      std::vector<std::string> inside;
      for (const auto& entry : fs::directory_iterator(path))
        if (entry.path().extension() == ".ply") inside.push_back(entry.path().string());
      std::sort(inside.begin(), inside.end());
      files.insert(files.end(), inside.begin(), inside.end());
    } else if (fs::exists(path)) {
      files.push_back(path.string());
    } else {
      std::cerr << "bench: SKIPPED " << name << ": there is no " << path.string() << '\n';
    }
  }
  return files;
}

int run(int argc, char** argv) {
  CLI::App app{"Trace against Embree: closest and any hit, build time, memory"};
  std::vector<std::string> names, more;
  std::vector<std::size_t> triangles;
  std::string json;
  Plan plan;
  app.add_option("files", names,
                 "meshes: binary PLY files, folders of them, or names in " + kFolder.string());
  app.add_option("--meshes", more, "the same, separated by commas")->delimiter(',');
  app.add_option("--passes", plan.passes, "measurements of each number; the median counts")
      ->check(CLI::Range(1, 1000));
  app.add_option("--scale", plan.scale, "make everything this much larger")->check(CLI::PositiveNumber);
  app.add_option("--builds", plan.builds, "of each structure")->check(CLI::Range(1, 1000));
  app.add_option("--triangles", triangles, "resize each mesh to about these numbers of triangles")
      ->delimiter(',');
  app.add_option("--size", plan.size, "pixels on a side of the picture")->check(CLI::Range(1, 16384));
  app.add_option("--embree", plan.embree, "configuration of Embree: isa=avx2 keeps it from AVX-512");
  app.add_option("--kernel", plan.instructions,
                 "avx512, avx2 or base: the mesh without a World, by that kernel");
  app.add_option("--json", json, "also write the numbers to this file");
  CLI11_PARSE(app, argc, argv);

  names.insert(names.end(), more.begin(), more.end());
  if (names.empty()) names.push_back(kFolder.string());
  if (triangles.empty()) triangles.push_back(0);
  std::vector<MeshReport> reports;
  for (const std::string& file : meshFiles(names)) {
    std::cerr << "bench: " << fs::path(file).filename().string() << '\n';
    for (const std::size_t count : triangles) reports.push_back(measure(file, plan, count));
  }
  if (reports.empty())
    std::cerr << "bench: SKIPPED everything: no mesh was found\n";
  else
    printTables(std::cout, reports);
  if (!json.empty()) writeFile(json, toJson(reports, plan).dump(2) + '\n');
  return 0;
}

}  // namespace
}  // namespace trace::bench

int main(int argc, char** argv) {
  try {
    return trace::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
