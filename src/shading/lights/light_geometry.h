// Where the rays of a light start, for paths and photons that begin there.
#pragma once

#include <optional>

#include "math/vec.h"

namespace trace {

/// The origin of a light's rays.
enum class LightOrigin {
  none,     ///< ambient light, and a portal, through which the rays of others come in
  ball,     ///< a point, or the ball around it if the light has a radius; the light fades with the distance
  panel,    ///< a rectangle or the ellipse in it, by the cosine
  parallel  ///< infinitely far away
};

/// The directions into which a light emits.
struct LightCone {
  Vec3 axis;    ///< unit
  Real angle;   ///< half angle, degrees
  Real cosine;  ///< its cosine
};

/// Numbers that a light's origin does not have are 0.
struct LightGeometry {
  LightOrigin starts = LightOrigin::none;
  Vec3 position{};  ///< middle of a ball, of a panel or of a portal
  Real radius = 0;  ///< radius of a ball; 0: a point
  Vec3 u{}, v{};    ///< edges of a panel or of a portal
  bool round = false, twoSided = false;
  std::optional<LightCone> cone{};  ///< none: a ball emits into all directions
};

}  // namespace trace
