// Bicubic Bezier patches, as of the Utah teapot: open sheets. A patch is never made triangles of: where a ray
// meets it is a common root of two polynomials in (u, v), found by halving until one root at most is left,
// which the convex hulls of the polynomials and of their derivatives tell.
//
// Sources: Kajiya, Ray Tracing Parametric Patches, 1982 (two planes); Toth, On Ray Tracing Parametric
// Surfaces, 1985 (where Newton's steps are safe).
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/ray.h"
#include "geometry/solve/line_tree.h"

namespace trace {

class TracedPatches;

struct BezierPatches {
  static constexpr std::string_view kKeyword = "bezier_patches";
  static constexpr std::string_view kHelp = "bicubic Bezier patches, each of 16 points";

  /// Four rows of four points (x, y, z); v goes from row to row.
  using Points = std::vector<std::array<Real, 3>>;
  std::vector<Points> patches{{{-1, -1, 0},
                               {-0.3, -1, 0.8},
                               {0.3, -1, -0.8},
                               {1, -1, 0},
                               {-1, -0.3, 0.6},
                               {-0.3, -0.3, 1},
                               {0.3, -0.3, -0.4},
                               {1, -0.3, 0.6},
                               {-1, 0.3, -0.6},
                               {-0.3, 0.3, 0.4},
                               {0.3, 0.3, -1},
                               {1, 0.3, 0.6},
                               {-1, 1, 0},
                               {-0.3, 1, 0.8},
                               {0.3, 1, -0.8},
                               {1, 1, 0}}};

  static constexpr auto fields() {
    return Fields{Field{"patches", &BezierPatches::patches, "", -kNoLimit, kNoLimit,
                        "list of patches, each a list of 16 points (x, y, z): four rows of four"}};
  }
  bool operator==(const BezierPatches&) const = default;

  /// Throws Error if a patch has not 16 points.
  std::shared_ptr<const TracedPatches> prepared() const;
};

class TracedPatches {
 public:
  using Patch = std::array<Vec3, 16>;
  explicit TracedPatches(std::vector<Patch> patches);

  bool solid() const { return false; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, VisitCrossing visit) const;
  /// u and v are those of the patch; the normal is turned to the ray.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  /// As surface(), but the normal is that of the patch: along u across along v.
  SurfacePoint place(const Ray& ray, const Crossing& crossing) const;
  /// The patch of a part, and whether the part lies on an edge of that patch.
  static std::size_t patchOf(std::int64_t part) { return static_cast<std::size_t>(part >> (2 * kStepBits)); }
  static bool onEdge(std::int64_t part);
  std::int64_t partCount() const { return static_cast<std::int64_t>(patches_.size()) << (2 * kStepBits); }

 private:
  static constexpr int kStepBits = 20;  ///< step bits of a part: where on the patch, roughly, in u and in v

  std::vector<Patch> patches_;
  LineTree tree_;
  Box3 bounds_;
  Real error_ = 0;
};

}  // namespace trace
