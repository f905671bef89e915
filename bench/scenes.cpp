// bench_scenes FOLDER MESH.ply...: writes the scenes that programs.sh renders with ray and with POV-Ray.
//
//   analytic    25 mirroring spheres, 6 boxes, 4 cones and a glass ball on a floor of 576 slightly mirroring
//   tiles MESH        the mesh on a floor, matt, one lamp, from the view of the kernel benchmarks
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "ply.h"
#include "scene_pair.h"

namespace trace::bench {
namespace {

constexpr int kTiles = 24;  // on a side

void writeAnalytic(const std::string& base) {
  ScenePair scene(base);
  scene.camera({.eye = {0, 4, -9}, .at = {0, 1, 0}, .light = {}, .fov = 55, .radius = 0, .size = 400});
  scene.lamp({-6, 8, -6}, 0.7);
  scene.lamp({5, 9, -3}, 0.5);
  for (int i = 0; i < kTiles; ++i)
    for (int j = 0; j < kTiles; ++j) {
      const double x = i - kTiles / 2, z = j - kTiles / 2;
      const double grey = (i + j) % 2 ? 0.8 : 0.25;
      scene.box({x, -0.1, z}, {x + 1, 0, z + 1}, {.color = {grey, grey, grey * 0.9}, .mirror = 0.1});
    }
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      scene.sphere({-3 + 1.5 * i, 0.35, -2 + 1.4 * j}, 0.35,
                   {.color = {0.2 + 0.1 * i, 0.3, 0.6 - 0.1 * j}, .phong = 0.4, .mirror = 0.5});
  for (int i = 0; i < 6; ++i)
    scene.box({-4.5 + 1.5 * i, 0, 4}, {-3.7 + 1.5 * i, 1 + 0.4 * i, 5}, {.color = {0.7, 0.3 + 0.1 * i, 0.2}});
  for (int i = 0; i < 4; ++i)
    scene.cone({-2.2 + 1.5 * i, 0, 1.5}, 1.4, 0.45, 0.05, {.color = {0.3, 0.6, 0.4}, .phong = 0.2});
  scene.sphere({0, 1.1, -2.6}, 0.8, {.color = {}, .phong = 0.3, .mirror = 0.1, .through = 0.9, .index = 1.5});
  scene.finish();
}

void writeMesh(const std::string& base, const std::string& file) {
  const MeshData mesh = readPly(file);
  const Box3 box = bounds(mesh);
  const View view = viewOf(std::filesystem::path(file).stem().string(), box);
  const Vec3 center = box.center(), wide = Vec3{1, 0, 1} * (50 * view.radius);
  const Vec3 foot{center.x, box.low.y, center.z};
  ScenePair scene(base);
  scene.camera(view);
  scene.lamp(view.light, 1);
  scene.box(foot - wide - Vec3{0, view.radius, 0}, foot + wide, {.color = {0.6, 0.6, 0.6}});
  scene.mesh(mesh, {.color = {0.8, 0.6, 0.4}});
  scene.finish();
}

}  // namespace
}  // namespace trace::bench

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  fs::path folder;
  std::vector<std::string> meshes;
  CLI::App app("Writes scenes for ray and for POV-Ray: spheres and boxes, and each mesh on a floor",
               "bench_scenes");
  app.add_option("FOLDER", folder, "folder for the scenes; is made where there is none")->required();
  app.add_option("MESH", meshes, "PLY files");
  CLI11_PARSE(app, argc, argv);
  try {
    fs::create_directories(folder);
    trace::bench::writeAnalytic((folder / "analytic").string());
    for (const std::string& mesh : meshes)
      trace::bench::writeMesh((folder / fs::path(mesh).stem()).string(), mesh);
    return 0;
  } catch (const std::exception& error) {
    return std::cerr << error.what() << '\n', 1;
  }
}
