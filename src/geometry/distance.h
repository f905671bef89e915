// Signed distances from solids, along a line: what blends are made of. Exact, or of faces and edges that go
// on for ever, where that makes no difference to how a fillet lies; negative inside.
#pragma once

#include "math/along.h"
#include "math/transform.h"

namespace trace {

/// One of a few solids in its place.
struct DistanceForm {
  enum class Kind {
    ball,       ///< of `radius` around the origin
    box,        ///< of half width `size`, and around it `radius`
    cone,       ///< around z, `radius` at z = 0 and `other` at z = `size.z`; also cylinders
    ring,       ///< around z, `radius` to the middle of its tube of radius `other`
    capsule,    ///< within `radius` of the line from the origin to (0, 0, size.z)
    ellipsoid,  ///< of half width `size`
    below,      ///< z < 0
  };
  Kind kind = Kind::ball;
  Vec3 size;
  Real radius = 0, other = 0;
  Affine formFromWhole;
  Real scale = 1;  ///< what a length in its own space is in that of the whole

  /// At o + t d, a line in its own space.
  template <class T>
  Along<T> along(const Vec3& o, const Vec3& d, const T& t) const;
};

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
