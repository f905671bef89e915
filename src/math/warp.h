// Two numbers from 0 up to 1 as evenly spread places: on a disk, in a polygon, among directions. (0.5, 0.5)
// is the middle of each.
#pragma once

#include <cmath>
#include <initializer_list>

#include "math/elementary.h"
#include "math/perpendicular.h"
#include "math/vec.h"

namespace trace {

inline constexpr Vec2 kCenter{0.5, 0.5};

/// Cosine and sine of an angle between -pi / 4 and pi / 4 by their series, to a unit in the last place: the
/// same bits on every machine, whatever its C library.
inline Vec2 onEighth(Real angle) {
  const Real z = angle * angle;
  const auto series = [z](std::initializer_list<Real> factors) {
    Real sum = 0;
    for (const Real factor : factors) sum = sum * z + factor;
    return sum;
  };
  return {1 + z * series({1 / 20922789888000.0, -1 / 87178291200.0, 1 / 479001600.0, -1 / 3628800.0,
                          1 / 40320.0, -1 / 720.0, 1 / 24.0, -0.5}),
          angle + angle * z *
                      series({-1 / 1307674368000.0, 1 / 6227020800.0, -1 / 39916800.0, 1 / 362880.0,
                              -1 / 5040.0, 1 / 120.0, -1 / 6.0})};
}

/// Cosine and sine of that part of a turn, likewise; 0 <= turns.
inline Vec2 onCircle(Real turns) {
  const int quarter = static_cast<int>(4 * turns + 0.5);
  const Vec2 near = onEighth(2 * kPi * (turns - 0.25 * quarter));
  const Vec2 at = quarter & 1 ? Vec2{-near.y, near.x} : near;
  return quarter & 2 ? Vec2{-at.x, -at.y} : at;
}

/// In the disk of radius 1 (Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997).
inline Vec2 toDisk(const Vec2& u) {
  const Real a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const Real r = wide ? a : b;
  const Vec2 near = onEighth(kPi / 4 * (wide ? b / a : a / b));
  return wide ? Vec2{r * near.x, r * near.y} : Vec2{r * near.y, r * near.x};
}

/// In the regular polygon of so many corners, at distance 1 from the middle, the first at `angle` from x.
inline Vec2 toPolygon(const Vec2& u, int corners, Real angle) {
  const Vec2 disk = toDisk(u);
  const Real r2 = disk.x * disk.x + disk.y * disk.y;
  if (r2 == 0) return {0, 0};
  // The square root of an even number in a triangle's height: the share of the way to the side.
  const Real turn = (math::atan2(disk.y, disk.x) / (2 * kPi) + 0.5) * corners;
  const Real corner = std::floor(turn), along = turn - corner, out = std::sqrt(r2);
  const auto at = [&](Real n) {
    const math::SinCos a = math::sincos(angle + 2 * kPi * n / corners);
    return Vec2{a.cos, a.sin};
  };
  const Vec2 p = at(corner), q = at(corner + 1);
  return {out * (p.x + (q.x - p.x) * along), out * (p.y + (q.y - p.y) * along)};
}

/// Unit directions around the unit vector `axis`, evenly over those whose cosine to it is at least `cosine`.
inline Vec3 toCone(const Vec2& u, const Vec3& axis, Real cosine) {
  const Vec2 disk = toDisk(u);
  const Real r2 = disk.x * disk.x + disk.y * disk.y, down = 1 - cosine;
  // z = 1 - r^2 (1 - cosine), and x and y so that the length is 1.
  const Real scale = std::sqrt(down * std::max(0.0, 2 - r2 * down));
  const Vec3 x = perpendicularTo(axis), y = cross(axis, x);
  return normalize(axis * (1 - r2 * down) + x * (disk.x * scale) + y * (disk.y * scale));
}

}  // namespace trace
