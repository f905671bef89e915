#include "formats/ray/read/shape_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/mandelbox.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/surfaces/curves.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/shapes/surfaces/sweep.h"
#include "math/expression.h"

namespace trace::rayfile {
namespace {

/// The same number in each kind of curve: 4 for `bezier`, 2 for `linear`.
void checkCurve(const Tell& tell, std::string_view list, std::size_t points, Spline spline, bool closed) {
  const auto say = [&](const std::string& expected, const std::string& end) {
    tell(std::string(list) + ": expected " + expected + " points for the spline " +
             std::string(names(spline)[static_cast<std::size_t>(spline)]) + ", found " +
             std::to_string(points) + end,
         spline == Spline::bezier ? "spline = linear joins them by lines, spline = catmull by a curve" : "");
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
  if (!axes.empty()) tell("low is above high in " + axes + "; they are swapped there", {});
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

/// Checks lists, whose fields have no range: the number at `index` of each tuple is a length.
template <std::size_t N>
void checkLengths(const Tell& tell, std::string_view list, const std::vector<std::array<Real, N>>& tuples,
                  std::size_t index, std::string_view length) {
  for (const std::array<Real, N>& tuple : tuples)
    if (tuple[index] < 0)
      return tell(std::string(list) + ": expected " + std::string(length) + " of at least 0, found " +
                      toText(tuple[index]) + "; the sign is ignored",
                  {});
}

/// Values that the shape's geometry cannot mean although each is in its range.
void checkMeaning(const Shape& shape, const Tell& tell) {
  if (const auto* sweep = shape.as<SphereSweep>()) checkLengths(tell, "points", sweep->points, 3, "radii");
  if (const auto* curves = shape.as<Curves>())
    for (const Curves::Strand& strand : curves->strands) checkLengths(tell, "strands", strand, 3, "widths");
  if (const auto* lathe = shape.as<Lathe>(); lathe && lathe->spline == Spline::linear)  // others have handles
    checkLengths(tell, "profile", lathe->profile, 0, "distances from the axis");
  if (const auto* metaballs = shape.as<Metaballs>()) {
    checkLengths(tell, "balls", metaballs->balls, 3, "radii");
    checkLengths(tell, "capsules", metaballs->capsules, 6, "radii");
  }
  if (const auto* conic = shape.as<Conic>(); conic && conic->zMin > conic->zMax)
    tell("conic: expected z_min below z_max, found " + toText(conic->zMin) + " and " + toText(conic->zMax) +
             "; it begins at the upper end",
         {});
  if (const auto* disk = shape.as<Disk>();
      disk && disk->innerRadius >= std::abs(disk->radius) && disk->radius != 0)
    tell("disk: nothing of it can be seen, for the hole is as large as the disk", {});
  if (const auto* box = shape.as<Mandelbox>(); box && std::abs(box->scale) < 1.1)
    tell("scale of mandelbox: expected one farther from 0 than 1.1, found " + toText(box->scale) +
             "; it becomes " + (std::signbit(box->scale) ? "-1.1" : "1.1"),
         {});
  if (const auto* box = shape.as<RoundedBox>();
      box && std::abs(box->radius) > std::min({box->size.x, box->size.y, box->size.z}) / 2)
    tell("radius of rounded_box: expected at most half of the least width, found " + toText(box->radius), {});
  if (const auto* julia = shape.as<Julia>();
      julia && std::all_of(julia->normal.begin(), julia->normal.end(), [](Real n) { return n == 0; }))
    tell("normal of julia: expected a direction, found one of length 0; it becomes (0, 0, 0, 1)", {});
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

// --- repairs

/// The courses take the absolute value of a radius, and their cones are never quite cylinders: a slope of
/// less than 0.001 becomes 0.001, widening upward. A cone of height h < 0 reaches from z = 0 down to z = h:
/// it is the mirror image of the cone of height -h, and the mirror goes into the transform.
std::string_view repair(Cone& cone, Affine& worldFromObject) {
  cone.bottomRadius = std::abs(cone.bottomRadius);
  cone.topRadius = std::abs(cone.topRadius);
  if (cone.height < 0) {
    cone.height = -cone.height;
    worldFromObject = worldFromObject * Affine::scaling({1, 1, -1});
  }
  if (cone.height == 0) return "a cone of height 0 is left out";
  if (cone.bottomRadius == 0 && cone.topRadius == 0) return "a cone of radius 0 is left out";
  constexpr Real kLeastSlope = 0.001;
  if (std::abs(cone.topRadius - cone.bottomRadius) < kLeastSlope * cone.height)
    cone.topRadius = cone.bottomRadius + kLeastSlope * cone.height;
  return {};
}

std::string_view repair(const Conic& conic) {
  if (conic.zMin == conic.zMax) return "a conic of height 0 is left out";
  if (conic.bottomRadius == 0 && conic.topRadius == 0) return "a conic of radius 0 is left out";
  return {};
}

}  // namespace

std::string_view repair(Shape& shape, Affine& worldFromObject) {
  if (auto* cone = shape.edit<Cone>()) return repair(*cone, worldFromObject);
  if (const auto* conic = shape.as<Conic>()) return repair(*conic);
  return {};
}

void checkShape(const Shape& shape, const ShapeFacts& facts, const Tell& tell) {
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
  if (const auto* curves = shape.as<Curves>())
    for (const Curves::Strand& strand : curves->strands)
      checkCurve(tell, "a strand", strand.size(), curves->spline, false);
  visitAs<Quadric, Isosurface>(shape, [&](const auto& cut) { checkBox(tell, cut.low, cut.high); });
  if (const auto* surface = shape.as<Isosurface>())
    checkFormula(tell, surface->formula, surface->low, surface->high);
  if (const auto* field = shape.as<HeightField>(); field && field->file.file.empty())
    checkFormula(tell, field->formula, {-1, -1, 0}, {1, 1, 0});
  checkMeaning(shape, tell);
  checkSize(tell, shape.keyword(), facts.bounds, facts.solid);
}

}  // namespace trace::rayfile
