// Signed distances from solids, along a line: what blends are made of. Exact, or of faces and edges that go
// on without limit, where that makes no difference to how a fillet lies; negative inside.
#pragma once

#include "math/along.h"
#include "math/box.h"
#include "math/transform.h"

namespace trace {

/// One of a few solids in its place.
struct DistanceForm {
  enum class Kind {
    ball,       ///< ball of `radius` around the origin
    box,        ///< box of half width `size`, and around it `radius`
    cone,       ///< around z, `radius` at z = 0 and `other` at z = `size.z`; also cylinders
    ring,       ///< around z, `radius` to the middle of its tube of radius `other`
    capsule,    ///< within `radius` of the line from the origin to (0, 0, size.z)
    ellipsoid,  ///< ellipsoid of half width `size`
    below,      ///< z < 0
  };
  Kind kind = Kind::ball;
  Vec3 size;
  Real radius = 0, other = 0;
  Affine formFromWhole;
  Real scale = 1;  ///< what a length in its own space is in that of the whole

  /// A box, in its own space, of all places nearer than `distance`, in lengths of the whole.
  Box3 within(Real distance) const;
  /// At o + t d, a line in its own space.
  template <class T>
  Along<T> along(const Vec3& o, const Vec3& d, const T& t) const;
};

inline Box3 DistanceForm::within(Real distance) const {
  const Real far = distance / scale, end = size.z + far;
  const auto box = [](const Vec3& half) { return Box3{-half, half}; };
  switch (kind) {
    case Kind::ball: return box(Vec3{1, 1, 1} * (radius + far));
    case Kind::box: return box(size + Vec3{1, 1, 1} * (radius + far));
    case Kind::cone: {  // from its side it is far / cos(slope) across the axis
      const Real slope = std::abs(other - radius) / size.z;
      const Real wide = max(radius, other) + far * (slope + std::sqrt(1 + slope * slope));
      return {{-wide, -wide, -far}, {wide, wide, end}};
    }
    case Kind::ring: return box({radius + other + far, radius + other + far, other + far});
    case Kind::capsule: {
      const Real wide = radius + far;
      return {{-wide, -wide, -wide}, {wide, wide, end + radius}};
    }
    case Kind::ellipsoid:  // (f - 1) f / g <= far, and f / g is no less than the least half width
      return box(size * (1 + far / min(size.x, min(size.y, size.z))));
    case Kind::below: break;
  }
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

template <class T>
Along<T> DistanceForm::along(const Vec3& o, const Vec3& d, const T& t) const {
  const Along<T> x{T(o.x) + t * T(d.x), T(d.x)}, y{T(o.y) + t * T(d.y), T(d.y)},
      z{T(o.z) + t * T(d.z), T(d.z)};
  const auto distance = [&]() -> Along<T> {
    switch (kind) {
      case Kind::ball: return lengthOf({x, y, z}) - radius;
      case Kind::box: {
        const Along<T> a = abs(x) - size.x, b = abs(y) - size.y, c = abs(z) - size.z;
        const Along<T> most = max(max(a, b), c);
        // Before a face alone it is that face's, whose slope never is 0 where a ray goes through.
        if (mayBePositive(a) + mayBePositive(b) + mayBePositive(c) <= 1) return most - radius;
        return lengthOf({max(a, 0), max(b, 0), max(c, 0)}) + min(most, Along<T>{T(0), T(0)}) - radius;
      }
      case Kind::cone: {
        const Real slope = (other - radius) / size.z, steep = std::sqrt(1 + slope * slope);
        const Along<T> side = (lengthOf({x, y}) - z * slope - radius) * (1 / steep);
        return max(side, max(-z, z - size.z));
      }
      case Kind::ring: return lengthOf({lengthOf({x, y}) - radius, z}) - other;
      case Kind::capsule: return lengthOf({x, y, max(-z, max(z - size.z, 0))}) - radius;
      case Kind::ellipsoid: {  // no distance, but as steep as one at the surface, where f = 1 and f / g its
                               // slope
        const Along<T> a = x * (1 / size.x), b = y * (1 / size.y), c = z * (1 / size.z);
        const Along<T> f = lengthOf({a, b, c}),
                       g = lengthOf({a * (1 / size.x), b * (1 / size.y), c * (1 / size.z)});
        constexpr Real kMiddle = 0.25;  // within this part of its size the slope is that of a ball
        return (f - 1) * (max(f, kMiddle) / max(g, kMiddle / maxComponent(size)));
      }
      case Kind::below: return z;
    }
    return z;
  };
  return distance() * scale;
}

}  // namespace trace
