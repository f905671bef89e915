// A ball of triangles with the normals of the sphere.
#pragma once

#include <cmath>
#include <memory>

#include "geometry/mesh/mesh.h"

namespace trace::test {

/// So many triangles around z and so many from pole to pole; closed, all points on the sphere.
inline std::shared_ptr<MeshData> sphereMesh(int around, int rows, Real radius = 1) {
  auto mesh = std::make_shared<MeshData>();
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < around; ++j) {
      if ((i == 0 || i == rows) && j > 0) continue;
      const Real theta = kPi * i / rows, phi = 2 * kPi * j / around;
      const Vec3 n = i == 0      ? Vec3{0, 0, 1}
                     : i == rows ? Vec3{0, 0, -1}
                                 : Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                        std::cos(theta)};
      mesh->points.push_back(Vec3f(n * radius));
      mesh->normals.push_back(Vec3f(n));
    }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i == 0      ? 0
                                      : i == rows ? 1 + (rows - 1) * around
                                                  : 1 + (i - 1) * around + j % around);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) mesh->triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rows) mesh->triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

}  // namespace trace::test
