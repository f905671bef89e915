// Triangles that look like a shape, for drawing it in an interactive view; rendering never uses them.
//
// One way for every analytic shape, out of its crossings alone: dual contouring (Ju, Losasso, Schaefer and
// Warren, SIGGRAPH 2002). A grid lies over the shape's bounds. Rays along its lines find where the surface
// crosses them; each cell with crossings gets a point where their tangent planes meet best, so that edges
// stay sharp; each crossing joins the points of the four cells around it. Unlike the paper's, sheets that
// enclose nothing are welcome: it matters that an edge is crossed, not what is inside.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/materials.h"
#include "geometry/shape.h"
#include "math/box.h"

namespace trace {

struct SurfaceCorner {
  static constexpr std::uint32_t kOwn = MaterialMix::kClear - 1;  ///< the material of the whole

  Vec3 point, normal;             ///< in the shape's space; normals are unit and on either side
  std::uint32_t material = kOwn;  ///< that most of the place is made of: of Scene::materials, kOwn, or kClear
};

/// Where an infinite shape is cut off, in its own space, unless something else is said.
inline constexpr Box3 kFarthest{{-100, -100, -100}, {100, 100, 100}};

/// The shape's bounds; of an infinite one the part that lies in the box.
Box3 drawnBounds(const Shape& shape, const Box3& within = kFarthest);

/// Three corners for each triangle. A mesh gives its own; other shapes are sampled on a grid of about
/// `divisions` cells along their longest side. Those of a solid stand counter-clockwise seen from outside.
///
/// A surface that folds so finely that such a grid would take minutes has fewer divisions, unless all are
/// `wanted`; `followed` then tells how many. None of what is empty, or folds more finely than any search
/// follows.
std::vector<SurfaceCorner> tessellate(const Shape& shape, int divisions = 24, const Box3& within = kFarthest,
                                      int* followed = nullptr, bool wanted = false);

}  // namespace trace
