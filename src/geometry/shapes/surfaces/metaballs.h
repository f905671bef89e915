// Metaballs (Blinn, A Generalization of Algebraic Surface Drawing, 1982), with the bounded field of the
// Wyvills in squared distance: each component adds strength (1 - (distance / radius)^2)^2 within its radius;
// the surface is where the sum is the threshold. Components are balls and capsules; negative ones push away.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/ray.h"
#include "geometry/solve/line_tree.h"

namespace trace {

class TracedMetaballs;

struct Metaballs {
  static constexpr std::string_view kKeyword = "metaballs";
  static constexpr std::string_view kHelp =
      "blobs: an isosurface of the sum of the fields of balls and capsules";

  Real threshold = 0.5;
  std::vector<std::array<Real, 5>> balls{{-0.5, 0, 0, 1, 1}, {0.5, 0, 0, 1, 1}};
  std::vector<std::array<Real, 8>> capsules;

  static constexpr auto fields() {
    return Fields{
        Field{"threshold", &Metaballs::threshold, "", 0, kNoLimit, "the sum of the fields on the surface"},
        Field{"balls", &Metaballs::balls, "", -kNoLimit, kNoLimit, "list of (x, y, z, radius, strength)"},
        Field{"capsules", &Metaballs::capsules, "", -kNoLimit, kNoLimit,
              "list of (x, y, z, x, y, z, radius, strength), around the line between two points"}};
  }
  bool operator==(const Metaballs&) const = default;

  std::shared_ptr<const TracedMetaballs> prepared() const;
};

/// Their traced form. Along a ray the sum is, between the places where components begin and end, a
/// polynomial of degree four, whose extrema say where to look.
class TracedMetaballs {
 public:
  explicit TracedMetaballs(const Metaballs& shape);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

 private:
  struct Component {
    Vec3 from, axis;  ///< axis: to the other end; zero for a ball
    Real radius, strength, axisSquare;
    /// The nearest point of the segment.
    Vec3 nearest(const Vec3& p) const;
  };
  struct Piece;

  std::vector<Component> components_;
  LineTree tree_;
  Box3 bounds_;
  Real threshold_ = 0, curvature_ = 0;  ///< curvature_: at most the second derivative of the sum
};

}  // namespace trace
