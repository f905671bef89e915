#include "shading/cameras/camera.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

/// Axes at right angles, of length 1, whatever those of the picture are.
struct Axes {
  Vec3 right, up, ahead;
  explicit Axes(const CameraFrame& f)
      : right(normalize(f.right - f.ahead * dot(f.right, f.ahead))),
        up(cross(right, f.ahead)),
        ahead(f.ahead) {
    if (dot(up, f.up) < 0) up = -up;
  }
};

Real aspectOf(const CameraFrame& f) { return length(f.right) / length(f.up); }

/// From the middle, the shorter side from -1 to 1.
Real shorterOf(const CameraFrame& f) { return std::min(aspectOf(f), 1.0) / 2; }

/// By how much a place of the picture is moved outward (Brown 1966, its first term).
Real stretch(const Optics& optics, Real radius) { return 1 + optics.distortion * radius * radius; }

Vec2 distorted(const CameraFrame& f, const Vec2& p) {
  if (f.optics.distortion == 0) return p;
  const Real s = stretch(f.optics, 2 * math::hypot(p.x * aspectOf(f), p.y));
  return {p.x * s, p.y * s};
}

/// The place that distorted() moves there, by Newton's method.
Vec2 undistorted(const CameraFrame& f, const Vec2& p) {
  const Real wanted = 2 * math::hypot(p.x * aspectOf(f), p.y), k = f.optics.distortion;
  if (k == 0 || wanted == 0) return p;
  Real r = wanted;
  for (int i = 0; i < 20; ++i) r -= (r * stretch(f.optics, r) - wanted) / (1 + 3 * k * r * r);
  return {p.x * (r / wanted), p.y * (r / wanted)};
}

/// The part of the picture that is one eye's: which eye, -1 the left and 1 the right, and the place in there.
struct EyePlace {
  Vec2 place;
  int eye = 0;
};

EyePlace eyePlace(Stereo stereo, const Vec2& place) {
  if (stereo == Stereo::off) return {place, 0};
  if (stereo == Stereo::overUnder) {
    const bool upper = place.y >= 0.5;
    return {{place.x, 2 * place.y - upper}, upper ? -1 : 1};
  }
  const bool second = place.x >= 0.5;
  return {{2 * place.x - second, place.y}, second == (stereo != Stereo::crossEyed) ? 1 : -1};
}

}  // namespace

struct CameraFrame::Path {
  Vec3 from, to;  ///< the ray, `to` of length 1
  Vec3 across;    ///< to the right eye
  Vec3 normal;  ///< normal of points at one distance: the planes before the camera, or the spheres around it
};

CameraFrame frame(const Camera& camera, CameraAxes axes, const Optics& optics) {
  Vec3 back = -camera.viewdir, up = camera.updir;
  if (axes == CameraAxes::normalized || axes == CameraAxes::skewed) {
    back = normalize(back);
    up = normalize(up);
  }
  Vec3 right = cross(up, back);
  if (axes == CameraAxes::skewed) right = normalize(right);
  if (axes == CameraAxes::orthonormal) {
    up = normalize(cross(back, right));
    back = normalize(back);
    right = normalize(right);
  }
  const Real height = 2 * math::tan(camera.fov * kPi / 360);
  CameraFrame f{camera.position, -back, right * (height * camera.aspectratio), up * height, camera.near,
                camera.far,      optics};
  f.ahead = normalize(f.look);
  if (f.optics.eyeSeparation == 0) f.optics.eyeSeparation = optics.zeroParallax / 30;
  if (optics.shift != Vec2{}) f.look += f.right * optics.shift.x + f.up * optics.shift.y;
  f.plain = optics.projection == Projection::perspective && optics.distortion == 0 &&
            optics.stereo == Stereo::off && optics.tilt == 0;
  return f;
}

/// Through the middle of the lens of the eye in the middle; the place is from the picture's middle.
CameraFrame::Path CameraFrame::path(const Vec2& p) const {
  const Axes axes(*this);
  switch (optics.projection) {
    case Projection::perspective:
      return {eye, normalize(look + right * p.x + up * p.y), axes.right, axes.ahead};
    case Projection::orthographic: {
      const Real scale = optics.viewHeight / length(up);
      const Vec2 moved{p.x + optics.shift.x, p.y + optics.shift.y};
      return {eye + (right * moved.x + up * moved.y) * scale, axes.ahead, axes.right, axes.ahead};
    }
    case Projection::fisheye: {
      const Real x = p.x * aspectOf(*this), radius = math::hypot(x, p.y);
      const math::SinCos off =
          math::sincos(std::min(radius / shorterOf(*this) * optics.fisheyeAngle / 2, kPi));
      const Vec3 aside = radius > 0 ? (axes.right * x + axes.up * p.y) / radius : axes.right;
      const Vec3 to = normalize(axes.ahead * off.cos + aside * off.sin);
      return {eye, to, axes.right, to};
    }
    case Projection::panorama:
    case Projection::cylinder: break;
  }
  const math::SinCos azimuth = math::sincos(2 * kPi * p.x);
  const Vec3 level = axes.ahead * azimuth.cos + axes.right * azimuth.sin;
  const bool sphere = optics.projection == Projection::panorama;
  const Real upward = sphere ? math::tan(std::clamp(p.y, -0.5, 0.5) * kPi) : p.y * length(up);
  const Vec3 to = normalize(level + axes.up * upward);
  return {eye, to, axes.right * azimuth.cos - axes.ahead * azimuth.sin, to};
}

Ray CameraFrame::bent(const Vec2& picture, const Vec2* u) const {
  const auto [place, side] = eyePlace(optics.stereo, picture);
  Path p = path(distorted(*this, {place.x - 0.5, place.y - 0.5}));
  if (side != 0) {
    const Vec3 offset = p.across * (side * optics.eyeSeparation / 2);
    p.from += offset;
    if (optics.zeroParallax < kInfinity)
      p.to = normalize(p.to * (optics.zeroParallax / dot(p.to, p.normal)) - offset);
  }
  if (!u || !(optics.lens.radius > 0)) return {p.from, p.to};
  if (optics.tilt == 0) return through({p.from, p.to}, *u, p.normal);
  // The plane in focus is turned about the right axis, and still goes through the point in focus straight
  // ahead. Where it lies behind the eye, rays part as if they came from there.
  const Axes axes(*this);
  const Vec3 normal = axes.ahead * math::cos(optics.tilt) + axes.up * math::sin(optics.tilt);
  const Vec2 onLens = optics.lens.at(*u);
  const Vec3 offset = axes.right * onLens.x + axes.up * onLens.y;
  const Real distance = optics.lens.focus == kInfinity
                            ? kInfinity
                            : dot(normal, axes.ahead * optics.lens.focus) / dot(normal, p.to);
  if (!std::isfinite(distance)) return {p.from + offset, p.to};
  const Vec3 sharp = p.to * distance - offset;
  return {p.from + offset, normalize(distance < 0 ? -sharp : sharp)};
}

Vec2 CameraFrame::placeOf(const Ray& ray) const {
  const Axes axes(*this);
  const Vec3& d = ray.direction;
  const Real x = dot(d, axes.right), y = dot(d, axes.up), z = dot(d, axes.ahead);
  switch (optics.projection) {
    case Projection::perspective: {
      const Vec3 upward = cross(look, right), sideways = cross(look, up), forward = cross(right, up);
      const Real away = dot(look, forward) / dot(d, forward);
      const Vec2 p{dot(d, sideways) / dot(right, sideways) * away, dot(d, upward) / dot(up, upward) * away};
      if (optics.distortion == 0) return {0.5 + p.x, 0.5 + p.y};
      const Vec2 place = undistorted(*this, p);
      return {0.5 + place.x, 0.5 + place.y};
    }
    case Projection::orthographic: {
      const Real scale = optics.viewHeight / length(up);
      const Real distance = optics.stereo != Stereo::off ? optics.zeroParallax : optics.lens.focus;
      const Vec3 meets = ray.origin - eye + (distance < kInfinity ? d * (distance / z) : Vec3{});
      const Vec2 p{dot(meets, axes.right) / (length(right) * scale) - optics.shift.x,
                   dot(meets, axes.up) / (length(up) * scale) - optics.shift.y};
      const Vec2 place = undistorted(*this, p);
      return {0.5 + place.x, 0.5 + place.y};
    }
    case Projection::fisheye: {
      const Real aside = math::hypot(x, y), angle = math::atan2(aside, z);
      const Real radius = aside > 0 ? angle / (optics.fisheyeAngle / 2) * shorterOf(*this) / aside : 0;
      const Vec2 place = undistorted(*this, {x * radius / aspectOf(*this), y * radius});
      return {0.5 + place.x, 0.5 + place.y};
    }
    case Projection::panorama:
    case Projection::cylinder: break;
  }
  const Real level = math::hypot(x, z);
  const bool sphere = optics.projection == Projection::panorama;
  const Vec2 place = undistorted(
      *this, {math::atan2(x, z) / (2 * kPi), sphere ? math::atan2(y, level) / kPi : y / level / length(up)});
  return {0.5 + place.x, 0.5 + place.y};
}

std::optional<Vec2> CameraFrame::placeOf(const Vec3& point) const {
  const bool parallel = optics.projection == Projection::orthographic;
  const bool flat = parallel || optics.projection == Projection::perspective;
  if (flat && !(dot(point - eye, ahead) > 0)) return std::nullopt;
  CameraFrame single = *this;
  single.optics.stereo = Stereo::off;
  single.optics.lens.focus = kInfinity;
  const Vec2 middle = single.placeOf(parallel ? Ray{point, ahead} : Ray{eye, normalize(point - eye)});
  if (optics.stereo == Stereo::off) return middle;
  // Which way the left eye lies depends, in a panorama, on the place: better and better ones.
  Vec2 left = middle;
  for (int i = 0; i < 30; ++i) {
    const Path seen = single.path(distorted(*this, {left.x - 0.5, left.y - 0.5}));
    const Vec3 offset = seen.across * (-optics.eyeSeparation / 2);
    const auto atZero = [&](const Vec3& to) {  // on the plane, or the sphere, that both eyes see alike
      const Real along = dot(offset, to), z = optics.zeroParallax;
      return to *
             (flat ? z / dot(to, ahead) : std::sqrt(along * along - dot(offset, offset) + z * z) - along);
    };
    const bool converges = optics.zeroParallax < kInfinity;
    if (parallel) {
      const Vec3 to = converges ? atZero(ahead) - offset : ahead;
      const Vec3 from = point - to * (dot(point - eye, ahead) / dot(to, ahead)) - offset;
      left = single.placeOf(Ray{from, ahead});
    } else {
      const Vec3 to = normalize(point - eye - offset);
      left = single.placeOf(Ray{eye, converges ? normalize(offset + atZero(to)) : to});
    }
  }
  if (optics.stereo == Stereo::overUnder) return Vec2{left.x, 0.5 + left.y / 2};
  return Vec2{(optics.stereo == Stereo::crossEyed ? 0.5 : 0) + left.x / 2, left.y};
}

Vec2 CameraFrame::inEyeOf(const Vec2& pixel, Vec2 place) const {
  if (optics.stereo == Stereo::off) return place;
  constexpr Real kUnder = 0.5 - 0x1p-53;
  Real Vec2::*side = optics.stereo == Stereo::overUnder ? &Vec2::y : &Vec2::x;
  place.*side = pixel.*side < 0.5 ? std::min(place.*side, kUnder) : std::max(place.*side, 0.5);
  return place;
}

Real CameraFrame::focusOn(const Vec3& point) const {
  const bool flat =
      optics.projection == Projection::perspective || optics.projection == Projection::orthographic;
  if (!flat && optics.tilt == 0) return length(point - eye);
  const Axes axes(*this);
  const Vec3 normal = axes.ahead * math::cos(optics.tilt) + axes.up * math::sin(optics.tilt);
  return dot(normal, point - eye) / dot(normal, axes.ahead);
}

bool CameraFrame::wantsMiddle() const {
  return (optics.lens.radius > 0 && optics.lens.focus == 0) ||
         (optics.projection == Projection::orthographic && optics.viewHeight == 0) ||
         (optics.stereo != Stereo::off && optics.zeroParallax == 0);
}

void CameraFrame::setMiddle(Real distance) {
  if (optics.lens.focus == 0) optics.lens.focus = distance;
  const Real known = distance < kInfinity ? distance : 1;
  if (optics.viewHeight == 0) optics.viewHeight = known * length(up);
  if (optics.zeroParallax == 0) optics.zeroParallax = known;
  if (optics.eyeSeparation == 0) optics.eyeSeparation = optics.zeroParallax / 30;
}

}  // namespace trace
