// The checks of meshes and of faces in one plane.
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/lint/checks.h"
#include "app/lint/coplanar.h"
#include "geometry/mesh/mesh.h"

namespace trace::lint_checks {
namespace {

/// Calls visit(object, mesh data) once for each mesh, however many objects share it.
template <class Visit>
void forEachMesh(const LintScene& s, Visit&& visit) {
  std::set<const MeshData*> seen;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i)
    if (const auto* mesh = s.scene.objects[i].shape.as<Mesh>())
      if (seen.insert(mesh->data.get()).second) visit(i, *mesh->data);
}

}  // namespace

void insideOut(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    // A room looks inward, and rightly so: lamps light it from within.
    const bool room =
        isAroundCamera(s, object) || (s.world.opaque(object) && s.survey.objects[object].direct > 0);
    if (room || shareInsideOut(s.world, object, mesh) < 0.9) return;
    warn(findings, "inside-out", placeOf(s, object),
         "the faces of " + quoted(s, object) +
             " look inward: it is lit from inside, and glass refracts the wrong way",
         "list the corners of each face counter-clockwise as seen from outside");
  });
}

void turnedFaces(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    struct Edge {
      std::uint32_t low, high;
      bool upward;
      bool operator<(const Edge& o) const { return low != o.low ? low < o.low : high < o.high; }
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    std::sort(edges.begin(), edges.end());
    std::size_t shared = 0, against = 0;
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i + 1;
      while (end < edges.size() && !(edges[i] < edges[end])) ++end;
      if (end - i == 2) {
        ++shared;
        against += edges[i].upward == edges[i + 1].upward;
      }
      i = end;
    }
    if (against == 0) return;
    warn(findings, "turned-faces", placeOf(s, object),
         std::to_string(against) + " of " + std::to_string(shared) + " neighbouring pairs of faces of " +
             quoted(s, object) + " are turned opposite ways",
         "list the corners of every face in the same sense, counter-clockwise as seen from outside");
  });
}

void normalsAgainstFaces(const LintScene& s, Findings& findings) {
  forEachMesh(s, [&](std::uint32_t object, const MeshData& mesh) {
    if (mesh.normals.empty() || mesh.triangles.empty()) return;
    std::size_t against = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3 face = faceNormal(mesh, i);
      const Triangle& t = mesh.triangles[i];
      against += std::all_of(t.begin(), t.end(),
                             [&](std::uint32_t point) { return dot(Vec3(mesh.normals[point]), face) < 0; });
    }
    const double share = static_cast<double>(against) / static_cast<double>(mesh.triangles.size());
    if (share < 0.05) return;
    warn(findings, "normals-against-faces", placeOf(s, object),
         "the normals of " + quoted(s, object) + " point against its faces in " + percent(share) +
             " of the triangles: shading and shadows disagree there",
         "reverse either the normals or the order of the faces' corners; gennormals makes normals that fit");
  });
}

void zeroArea(const LintScene& s, Findings& findings) {
  for (const Message& message : s.warnings)
    if (isOfArea(message))
      warn(findings, "zero-area", message.place, message.what,
           "their corners lie on one line, or are one point: remove them from the file, or correct their "
           "corners");
}

void coplanarFaces(const LintScene& s, Findings& findings) {
  constexpr int kFew = 3;
  // Flat faces wherever they are; others, such as those of prisms, where the camera sees them.
  Statistics statistics;
  const auto isSeen = [&](const Vec3& place) {  // whichever way the camera looks
    constexpr Real kThere = 1 - 1e-6;           // tolerance relative to the distance
    const Vec3& eye = s.world.camera().eye;
    const auto found = s.world.closest({eye, place - eye}, Faces::both, statistics);
    return found && found->t > kThere;
  };
  const std::set<std::pair<std::uint32_t, std::uint32_t>> flat = overlappingFaces(s.scene, isSeen);
  auto pairs = flat;
  for (const auto& [pair, places] : s.survey.coplanar)
    if (places >= kFew) pairs.insert(pair);
  for (const auto& pair : pairs) {
    if (s.world.opaque(pair.first) && materialOf(s, pair.first) == materialOf(s, pair.second)) continue;
    warn(findings, "coplanar", placeOf(s, pair.second),
         (flat.contains(pair) ? "a face of " + quoted(s, pair.second) + " lies in the same plane as one of " +
                                    quoted(s, pair.first) + " and covers it"
                              : "the surfaces of " + quoted(s, pair.second) + " and " +
                                    quoted(s, pair.first) + " are at the same place") +
             ": rounding decides which of them is visible",
         "move one of them a little, or leave out the part that is covered");
  }
}

}  // namespace trace::lint_checks
