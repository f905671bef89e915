// What a shape of a .ray file shows to be a mistake, though it can be traced: nothing of it can be seen, its
// corners are the wrong way round, a list is too short for its curve. A new shape needs nothing here.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/ray_findings.h"
#include "geometry/traced.h"

namespace trace::rayfile {

using Tell = std::function<void(std::string what, std::string hint)>;

/// The same number in each kind of curve: 4 for `bezier`, 2 for `linear`.
void checkCurve(const Tell& tell, std::string_view list, std::size_t points, Spline spline, bool closed);
void checkBox(const Tell& tell, const Vec3& low, const Vec3& high);
/// Is the formula a number anywhere between the corners?
void checkFormula(const Tell& tell, const std::string& formula, const Vec3& low, const Vec3& high);
void checkSize(const Tell& tell, std::string_view keyword, const Box3& bounds, bool solid);

/// `form` is what prepare() made of the shape.
template <class S, class Form>
void checkShape(const S& shape, const Form& form, const Tell& tell) {
  if constexpr (
      requires {
        shape.profile;
        shape.spline;
        shape.capped;
      } &&
      !requires { shape.points; })
    checkCurve(tell, "profile", shape.profile.size(), shape.spline, false);
  if constexpr (requires {
                  shape.outline;
                  shape.holes;
                }) {
    checkCurve(tell, "outline", shape.outline.size(), shape.spline, true);
    for (const auto& hole : shape.holes) checkCurve(tell, "a hole", hole.size(), shape.spline, true);
  }
  if constexpr (requires { shape.profileSpline; })
    checkCurve(tell, "profile", shape.profile.size(), shape.profileSpline, shape.closed);
  if constexpr (requires {
                  shape.points.size();
                  shape.spline;
                })
    checkCurve(tell, "points", shape.points.size(), shape.spline, false);
  if constexpr (requires {
                  shape.low;
                  shape.high;
                })
    checkBox(tell, shape.low, shape.high);
  if constexpr (requires {
                  shape.formula;
                  shape.low;
                })
    checkFormula(tell, shape.formula, shape.low, shape.high);
  if constexpr (requires {
                  shape.formula;
                  shape.file;
                })
    if (shape.file.file.empty()) checkFormula(tell, shape.formula, {-1, -1, 0}, {1, 1, 0});
  checkSize(tell, S::kKeyword, formOf(form).bounds(), formOf(form).solid());
}

}  // namespace trace::rayfile
