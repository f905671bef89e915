// The cube [-0.5, 0.5]^3, keyword `box` (Kay and Kajiya's slabs: Glassner, section 2.3).
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "geometry/solve/span.h"

namespace trace {

struct Cube {
  static constexpr std::string_view kKeyword = "box";
  static constexpr std::string_view kHelp = "cube from -0.5 to 0.5 in x, y and z";
  static constexpr auto fields() { return Fields{}; }
  bool operator==(const Cube&) const = default;

  bool solid() const { return true; }
  bool convex() const { return true; }
  Box3 bounds() const { return {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}; }

  /// A part is 2 axis + (0 for the face at -0.5, 1 for the face at +0.5).
  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const auto [in, out] = crossingsOf(bounds(), ray);
    if (in.t <= out.t) {
      visit(in);
      visit(out);
    }
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    const int axis = crossing.part / 2;
    const Real side = crossing.part % 2 ? 1 : -1;
    Vec3 p = ray.at(crossing.t);
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], -0.5, 0.5);
    p[axis] = 0.5 * side;
    Vec3 n;
    n[axis] = side;
    // As in the courses' skeleton: u mirrored on the three faces at -0.5.
    const Real u = p[axis == 0 ? 1 : 0], v = p[axis == 2 ? 1 : 2];
    return {p, abs(p) * gammaError(4), n, n, {0.5 + side * u, 0.5 + v}};
  }
};

}  // namespace trace
