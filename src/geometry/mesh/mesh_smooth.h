// Smoother meshes: normals that follow a crease angle, and the subdivisions of Loop and of Catmull and Clark.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace trace {

/// An edge between two points that subdivision keeps sharp for so many levels, from 0; the broken part of a
/// level counts in part (DeRose, Kass and Truong, Subdivision Surfaces in Character Animation, 1998).
struct Crease {
  std::uint32_t a = 0, b = 0;
  Real sharpness = 0;
};

/// For each point the number of its place: those at equal places have the same. Negative zeros are zeros.
std::vector<std::uint32_t> placesOf(const MeshData& mesh);

/// The mesh with normals at its points that are smooth across edges whose faces turn by less than `angle`
/// (radians), and sharp at others, where points are doubled. Faces count by their angle at the point
/// (Thuermer and Wuethrich 1998). Points at equal places are one. Normals of the mesh are replaced. Linear.
MeshData withCreaseNormals(const MeshData& mesh, Real angle);

/// Each triangle in four, `levels` times, and the points moved toward a smooth surface (Loop 1987, with
/// Warren's weights; borders become cubic B-splines). Normals are left out; uv are mixed, and a new point
/// takes the material of one end of its edge. Creases of what are no edges count for nothing.
/// Precondition: 4^levels times the triangles fits into 32 bits.
MeshData subdivided(const MeshData& mesh, int levels, const std::vector<Crease>& creases = {});

/// Each polygon of n corners in n quadrangles, `levels` times, and the points moved toward a smooth surface
/// (Catmull and Clark 1978; borders become cubic B-splines); then cut into triangles. Normals are left out;
/// uv are mixed, and new points take the material of a corner. Precondition: 4^levels times the corners of
/// all polygons fits into 32 bits.
MeshData subdividedByCatmullClark(const MeshData& mesh, int levels, const std::vector<Crease>& creases = {});

}  // namespace trace
