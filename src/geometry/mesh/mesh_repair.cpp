#include "geometry/mesh/mesh_repair.h"

#include <array>
#include <optional>

namespace trace {
namespace {

/// Polygons of more corners become fans, dents or not: cutting ears takes quadratic time.
constexpr std::size_t kMostEarCorners = 64;

Vec3 at(const MeshData& mesh, std::uint32_t point) { return Vec3(mesh.points[point]); }

/// Twice the area, along the normal (Newell's method).
Vec3 areaNormal(const MeshData& mesh, std::span<const std::uint32_t> corners) {
  Vec3 sum;
  const Vec3 first = at(mesh, corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(at(mesh, corners[i]) - first, at(mesh, corners[i + 1]) - first);
  return sum;
}

/// How far to the left of a -> b the point p is, seen against the normal.
Real sideOf(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& normal) {
  return dot(cross(b - a, p - a), normal);
}

bool isConvex(const MeshData& mesh, std::span<const std::uint32_t> corners, const Vec3& normal) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = at(mesh, corners[i]), b = at(mesh, corners[(i + 1) % n]),
               c = at(mesh, corners[(i + 2) % n]);
    if (sideOf(a, b, c, normal) < 0) return false;
  }
  return true;
}

void appendFan(MeshData& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i], corners[i + 1]});
}

/// Is the corner after `i` one that can be cut off: convex, and no other corner in its triangle?
bool isEar(const MeshData& mesh, std::span<const std::uint32_t> corners, std::size_t i, const Vec3& normal) {
  const std::size_t n = corners.size();
  const std::array<std::uint32_t, 3> ear{corners[i], corners[(i + 1) % n], corners[(i + 2) % n]};
  const Vec3 a = at(mesh, ear[0]), b = at(mesh, ear[1]), c = at(mesh, ear[2]);
  if (!(sideOf(a, b, c, normal) > 0)) return false;
  for (std::uint32_t other : corners) {
    if (other == ear[0] || other == ear[1] || other == ear[2]) continue;
    const Vec3 p = at(mesh, other);
    if (sideOf(a, b, p, normal) >= 0 && sideOf(b, c, p, normal) >= 0 && sideOf(c, a, p, normal) >= 0)
      return false;
  }
  return true;
}

/// The two-ears theorem (Meisters 1975): a polygon without crossings always has one.
void cutEars(MeshData& mesh, std::span<const std::uint32_t> polygon, const Vec3& normal) {
  std::vector<std::uint32_t> corners(polygon.begin(), polygon.end());
  std::size_t i = 0;
  for (std::size_t tries = 0; corners.size() > 3 && tries < corners.size();) {
    i %= corners.size();
    if (!isEar(mesh, corners, i, normal)) {
      ++i;
      ++tries;
      continue;
    }
    const std::size_t n = corners.size(), tip = (i + 1) % n;
    mesh.triangles.push_back({corners[i], corners[tip], corners[(i + 2) % n]});
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(tip));
    tries = 0;
  }
  appendFan(mesh, corners);  // the last triangle; or, of a polygon that crosses itself, the rest
}

}  // namespace

void appendPolygon(MeshData& mesh, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) return appendFan(mesh, corners);
  const auto count = static_cast<std::uint32_t>(corners.size() - 2);
  mesh.polygons.push_back({static_cast<std::uint32_t>(mesh.triangles.size()), count});
  if (corners.size() > kMostEarCorners) return appendFan(mesh, corners);
  const Vec3 normal = areaNormal(mesh, corners);
  if (isConvex(mesh, corners, normal))
    appendFan(mesh, corners);
  else
    cutEars(mesh, corners, normal);
}

Degenerate dropDegenerate(MeshData& mesh) {
  Degenerate found;
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::uint32_t kept = 0;
  std::vector<std::uint32_t> place;  // new place of each triangle, once those before it are gone
  if (!mesh.polygons.empty()) place.reserve(count + 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!mesh.polygons.empty()) place.push_back(kept);
    if (faceNormal(mesh, i) == Vec3{}) {
      if (found.count++ == 0) found.first = i;
      continue;
    }
    mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  if (kept < count && !mesh.polygons.empty()) {  // what is left of a polygon is triangles
    place.push_back(kept);
    std::vector<std::array<std::uint32_t, 2>> whole;
    for (const auto& [first, n] : mesh.polygons)
      if (place[first + n] - place[first] == n) whole.push_back({place[first], n});
    mesh.polygons = std::move(whole);
  }
  return found;
}

std::size_t repairNormals(MeshData& mesh) {
  if (mesh.generateNormals) return 0;
  std::size_t repaired = 0;
  std::optional<MeshData> generated;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (mesh.normals[i] != Vec3f{}) continue;
    if (!generated) {
      MeshData bare;
      bare.points = mesh.points;
      bare.triangles = mesh.triangles;
      generated = withGeneratedNormals(bare, true);
    }
    mesh.normals[i] = generated->normals[i];
    ++repaired;
  }
  return repaired;
}

}  // namespace trace
