#include "geometry/mesh/mesh_displace.h"

#include <cmath>
#include <string>

#include "base/budget.h"
#include "base/error.h"
#include "base/unique.h"
#include "geometry/mesh/mesh_crease.h"
#include "math/elementary.h"

namespace trace {
namespace {

using Index = std::uint32_t;

Vec3f unitOr(const Vec3& v, const Vec3f& otherwise) {
  const Real size = length(v);
  return size > 0 && std::isfinite(size) ? Vec3f(v / size) : otherwise;
}

/// Each triangle in four. The middle of an edge is the same to the last bit from both sides, and where points
/// are doubled along it.
MeshData cutInFour(const MeshData& mesh) {
  MeshData result = mesh;
  result.triangles.clear();
  result.triangles.reserve(4 * mesh.triangles.size());
  Unique<Edge> edges;
  const auto middle = [&](Index a, Index b) {
    const Index number = edges.number(edgeOf(a, b)), point = static_cast<Index>(mesh.points.size()) + number;
    if (point < result.points.size()) return point;
    const Edge e = edges.keys()[number];
    result.points.push_back(Vec3f((Vec3(mesh.points[e.a]) + Vec3(mesh.points[e.b])) / 2));
    result.normals.push_back(unitOr(Vec3(mesh.normals[e.a]) + Vec3(mesh.normals[e.b]), mesh.normals[e.a]));
    if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[e.a]);
    addMiddle(result.uvs, mesh.uvs, e.a, e.b);
    addMiddle(result.secondUvs, mesh.secondUvs, e.a, e.b);
    if (!mesh.tangents.empty()) {
      const MeshTangent &first = mesh.tangents[e.a], &last = mesh.tangents[e.b];
      result.tangents.push_back({Vec3f(Vec3(first.direction) + Vec3(last.direction)), first.side});
    }
    return point;
  };
  for (const Triangle& t : mesh.triangles) {
    checkBudget();
    const Triangle m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    result.triangles.push_back({t[0], m[0], m[2]});
    result.triangles.push_back({t[1], m[1], m[0]});
    result.triangles.push_back({t[2], m[2], m[1]});
    result.triangles.push_back(m);
  }
  return result;
}

/// With normals along which points can move.
MeshData withSomeNormals(const MeshData& mesh) {
  MeshData result = mesh.generateNormals   ? withGeneratedNormals(mesh, true)
                    : mesh.normals.empty() ? withCreaseNormals(mesh, kPi)
                                           : mesh;
  result.twoSided = mesh.twoSided;
  result.polygons.clear();
  for (Vec3f& n : result.normals) n = unitOr(Vec3(n), {});
  return result;
}

/// A place and one of the normals there.
struct PlaceNormal {
  Index place;
  Vec3f normal;
};

/// Which points share a normal when it is made anew.
std::vector<Index> sharesOf(const MeshData& mesh, const std::vector<Index>& place,
                            Unique<PlaceNormal>& shares) {
  std::vector<Index> share;
  share.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3f& n = mesh.normals[i];
    share.push_back(shares.number({place[i], {n.x + 0.0f, n.y + 0.0f, n.z + 0.0f}}));
  }
  return share;
}

void movePoints(MeshData& mesh, const std::vector<Index>& place, const Unique<PlaceNormal>& shares,
                const HeightOfPoint& height) {
  struct Moved {
    Vec3 along;
    Real height = 0;
    int count = 0;
  };
  std::vector<Moved> moved(mesh.points.size());  // by the number of the place
  for (const PlaceNormal& share : shares.keys()) moved[share.place].along += Vec3(share.normal);
  for (Index i = 0; i < mesh.points.size(); ++i) {
    checkBudget();
    Moved& m = moved[place[i]];
    m.height += height(mesh, i);
    ++m.count;
  }
  constexpr Real kCancelled = 1e-6;  // length at which unit normals cancel
  for (Index i = 0; i < mesh.points.size(); ++i) {
    const Moved& m = moved[place[i]];
    if (length(m.along) < kCancelled) continue;
    Vec3f& p = mesh.points[i];
    p = Vec3f(Vec3(p) + normalize(m.along) * (m.height / m.count));
    if (!isFinite(Vec3(p)))
      throw Error(Fault::scene, "the displacement moves a point of the mesh beyond what a float holds",
                  "a smaller displacement, in units of the object");
  }
}

Real angleAt(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - corner, v = b - corner;
  return math::atan2(length(cross(u, v)), dot(u, v));
}

/// Faces count by their angle at the point (Thuermer and Wuethrich 1998).
void renewNormals(MeshData& mesh, const std::vector<Index>& share, std::size_t shares) {
  std::vector<Vec3> sums(shares);
  for (Index i = 0; i < mesh.triangles.size(); ++i) {
    checkBudget();
    const Vec3 normal = faceNormal(mesh, i);
    if (normal == Vec3{}) continue;
    const Corners v = corners(mesh, i);
    const Vec3 at[3] = {v.a, v.b, v.c};
    for (std::size_t c = 0; c < 3; ++c)
      sums[share[mesh.triangles[i][c]]] +=
          normalize(normal) * angleAt(at[c], at[(c + 1) % 3], at[(c + 2) % 3]);
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    mesh.normals[i] = unitOr(sums[share[i]], mesh.normals[i]);
}

}  // namespace

MeshData displaced(const MeshData& mesh, int levels, const HeightOfPoint& height) {
  MeshData result = withSomeNormals(mesh);
  Work work("displacing a mesh", levels + 1);
  for (int level = 0; level < levels; ++level) {
    work.reached(level);
    result = cutInFour(result);
  }
  work.reached(levels);
  const std::vector<Index> place = placesOf(result);
  Unique<PlaceNormal> shares;
  const std::vector<Index> share = sharesOf(result, place, shares);
  movePoints(result, place, shares, height);
  renewNormals(result, share, shares.keys().size());
  return result;
}

}  // namespace trace
