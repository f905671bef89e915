// Extrusions: a closed outline with holes in the plane z = 0, carried up along z, straight or growing or
// shrinking towards the axis.
//
// In coordinates divided by the scale at its height, a ray runs along a straight line of the outline's plane:
// it crosses an arc where a cubic changes sign. Neighbouring arcs share their ends to the last bit, so that
// along a ray entries and exits take turns.
//
// In a twisted one the ray runs along a curve of the outline's plane, which stays within a disk over a
// stretch of the ray. Where the outline is farther away than that disk reaches, the stretch crosses nothing;
// where it goes towards one arc or away from it all along, the ends of the stretch decide; any other is
// halved.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/shapes/surfaces/profile.h"
#include "geometry/solve/span.h"

namespace trace {

class TracedPrism;

struct Prism {
  static constexpr std::string_view kKeyword = "prism";
  static constexpr std::string_view kHelp = "extrusion along z of a closed outline with holes";

  using Outline = std::vector<std::array<Real, 2>>;
  Outline outline{{-1, -0.7}, {1, -0.8}, {0.6, 0.7}, {-0.5, 0.9}};
  std::vector<Outline> holes;
  Spline spline = Spline::linear;
  Real height = 1, taper = 1, twist = 0;

  static constexpr auto fields() {
    return Fields{
        Field{"outline", &Prism::outline, "", -kNoLimit, kNoLimit, "list of (x, y); closed automatically"},
        Field{"holes", &Prism::holes, "", -kNoLimit, kNoLimit,
              "list of outlines; those within holes are solid again"},
        Field{"spline", &Prism::spline, "", 0, 0, "how the points are joined"},
        Field{"height", &Prism::height, "", 0, kNoLimit, "length along z"},
        Field{"taper", &Prism::taper, "", 0, kNoLimit, "scale of the outline at the top; 0 makes a point"},
        Field{"twist", &Prism::twist, "degrees", -kNoLimit, kNoLimit,
              "rotation of the top around z, counter-clockwise"}};
  }
  bool operator==(const Prism&) const = default;

  std::shared_ptr<const TracedPrism> prepared() const;
};

class TracedPrism {
 public:
  explicit TracedPrism(const Prism& shape);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const {
    return kFirstSide + (static_cast<std::int64_t>(arcs_.size()) << kStepBits);
  }

 private:
  static constexpr int kStepBits = 24;  ///< step bits of a part: where on the arc, roughly
  static constexpr std::int64_t kBottom = 0, kTop = 1, kFirstSide = 2;

  struct Arc {
    Cubic<2> curve;
    std::array<Real, 2> from, to;
    Real outward = 1;                   ///< 1 if outside is to the right
    Real curvature = 0;                 ///< at most
    std::array<Real, 2> low{}, high{};  ///< corners of a box around it
    /// From a place, at least.
    Real distance(const std::array<Real, 2>& p) const {
      const Real x = max(max(low[0] - p[0], p[0] - high[0]), 0),
                 y = max(max(low[1] - p[1], p[1] - high[1]), 0);
      return std::sqrt(x * x + y * y);
    }
  };
  /// The outline's nearest place, and how far all other arcs are at least.
  struct Nearest {
    Real distance = kInfinity, others = kInfinity, u = 0;
    std::size_t arc = 0;
  };
  class Twisted;
  void addLoop(Spline spline, const Prism::Outline& points);
  bool inside(const std::array<Real, 2>& p) const;
  Real scaleAt(Real z) const { return 1 + slope_ * z; }
  /// A point of space brought down to the outline.
  std::array<Real, 2> unfolded(const Vec3& p) const;
  /// Distances beyond `care` are only told to be that large.
  Nearest nearest(const std::array<Real, 2>& p, Real care = kInfinity) const;
  void meetTwisted(const Ray& ray, const Crossing& in, const Crossing& out, const Range& range,
                   const VisitCrossing& visit) const;
  SurfacePoint twistedSide(const Vec3& p) const;
  template <class Visit>
  void meetPlane(const Vec3& normal, Visit&& visit) const;

  std::vector<Arc> arcs_;
  Real height_ = 0, slope_ = 0, turn_ = 0, error_ = 0;  ///< turn_: radians for each unit of z
  Real radius_ = 0;                                     ///< farthest of the outline from the axis, if turned
  Box3 base_, bounds_;                                  ///< base_: of the outline
};

}  // namespace trace
