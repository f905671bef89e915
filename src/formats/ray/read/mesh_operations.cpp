#include "formats/ray/read/mesh_operations.h"

#include <cmath>
#include <string>

#include "formats/ray/read/fields.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"

namespace trace::rayfile {

bool MeshOperations::read(Findings& findings, const Item& field) {
  const std::string_view key = field.key();
  double number = 0;
  if (key == "crease") {
    if (!rayfile::read(findings, key, field.value(), number)) return true;
    if (number >= 0 && number <= 180)
      crease = number;
    else
      findings.expected(field.value(), key, "an angle from 0 to 180 degrees");
    return true;
  }
  if (key == "uv") {
    uv = field.value().is(Kind::word) ? uvProjection(field.value().text()) : std::nullopt;
    if (!uv) findings.expected(field.value(), key, "spherical, cylindrical, planar or cubic");
    return true;
  }
  if (key == "scheme") {
    const bool word = field.value().is(Kind::word);
    catmullClark = word && field.value().text() == "catmull_clark";
    if (!catmullClark && !(word && field.value().text() == "loop"))
      findings.expected(field.value(), key, "loop or catmull_clark");
    return true;
  }
  if (key != "subdivide") return false;
  if (!rayfile::read(findings, key, field.value(), number)) return true;
  if (number >= 0 && number <= 10 && number == std::floor(number))
    subdivide = static_cast<int>(number);
  else
    findings.expected(field.value(), key, "a whole number from 0 to 10");
  return true;
}

MeshData MeshOperations::apply(const MeshData& mesh, const SourcePlace& place,
                               const std::vector<Crease>& creases) const {
  // A polygon of n triangles becomes 2 (n + 2) at the first level of Catmull and Clark's.
  const std::size_t extra = catmullClark && subdivide > 0 ? 3 : 1;
  const std::size_t most = (kMostTriangles >> (2 * subdivide)) * (extra > 1 ? 2 : 1) / extra;
  if (mesh.triangles.size() > most)
    throw Error(Fault::limit, place,
                "subdivide: expected a mesh that gets at most 50 million triangles, found one of " +
                    std::to_string(mesh.triangles.size()) + " before");
  MeshData result = subdivide == 0 ? mesh
                    : catmullClark ? subdividedByCatmullClark(mesh, subdivide, creases)
                                   : subdivided(mesh, subdivide, creases);
  if (subdivide > 0) {
    dropDegenerate(result);
    result.generateNormals = crease < 0;
  }
  if (crease >= 0) result = withCreaseNormals(result, crease * kPi / 180);
  return uv ? withProjectedUvs(result, *uv) : result;
}

}  // namespace trace::rayfile
