// Boxes in float for code that goes through many of them. Only for sources that are not compiled once for
// each instruction set: Bounds is the same name for all of them.
#pragma once

#include <limits>

#include "accel/boxed_item.h"
#include "accel/simd.h"

namespace trace {

/// A box in float, x y z and a fourth lane that means nothing. Empty as made.
struct Bounds {
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  simd::Float4 low = simd::Float4::all(kFar), high = simd::Float4::all(-kFar);

  void extend(const Bounds& b) {
    low = min(low, b.low);
    high = max(high, b.high);
  }
  bool inside(const Bounds& b) const { return (lessEqual(b.low, low) & lessEqual(high, b.high) & 7) == 7; }
  float halfArea() const {
    const simd::Float4 size = high - low, products = size * rotate(size);
    return first(products + rotate(products) + rotate(rotate(products)));
  }
};

inline Bounds boxOf(const BoxedItem& item) {
  return {simd::Float4::loadThree(item.low), simd::Float4::loadThree(item.high)};
}
inline Bounds boxOf(const Vec3f& p) {
  const simd::Float4 point = simd::Float4::of(p.x, p.y, p.z);
  return {point, point};
}

inline Box3 box3(const Bounds& box) {
  alignas(16) float low[4], high[4];
  box.low.store(low);
  box.high.store(high);
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

}  // namespace trace
