#include <algorithm>
#include <utility>

#include "base/budget.h"
#include "geometry/mesh/mesh_crease.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace {
namespace {

using Index = std::uint32_t;
using Polygon = std::vector<Index>;

/// The corners of the polygon that consecutive triangles make up, in order: along the edges that only one of
/// them has. Empty if these are not one ring.
Polygon outlineOf(const std::vector<Triangle>& triangles, Index first, Index count) {
  constexpr Index kMost = 64;
  if (count > kMost) {  // a fan
    Polygon fan{triangles[first][0], triangles[first][1]};
    for (Index i = first; i < first + count; ++i) fan.push_back(triangles[i][2]);
    return fan;
  }
  std::vector<std::array<Index, 2>> edges;
  for (Index i = first; i < first + count; ++i)
    for (std::size_t c = 0; c < 3; ++c) edges.push_back({triangles[i][c], triangles[i][(c + 1) % 3]});
  std::vector<std::array<Index, 2>> border;
  for (const auto& [a, b] : edges)
    if (std::find(edges.begin(), edges.end(), std::array{b, a}) == edges.end()) border.push_back({a, b});
  if (border.size() != count + 2) return {};
  Polygon outline{border[0][0]};
  for (Index at = border[0][1]; at != outline[0];) {
    const auto next = std::find_if(border.begin(), border.end(), [&](const auto& e) { return e[0] == at; });
    if (next == border.end() || outline.size() == border.size()) return {};
    outline.push_back(at);
    at = (*next)[1];
  }
  return outline.size() == border.size() ? outline : Polygon{};
}

std::vector<Polygon> polygonsOf(const MeshData& mesh) {
  std::vector<Polygon> all;
  auto polygon = mesh.polygons.begin();
  const auto count = static_cast<Index>(mesh.triangles.size());
  for (Index i = 0; i < count;) {
    if (polygon != mesh.polygons.end() && (*polygon)[0] == i) {
      const Index n = (*polygon++)[1];
      if (Polygon outline = outlineOf(mesh.triangles, i, n); !outline.empty()) {
        all.push_back(std::move(outline));
        i += n;
        continue;
      }
    }
    all.emplace_back(mesh.triangles[i].begin(), mesh.triangles[i].end());
    ++i;
  }
  return all;
}

/// The points of the mesh, its polygons and creases become those one level finer; its triangles are of no
/// concern.
void divide(MeshData& mesh, std::vector<Polygon>& polygons, std::vector<Crease>& creases) {
  const auto points = static_cast<Index>(mesh.points.size());
  const auto at = [&](Index i) { return Vec3(mesh.points[i]); };
  Unique<Edge> edges;
  std::vector<Vec3> middles, beside;  // middles of each polygon; the sum of those beside each edge
  std::vector<int> uses;
  std::vector<Index> edgesOf;  // edges at each corner of each polygon
  for (const Polygon& polygon : polygons) {
    Vec3 sum;
    for (const Index corner : polygon) sum += at(corner);
    middles.push_back(sum / static_cast<Real>(polygon.size()));
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      const Index number = edges.number(edgeOf(polygon[c], polygon[(c + 1) % polygon.size()]));
      if (number == uses.size()) {
        uses.push_back(0);
        beside.emplace_back();
      }
      ++uses[number];
      beside[number] += middles.back();
      edgesOf.push_back(number);
    }
  }

  // An old point: (Q + 2 R + (n - 3) P) / n, with the means of the middles around it and of those of its
  // edges.
  SharpEdges sharp(edges, uses, creases, points);
  creases = std::move(sharp.finer);
  std::vector<Vec3> around(points), across(points);
  std::vector<int> faces(points), valence(points), borders(points);
  std::vector<PointCreases> creasesAt(points);
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (const Index corner : polygons[i]) {
      around[corner] += middles[i];
      ++faces[corner];
    }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Edge e = edges.keys()[i];
    for (const auto& [p, other] : {Edge{e.a, e.b}, Edge{e.b, e.a}}) {
      across[p] += (at(p) + at(other)) * 0.5;
      ++valence[p];
      creasesAt[p].add(at(other), sharp.sharpness[i]);
      if (uses[i] != 2) ++borders[p];
    }
  }
  std::vector<Vec3f> moved;
  for (Index i = 0; i < points; ++i) {
    const Real n = faces[i];
    const bool inside = borders[i] == 0 && faces[i] == valence[i] && faces[i] >= 3;
    if (borders[i] == 2 || inside)
      moved.push_back(
          Vec3f(creasesAt[i].moved(at(i), (around[i] / n + across[i] * (2 / n) + at(i) * (n - 3)) / n)));
    else
      moved.push_back(mesh.points[i]);  // a corner
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto [a, b] = edges.keys()[i];
    const Vec3 ends = at(a) + at(b);
    moved.push_back(Vec3f(creased((ends + beside[i]) * 0.25, ends * 0.5, sharp.sharpness[i])));
    if (!mesh.materials.empty()) mesh.materials.push_back(mesh.materials[a]);
    addMiddle(mesh.uvs, mesh.uvs, a, b);
    addMiddle(mesh.secondUvs, mesh.secondUvs, a, b);
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    moved.push_back(Vec3f(middles[i]));
    if (!mesh.materials.empty()) mesh.materials.push_back(mesh.materials[polygons[i][0]]);
    for (std::vector<Vec2>* uvs : {&mesh.uvs, &mesh.secondUvs}) {
      if (uvs->empty()) continue;
      Vec2 sum;
      for (const Index corner : polygons[i]) {
        sum.x += (*uvs)[corner].x;
        sum.y += (*uvs)[corner].y;
      }
      const Real n = static_cast<Real>(polygons[i].size());
      uvs->push_back({sum.x / n, sum.y / n});
    }
  }
  mesh.points = std::move(moved);

  std::vector<Polygon> finer;
  finer.reserve(edgesOf.size());
  const Index firstMiddle = points + static_cast<Index>(uses.size());
  std::size_t corner = 0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::size_t n = polygons[i].size();
    checkBudget();
    for (std::size_t c = 0; c < n; ++c)
      finer.push_back({polygons[i][c], points + edgesOf[corner + c], firstMiddle + static_cast<Index>(i),
                       points + edgesOf[corner + (c + n - 1) % n]});
    corner += n;
  }
  polygons = std::move(finer);
}

}  // namespace

MeshData subdividedByCatmullClark(const MeshData& mesh, int levels, const std::vector<Crease>& creases) {
  MeshData result = mesh;
  std::vector<Crease> left = creases;
  result.normals.clear();
  result.tangents.clear();
  std::vector<Polygon> polygons = polygonsOf(mesh);
  Work work("subdividing a mesh", levels);
  for (int level = 0; level < levels; ++level) {
    work.reached(level);
    divide(result, polygons, left);
  }
  result.triangles.clear();
  result.polygons.clear();
  for (const Polygon& polygon : polygons) appendPolygon(result, polygon);
  return result;
}

}  // namespace trace
