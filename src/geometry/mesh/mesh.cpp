#include "geometry/mesh/mesh.h"

#include "accel/bounds.h"

namespace trace {
Corners corners(const MeshData& mesh, std::uint32_t index) {
  const Triangle& t = mesh.triangles[index];
  return {Vec3(mesh.points[t[0]]), Vec3(mesh.points[t[1]]), Vec3(mesh.points[t[2]])};
}

SurfacePoint surface(const MeshData& mesh, std::uint32_t index, const TriangleHit& hit) {
  const Triangle& t = mesh.triangles[index];
  const Corners v = corners(mesh, index);
  const auto mix = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return a * hit.b[0] + b * hit.b[1] + c * hit.b[2];
  };

  SurfacePoint s;
  s.point = mix(v.a, v.b, v.c);
  s.error = max(max(abs(v.a), abs(v.b)), abs(v.c)) * gammaError(20);
  s.normal = normalize(cross(v.b - v.a, v.c - v.a));
  s.shading = s.normal;
  if (!mesh.normals.empty()) {
    const Vec3 n = mix(Vec3(mesh.normals[t[0]]), Vec3(mesh.normals[t[1]]), Vec3(mesh.normals[t[2]]));
    const Real l = length(n);
    if (l > 0 && std::isfinite(l)) s.shading = n / l;
  }
  s.uv = {hit.b[1], hit.b[2]};
  if (!mesh.uvs.empty()) {
    const Vec2 &p = mesh.uvs[t[0]], &q = mesh.uvs[t[1]], &r = mesh.uvs[t[2]];
    s.uv = {p.x * hit.b[0] + q.x * hit.b[1] + r.x * hit.b[2],
            p.y * hit.b[0] + q.y * hit.b[1] + r.y * hit.b[2]};
  }
  return s;
}

Vec3 faceNormal(const MeshData& mesh, std::uint32_t index) {
  const Corners v = corners(mesh, index);
  return cross(v.b - v.a, v.c - v.a);
}

Box3 bounds(const MeshData& mesh, std::uint32_t index) {
  const Corners v = corners(mesh, index);
  Box3 box;
  box.extend(v.a);
  box.extend(v.b);
  box.extend(v.c);
  return box;
}

Box3 bounds(const MeshData& mesh) {
  Bounds box;
  for (const Triangle& triangle : mesh.triangles)
    for (std::uint32_t point : triangle) box.extend(boxOf(mesh.points[point]));
  return box3(box);
}

MeshData withGeneratedNormals(const MeshData& mesh, bool unit) {
  std::vector<Vec3> sums(mesh.points.size());
  std::vector<int> counts(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 n = faceNormal(mesh, i);
    if (n == Vec3{}) continue;
    for (std::uint32_t point : mesh.triangles[i]) {
      sums[point] += normalize(n);
      ++counts[point];
    }
  }
  MeshData result = mesh;
  result.generateNormals = false;
  result.normals.resize(mesh.points.size());
  for (size_t i = 0; i < sums.size(); ++i) {
    Vec3 n = counts[i] ? sums[i] / counts[i] : Vec3{};
    if (!mesh.normals.empty()) n += Vec3(mesh.normals[i]);
    if (unit && n != Vec3{}) n = normalize(n);
    result.normals[i] = Vec3f(n);
  }
  return result;
}

}  // namespace trace
