// What rays meet in place of a shape: the shape itself, or what its prepared() makes of it once.
#pragma once

#include <utility>

#include "base/match.h"
#include "geometry/approach.h"
#include "geometry/shape.h"

namespace trace {

template <class T>
concept Traceable = requires(const T& t, const Ray ray, const Crossing crossing) {
  { t.solid() } -> std::same_as<bool>;
  { t.bounds() } -> std::same_as<Box3>;
  { t.surface(ray, crossing) } -> std::same_as<SurfacePoint>;
};

/// A form may be held by a shared handle.
template <class T>
const T& formOf(const T& form) {
  return form;
}
template <class T>
const T& formOf(const std::shared_ptr<const T>& form) {
  return *form;
}

/// Solids of solids take over the hierarchies of meshes that are `made`.
template <class S>
auto prepare(const S& shape, const MeshTrees& made = {}) {
  if constexpr (requires { shape.prepared(made); })
    return shape.prepared(made);
  else if constexpr (requires { shape.prepared(); })
    return shape.prepared();
  else
    return shape;
}

namespace detail {
template <class Variant>
struct TracedOf;
template <class... S>
struct TracedOf<std::variant<S...>> {
  using type = std::variant<decltype(prepare(std::declval<S>()))...>;
};
}  // namespace detail

/// Alternative i is what alternative i of Shape is traced as. A Mesh stays what it is: whoever traces it
/// keeps its MeshTree.
using TracedShape = detail::TracedOf<Shape>::type;

inline TracedShape prepare(const Shape& shape, const MeshTrees& made = {}) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    TracedShape traced;
    ((shape.index() == I ? void(traced.emplace<I>(prepare(*std::get_if<I>(&shape), made))) : void()), ...);
    return traced;
  }
  (std::make_index_sequence<std::variant_size_v<Shape>>{});
}

/// Is the form searched for, by steps that are as fine as its details? The others are solved in closed form
/// and put the place that is found back on the surface, so that no distance is too far for them.
template <class Traced>
inline constexpr bool kSearched = requires(const Traced& form, const Ray ray, const Range range,
                                           VisitCrossing visit) {
  formOf(form).crossings(ray, range, visit);
}
|| !std::is_same_v<std::remove_cvref_t<decltype(formOf(std::declval<const Traced&>()))>, Traced>;

/// Calls visit(Crossing) for the crossings of the form in the range; of other crossings some may come too.
template <class Form, class Visit>
void visitCrossings(const Form& form, const Ray& ray, const Range& range, Visit&& visit) {
  if constexpr (requires { form.crossings(ray, range, visit); })
    form.crossings(ray, range, visit);
  else
    form.crossings(ray, visit);
}

/// The same for rays that may come from far away. `traced` is an alternative of TracedShape, other than Mesh.
template <class Traced, class Visit>
void visitCrossings(const Traced& traced, const Approach& approach, const Ray& ray, const Range& range,
                    Visit&& visit) {
  if constexpr (kSearched<Traced>) {
    const Real start = approach.start(ray);
    if (start != 0) {
      // One number more than wanted, as t is rounded; nothing where a visit has ended the query.
      const auto last = [&] { return range.to < 0 ? -kInfinity : onward(range.to, 1) - start; };
      Real to = last();
      const auto visitNear = [&](const Crossing& c) { visit(Crossing{start + c.t, c.part}), to = last(); };
      return visitCrossings(formOf(traced), Approach::from(start, ray), Range{range.from - start, to},
                            VisitCrossing(visitNear));
    }
  }
  visitCrossings(formOf(traced), ray, range, visit);
}

/// The place of a crossing that visitCrossings() found with the same approach.
template <class Traced>
SurfacePoint surfaceOf(const Traced& traced, const Approach& approach, const Ray& ray,
                       const Crossing& crossing) {
  if constexpr (kSearched<Traced>) {
    const Real start = approach.start(ray);
    if (start != 0) {
      SurfacePoint s =
          formOf(traced).surface(Approach::from(start, ray), {crossing.t - start, crossing.part});
      s.error += Approach::rounding(start, crossing.t, ray);
      return s;
    }
  }
  return formOf(traced).surface(ray, crossing);
}

}  // namespace trace
