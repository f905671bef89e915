// Triangle meshes. The arrays are bulk data behind a shared const handle: copying a scene never copies
// them, and a mesh named twice is stored once.
//
// A mesh is not asked for its crossings like the other shapes: the World keeps a hierarchy over each
// mesh's triangles and tests them here, without a dispatch per triangle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/mesh/triangle.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

using Triangle = std::array<std::uint32_t, 3>;

/// The direction along which u grows at a point, and the side to which v does: 1 if it is that of normal x
/// direction, -1 if the texture is mirrored.
struct MeshTangent {
  Vec3f direction;
  float side = 1;

  bool operator==(const MeshTangent&) const = default;
};

struct MeshData {
  std::vector<Vec3f> points;
  std::vector<Triangle> triangles;       ///< indices into points; counter-clockwise is the front
  std::vector<Vec3f> normals;            ///< per point, or empty: faces look flat
  std::vector<std::uint32_t> materials;  ///< per point, indices into Scene::materials, or empty
  std::vector<Vec2> uvs;                 ///< per point, or empty
  std::vector<Vec2> secondUvs;           ///< per point, or empty: for pictures that ask for them
  std::vector<MeshTangent> tangents;     ///< per point, or empty: normal maps follow the texture coordinates
  bool generateNormals = false;          ///< `gennormals`: compile adds averaged face normals
  bool twoSided = false;                 ///< seen from behind, shaded with its normals turned to the eye

  /// The polygons with more than three corners: the first of their triangles and how many. They change
  /// nothing that is seen; subdivision begins with them.
  std::vector<std::array<std::uint32_t, 2>> polygons;

  /// Is the same seen?
  bool operator==(const MeshData& other) const {
    return points == other.points && triangles == other.triangles && normals == other.normals &&
           materials == other.materials && uvs == other.uvs && secondUvs == other.secondUvs &&
           tangents == other.tangents && generateNormals == other.generateNormals &&
           twoSided == other.twoSided;
  }
};

/// Adds the middle of two of them, where there are any.
inline void addMiddle(std::vector<Vec2>& to, const std::vector<Vec2>& from, std::size_t a, std::size_t b) {
  if (from.empty()) return;
  const Vec2 p = from[a], q = from[b];
  to.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
}

struct Mesh {
  static constexpr std::string_view kKeyword = "polymesh";
  static constexpr std::string_view kHelp =
      "triangle mesh: points, faces, and per-point normals, materials, uv";
  static constexpr auto fields() { return Fields{}; }

  std::shared_ptr<const MeshData> data = std::make_shared<MeshData>();

  bool operator==(const Mesh& other) const { return data == other.data || *data == *other.data; }
};

/// The corners of a triangle, as a ray hits them.
Corners corners(const MeshData& mesh, std::uint32_t index);

SurfacePoint surface(const MeshData& mesh, std::uint32_t index, const TriangleHit& hit);

/// (b - a) x (c - a), not normalised; zero for a degenerate triangle.
Vec3 faceNormal(const MeshData& mesh, std::uint32_t index);

Box3 bounds(const MeshData& mesh, std::uint32_t index);
Box3 bounds(const MeshData& mesh);

/// The mesh with each point's normal the unweighted mean of the unit normals of the faces around it, added
/// to its explicit normals if it has any. `unit` scales the means to length 1; else they stay shorter
/// where faces turn away from each other, which weighs them less when a face interpolates.
MeshData withGeneratedNormals(const MeshData& mesh, bool unit);

}  // namespace trace
