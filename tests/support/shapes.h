// Instances of every shape on the list, and random scenes of them, made by looping over the lists: a new
// shape is tested without a new line here.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/match.h"
#include "geometry/shape.h"
#include "support/random.h"

namespace trace::test {

/// A closed, lumpy ball of triangles around the origin.
inline std::shared_ptr<MeshData> ballMesh(int rings, Random& random) {
  auto mesh = std::make_shared<MeshData>();
  const int sectors = 2 * rings;
  mesh->points.push_back({0, 0, 1});
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double theta = kPi * i / rings, phi = 2 * kPi * j / sectors, r = random.uniform(0.8, 1.1);
      mesh->points.push_back(Vec3f(Vec3{r * std::sin(theta) * std::cos(phi),
                                        r * std::sin(theta) * std::sin(phi), r * std::cos(theta)}));
    }
  mesh->points.push_back({0, 0, -1});
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i == 0       ? 0
                                      : i == rings ? 1 + (rings - 1) * sectors
                                                   : 1 + (i - 1) * sectors + j % sectors);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) mesh->triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) mesh->triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

/// Long thin triangles across the whole mesh, which the hierarchy holds in parts.
inline void addNeedles(MeshData& mesh, Random& random, double scale = 1, const Vec3& offset = {}) {
  for (int i = 0; i < 60; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const Vec3 a = random.inCube(3 * scale), b = random.inCube(3 * scale);
    for (const Vec3& p : {a, b, b + random.inCube(0.05 * scale)}) mesh.points.push_back(Vec3f(p + offset));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

/// The default instance of each analytic shape, and one with each field changed: flags flipped, numbers
/// scaled.
inline std::vector<Shape> analyticShapes() {
  std::vector<Shape> shapes;
  forEachType<Shape>([&]<class S>(S*) {
    if constexpr (!std::is_same_v<S, Mesh>) {
      shapes.push_back(S{});
      forEachField<S>([&](const auto& field) {
        S changed;
        auto& value = changed.*field.member;
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(value)>, bool>) {
          value = !value;
          shapes.push_back(changed);
        } else {
          for (double factor : {0.25, 3.0}) {
            value = value == 0 ? factor : value * factor;
            shapes.push_back(changed);
          }
        }
      });
    }
  });
  return shapes;
}

inline std::string nameOf(const Shape& shape) {
  return std::string(match(shape, [](const auto& s) { return s.kKeyword; }));
}

inline std::vector<Crossing> crossingsOf(const Shape& shape, const Ray& ray) {
  std::vector<Crossing> found;
  match(shape,
        Overloaded{[](const Mesh&) {},
                   [&](const auto& s) { s.crossings(ray, [&](const Crossing& c) { found.push_back(c); }); }});
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  return found;
}

inline SurfacePoint surfaceOf(const Shape& shape, const Ray& ray, const Crossing& crossing) {
  return match(shape, Overloaded{[](const Mesh&) { return SurfacePoint{}; },
                                 [&](const auto& s) { return s.surface(ray, crossing); }});
}

inline Box3 boundsOf(const Shape& shape) {
  return match(shape, Overloaded{[](const Mesh& m) { return bounds(*m.data); },
                                 [](const auto& s) { return s.bounds(); }});
}

inline bool isSolid(const Shape& shape) {
  return match(shape, Overloaded{[](const Mesh&) { return false; }, [](const auto& s) { return s.solid(); }});
}

}  // namespace trace::test
