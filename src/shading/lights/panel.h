// Rectangles by their middle and two sides, and the ellipses in them.
#pragma once

#include <cmath>
#include <optional>

#include "geometry/ray.h"
#include "math/vec.h"
#include "math/warp.h"

namespace trace {

/// The place of a panel that two numbers from 0 up to 1 choose, evenly over its area.
template <class P>
Vec3 placeOn(const P& panel, const Vec2& chosen) {
  Vec2 at{chosen.x - 0.5, chosen.y - 0.5};
  if constexpr (requires { panel.round; })
    if (panel.round) {
      const Vec2 disk = toDisk(chosen);
      at = {disk.x / 2, disk.y / 2};
    }
  return panel.position + panel.u * at.x + panel.v * at.y;
}

/// Where along the ray the panel is hit, if it is.
template <class P>
std::optional<Real> meetsPanel(const P& panel, const Ray& ray) {
  const Vec3 across = cross(panel.u, panel.v);
  const Real t = dot(panel.position - ray.origin, across) / dot(ray.direction, across);
  if (!(t > 0 && t < kInfinity)) return {};
  const Vec3 off = ray.at(t) - panel.position;
  const Real x = dot(cross(off, panel.v), across), y = dot(cross(panel.u, off), across),
             half = dot(across, across) / 2;
  bool inside = std::abs(x) <= half && std::abs(y) <= half;
  if constexpr (requires { panel.round; })
    if (panel.round) inside = x * x + y * y <= half * half;
  return inside ? std::optional(t) : std::nullopt;
}

}  // namespace trace
