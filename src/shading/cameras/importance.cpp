#include "shading/cameras/importance.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

Real cubed(Real x) { return x * x * x; }

}  // namespace

CameraImportance::CameraImportance(const CameraFrame& frame) : frame_(frame) {
  const Optics& o = frame.optics;
  const bool bent = o.distortion != 0 || o.stereo != Stereo::off || o.tilt != 0;
  known_ = !bent && (o.projection == Projection::perspective || !(o.lens.radius > 0));
  right_ = normalize(frame.right - frame.ahead * dot(frame.right, frame.ahead));
  up_ = cross(right_, frame.ahead);
  if (dot(up_, frame.up) < 0) up_ = -up_;
}

Vec3 CameraImportance::sharp(const Ray& ray) const {
  const Real focus = frame_.optics.lens.focus;
  if (!hasLens() || focus == kInfinity) return ray.direction;
  const Vec3 offset = ray.origin - frame_.eye;
  return offset + ray.direction * ((focus - dot(offset, frame_.ahead)) / dot(ray.direction, frame_.ahead));
}

Real CameraImportance::density(const Ray& ray) const {
  const Optics& optics = frame_.optics;
  const Vec3& d = ray.direction;
  const Real wide = length(frame_.right), high = length(frame_.up);
  switch (optics.projection) {
    case Projection::perspective: {
      const Vec3 to = sharp(ray), normal = cross(frame_.right, frame_.up);
      const Vec3 onFilm = to * (dot(frame_.look, normal) / dot(to, normal));
      const Real fromEye = cubed(length(onFilm)) / std::abs(dot(onFilm, normal));
      if (!hasLens() || optics.lens.focus == kInfinity) return fromEye;
      const Vec3 fromLens = to - (ray.origin - frame_.eye);
      return fromEye * (dot(to, frame_.ahead) / cubed(length(to))) *
             (cubed(length(fromLens)) / dot(fromLens, frame_.ahead));
    }
    case Projection::orthographic: {
      const Real scale = optics.viewHeight / high;
      return 1 / (wide * high * scale * scale);
    }
    case Projection::fisheye: {
      const Real across = dot(d, right_), upward = dot(d, up_);
      const Real sine = math::hypot(across, upward), angle = math::atan2(sine, dot(d, frame_.ahead));
      const Real shorter = std::min(wide / high, 1.0) / 2, perAngle = 2 * shorter / optics.fisheyeAngle;
      return (sine > 0 ? angle / sine : 1) * perAngle * perAngle * high / wide;
    }
    case Projection::panorama: {
      const Real upward = dot(d, up_);
      return 1 / (2 * kPi * kPi * std::sqrt(std::max(0.0, 1 - upward * upward)));
    }
    case Projection::cylinder: break;
  }
  const Real upward = dot(d, up_);
  return 1 / (2 * kPi * high * cubed(std::sqrt(std::max(0.0, 1 - upward * upward))));
}

std::optional<CameraImportance::Seen> CameraImportance::sees(const Vec3& point, const Vec2& u) const {
  const Vec3 to = point - frame_.eye;
  const bool flat = parallel() || frame_.optics.projection == Projection::perspective;
  if (flat && !(dot(to, frame_.ahead) > 0)) return {};
  if (parallel()) {
    const Real distance = dot(to, frame_.ahead);
    const Ray ray{point - frame_.ahead * distance, frame_.ahead};
    CameraFrame frame = frame_;
    frame.optics.lens.focus = kInfinity;
    return Seen{ray, frame.placeOf(ray), distance};
  }
  Vec3 from = frame_.eye;
  if (hasLens()) {
    const Vec2 place = frame_.optics.lens.at(u);
    from += normalize(frame_.right) * place.x + normalize(frame_.up) * place.y;
  }
  const Real distance = length(point - from);
  if (!(distance > 0)) return {};
  const Ray ray{from, (point - from) / distance};
  if (flat && !(dot(ray.direction, frame_.ahead) > 0)) return {};
  return Seen{ray, frame_.placeOf(Ray{frame_.eye, normalize(sharp(ray))}), distance};
}

}  // namespace trace
