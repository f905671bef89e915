// Axis-aligned boxes.
#pragma once

#include "math/vec.h"

namespace trace {

/// Empty as made; grows by extend().
struct Box3 {
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high{-kInfinity, -kInfinity, -kInfinity};

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  /// Infinite on some side.
  bool unbounded() const { return !empty() && !(isFinite(low) && isFinite(high)); }
  Vec3 center() const { return low * 0.5 + high * 0.5; }
  Vec3 size() const { return empty() ? Vec3{} : high - low; }
  void extend(const Vec3& p) {
    low = min(low, p);
    high = max(high, p);
  }
  void extend(const Box3& b) {
    low = min(low, b.low);
    high = max(high, b.high);
  }
  bool contains(const Vec3& p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z && p.z <= high.z;
  }
  bool operator==(const Box3&) const = default;
};

inline Real halfArea(const Box3& b) {
  const Vec3 s = b.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

}  // namespace trace
