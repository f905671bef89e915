// THE list of shapes. A new shape is one header and one line here; readers, writers, the reference page
// and the generic tests loop over the list.
//
// Every shape but Mesh answers, in its own space:
//   solid()             does it enclose space? (an open sheet is seen from both sides)
//   bounds()            a box that holds it
//   crossings(ray, f)   f(Crossing) for every place, in any order and at any t, where the ray's line goes
//                       through the surface; for solids, entries and exits come in pairs
//   surface(ray, c)     the point, put back on the surface, with error bounds, normal and uv
#pragma once

#include <concepts>
#include <string_view>
#include <variant>

#include "geometry/cone.h"
#include "geometry/cube.h"
#include "geometry/mesh.h"
#include "geometry/sphere.h"
#include "geometry/square.h"

namespace trace {

using Shape = std::variant<Sphere, Cube, Square, Cylinder, Cone, Mesh>;

template <class S>
concept AnalyticShape = requires(const S s, const Ray ray, const Crossing crossing) {
  { S::kKeyword } -> std::convertible_to<std::string_view>;
  { S::kHelp } -> std::convertible_to<std::string_view>;
  S::fields();
  { s.solid() } -> std::same_as<bool>;
  { s.bounds() } -> std::same_as<Box3>;
  s.crossings(ray, [](const Crossing&) {});
  { s.surface(ray, crossing) } -> std::same_as<SurfacePoint>;
};
static_assert(AnalyticShape<Sphere> && AnalyticShape<Cube> && AnalyticShape<Square> &&
              AnalyticShape<Cylinder> && AnalyticShape<Cone>);

}  // namespace trace
