// Orbit traps (Pickover; Carlson, Two Artistic Orbit Trap Rendering Methods, 1999): how near the points that
// a fractal's repetition visits come to a point, line or plane. Given as texture coordinates, so that any map
// can colour by them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "math/vec.h"

namespace trace {

/// The meaning of a fractal's texture coordinates.
enum class Trap {
  none,   ///< where on a sphere around the middle
  point,  ///< how near the origin its points come
  axis,   ///< ... the axis x
  plane,  ///< ... the plane x = 0
};
constexpr std::array<std::string_view, 4> names(Trap) { return {"none", "point", "axis", "plane"}; }

class OrbitTrap {
 public:
  /// `reach`: a distance beyond which points have escaped.
  OrbitTrap(Trap trap, Real reach) : trap_(trap), reach_(reach) {}  // none: as point

  /// A point visited, by its coordinate along x and its distance from that axis.
  void visit(Real along, Real across) {
    const Real distance = trap_ == Trap::axis    ? across
                          : trap_ == Trap::plane ? std::abs(along)
                                                 : std::sqrt(along * along + across * across);
    if (distance < least_) {
      least_ = distance;
      when_ = count_;
    }
    ++count_;
  }
  /// u: the least distance, from 0 to 1; v: when that was, from the first visit to the last.
  Vec2 uv() const {
    return {std::clamp(least_ / reach_, 0.0, 1.0), count_ > 1 ? static_cast<Real>(when_) / (count_ - 1) : 0};
  }

 private:
  Trap trap_;
  Real reach_, least_ = kInfinity;
  int count_ = 0, when_ = 0;
};

/// The place of an orbit between materials, as the part of a crossing: `face` of a few, and how near the
/// orbit came.
struct TrapPart {
  static constexpr std::int64_t kFaces = 8, kLevels = 1 << 16;
  static constexpr std::int64_t kCount = kFaces * kLevels;

  static std::int64_t part(std::int64_t face, Real u) {
    return face + kFaces * std::llround(std::clamp(u, 0.0, 1.0) * static_cast<Real>(kLevels - 1));
  }
  static std::int64_t face(std::int64_t part) { return part % kFaces; }
  static Real level(std::int64_t part) {
    return static_cast<Real>(part / kFaces) / static_cast<Real>(kLevels - 1);
  }
};

}  // namespace trace
