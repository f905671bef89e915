// The light that arrives at a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/color.h"
#include "math/vec.h"
#include "math/warp.h"
#include "shading/materials/phong.h"
#include "shading/rules.h"

namespace trace {

struct Illumination {
  Vec3 toLight;            ///< unit
  Real distance = 0;       ///< beyond it nothing casts a shadow; infinite for directional lights
  Color color;             ///< color of the source
  Real attenuation = 1;    ///< by distance
  Color extraHighlight{};  ///< added to `color` in highlights
  Color intensity() const { return color * attenuation; }
  /// The light reflected by a surface that scatters so.
  Color scattered(const Scatter& scatter) const {
    return intensity() * scatter.sum() + extraHighlight * attenuation * scatter.specular;
  }
};

/// The attenuation, at that distance, of a light that has the three coefficients: 1 / (a + b d + c d^2).
template <class L>
Real faded(const L& light, Real distance, const Rules& rules) {
  const Real attenuation =
      1 / (light.constant + light.linear * distance + light.quadratic * distance * distance);
  return rules.limitAttenuation ? std::min(1.0, attenuation) : attenuation;
}

/// The light that arrives at p from a uniform point at the light's position; nothing at that place itself.
template <class L>
std::optional<Illumination> fromPlace(const L& light, const Vec3& p, const Rules& rules) {
  std::optional<Illumination> arriving;
  const Vec3 d = light.position - p;
  if (const Real l = length(d); l > 0) {
    arriving.emplace();
    arriving->toLight = d / l;
    arriving->distance = l;
    arriving->color = light.color;
    arriving->attenuation = faded(light, l, rules);
  }
  return arriving;
}

/// Where a light is aimed: unit vectors, `up` as nearly upward as it can be.
struct AimFrame {
  Vec3 ahead, right, up;

  AimFrame(const Vec3& direction, const Vec3& upward) : ahead(normalize(direction)) {
    right = cross(ahead, upward);
    const Real l = length(right);
    right = l > 0 ? right / l : perpendicularTo(ahead);
    up = cross(right, ahead);
  }
};

/// Chooses by `u` a part of a ball of that radius, `distance` away in the unit direction `toMiddle`, among
/// those that are seen; parts that cover the same solid angle are equally likely. From inside, its middle is
/// taken.
inline void towardBall(Illumination& to, Real radius, const Vec2& u) {
  if (!(radius > 0) || to.distance <= radius) return;
  const Real sine2 = radius * radius / (to.distance * to.distance);
  const Real cosMost = std::sqrt(1 - sine2);
  const Vec3 toMiddle = to.toLight * to.distance;
  to.toLight = toCone(u, to.toLight, cosMost);
  const Real along = dot(toMiddle, to.toLight), off2 = dot(toMiddle, toMiddle) - along * along;
  to.distance = along - std::sqrt(std::max(0.0, radius * radius - off2));
}

}  // namespace trace
