// Where a light shines and how strongly: what a choice among many lights knows of each
// (render/world/light_tree.h). It may be said to shine where it does not; never the other way round.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/box.h"
#include "math/color.h"
#include "math/vec.h"
#include "shading/rules.h"

namespace trace {

/// The largest of its numbers, whatever their sign.
inline Real strengthOf(const Color& c) { return max(std::abs(c.r), max(std::abs(c.g), std::abs(c.b))); }

struct LightReach {
  Box3 box;            ///< where its light comes from
  Vec3 axis{0, 0, 1};  ///< unit
  Real around = kPi;   ///< so far from the axis it shines at its full strength; radians
  Real beyond = 0;     ///< and so much farther, by the cosine, as a panel does
  bool twoSided = false;
  bool everywhere = false;  ///< it is parallel light along the axis, and has no box
  Real power = 0;           ///< the strength of its colour before it fades; of a panel with its area / pi
  Vec3 fading{0, 0, 1};     ///< a, b, c of 1 / (a + b d + c d^2)
  Real most = kInfinity;    ///< what remains of it is at most that
};

/// The reach of a light that shines to all sides and fades by three coefficients.
template <class L>
LightReach reachOfLamp(const L& light, const Rules& rules) {
  LightReach reach;
  const Vec3 size(light.radius, light.radius, light.radius);
  reach.box.extend(light.position - size);
  reach.box.extend(light.position + size);
  reach.power = strengthOf(light.color);
  reach.fading = {light.constant, light.linear, light.quadratic};
  if (rules.limitAttenuation) reach.most = 1;
  return reach;
}

}  // namespace trace
