#include "formats/ray_shape_checks.h"

#include <cmath>

#include "base/text.h"
#include "geometry/height_field.h"
#include "geometry/isosurface.h"
#include "geometry/lathe.h"
#include "geometry/prism.h"
#include "geometry/quadric.h"
#include "geometry/sphere_sweep.h"
#include "geometry/sweep.h"
#include "math/expression.h"

namespace trace::rayfile {
namespace {

/// The same number in each kind of curve: 4 for `bezier`, 2 for `linear`.
void checkCurve(const Tell& tell, std::string_view list, std::size_t points, Spline spline, bool closed) {
  const auto say = [&](const std::string& expected, const std::string& end) {
    tell(std::string(list) + ": expected " + expected + " points for the spline " +
             std::string(names(spline)[static_cast<std::size_t>(spline)]) + ", found " +
             std::to_string(points) + end,
         {});
  };
  if (closed && spline != Spline::bezier) {
    if (points < 3) say("at least 3", "");  // what goes over its beginning again has enough
    return;
  }
  const std::size_t least = spline == Spline::linear ? 2 : 4;
  if (points < (closed ? 3 : least)) return say("at least " + std::to_string(closed ? 3 : least), "");
  if (spline != Spline::bezier) return;
  // An arc begins where the one before it ends; a closed curve may leave out its last point, which is the
  // first.
  const std::size_t over = closed && points % 3 == 0 ? 0 : (points - 1) % 3;
  if (over > 0) say("4, 7, 10 or so on", over == 1 ? "; the last is ignored" : "; the last two are ignored");
}

void checkBox(const Tell& tell, const Vec3& low, const Vec3& high) {
  std::string axes;
  for (int axis = 0; axis < 3; ++axis)
    if (low[axis] > high[axis]) axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
  if (!axes.empty()) tell("low is above high in " + axes + "; they change places there", {});
}

/// Is the formula a number anywhere between the corners?
void checkFormula(const Tell& tell, const std::string& formula, const Vec3& low, const Vec3& high) {
  constexpr int kSteps = 7;
  const Expression expression(formula);
  const Vec3 size = high - low;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; k <= (size.z == 0 ? 0 : kSteps); ++k) {
        const Vec3 share{Real(i) / kSteps, Real(j) / kSteps, Real(k) / kSteps};
        const Vec3 place{low.x + share.x * size.x, low.y + share.y * size.y, low.z + share.z * size.z};
        if (std::isfinite(expression.at(place))) return;
      }
  tell("formula: it has no value anywhere, as the logarithm of a negative number or a division by 0",
       "log and / need a number that is not negative, or not 0");
}

void checkSize(const Tell& tell, std::string_view keyword, const Box3& bounds, bool solid) {
  const Vec3 size = bounds.size();
  int flat = 0;
  for (int axis = 0; axis < 3; ++axis) flat += !(size[axis] > 0);
  if (bounds.empty() || flat >= (solid ? 1 : 2))
    tell(
        std::string(keyword) + ": nothing of it can be seen, for it has no " + (solid ? "volume" : "surface"),
        {});
}

}  // namespace

void checkShape(const Shape& shape, const TracedShape& form, const Tell& tell) {
  if (const auto* lathe = shape.as<Lathe>())
    checkCurve(tell, "profile", lathe->profile.size(), lathe->spline, false);
  if (const auto* prism = shape.as<Prism>()) {
    checkCurve(tell, "outline", prism->outline.size(), prism->spline, true);
    for (const auto& hole : prism->holes) checkCurve(tell, "a hole", hole.size(), prism->spline, true);
  }
  if (const auto* sweep = shape.as<Sweep>()) {
    checkCurve(tell, "profile", sweep->profile.size(), sweep->profileSpline, sweep->closed);
    checkCurve(tell, "points", sweep->points.size(), sweep->spline, false);
  }
  if (const auto* sweep = shape.as<SphereSweep>())
    checkCurve(tell, "points", sweep->points.size(), sweep->spline, false);
  visitAs<Quadric, Isosurface>(shape, [&](const auto& cut) { checkBox(tell, cut.low, cut.high); });
  if (const auto* surface = shape.as<Isosurface>())
    checkFormula(tell, surface->formula, surface->low, surface->high);
  if (const auto* field = shape.as<HeightField>(); field && field->file.file.empty())
    checkFormula(tell, field->formula, {-1, -1, 0}, {1, 1, 0});
  checkSize(tell, shape.keyword(), form.bounds(), form.solid());
}

}  // namespace trace::rayfile
