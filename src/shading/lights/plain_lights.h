// The lights that every program has, for those that make one or ask for one: who needs no more of them is not
// compiled again when one of their structs changes.
#pragma once

#include "shading/lights/light.h"

namespace trace {

/// At distance d a light fades by 1 / (constant + linear d + quadratic d^2).
struct Fading {
  Real constant = 1, linear = 0, quadratic = 0;
};
constexpr Fading kInverseSquare{0, 0, 1};

/// The cone of a spot light: half angles in degrees, of its side and of the part where it does not fade.
struct SpotCone {
  Real angle = 45, fullAngle = 45;
  bool smooth = false;  ///< fades smoothly in the cosine of the angle, not linearly in the angle
  Real exponent = 0;    ///< exponent of the cosine to the axis, a factor on the light
};

/// `extraHighlight` is added to the color in highlights; `radius` is that of the luminous sphere.
Light pointLight(const Vec3& position, const Color& color, const Fading& fading = kInverseSquare,
                 Real radius = 0, const Color& extraHighlight = {});
Light spotLight(const Vec3& position, const Vec3& direction, const Color& color, const SpotCone& cone,
                const Fading& fading = {}, Real radius = 0);
/// `size`: its angular diameter in degrees.
Light directionalLight(const Vec3& direction, const Color& color, Real size = 0);
Light ambientLight(const Color& color);

bool isSpot(const Light& light);
bool isAmbient(const Light& light);

}  // namespace trace
