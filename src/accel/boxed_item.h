// The items of a hierarchy.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/box.h"

namespace trace {

/// A box around an item or a part of it; an item may have several. Two of them fill a cache line.
struct alignas(16) BoxedItem {
  float low[3];
  std::uint32_t item;
  float high[3];
  float note = 0;  ///< for whoever makes the item, until the tree is built
};

inline float floatBelow(Real x) {
  const float f = static_cast<float>(x);
  return static_cast<Real>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
inline float floatAbove(Real x) { return -floatBelow(-x); }

/// The box rounded outward.
inline BoxedItem boxedItem(const Box3& box, std::uint32_t item) {
  return {{floatBelow(box.low.x), floatBelow(box.low.y), floatBelow(box.low.z)},
          item,
          {floatAbove(box.high.x), floatAbove(box.high.y), floatAbove(box.high.z)}};
}

}  // namespace trace
