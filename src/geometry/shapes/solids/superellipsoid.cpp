#include "geometry/shapes/solids/superellipsoid.h"

#include <algorithm>

#include "geometry/solve/span.h"
#include "math/elementary.h"

namespace trace {
namespace {

Real ellipsoidExponent(Real squareness) { return 2 / std::clamp(squareness, 0.02, 2.0); }

/// (a^p + b^p)^(1/p) for a, b >= 0, and its derivatives, without overflow.
Real norm2(Real a, Real b, Real p, Real& byA, Real& byB) {
  const Real most = max(a, b);
  if (most == 0) {
    byA = byB = p == 1 ? 1 : 0;
    return 0;
  }
  if (p == 1) {
    byA = byB = 1;
    return a + b;
  }
  if (p == 2) {
    const Real l = std::sqrt(a * a + b * b);
    byA = a / l;
    byB = b / l;
    return l;
  }
  // With w = (least / most)^p the norm is most (1 + w)^(1/p), and its slopes are powers of the same.
  const Real least = min(a, b), w = math::pow(least / most, p), root = math::pow(1 + w, 1 / p);
  const Real byMost = root / (1 + w), byLeast = least > 0 ? w * (most / least) * byMost : 0;
  byA = a < b ? byLeast : byMost;
  byB = a < b ? byMost : byLeast;
  return most * root;
}

/// The norm whose unit ball is the superellipsoid.
Real surfaceNorm(const Superellipsoid& shape, const Vec3& p, Vec3& slopes) {
  const Vec3 q = abs(p);
  Real byX, byY, byRho, byZ;
  const Real rho = norm2(q.x, q.y, ellipsoidExponent(shape.east), byX, byY);
  const Real size = norm2(rho, q.z, ellipsoidExponent(shape.north), byRho, byZ);
  slopes = {std::copysign(byRho * byX, p.x), std::copysign(byRho * byY, p.y), std::copysign(byZ, p.z)};
  return size;
}

}  // namespace

void Superellipsoid::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  Span span = spanIn(roomy(bounds()), ray);
  if (range.from >= 0) span.from = max(span.from, 0);  // nothing behind the origin is wanted
  if (span.empty()) return;
  convexCrossings(
      span, range,
      [&](Real t) {
        Vec3 slopes;
        const Real size = surfaceNorm(*this, ray.at(t), slopes);
        return Jet{size - 1, dot(slopes, ray.direction)};
      },
      [&](Real t, int end) {
        visit(Crossing{t, end});
      });
}

SurfacePoint Superellipsoid::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t), slopes;
  const Real size = surfaceNorm(*this, p, slopes);
  if (size > 0) p = p / size;
  surfaceNorm(*this, p, slopes);
  const Vec3 n = normalize(slopes);
  const Real error = gammaError(80);
  return {p, {error, error, error}, n, n, SurfaceUv::toward(normalize(p))};
}

}  // namespace trace
