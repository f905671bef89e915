// Measured intensities of a lamp by direction, as files of IES LM-63 have them: on a grid of angles, between
// which they are interpolated linearly.
//
// In the three systems of angles (LM-63-2002; CIE 121 calls them C, B and A planes):
//   type C  the polar axis is where the lamp is aimed: vertical angles are measured from it, horizontal ones
//           around it
//   type A  the polar axis is upward: horizontal angles turn around it, vertical ones are above the horizon
//   type B  the polar axis is to the side: vertical angles turn around it, horizontal ones lean to it
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "math/vec.h"

namespace trace {

class Photometry {
 public:
  enum class Type { c = 1, b = 2, a = 3 };
  /// `candelas` are those of all vertical angles for the first horizontal one, then for the next. Angles
  /// ascend, in degrees; where they cover a half or a quarter of all, the rest is its mirror image.
  /// Precondition: neither list is empty.
  Photometry(Type type, std::vector<Real> vertical, std::vector<Real> horizontal, std::vector<Real> candelas);

  /// Candelas in a unit direction: z is where the lamp is aimed, x where the horizontal angle is 0 (types A
  /// and B: upward), y where it is 90 degrees (types A and B: to the left, as the lamp looks).
  Real at(const Vec3& direction) const;
  Real brightest() const { return brightest_; }
  /// The largest angle to z at which it may shine, radians.
  Real widest() const { return widest_; }
  /// The total power, by quadrature: candelas over the sphere.
  Real lumens() const { return lumens_; }

 private:
  Real atAngles(Real vertical, Real horizontal) const;
  /// The angle in the list that stands for this one.
  Real folded(Real horizontal) const;

  Type type_;
  std::vector<Real> vertical_, horizontal_, candelas_;
  Real brightest_ = 0, widest_ = kPi, lumens_ = 0;
};

/// The contents of a file of that name, behind a shared const handle; null until it is read (formats/ies.h).
struct PhotometryFile {
  std::string file;  ///< as the scene names it
  std::shared_ptr<const Photometry> data;
  SourcePlace place;  ///< where the scene names it
  bool operator==(const PhotometryFile& other) const { return file == other.file; }
};

}  // namespace trace
