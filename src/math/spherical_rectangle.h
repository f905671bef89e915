// A rectangle as it is seen from a point (Ureña, Fajardo and King, An Area-Preserving Parametrization for
// Spherical Rectangles, 2013): its solid angle, and places that are spread evenly over that.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/vec.h"

namespace trace {

class SphericalRectangle {
 public:
  /// `a` and `b` are its sides from one corner, at a right angle.
  SphericalRectangle(const Vec3& from, const Vec3& corner, const Vec3& a, const Vec3& b)
      : from_(from), alongA_(normalize(a)), alongB_(normalize(b)), up_(cross(alongA_, alongB_)) {
    const Vec3 to = corner - from;
    z_ = dot(to, up_);
    if (z_ > 0) {
      up_ = -up_;
      z_ = -z_;
    }
    x0_ = dot(to, alongA_);
    x1_ = x0_ + dot(a, alongA_);
    y0_ = dot(to, alongB_);
    y1_ = y0_ + dot(b, alongB_);
    // The planes through the point and the sides: the third coordinates of their unit normals.
    const Side low = side(-y0_), right = side(x1_), high = side(y1_), left = side(-x0_);
    normalLow_ = low.normal;
    normalHigh_ = high.normal;
    const Real first = angles(angle(low, right), angle(right, high));
    before_ = 2 * kPi - angles(angle(high, left), angle(left, low));
    solidAngle_ = first - before_;
  }

  /// To a few units of 1e-16.
  Real solidAngle() const { return solidAngle_; }

  /// By two numbers from 0 up to 1: on the rectangle.
  Vec3 place(const Vec2& u) const {
    const Real turn = before_ + u.x * solidAngle_;
    const Real f = (math::cos(turn) * normalLow_ - normalHigh_) / math::sin(turn);
    const Real c = std::clamp(std::copysign(1 / std::sqrt(f * f + normalLow_ * normalLow_), f), -1.0, 1.0);
    const Real x = std::clamp(-c * z_ / std::sqrt(std::max(1e-300, 1 - c * c)), x0_, x1_);
    const Real away2 = x * x + z_ * z_;
    const Real low = y0_ / std::sqrt(away2 + y0_ * y0_), high = y1_ / std::sqrt(away2 + y1_ * y1_);
    const Real h = low + u.y * (high - low), rest = 1 - h * h;
    const Real y = rest > 0 ? std::clamp(h * std::sqrt(away2 / rest), y0_, y1_) : y1_;
    return from_ + alongA_ * x + alongB_ * y + up_ * z_;
  }

 private:
  /// The plane of a side that far out: a coordinate of its normal, and 1 less the square of that.
  struct Side {
    Real normal, rest;
  };
  Side side(Real out) const {
    const Real all = out * out + z_ * z_;
    return {out / std::sqrt(all), z_ * z_ / all};
  }
  /// The cosine and the sine of the angle between neighbours, the latter without a loss of digits.
  static Vec2 angle(const Side& a, const Side& b) {
    return {-a.normal * b.normal, std::sqrt(a.rest + b.rest - a.rest * b.rest)};
  }
  /// The sum of two angles, from 0 to 2 pi.
  static Real angles(const Vec2& a, const Vec2& b) {
    const Real sum = math::atan2(a.x * b.y + a.y * b.x, a.x * b.x - a.y * b.y);
    return sum < 0 ? sum + 2 * kPi : sum;
  }

  Vec3 from_, alongA_, alongB_, up_;
  Real x0_, x1_, y0_, y1_, z_;
  Real normalLow_, normalHigh_, before_, solidAngle_;
};

}  // namespace trace
