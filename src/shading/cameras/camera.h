// Cameras: what a scene says, what the options say, and the frame that turns places of the picture into rays.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/vec.h"
#include "math/warp.h"
#include "shading/cameras/aperture.h"

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
    return Fields{
        Field{"position", &Camera::position, "", -kNoLimit, kNoLimit, "the eye"},
        Field{"viewdir", &Camera::viewdir, "", -kNoLimit, kNoLimit, "the viewing direction"},
        Field{"updir", &Camera::updir, "", -kNoLimit, kNoLimit, "the direction that is up"},
        Field{"fov", &Camera::fov, "degrees", 0, 180, "vertical angle of view"},
        Field{"aspectratio", &Camera::aspectratio, "", 0, kNoLimit, "width / height of the picture"},
        Field{"near", &Camera::near, "", 0, kNoLimit,
              "a camera ray whose first surface is nearer shows nothing"},
        Field{"far", &Camera::far, "", 0, kNoLimit, "camera rays end at this distance"}};
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
  Real radius = 0;                            ///< 0: a pinhole
  Real focus = 0;                             ///< distance of that plane along the view; 0 until it is known
  int blades = 0;                             ///< corners of the opening; below 3 it is round
  Real angle = 0;                             ///< angle of its first corner from the right, radians
  std::shared_ptr<const Aperture> picture{};  ///< the opening's shape, if it has one of its own

  bool operator==(const Lens&) const = default;

  /// A place of the opening.
  Vec2 at(const Vec2& u) const {
    const Vec2 place = picture ? picture->at(u) : blades < 3 ? toDisk(u) : toPolygon(u, blades, angle);
    return {place.x * radius, place.y * radius};
  }
};

/// How the directions around the eye become places of the picture.
enum class Projection {
  perspective,   ///< as through a window: straight lines stay straight
  orthographic,  ///< parallel rays: no foreshortening
  fisheye,       ///< the distance from the middle is the angle from the view (equidistant)
  panorama,      ///< all around: across is the azimuth, upward the elevation (equirectangular)
  cylinder,      ///< across is the azimuth; upright lines stay straight
};

/// Where the pictures of two eyes stand in one. From redCyan on they are rendered side by side, and the
/// finished picture shows both in one place, for glasses of two colours (image/development/anaglyph.h).
enum class Stereo { off, sideBySide, crossEyed, overUnder, redCyan, halfColor, grey, dubois };

constexpr bool isAnaglyph(Stereo stereo) { return stereo >= Stereo::redCyan; }

/// How much wider, against its height, what is rendered is than the picture of one eye.
constexpr Real eyesAcross(Stereo stereo) {
  return stereo == Stereo::off ? 1 : stereo == Stereo::overUnder ? 0.5 : 2;
}

/// The properties of the camera that options set, beyond those of the scene.
struct Optics {
  Projection projection = Projection::perspective;
  Real viewHeight = 0;      ///< orthographic; 0: as the perspective at the middle
  Real fisheyeAngle = kPi;  ///< across the shorter side, radians
  Vec2 shift{};  ///< shift of the film, in widths and heights of the picture (as a tilt-shift lens shifts)
  Real distortion = 0;  ///< k of r' = r (1 + k r^2), r = 1 at the upper edge; above 0 it is a barrel
  Real tilt = 0;        ///< tilt of the plane in focus, radians: above 0 its upper half comes nearer
  Lens lens{};
  Stereo stereo = Stereo::off;
  Real eyeSeparation = 0;  ///< 0: a thirtieth of the next
  Real zeroParallax = 0;   ///< distance of what both eyes see in one place; 0: that of the middle
  bool operator==(const Optics&) const = default;
};

/// A scene's camera with its optics, and what follows from them: the way from places of the picture to rays.
/// Places are in [0, 1]^2, (0, 0) at the bottom left. In perspective the ray through (x, y) has the direction
/// look + (x - 0.5) right + (y - 0.5) up, normalised.
struct CameraFrame {
  Vec3 eye, look, right, up;
  Real near = 0, far = kInfinity;
  Optics optics{};
  Vec3 ahead{};       ///< where it looks, of length 1; without the film's shift
  bool plain = true;  ///< perspective of one eye, neither distorted nor tilted

  bool sees(Real distance) const { return near <= distance && distance <= far; }

  Ray ray(const Vec2& place) const { return plain ? pinhole(place) : bent(place, nullptr); }
  /// The ray from the point of the lens that `u` chooses.
  Ray ray(const Vec2& place, const Vec2& u) const {
    if (!plain) return bent(place, &u);
    if (!(optics.lens.radius > 0)) return pinhole(place);
    return through(pinhole(place), u, ahead);
  }

  /// Where ray(place) of a pinhole goes that way; of a ray that looks backward, where its opposite does. With
  /// two eyes, in the picture of one.
  Vec2 placeOf(const Ray& ray) const;
  /// Where a point is seen in the whole picture, by the left of two eyes; nothing if it is behind.
  std::optional<Vec2> placeOf(const Vec3& point) const;

  /// With two eyes: the place of the whole picture that is nearest to `place` in the same eye's as `pixel`.
  Vec2 inEyeOf(const Vec2& pixel, Vec2 place) const;

  /// The distance at which the lens is to be focused for the point to be sharp; not above 0 where it lies
  /// behind a flat picture.
  Real focusOn(const Vec3& point) const;

  /// Something is left to the first surface in the middle of the picture.
  bool wantsMiddle() const;
  /// Tells the distance of that surface.
  void setMiddle(Real distance);

 private:
  struct Path;  // a ray on its way through the parts of the camera

  Ray pinhole(const Vec2& place) const {
    return {eye, normalize(look + right * (place.x - 0.5) + up * (place.y - 0.5))};
  }
  /// From a place of the lens to where the ray through its middle hits the plane in focus.
  Ray through(const Ray& middle, const Vec2& u, const Vec3& normal) const {
    const Lens& lens = optics.lens;
    const Vec2 place = lens.at(u);
    const Vec3 offset = normalize(right) * place.x + normalize(up) * place.y;
    if (lens.focus == kInfinity) return {middle.origin + offset, middle.direction};
    const Vec3 sharp = middle.direction * (lens.focus / dot(middle.direction, normal));
    return {middle.origin + offset, normalize(sharp - offset)};
  }
  Ray bent(const Vec2& place, const Vec2* u) const;
  Path path(const Vec2& fromMiddle) const;
};

/// Precondition: viewdir and updir finite, neither zero nor parallel; 0 < fov < 180.
CameraFrame frame(const Camera& camera, CameraAxes axes, const Optics& optics = {});

}  // namespace trace
