#include "geometry/mesh/mesh_closed.h"

#include <algorithm>

#include "geometry/mesh/mesh_smooth.h"

namespace trace {

bool closed(const MeshData& mesh) {
  const std::vector<std::uint32_t> place = placesOf(mesh);
  struct HalfEdge {
    std::uint32_t low, high;
    int sense;
  };
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = place[t[i]], b = place[t[(i + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    const HalfEdge edge = edges[i];
    for (; i < edges.size() && edges[i].low == edge.low && edges[i].high == edge.high; ++i)
      balance += edges[i].sense;
    if (balance != 0) return false;
  }
  return !edges.empty();
}

}  // namespace trace
