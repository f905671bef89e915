// A sphere carried along a curve while its radius changes: hoses, necks, letters, roots.
//
// The ray's line is inside the sphere at u from t-(u) to t+(u), where D(u), a polynomial, is not negative.
// Each interval of such u is one stretch of the line inside the sweep, from the least t- to the greatest t+;
// these lie where a polynomial of degree ten changes sign. Stretches that overlap are one. So the sweep is
// the union of its spheres, with nothing inside, by construction.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/ray.h"
#include "geometry/shapes/surfaces/profile.h"
#include "geometry/solve/line_tree.h"

namespace trace {

class TracedSweep;

struct SphereSweep {
  static constexpr std::string_view kKeyword = "sphere_sweep";
  static constexpr std::string_view kHelp = "sphere of varying radius moved along a curve";

  std::vector<std::array<Real, 4>> points{
      {-1, 0, 0, 0.25}, {-0.3, 0.5, 0.2, 0.15}, {0.3, -0.5, 0.2, 0.35}, {1, 0, 0, 0.2}};
  Spline spline = Spline::bezier;

  static constexpr auto fields() {
    return Fields{Field{"points", &SphereSweep::points, "", -kNoLimit, kNoLimit, "list of (x, y, z, radius)"},
                  Field{"spline", &SphereSweep::spline, "", 0, 0, "how the points are joined"}};
  }
  bool operator==(const SphereSweep&) const = default;

  std::shared_ptr<const TracedSweep> prepared() const;
};

class TracedSweep {
 public:
  /// (x, y, z, radius) along each curve.
  explicit TracedSweep(const std::vector<Cubic<4>>& curves);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const { return static_cast<std::int64_t>(arcs_.size()) << kStepBits; }

 private:
  static constexpr int kStepBits = 24;  ///< step bits of a part: where on the arc, roughly

  struct Arc {
    Cubic<4> curve;
    Vec3 across;  ///< from which the angle around the path counts, at the beginning
    Vec3 at(Real u) const { return {curve.at(0, u), curve.at(1, u), curve.at(2, u)}; }
    Vec3 slope(Real u) const { return {curve.slope(0, u), curve.slope(1, u), curve.slope(2, u)}; }
    Real radius(Real u) const { return std::abs(curve.at(3, u)); }
  };
  struct Reach;

  std::vector<Arc> arcs_;
  LineTree tree_;
  Box3 bounds_;
  Real error_ = 0;
};

}  // namespace trace
