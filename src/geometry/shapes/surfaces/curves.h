// Many thin cubic curves in one shape: hair, fur, grass, threads. Each is seen as a round tube, or as a flat
// ribbon that faces the ray.
//
// In the plane across the ray a curve is a plane cubic c(u), and the ray is the point 0. The tube around the
// curve is the union of spheres of radius r(u): the ray is inside the sphere at u where
// D(u) = r^2 - |c|^2 > 0, and enters the tube where z(u) - sqrt(D(u)) is least. The ribbon consists of the
// points of the plane nearest the curve, so that the ray meets it where |c| is least, if that is at most r.
// Both are changes of sign.
//
// A strand is an open sheet, and a ray meets the tube only where it enters it. So light that a material
// scatters through a strand leaves it on the other side without a second hit, and other strands cast shadows.
// Nakamaru and Ohno, Ray Tracing for Curves Primitive, WSCG 2002, have the ribbons and the plane across.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "base/field.h"
#include "geometry/ray.h"
#include "geometry/shapes/surfaces/profile.h"

namespace trace {

class TracedCurves;

struct Curves {
  static constexpr std::string_view kKeyword = "curves";
  static constexpr std::string_view kHelp =
      "thin curves, as many as hair has: tubes, or ribbons that face the ray";

  /// Points (x, y, z, width) along a curve.
  using Strand = std::vector<std::array<Real, 4>>;

  std::vector<Strand> strands{
      {{-1, 0, 0, 0.2}, {-0.4, 0.9, 0.2, 0.16}, {0.4, -0.9, 0.2, 0.24}, {1, 0, 0, 0.1}},
      {{-1, -0.6, 0, 0.1}, {-0.3, -0.6, 0.9, 0.2}, {0.3, -0.6, -0.9, 0.2}, {1, -0.6, 0, 0.1}}};
  Spline spline = Spline::bezier;
  bool round = true;

  static constexpr auto fields() {
    return Fields{Field{"strands", &Curves::strands, "", -kNoLimit, kNoLimit,
                        "list of curves, each a list of points (x, y, z, width)"},
                  Field{"spline", &Curves::spline, "", 0, 0, "how the points are joined"},
                  Field{"round", &Curves::round, "", 0, 0, "tubes; off: flat ribbons that face the ray"}};
  }
  bool operator==(const Curves&) const = default;

  /// Throws Error if there are more arcs than can be numbered.
  std::shared_ptr<const TracedCurves> prepared() const;
};

class TracedCurves {
 public:
  static constexpr std::size_t kMostArcs = std::size_t{1} << 28;
  using Strand = Curves::Strand;

  /// Strands of fewer points than an arc needs, or of numbers beyond those of float, are left out.
  TracedCurves(const std::vector<Strand>& strands, Spline spline, bool round);

  bool solid() const { return false; }
  bool strands() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  /// u grows from the root of each strand to its tip; v goes across a ribbon, or around a tube.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const { return partsOf(static_cast<std::int64_t>(arcs_.size())); }
  /// How many parts so many arcs have.
  static std::int64_t partsOf(std::int64_t arcs) { return arcs << kStepBits; }
  /// Points (x, y, z, radius) along at most so many strands, taken evenly from all, for drawings.
  std::vector<Strand> drawn(std::size_t most) const;

 private:
  static constexpr int kStepBits = 24;  ///< step bits of a part: where on the arc, roughly
  struct Across;
  struct Search;

  /// Where the points of an arc begin, and whether it is the first or last of its strand.
  struct Arc {
    std::uint32_t point : 30, begins : 1, ends : 1;
  };
  Cubic<4> cubicOf(std::size_t arc) const;
  void addStrand(const Strand& strand);
  void build();
  SurfacePoint onTube(const Vec3& p, const Vec3& along, const Cubic<4>& curve, Real u) const;
  SurfacePoint onRibbon(const Vec3& p, const Vec3& along, const Cubic<4>& curve, Real u) const;
  Real pathOf(std::size_t arc, Real u) const;

  Spline spline_;
  bool round_;
  std::vector<std::array<float, 4>> points_;  ///< (x, y, z, radius)
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> first_;  ///< first arc of each strand, and the number of arcs
  std::uint32_t pieces_ = 1;          ///< pieces that each arc is divided into, with a box for each
  Bvh bvh_;                           ///< over the pieces
  Box3 bounds_;
  Real error_ = 0;
};

}  // namespace trace
