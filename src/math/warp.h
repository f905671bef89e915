// Two numbers from 0 up to 1 as evenly spread places: on a disk, in a polygon, among directions. (0.5, 0.5)
// is the middle of each.
#pragma once

#include <cmath>

#include "math/perpendicular.h"
#include "math/vec.h"

namespace trace {

inline constexpr Vec2 kCenter{0.5, 0.5};

/// In the disk of radius 1 (Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997).
inline Vec2 toDisk(const Vec2& u) {
  const Real a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const Real r = wide ? a : b, angle = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
  return {r * std::cos(angle), r * std::sin(angle)};
}

/// In the regular polygon of so many corners, at distance 1 from the middle, the first at `angle` from x.
inline Vec2 toPolygon(const Vec2& u, int corners, Real angle) {
  const Vec2 disk = toDisk(u);
  const Real r2 = disk.x * disk.x + disk.y * disk.y;
  if (r2 == 0) return {0, 0};
  // The square root of an even number in a triangle's height: the share of the way to the side.
  const Real turn = (std::atan2(disk.y, disk.x) / (2 * kPi) + 0.5) * corners;
  const Real corner = std::floor(turn), along = turn - corner, out = std::sqrt(r2);
  const auto at = [&](Real n) {
    const Real a = angle + 2 * kPi * n / corners;
    return Vec2{std::cos(a), std::sin(a)};
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
