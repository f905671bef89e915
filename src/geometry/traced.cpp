// The crossings and surface points of a shape, whatever its type. They are apart from the table of shapes,
// because this file is compiled for speed.
#include "geometry/traced.h"

#include "base/match.h"
#include "geometry/shape_list.h"

namespace trace {

void TracedShape::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  match(held_->form,
        Overloaded{[](const Mesh&) {},
                   [&](const auto& form) { visitCrossings(form, held_->approach, ray, range, visit); }});
}

SurfacePoint TracedShape::surface(const Ray& ray, const Crossing& crossing) const {
  return match(held_->form,
               Overloaded{[](const Mesh&) { return SurfacePoint{}; },
                          [&](const auto& form) { return surfaceOf(form, held_->approach, ray, crossing); }});
}

}  // namespace trace
