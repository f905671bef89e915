// bench_readers FILE...: how long files of meshes take to read, next to the Open Asset Import Library and
// tinyobjloader, in turn, in one process, in CPU time; the median of five. Assimp joins equal points, as our
// readers do; the column after it leaves that out, so that its meshes have three points for each triangle.
// tinyobjloader reads OBJ alone, and joins nothing.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <string>
#include <string_view>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

constexpr std::size_t kPasses = 5;

/// The triangles found, and the median time of reading them.
struct Reading {
  std::size_t triangles = 0;
  std::array<double, kPasses> seconds{};
  double median() {
    std::sort(seconds.begin(), seconds.end());
    return seconds[kPasses / 2];
  }
};

std::size_t trianglesOf(const Scene& scene) {
  std::size_t count = 0;
  for (const Object& object : scene.objects)
    if (const auto* mesh = object.shape.as<Mesh>()) count += mesh->data->triangles.size();
  return count;
}

std::size_t assimpTriangles(const char* file, unsigned steps) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, steps);
  std::size_t count = 0;
  if (scene)
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) count += scene->mMeshes[i]->mNumFaces;
  return count;
}

std::size_t tinyobjTriangles(const std::string& file) {
  tinyobj::ObjReader reader;
  std::size_t count = 0;
  if (reader.ParseFromFile(file))
    for (const tinyobj::shape_t& shape : reader.GetShapes()) count += shape.mesh.num_face_vertices.size();
  return count;
}

template <class Read>
void measure(Reading& reading, std::size_t pass, Read read) {
  const double start = processSeconds();
  reading.triangles = read();
  reading.seconds[pass] = processSeconds() - start;
}

void compare(const char* file) {
  Reading ours, joined, plain, tiny;
  const bool isObj = std::string_view(file).ends_with(".obj");
  for (std::size_t pass = 0; pass < kPasses; ++pass) {
    measure(ours, pass, [&] {
      Messages messages;
      return trianglesOf(readScene(file, messages));
    });
    measure(joined, pass,
            [&] { return assimpTriangles(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices); });
    measure(plain, pass, [&] { return assimpTriangles(file, aiProcess_Triangulate); });
    if (isObj) measure(tiny, pass, [&] { return tinyobjTriangles(file); });
  }
  const double own = ours.median(), theirs = joined.median(), bare = plain.median();
  std::printf("%-40s %9zu %9.3f s | %9zu %9.3f s  %5.2f | %9.3f s  %5.2f", file, ours.triangles, own,
              joined.triangles, theirs, own / theirs, bare, own / bare);
  if (const double other = tiny.median(); isObj)
    std::printf(" | %9zu %9.3f s  %5.2f", tiny.triangles, other, own / other);
  std::printf("\n");
}

}  // namespace
}  // namespace trace::bench

int main(int argc, char** argv) {
  std::printf("%-40s %9s %11s | %9s %11s  %5s | %11s  %5s | %9s %11s  %5s\n", "file", "triangles", "Trace",
              "triangles", "Assimp", "ratio", "not joined", "ratio", "triangles", "tinyobj", "ratio");
  for (int i = 1; i < argc; ++i) trace::bench::compare(argv[i]);
}
