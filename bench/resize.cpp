#include "resize.h"

#include <cmath>
#include <unordered_map>
#include <utility>

namespace trace::bench {
namespace {

/// Points of one cell become the first of them.
MeshData clustered(const MeshData& mesh, double cell) {
  const Box3 box = bounds(mesh);
  MeshData result;
  std::unordered_map<std::uint64_t, std::uint32_t> places;
  std::vector<std::uint32_t> place(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21 | static_cast<std::uint64_t>((mesh.points[i][axis] - box.low[axis]) / cell);
    const auto next = static_cast<std::uint32_t>(result.points.size());
    const auto [at, fresh] = places.try_emplace(key, next);
    if (fresh) result.points.push_back(mesh.points[i]);
    place[i] = at->second;
  }
  for (const Triangle& t : mesh.triangles) {
    const Triangle moved{place[t[0]], place[t[1]], place[t[2]]};
    if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0])
      result.triangles.push_back(moved);
  }
  return result;
}

MeshData subdivided(const MeshData& mesh) {
  MeshData result;
  result.points = mesh.points;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto next = static_cast<std::uint32_t>(result.points.size());
    const auto [at, fresh] = middles.try_emplace(std::uint64_t{a} << 32 | b, next);
    if (fresh) result.points.push_back(Vec3f((Vec3(mesh.points[a]) + Vec3(mesh.points[b])) / 2));
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& part :
         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
      result.triangles.push_back(part);
  }
  return result;
}

}  // namespace

MeshData resized(const MeshData& mesh, std::size_t triangles) {
  MeshData result = mesh;
  while (result.triangles.size() * 2 < triangles) result = subdivided(result);
  if (triangles >= mesh.triangles.size()) return result;
  // A surface fills a number of cells that goes with the square of their number along an edge.
  double cell = maxComponent(bounds(mesh).size()) / std::sqrt(static_cast<double>(triangles));
  for (int i = 0; i < 6; ++i) {
    result = clustered(mesh, cell);
    cell *= std::sqrt(static_cast<double>(result.triangles.size()) / static_cast<double>(triangles));
  }
  return result;
}

}  // namespace trace::bench
