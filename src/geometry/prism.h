// Extrusions: a closed outline with holes in the plane z = 0, carried up along z, straight or growing or
// shrinking towards the axis.
//
// In coordinates divided by the scale at its height, a ray runs along a straight line of the outline's plane:
// it crosses an arc where a cubic changes sign. Neighbouring arcs share their ends to the last bit, so that
// along a ray entries and exits take turns.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/profile.h"
#include "geometry/span.h"

namespace trace {

class TracedPrism;

struct Prism {
  static constexpr std::string_view kKeyword = "prism";
  static constexpr std::string_view kHelp = "extrusion along z of a closed outline with holes";

  using Outline = std::vector<std::array<Real, 2>>;
  Outline outline{{-1, -0.7}, {1, -0.8}, {0.6, 0.7}, {-0.5, 0.9}};
  std::vector<Outline> holes;
  Spline spline = Spline::linear;
  Real height = 1, taper = 1;

  static constexpr auto fields() {
    return std::tuple{
        Field{"outline", &Prism::outline, "", -kNoLimit, kNoLimit, "list of (x, y); it closes by itself"},
        Field{"holes", &Prism::holes, "", -kNoLimit, kNoLimit,
              "list of outlines; those within holes are solid again"},
        Field{"spline", &Prism::spline, "", 0, 0, "how the points are joined"},
        Field{"height", &Prism::height, "", 0, kNoLimit, "length along z"},
        Field{"taper", &Prism::taper, "", 0, kNoLimit, "scale of the outline at the top; 0 makes a point"}};
  }
  bool operator==(const Prism&) const = default;

  std::shared_ptr<const TracedPrism> prepared() const;
};

class TracedPrism {
 public:
  explicit TracedPrism(const Prism& shape);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const {
    return kFirstSide + (static_cast<std::int64_t>(arcs_.size()) << kStepBits);
  }

 private:
  static constexpr int kStepBits = 24;  ///< of a part: where on the arc, roughly
  static constexpr std::int64_t kBottom = 0, kTop = 1, kFirstSide = 2;

  struct Arc {
    Cubic<2> curve;
    std::array<Real, 2> from, to;
    Real outward = 1;  ///< 1 if outside is to the right
  };
  void addLoop(Spline spline, Prism::Outline points);
  bool inside(const std::array<Real, 2>& p) const;
  Real scaleAt(Real z) const { return 1 + slope_ * z; }
  template <class Visit>
  void meetPlane(const Vec3& normal, Visit&& visit) const;

  std::vector<Arc> arcs_;
  Real height_ = 0, slope_ = 0, error_ = 0;
  Box3 base_, bounds_;  ///< base_: of the outline
};

}  // namespace trace
