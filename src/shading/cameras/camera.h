// Pinhole cameras: what a scene says, and the frame that turns picture positions into rays.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/vec.h"
#include "math/warp.h"

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

/// A thin lens in place of a pinhole: all rays from one place of the plane in focus meet in one place of the
/// picture (Cook, Porter and Carpenter, Distributed Ray Tracing, 1984).
struct Lens {
  Real radius = 0;  ///< 0: a pinhole
  Real focus = 0;   ///< distance of that plane along the view; 0 until it is known
  int blades = 0;   ///< corners of the opening; below 3 it is round
  Real angle = 0;   ///< of its first corner from the right, radians

  /// A place of the opening.
  Vec2 at(const Vec2& u) const {
    const Vec2 place = blades < 3 ? toDisk(u) : toPolygon(u, blades, angle);
    return {place.x * radius, place.y * radius};
  }
};

/// The ray through film = (x, y) in [0, 1]^2, (0, 0) at the bottom left, has direction look + (x - 0.5) right
/// + (y - 0.5) up, normalised.
struct CameraFrame {
  Vec3 eye, look, right, up;
  Real near = 0, far = kInfinity;
  Lens lens{};
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
  /// The same from the place of the lens that `u` chooses.
  Ray ray(const Vec2& film, const Vec2& u) const {
    const Ray middle = ray(film);
    if (!(lens.radius > 0)) return middle;
    const Vec2 place = lens.at(u);
    const Vec3 offset = normalize(right) * place.x + normalize(up) * place.y;
    if (lens.focus == kInfinity) return {eye + offset, middle.direction};
    const Vec3 sharp = middle.direction * (lens.focus / dot(middle.direction, normalize(look)));
    return {eye + offset, normalize(sharp - offset)};
  }
};

/// Precondition: viewdir and updir finite, neither zero nor parallel; 0 < fov < 180.
CameraFrame frame(const Camera& camera, CameraAxes axes, const Lens& lens = {});

}  // namespace trace
