#include "geometry/mesh.h"

#include <utility>

namespace trace {
namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners corners(const MeshData& mesh, std::uint32_t index) {
  const Triangle& t = mesh.triangles[index];
  return {Vec3(mesh.points[t[0]]), Vec3(mesh.points[t[1]]), Vec3(mesh.points[t[2]])};
}

/// a d - b c with the right sign: where rounding could hide it, by Kahan's method (Jeannerod et al. 2013).
Real differenceOfProducts(Real a, Real d, Real b, Real c) {
  const Real ad = a * d, bc = b * c, difference = ad - bc;
  if (std::abs(difference) > gammaError(3) * (std::abs(ad) + std::abs(bc))) return difference;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

/// On which side of the edge p -> q (in the plane across the ray) the ray passes; exactly the negative for
/// q -> p. A ray that meets the edge exactly is decided as if it were moved by (e, e^2), e -> 0 (Edelsbrunner
/// and Muecke, Simulation of Simplicity, 1990). So the projected triangles tile the plane without gap or
/// overlap, at their vertices too.
Real edgeSide(const Vec2& p, const Vec2& q) {
  const Real side = differenceOfProducts(p.x, q.y, p.y, q.x);
  if (side != 0) return side;
  constexpr Real kTiny = std::numeric_limits<Real>::denorm_min();
  const Real lean = p.y != q.y ? p.y - q.y : q.x - p.x;
  return lean > 0 ? kTiny : lean < 0 ? -kTiny : 0;
}

}  // namespace

TriangleRay::TriangleRay(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
  const Vec3 size = abs(ray.direction);
  z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  x = (z + 1) % 3, y = (z + 2) % 3;
  if (ray.direction[z] < 0) std::swap(x, y);  // keeps the winding
  shearX = ray.direction[x] / ray.direction[z];
  shearY = ray.direction[y] / ray.direction[z];
}

std::optional<TriangleHit> TriangleRay::intersect(const MeshData& mesh, std::uint32_t index) const {
  const Corners v = corners(mesh, index);
  const Vec3 a = v.a - origin, b = v.b - origin, c = v.c - origin;
  const auto project = [&](const Vec3& p) { return Vec2{p[x] - shearX * p[z], p[y] - shearY * p[z]}; };
  const Vec2 pa = project(a), pb = project(b), pc = project(c);
  const Real e0 = edgeSide(pb, pc), e1 = edgeSide(pc, pa), e2 = edgeSide(pa, pb);
  if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0)) return {};
  const Real sum = e0 + e1 + e2;
  if (sum == 0) return {};

  TriangleHit hit;
  hit.b[0] = e0 / sum, hit.b[1] = e1 / sum, hit.b[2] = e2 / sum;
  // The distance along the face's normal has the right sign for rays that leave the surface; only for a ray
  // in the triangle's plane, by rounding, the corners' distances must do.
  const Vec3 normal = cross(v.b - v.a, v.c - v.a);
  if (normal == Vec3{}) return {};
  const Real along = dot(normal, direction);
  hit.t = along != 0 ? dot(normal, a) / along
                     : (hit.b[0] * a[z] + hit.b[1] * b[z] + hit.b[2] * c[z]) / direction[z];
  hit.front = along != 0 ? along < 0 : sum < 0;
  return hit;
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
  box.extend(v.a), box.extend(v.b), box.extend(v.c);
  return box;
}

Box3 bounds(const MeshData& mesh) {
  Box3 box;
  for (const Triangle& triangle : mesh.triangles)
    for (std::uint32_t point : triangle) box.extend(Vec3(mesh.points[point]));
  return box;
}

MeshData withGeneratedNormals(const MeshData& mesh, bool unit) {
  std::vector<Vec3> sums(mesh.points.size());
  std::vector<int> counts(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 n = faceNormal(mesh, i);
    if (n == Vec3{}) continue;
    for (std::uint32_t point : mesh.triangles[i]) sums[point] += normalize(n), ++counts[point];
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
