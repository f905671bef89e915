// Questions of a scene to its own objects while it is read: trace(), inside(), min_extent(), max_extent().
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "geometry/shapes/solids/placed.h"
#include "math/box.h"
#include "scene/scene.h"

namespace trace::pov {

class Query {
 public:
  /// Leaves out what cannot be traced.
  explicit Query(const std::vector<Object>& objects);

  /// The first point that a ray meets, and the normal there.
  std::optional<std::pair<Vec3, Vec3>> trace(const Vec3& from, const Vec3& direction) const;
  bool inside(const Vec3& p) const;
  const Box3& bounds() const { return bounds_; }

 private:
  std::vector<Placed> parts_;
  Box3 bounds_;
};

}  // namespace trace::pov
