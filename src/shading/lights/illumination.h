// What arrives of a light at a point.
#pragma once

#include "math/color.h"
#include "math/vec.h"
#include "math/warp.h"
#include "shading/materials/phong.h"
#include "shading/rules.h"

namespace trace {

struct Illumination {
  Vec3 toLight;            ///< unit
  Real distance;           ///< beyond it nothing casts a shadow; infinite for directional lights
  Color color;             ///< of the source
  Real attenuation = 1;    ///< by distance
  Color extraHighlight{};  ///< added to `color` in highlights
  Color intensity() const { return color * attenuation; }
  /// What a surface gives back that scatters so.
  Color scattered(const Scatter& scatter) const {
    return intensity() * scatter.sum() + extraHighlight * attenuation * scatter.specular;
  }
};

/// Of a ball of that radius, `distance` away in the unit direction `toMiddle`, the part that `u` chooses of
/// what is seen; those of its parts are equally likely that cover the same solid angle. From inside it is its
/// middle.
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
