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
  Real b[3];          ///< barycentric coordinates, sum 1; set with the hit
  bool front = true;  ///< the ray comes from the side the normal points to
};

/// a d - b c with the right sign: where rounding could hide it, by Kahan's method (Jeannerod et al. 2013).
inline Real differenceOfProducts(Real a, Real d, Real b, Real c) {
  const Real ad = a * d, bc = b * c, difference = ad - bc;
  if (std::abs(difference) > gammaError(3) * (std::abs(ad) + std::abs(bc))) return difference;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

/// On which side of the edge p -> q (in the plane across the ray) the ray passes; exactly the negative for
/// q -> p. A ray that hits the edge exactly is decided as if it were moved by (e, e^2), e -> 0 (Edelsbrunner
/// and Muecke, Simulation of Simplicity, 1990). So the projected triangles tile the plane without gap or
/// overlap, at their vertices too.
inline Real edgeSide(const Vec2& p, const Vec2& q) {
  const Real side = differenceOfProducts(p.x, q.y, p.y, q.x);
  if (side != 0) return side;
  constexpr Real kTiny = std::numeric_limits<Real>::denorm_min();
  const Real lean = p.y != q.y ? p.y - q.y : q.x - p.x;
  return lean > 0 ? kTiny : lean < 0 ? -kTiny : 0;
}

/// Where a ray hits the plane of a triangle (Moeller and Trumbore, JGT 2(1), 1997), if it does at
/// 0 < t <= tMost; not if it runs in the plane, as rounding goes. The distance has the right sign for rays
/// that leave the surface.
inline bool locate(const Ray& ray, const Corners& v, Real tMost, TriangleHit& hit) {
  const Vec3 ab = v.b - v.a, ac = v.c - v.a, a = v.a - ray.origin, normal = cross(ab, ac);
  const Real along = dot(normal, ray.direction);
  hit.t = dot(normal, a) / along;
  if (!(hit.t > 0 && hit.t <= tMost) || along == 0) return false;
  const Vec3 moment = cross(a, ray.direction);
  hit.b[1] = dot(moment, ac) / along;
  hit.b[2] = -dot(moment, ab) / along;
  hit.b[0] = 1 - hit.b[1] - hit.b[2];
  hit.front = along < 0;
  return true;
}

/// A ray prepared for many triangles: sheared so that it runs along an axis from the origin.
struct TriangleRay {
  Vec3 origin, direction;
  int x, y, z;  ///< axes, z that of the largest component of the direction
  Real shearX, shearY;

  explicit TriangleRay(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
    const Real d[3] = {direction.x, direction.y, direction.z};
    const Real sizeX = std::abs(d[0]), sizeY = std::abs(d[1]), sizeZ = std::abs(d[2]);
    // Without branches, which would be guessed wrongly for every other ray.
    const Real most = sizeX > sizeY ? sizeX : sizeY;
    z = 2 - (most > sizeZ) * (1 + (sizeX > sizeY));
    static constexpr int kNext[2][3] = {{1, 2, 0}, {2, 0, 1}};
    const int backward = d[z] < 0;  // keeps the winding
    x = kNext[backward][z];
    y = kNext[1 - backward][z];
    const Real inverse = 1 / d[z];
    shearX = d[x] * inverse;
    shearY = d[y] * inverse;
  }

  /// Whether the line of the ray passes through the triangle.
  bool passes(const Corners& v) const {
    const Vec3 a = v.a - origin, b = v.b - origin, c = v.c - origin;
    const auto project = [&](const Vec3& p) { return Vec2{p[x] - shearX * p[z], p[y] - shearY * p[z]}; };
    const Vec2 pa = project(a), pb = project(b), pc = project(c);
    const Real e0 = edgeSide(pb, pc), e1 = edgeSide(pc, pa), e2 = edgeSide(pa, pb);
    if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0)) return false;
    return e0 + e1 + e2 != 0;
  }

  /// Where the ray hits the triangle, if it does at 0 < t <= tMost.
  bool intersect(const Corners& v, Real tMost, TriangleHit& hit) const {
    return locate({origin, direction}, v, tMost, hit) && passes(v);
  }
};

}  // namespace trace
