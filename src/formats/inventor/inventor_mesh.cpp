#include "formats/inventor/inventor_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "geometry/mesh/mesh_repair.h"
#include "math/elementary.h"

namespace trace::inventor {
namespace {

/// Newell's normal of each polygon, of length 1, or zero.
std::vector<Vec3> faceNormals(const Faces& faces) {
  std::vector<Vec3> normals;
  normals.reserve(faces.counts.size());
  std::size_t first = 0;
  for (std::uint32_t count : faces.counts) {
    Vec3 sum;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3& a = faces.points[faces.corners[first + i].point];
      const Vec3& b = faces.points[faces.corners[first + (i + 1) % count].point];
      sum += Vec3{(a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y)};
    }
    const Real l = length(sum);
    normals.push_back(l > 0 && std::isfinite(l) ? sum / l : Vec3{});
    first += count;
  }
  return normals;
}

/// Each corner's normal is the mean of those of the faces around its point that are within the crease angle
/// of its own face's.
void mixNormals(Faces& faces) {
  // Faces around one point are compared in pairs; beyond this number all of them are taken.
  constexpr std::size_t kMostCompared = 1000;
  const std::vector<Vec3> normals = faceNormals(faces);
  std::vector<std::uint32_t> faceOf(faces.corners.size());
  std::vector<std::uint32_t> start(faces.points.size() + 1);
  std::size_t corner = 0;
  for (std::uint32_t face = 0; face < faces.counts.size(); ++face)
    for (std::uint32_t i = 0; i < faces.counts[face]; ++i, ++corner) {
      faceOf[corner] = face;
      ++start[faces.corners[corner].point + 1];
    }
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<std::uint32_t> around(faces.corners.size()), filled(start);
  for (std::size_t i = 0; i < faces.corners.size(); ++i) around[filled[faces.corners[i].point]++] = faceOf[i];

  const Real least =
      faces.creaseAngle >= kPi ? -2 : math::cos(faces.creaseAngle) - 1e-9;  // rounding of equals
  for (std::size_t i = 0; i < faces.corners.size(); ++i) {
    const std::uint32_t point = faces.corners[i].point;
    const Vec3& own = normals[faceOf[i]];
    Vec3 sum;
    const bool all = start[point + 1] - start[point] > kMostCompared;
    if (all && i > 0 && faces.corners[i - 1].point == point) {
      faces.corners[i].normal = faces.corners[i - 1].normal;
      continue;
    }
    const std::uint32_t end = all ? start[point] + kMostCompared : start[point + 1];
    for (std::uint32_t k = start[point]; k < end; ++k)
      if (dot(normals[around[k]], own) >= least) sum += normals[around[k]];
    const Real l = length(sum);
    faces.corners[i].normal = l > 0 ? sum / l : own;
  }
  faces.hasNormals = true;
}

struct CornerKey {
  std::size_t operator()(const Corner& c) const {
    std::size_t hash = c.point;
    const auto add = [&](std::size_t more) { hash = (hash ^ more) * 0x9e3779b97f4a7c15u + (hash >> 29); };
    for (Real r : {c.normal.x, c.normal.y, c.normal.z, c.uv.x, c.uv.y}) add(std::hash<Real>{}(r));
    add(c.material);
    return hash;
  }
  bool operator()(const Corner& a, const Corner& b) const {
    return a.point == b.point && a.normal == b.normal && a.material == b.material && a.uv == b.uv;
  }
};

}  // namespace

MeshData meshOf(Faces faces) {
  if (!faces.counterClockwise) {
    auto first = faces.corners.begin();
    for (std::uint32_t count : faces.counts) {
      std::reverse(first, first + count);
      first += count;
    }
  }
  if (!faces.hasNormals && faces.creaseAngle > 0) mixNormals(faces);

  MeshData mesh;
  std::unordered_map<Corner, std::uint32_t, CornerKey, CornerKey> known;
  std::vector<std::uint32_t> polygon;
  std::size_t at = 0;
  for (std::uint32_t count : faces.counts) {
    polygon.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      Corner corner = faces.corners[at++];
      if (!faces.hasNormals) corner.normal = {};
      const auto [found, fresh] = known.try_emplace(corner, static_cast<std::uint32_t>(mesh.points.size()));
      if (fresh) {
        mesh.points.push_back(Vec3f(faces.points[corner.point]));
        if (faces.hasNormals) mesh.normals.push_back(Vec3f(corner.normal));
        if (faces.hasMaterials) mesh.materials.push_back(corner.material);
        if (faces.hasUvs) mesh.uvs.push_back(corner.uv);
      }
      polygon.push_back(found->second);
    }
    if (count >= 3) appendPolygon(mesh, polygon);
  }
  return mesh;
}

}  // namespace trace::inventor
