// Operations that a mesh of a .ray file asks for, inline or from a file: `crease = 40; subdivide = 2; uv =
// cubic;`.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_smooth.h"
#include "geometry/mesh/mesh_uv.h"

namespace trace::rayfile {

struct MeshOperations {
  static constexpr std::array<std::string_view, 4> kFields{"crease", "scheme", "subdivide", "uv"};
  /// More triangles than this are not made.
  static constexpr std::size_t kMostTriangles = 50'000'000;

  double crease = -1;  ///< degrees; below 0 for none
  int subdivide = 0;
  bool catmullClark = false;  ///< polygons into quadrangles; else triangles into triangles
  std::optional<UvProjection> uv;

  bool operator==(const MeshOperations&) const = default;
  bool operator<(const MeshOperations& b) const {
    return std::tie(crease, subdivide, catmullClark, uv) <
           std::tie(b.crease, b.subdivide, b.catmullClark, b.uv);
  }
  bool none() const { return crease < 0 && subdivide == 0 && !uv; }

  /// Takes the field if it is one of these. Reports what is wrong with its value.
  bool read(Findings& findings, const Item& field);

  /// Subdivides with these creases, then makes normals, then uv. Throws Error(Fault::limit) at `place` if the
  /// mesh would become too large.
  MeshData apply(const MeshData& mesh, const SourcePlace& place,
                 const std::vector<Crease>& creases = {}) const;
};

}  // namespace trace::rayfile
