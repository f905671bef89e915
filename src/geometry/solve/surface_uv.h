// Texture coordinates of places on surfaces.
#pragma once

#include <algorithm>

#include "math/elementary.h"
#include "math/vec.h"

namespace trace {

/// u and v of a place on a surface, as a rule from 0 to 1. Angles are computed when somebody asks, as few
/// do and they take longer than all else about a place.
class SurfaceUv {
 public:
  constexpr SurfaceUv() = default;
  constexpr SurfaceUv(Real u, Real v) : at_(u, v, 0) {}
  constexpr SurfaceUv(const Vec2& uv) : at_(uv.x, uv.y, 0) {}  // NOLINT(google-explicit-constructor)
  /// u goes around z, from 0 at -x by way of -y to 1.
  static constexpr SurfaceUv around(const Vec3& p, Real v) { return {{p.x, p.y, v}, Kind::around}; }
  /// Texture coordinates by the unit direction d, with v from 0 at -z up to 1; the middle if d is not finite.
  static constexpr SurfaceUv toward(const Vec3& d) { return {d, Kind::toward}; }

  operator Vec2() const {  // NOLINT(google-explicit-constructor)
    if (kind_ == Kind::plain) return {at_.x, at_.y};
    if (kind_ == Kind::around) return {turn(), at_.z};
    if (!isFinite(at_)) return {0.5, 0.5};
    return {turn(), 0.5 + math::asin(std::clamp(at_.z, -1.0, 1.0)) / kPi};
  }

 private:
  enum class Kind { plain, around, toward };
  constexpr SurfaceUv(const Vec3& at, Kind kind) : at_(at), kind_(kind) {}
  Real turn() const { return 0.5 + math::atan2(at_.y, at_.x) / (2 * kPi); }

  Vec3 at_;  ///< plain: u, v; around: x, y, v
  Kind kind_ = Kind::plain;
};

}  // namespace trace
