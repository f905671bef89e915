#include "render/world/number_range.h"

#include <algorithm>

namespace trace {
namespace {

bool isShortEnough(const Vec3& v) { return maxComponent(abs(v)) <= kLongest; }
bool isLength(Real x) { return x == 0 || (kShortest <= std::abs(x) && std::abs(x) <= kLongest); }
bool isLength(const Vec3& v) { return isShortEnough(v) && isLength(maxComponent(abs(v))); }

}  // namespace

bool isInRange(const Affine& m) {
  for (const int axis : {0, 1, 2})
    if (!isLength(Vec3{m.row[0][axis], m.row[1][axis], m.row[2][axis]})) return false;
  return isShortEnough(m.offset);
}

bool isInRange(const Box3& box) {
  if (box.empty()) return true;
  for (const Vec3& corner : {box.low, box.high})
    for (const int axis : {0, 1, 2})
      if (std::isnan(corner[axis]) || (std::isfinite(corner[axis]) && std::abs(corner[axis]) > kLongest))
        return false;
  return box.unbounded() || isLength(maxComponent(box.size()));
}

bool isInRange(const Light& light) {
  bool inRange = true;
  forEachField(light, [&]<class Value>(const LightField& field, const Value& value) {
    if constexpr (std::is_same_v<Value, Vec3>)
      inRange &= field.keyword == "position" ? isShortEnough(value) : isLength(value);
    else if constexpr (std::is_same_v<Value, Real>)
      inRange &= field.keyword != "radius" || isLength(value);
  });
  return inRange;
}

bool isInRange(const Material& material) {
  const Color does = material.mediumScatters + material.mediumAbsorbs + material.mediumGlows;
  return material.mediumDensity * max(1, maxComponent(does)) <= kLongest;
}

bool isInRange(const Camera& camera) {
  return isShortEnough(camera.position) && isLength(camera.viewdir) && isLength(camera.updir);
}

void LeftOut::add(const SourcePlace& place) {
  if (count_++ == 0) first_ = place;
}

void LeftOut::warn(Messages& messages) const {
  if (count_ == 0) return;
  const std::string more = count_ == 1 ? "" : " (the first of " + std::to_string(count_) + ")";
  messages.warn(first_, what_ + " is left out: its numbers are too large or too small" + more,
                "places are at most 1e75 from the origin, sizes lie between 1e-75 and 1e75");
}

}  // namespace trace
