// A World in which lengths can be squared, and areas too: what is beyond that would turn every sum over the
// scene into infinity, and what is below it every density. Such things are left out when the World is made.
#pragma once

#include "base/error.h"
#include "math/transform.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"
#include "shading/material.h"

namespace trace {

/// The longest and the shortest length that is not 0, in world space.
inline constexpr Real kLongest = 1e75, kShortest = 1e-75;

/// Whether an object's transform makes no length that is longer or shorter.
bool isInRange(const Affine& worldFromObject);
/// Whether the box of an object lies in range, as far as it has an end, and is no smaller.
bool isInRange(const Box3& box);
/// Whether the places and sizes of a light do.
bool isInRange(const Light& light);
/// Whether what fills the body is not denser.
bool isInRange(const Material& material);
bool isInRange(const Camera& camera);

/// Objects left out of a World because they are not in range, told in one warning for each kind.
class LeftOut {
 public:
  explicit LeftOut(std::string what) : what_(std::move(what)) {}
  void add(const SourcePlace& place);
  void warn(Messages& messages) const;

 private:
  std::string what_;
  SourcePlace first_;
  int count_ = 0;
};

}  // namespace trace
