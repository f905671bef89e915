// Surfaces of revolution: a profile turned around z.
//
// The profile is split where it turns up or down. Over such an arc, the ray between the arc's two heights is
// inside where it is nearer to the axis than the profile at its height. Arcs that meet share their ends to
// the last bit, so that along a ray entries and exits take turns, whatever rounding does.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/shapes/surfaces/profile.h"
#include "geometry/solve/span.h"

namespace trace {

class TracedLathe;

struct Lathe {
  static constexpr std::string_view kKeyword = "lathe";
  static constexpr std::string_view kHelp = "surface of revolution: a profile rotated around z";
  static constexpr bool kAlongZ = true;

  std::vector<std::array<Real, 2>> profile{{0.4, 0}, {1.2, 0.3}, {0.1, 0.9}, {0.5, 1.5}};
  Spline spline = Spline::bezier;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"profile", &Lathe::profile, "", -kNoLimit, kNoLimit, "list of (distance from the axis, z)"},
        Field{"spline", &Lathe::spline, "", 0, 0, "how the points are joined"},
        Field{"capped", &Lathe::capped, "", 0, 1,
              "its ends joined to the axis by flat disks; else an open sheet"}};
  }
  bool operator==(const Lathe&) const = default;

  std::shared_ptr<const TracedLathe> prepared() const;
};

class TracedLathe {
 public:
  explicit TracedLathe(const Lathe& shape);

  bool solid() const { return solid_; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

 private:
  /// A part of the profile that only rises or only falls, or is flat.
  struct Arc {
    Cubic<2> curve;
    Real u0, u1;  ///< from where it is lowest to where it is highest
    Real r0, z0, r1, z1;
    Real least, most;  ///< distance from the axis, at least and at most
    int number;        ///< number of the curve, along the profile with its caps
    bool flat() const { return z0 == z1; }
    /// Precondition: not flat. Where the arc is at that height.
    Real at(Real z) const { return at(z, 0.5 * (u0 + u1)); }
    /// ... which is near `guess`.
    Real at(Real z, Real guess) const;
  };
  void add(const Cubic<2>& curve, std::array<Real, 2> from, std::array<Real, 2> to);
  void meetArc(const Arc& arc, std::int64_t number, const Ray& ray, const Span& span, const Range& range,
               VisitCrossing visit) const;

  std::vector<Arc> arcs_;
  int curves_ = 0;
  Box3 bounds_;
  bool solid_ = true;
  Real outward_ = 1;  ///< the sign of the profile's turning, which says on which side is outside
  Real error_ = 0;
};

}  // namespace trace
