// The surface where a formula in x, y, z has a given value, within a box: implicit surfaces, distance fields,
// fillets by smoothmin. Found by interval arithmetic, so that nothing is missed, however thin.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"
#include "math/expression.h"

namespace trace {

class TracedIsosurface;

struct Isosurface {
  static constexpr std::string_view kKeyword = "isosurface";
  static constexpr std::string_view kHelp =
      "surface where a formula in x, y, z is 0, solid where it is negative, within a box";

  std::string formula = "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4";
  Vec3 low{-1.2, -1.2, -1.2}, high{1.2, 1.2, 1.2};
  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"formula", &Isosurface::formula, "", 0, 0, "of x, y, z; negative inside"},
                  Field{"low", &Isosurface::low, "", -kNoLimit, kNoLimit, "corner of the box"},
                  Field{"high", &Isosurface::high, "", -kNoLimit, kNoLimit, "opposite corner"},
                  Field{"capped", &Isosurface::capped, "", 0, 1,
                        "closed where it reaches the box; else an open sheet"}};
  }
  bool operator==(const Isosurface&) const = default;

  /// Throws Error if the formula cannot be read.
  std::shared_ptr<const TracedIsosurface> prepared() const;
};

class TracedIsosurface {
 public:
  explicit TracedIsosurface(const Isosurface& shape);

  bool solid() const { return capped_; }
  Box3 bounds() const { return box_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

 private:
  static constexpr std::int64_t kSurface = 6;  ///< part; below: the faces of the box

  Expression formula_;
  Box3 box_;
  bool capped_ = true;
};

}  // namespace trace
