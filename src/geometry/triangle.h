// One ray and one triangle: the test that decides.
//
// Watertight (Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013), with the signs
// of the edges exact: of the triangles around an edge or a vertex that a ray hits exactly, one is hit per
// crossing.
#pragma once

#include <cmath>
#include <utility>

#include "geometry/ray.h"

namespace trace {

struct Corners {
  Vec3 a, b, c;
};

struct TriangleHit {
  Real t = 0;
  Real b[3] = {};     ///< barycentric coordinates, sum 1
  bool front = true;  ///< the ray comes from the side the normal points to
};

/// a d - b c with the right sign: where rounding could hide it, by Kahan's method (Jeannerod et al. 2013).
inline Real differenceOfProducts(Real a, Real d, Real b, Real c) {
  const Real ad = a * d, bc = b * c, difference = ad - bc;
  if (std::abs(difference) > gammaError(3) * (std::abs(ad) + std::abs(bc))) return difference;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

/// On which side of the edge p -> q (in the plane across the ray) the ray passes; exactly the negative for
/// q -> p. A ray that meets the edge exactly is decided as if it were moved by (e, e^2), e -> 0 (Edelsbrunner
/// and Muecke, Simulation of Simplicity, 1990). So the projected triangles tile the plane without gap or
/// overlap, at their vertices too.
inline Real edgeSide(const Vec2& p, const Vec2& q) {
  const Real side = differenceOfProducts(p.x, q.y, p.y, q.x);
  if (side != 0) return side;
  constexpr Real kTiny = std::numeric_limits<Real>::denorm_min();
  const Real lean = p.y != q.y ? p.y - q.y : q.x - p.x;
  return lean > 0 ? kTiny : lean < 0 ? -kTiny : 0;
}

/// A ray prepared for many triangles: sheared so that it runs along an axis from the origin.
struct TriangleRay {
  Vec3 origin, direction;
  int x, y, z;  ///< axes, z that of the largest component of the direction
  Real shearX, shearY;

  explicit TriangleRay(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
    const Vec3 size = abs(direction);
    z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    if (direction[z] < 0) std::swap(x, y);  // keeps the winding
    const Real inverse = 1 / direction[z];
    shearX = direction[x] * inverse;
    shearY = direction[y] * inverse;
  }

  /// Where the line of the ray meets the triangle; false if it does not.
  bool intersect(const Corners& v, TriangleHit& hit) const {
    const Vec3 a = v.a - origin, b = v.b - origin, c = v.c - origin;
    const auto project = [&](const Vec3& p) { return Vec2{p[x] - shearX * p[z], p[y] - shearY * p[z]}; };
    const Vec2 pa = project(a), pb = project(b), pc = project(c);
    const Real e0 = edgeSide(pb, pc), e1 = edgeSide(pc, pa), e2 = edgeSide(pa, pb);
    if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0)) return false;
    const Real sum = e0 + e1 + e2;
    const Vec3 normal = cross(v.b - v.a, v.c - v.a);
    if (sum == 0 || normal == Vec3{}) return false;

    const Real scale = 1 / sum;
    hit.b[0] = e0 * scale, hit.b[1] = e1 * scale, hit.b[2] = e2 * scale;
    // The distance along the face's normal has the right sign for rays that leave the surface; only for a ray
    // in the triangle's plane, by rounding, the corners' distances must do.
    const Real along = dot(normal, direction);
    hit.t = along != 0 ? dot(normal, a) / along
                       : (hit.b[0] * a[z] + hit.b[1] * b[z] + hit.b[2] * c[z]) / direction[z];
    hit.front = along != 0 ? along < 0 : sum < 0;
    return true;
  }
};

}  // namespace trace
