// What a ray is inside of, as far as refraction asks.
#pragma once

#include "math/vec.h"

namespace trace {

/// Indices of refraction at a surface: on the ray's side and on the other.
struct Indices {
  Real before = 1, behind = 1;
};

/// The rule of the courses: a ray that leaves a body comes from its inside and goes into the air; any other
/// comes from the air. Bodies inside one another are not known of.
class Interfaces {
 public:
  explicit Interfaces(Real air) : air_(air) {}

  /// At the surface of a body of that index, which the ray leaves or enters.
  Indices at(bool leaving, Real index) const { return leaving ? Indices{index, air_} : Indices{air_, index}; }

 private:
  Real air_;
};

}  // namespace trace
