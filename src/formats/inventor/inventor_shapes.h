// The shapes of Open Inventor, VRML 1.0 and VRML97 that are made of polygons: which points their faces join.
// What belongs to a corner beside its point (normal, material, texture) is bound afterwards.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/inventor/inventor_fields.h"
#include "formats/inventor/inventor_mesh.h"

namespace trace::inventor {

/// Faces before anything is bound to their corners.
struct Outline {
  std::vector<std::uint32_t> counts;  ///< corners of each face
  std::vector<std::uint32_t> parts;   ///< part of each face: the strip or polygon it belongs to
  std::vector<std::uint32_t> points;  ///< points of each corner
  std::vector<std::uint32_t> orders;  ///< orders of each corner: its number among those the file has
  std::vector<std::uint32_t> slots;   ///< slots of each corner: its place in coordIndex, the -1 counted too
  std::size_t bad = 0;                ///< faces that were left out

  void face(std::uint32_t part) {
    counts.push_back(0);
    parts.push_back(part);
  }
  void corner(std::uint32_t point, std::uint32_t order, std::uint32_t slot) {
    points.push_back(point);
    orders.push_back(order);
    slots.push_back(slot);
    ++counts.back();
  }
};

/// IndexedFaceSet, FaceSet, QuadMesh, TriangleStripSet, IndexedTriangleStripSet over `points` coordinates.
/// Faces that name points that do not exist are left out.
Outline outlineOf(const Values& shape, std::string_view type, std::size_t points);

/// Points and outline of an ElevationGrid; empty if its numbers do not fit.
struct Surface {
  std::vector<Vec3> points;
  std::vector<Vec2> uvs;  ///< uvs of each slot; may be empty
  Outline outline;
};

/// Texture coordinates of faces that have none: u along the longest side of the box around their points, from
/// 0 to 1, v along the second longest, on the same scale (VRML97, section 6.23).
class BoxUvs {
 public:
  explicit BoxUvs(const Surface& surface);
  Vec2 of(const Vec3& point) const;

 private:
  Vec3 low_;
  int u_ = 0, v_ = 1;
  Real size_ = 0;
};

/// A box around the origin, on each of whose sides a picture stands upright (VRML97, section 6.6).
Surface boxWithUvs(const Vec3& size);

Surface elevationGrid(const Values& grid);

/// Points and outline of an Extrusion (VRML97, section 6.18).
Surface extrusion(const Values& shape);

/// A disc of `radius` at the height y that looks up or down: the lid of an open cylinder. A picture is seen
/// upright where its front is tilted toward the eye.
Surface disc(Real radius, Real y, bool up);

}  // namespace trace::inventor
