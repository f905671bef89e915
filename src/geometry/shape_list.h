// THE list of shapes. A new shape is one header and one line here; readers, writers, the reference page
// and the generic tests loop over the table that shape_table.cpp makes of the list.
//
// Only that file, traced.cpp and render/world/world_queries.cpp include this one: everyone else sees a Shape
// (shape.h) or what rays hit of it (traced.h), whatever its type, and is not compiled again when a shape
// changes.
//
// Every shape but Mesh answers, in its own space:
//   solid()             does it enclose space? (an open sheet is seen from both sides)
//   bounds()            a box that holds it, infinite if the shape is
//   crossings(ray, f)   f(Crossing) for every place, in any order and at any t, where the ray's line goes
//                       through the surface; for solids, entries and exits come in pairs, of which one may
//                       lie at infinity
//   surface(ray, c)     the point, put back on the surface, with error bounds, normal and uv
//
// A shape may add
//   kAlongZ             its axis is z, as that of a cone: a new one is turned upright
//   convex()            a ray that leaves it on the side of its normal does not hit it again
//   strands()           rays meet its parts only where they enter these: light through a part leaves it
//                       without another hit, and the parts shade one another
//
// A shape of several materials adds
//   material(part, own)        the MaterialMix of a crossing; `own` is that of the whole
//   addMaterials(all)          the indices it may answer with beside that
// and, where its inside is of another material than its surface there,
//   inside(part, own)          that of the inside
//
// A shape that has to be computed before it is traced (coefficients, hierarchies, children) has instead
//   prepared()          what rays hit in its place, or a shared handle to it: something with the four above.
// prepare() asks for it once. Where that takes long, it adds
//   checked()           its ShapeFacts, found without; throws what prepared() throws
// What is costly to find everywhere may take the wanted part of the line:
//   crossings(ray, range, f)   as above, but only those in the Range need be visited; nearest first
#pragma once

#include <concepts>
#include <memory>
#include <utility>
#include <variant>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/mandelbox.h"
#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/fractals/menger.h"
#include "geometry/shapes/fractals/plant.h"
#include "geometry/shapes/solids/blend.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/copies.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/supertoroid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/curves.h"
#include "geometry/shapes/surfaces/fur.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/puff.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/shapes/surfaces/sweep.h"
#include "geometry/shapes/surfaces/terrain.h"
#include "geometry/solve/approach.h"
#include "geometry/traced.h"

namespace trace {

using ShapeList =
    std::variant<Sphere, Cube, Square, Cylinder, Cone, Conic, Plane, Disk, RoundedBox, Torus, Ellipsoid,
                 EllipticCone, Paraboloid, Hyperboloid, TwoSheets, Quadric, Superellipsoid, Supertoroid,
                 Lathe, Prism, SphereSweep, Sweep, Curves, Fur, Plant, BezierPatches, HeightField, Terrain,
                 Metaballs, Isosurface, Menger, Sierpinski, Ifs, Julia, Mandelbulb, Mandelbox, Union,
                 Intersection, Difference, Clip, Blend, Puff, Mesh>;

template <class T>
concept Traceable = requires(const T& t, const Ray ray, const Crossing crossing) {
  { t.solid() } -> std::same_as<bool>;
  { t.bounds() } -> std::same_as<Box3>;
  { t.surface(ray, crossing) } -> std::same_as<SurfacePoint>;
};

/// The form that rays intersect in place of a shape: the shape itself, or what its prepared() makes of it.
/// Solids of solids take over the hierarchies of meshes that are `made`.
template <class S>
auto formFor(const S& shape, const MeshTrees& made = {}) {
  if constexpr (requires { shape.prepared(made); })
    return shape.prepared(made);
  else if constexpr (requires { shape.prepared(); })
    return shape.prepared();
  else
    return shape;
}

/// A form may be held by a shared handle.
template <class T>
const T& formOf(const T& form) {
  return form;
}
template <class T>
const T& formOf(const std::shared_ptr<const T>& form) {
  return *form;
}

namespace detail {
template <class Variant>
struct FormsOf;
template <class... S>
struct FormsOf<std::variant<S...>> {
  using type = std::variant<decltype(formFor(std::declval<S>()))...>;
};
}  // namespace detail

/// Alternative i is what alternative i of the list is traced as. A Mesh stays what it is: whoever traces it
/// keeps its MeshTree.
using AnyForm = detail::FormsOf<ShapeList>::type;

/// The contents of a TracedShape.
struct TracedShape::Held {
  AnyForm form;
  Approach approach;
};

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

/// Crossings for rays that may come from far away. `traced` is an alternative of AnyForm, other than Mesh.
template <class Traced, class Visit>
void visitCrossings(const Traced& traced, const Approach& approach, const Ray& ray, const Range& range,
                    Visit&& visit) {
  if constexpr (kSearched<Traced>) {
    const Real start = approach.start(ray);
    if (start != 0) {
      // One number more than wanted, as t is rounded; nothing where a visit has ended the query.
      const auto last = [&] { return range.to < 0 ? -kInfinity : onward(range.to, 1) - start; };
      Real to = last();
      const auto visitNear = [&](const Crossing& c) {
        visit(Crossing{start + c.t, c.part});
        to = last();
      };
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
