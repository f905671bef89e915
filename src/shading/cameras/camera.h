// Pinhole cameras: what a scene says, and the frame that turns picture positions into rays.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/vec.h"

namespace trace {

struct Camera {
  static constexpr std::string_view kKeyword = "camera";
  static constexpr std::string_view kHelp = "pinhole camera; by default at the origin, looking along -z";

  Vec3 position;
  Vec3 viewdir{0, 0, -1};
  Vec3 updir{0, 1, 0};
  Real fov = 53.13010235415598;    ///< vertical, degrees: a plane of height 1 at distance 1
  Real aspectratio = 1;            ///< width / height
  Real near = 0, far = kInfinity;  ///< along camera rays: nearer and farther surfaces are not seen

  static constexpr auto fields() {
    return std::tuple{
        Field{"position", &Camera::position, "", -kNoLimit, kNoLimit, "the eye"},
        Field{"viewdir", &Camera::viewdir, "", -kNoLimit, kNoLimit, "where it looks"},
        Field{"updir", &Camera::updir, "", -kNoLimit, kNoLimit, "what is up"},
        Field{"fov", &Camera::fov, "degrees", 0, 180, "vertical angle of view"},
        Field{"aspectratio", &Camera::aspectratio, "", 0, kNoLimit, "width / height of the picture"},
        Field{"near", &Camera::near, "", 0, kNoLimit,
              "a camera ray whose first surface is nearer shows nothing"},
        Field{"far", &Camera::far, "", 0, kNoLimit, "a camera ray sees no farther"}};
  }
  bool operator==(const Camera&) const = default;
};

/// How viewdir and updir become the axes of the picture when they are not orthogonal unit vectors.
enum class CameraAxes {
  orthonormal,  ///< right = up x back, up = back x right, all of length 1
  raw,          ///< as written: lengths stretch the picture, up is not straightened
  normalized,   ///< viewdir and updir of length 1, up not straightened, right not normalised
  skewed,       ///< all three of length 1, up not straightened
};

/// The ray through film = (x, y) in [0, 1]^2, (0, 0) at the bottom left, has direction look + (x - 0.5) right
/// + (y - 0.5) up, normalised.
struct CameraFrame {
  Vec3 eye, look, right, up;
  Real near = 0, far = kInfinity;
  /// The y of the ray of that direction; for one that looks backward, of its opposite.
  Real heightOf(const Vec3& direction) const {
    const Vec3 upward = cross(look, right), forward = cross(right, up);
    return 0.5 + dot(direction, upward) / dot(up, upward) * (dot(look, forward) / dot(direction, forward));
  }
  /// The x of the ray of that direction, in the same way.
  Real acrossOf(const Vec3& direction) const {
    const Vec3 sideways = cross(look, up), forward = cross(right, up);
    return 0.5 +
           dot(direction, sideways) / dot(right, sideways) * (dot(look, forward) / dot(direction, forward));
  }
  bool sees(Real distance) const { return near <= distance && distance <= far; }
  Ray ray(const Vec2& film) const {
    return {eye, normalize(look + right * (film.x - 0.5) + up * (film.y - 0.5))};
  }
};

/// Precondition: viewdir and updir finite, neither zero nor parallel; 0 < fov < 180.
CameraFrame frame(const Camera& camera, CameraAxes axes);

}  // namespace trace
