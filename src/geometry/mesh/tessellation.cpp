#include "geometry/mesh/tessellation.h"

#include <array>
#include <cmath>
#include <utility>

#include "base/unique.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/tessellate.h"
#include "geometry/shapes/cone.h"
#include "geometry/shapes/conic.h"
#include "geometry/shapes/cube.h"
#include "geometry/shapes/sphere.h"
#include "geometry/shapes/square.h"
#include "geometry/traced.h"

namespace trace {
namespace {

class Builder {
 public:
  explicit Builder(int steps) : steps_(steps) {}

  MeshData finish() { return std::move(mesh_); }

  /// Four corners, counter-clockwise seen from where the normal points.
  void quad(const Vec3 (&corners)[4], const Vec3& normal) {
    const std::uint32_t first = next();
    for (const Vec3& p : corners) point(p, normal);
    mesh_.triangles.push_back({first, first + 1, first + 2});
    mesh_.triangles.push_back({first, first + 2, first + 3});
  }

  /// Rows of points around z, from below: row(i) gives radius and height, normal(i) the normal's two parts.
  template <class Row, class Normal>
  void around(int rows, Row&& row, Normal&& normal) {
    const std::uint32_t first = next(), width = static_cast<std::uint32_t>(steps_) + 1;
    for (int i = 0; i <= rows; ++i)
      for (int k = 0; k <= steps_; ++k) {
        const Real phi = 2 * kPi * k / steps_, c = std::cos(phi), s = std::sin(phi);
        const auto [radius, z] = row(i);
        const auto [out, up] = normal(i);
        point({radius * c, radius * s, z}, {out * c, out * s, up});
      }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(rows); ++i)
      for (std::uint32_t k = 0; k + 1 < width; ++k) {
        const std::uint32_t p = first + i * width + k;
        triangle(p, p + 1, p + width + 1);
        triangle(p, p + width + 1, p + width);
      }
  }

  void disc(Real radius, Real z, bool up) {
    if (radius == 0) return;
    const std::uint32_t center = next();
    const Vec3 normal{0, 0, up ? 1.0 : -1.0};
    point({0, 0, z}, normal);
    for (int k = 0; k <= steps_; ++k) {
      const Real phi = (up ? 2 : -2) * kPi * k / steps_;
      point({radius * std::cos(phi), radius * std::sin(phi), z}, normal);
    }
    for (std::uint32_t k = 1; k <= static_cast<std::uint32_t>(steps_); ++k)
      triangle(center, center + k, center + k + 1);
  }

  void frustum(const Frustum& f, Real bottom) {
    const Vec3 n = normalize({1, 0, -f.slope()});
    around(
        1,
        [&](int i) {
          return std::pair{i ? f.r1 : f.r0, bottom + (i ? f.h : 0)};
        },
        [&](int) {
          return std::pair{n.x, n.z};
        });
    if (f.capped) {
      disc(f.r0, bottom, false);
      disc(f.r1, bottom + f.h, true);
    }
  }

 private:
  std::uint32_t next() const { return static_cast<std::uint32_t>(mesh_.points.size()); }
  void point(const Vec3& p, const Vec3& normal) {
    mesh_.points.push_back(Vec3f(p));
    mesh_.normals.push_back(Vec3f(normal));
  }
  /// At a pole or an apex a triangle has no area.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
    if (faceNormal(mesh_, static_cast<std::uint32_t>(mesh_.triangles.size() - 1)) == Vec3{})
      mesh_.triangles.pop_back();
  }

  int steps_;
  MeshData mesh_;
};

void add(Builder& builder, const Sphere&, int steps) {
  const int rows = steps / 2;
  const auto angle = [&](int i) { return kPi * (static_cast<Real>(i) / rows - 0.5); };
  // Exactly at the poles, so that their triangles have no area.
  const auto out = [&](int i) { return i == 0 || i == rows ? 0.0 : std::cos(angle(i)); };
  const auto row = [&](int i) { return std::pair{out(i), std::sin(angle(i))}; };
  builder.around(rows, row, row);
}

void add(Builder& builder, const Cube&, int) {
  for (int axis = 0; axis < 3; ++axis)
    for (Real side : {-1.0, 1.0}) {
      Vec3 n, u, v;
      n[axis] = side;
      u[(axis + 1) % 3] = 0.5;
      v[(axis + 2) % 3] = 0.5 * side;
      const Vec3 c = n * 0.5;
      builder.quad({c - u - v, c + u - v, c + u + v, c - u + v}, n);
    }
}

void add(Builder& builder, const Square&, int) {
  builder.quad({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, {0, 0, 1});
}

void add(Builder& builder, const Cylinder& shape, int) { builder.frustum(shape.frustum(), 0); }
void add(Builder& builder, const Cone& shape, int) { builder.frustum(shape.frustum(), 0); }
void add(Builder& builder, const Conic& shape, int) { builder.frustum(shape.frustum(), shape.low()); }

/// The triangles of any shape with equal corners joined; those of a solid face outward.
MeshData joined(const std::vector<SurfaceCorner>& corners, bool solid) {
  using Key = std::array<float, 6>;
  Unique<Key> numbers;
  MeshData mesh;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    Triangle triangle;
    Vec3 normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f p(corners[i + k].point), n(corners[i + k].normal);
      triangle[k] = numbers.number({p.x, p.y, p.z, n.x, n.y, n.z});
      if (triangle[k] == mesh.points.size()) {
        mesh.points.push_back(p);
        mesh.normals.push_back(n);
      }
      normal += corners[i + k].normal;
    }
    mesh.triangles.push_back(triangle);
    const Vec3 face = faceNormal(mesh, static_cast<std::uint32_t>(mesh.triangles.size() - 1));
    if (face == Vec3{})
      mesh.triangles.pop_back();
    else if (solid && dot(face, normal) < 0)
      std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
  }
  return mesh;
}

}  // namespace

std::optional<MeshData> tessellated(const Shape& shape, int steps) {
  if (shape.is<Mesh>()) return {};
  const TracedShape form = prepare(shape);
  const Box3 box = form.bounds();
  if (box.empty() || !isFinite(box.size())) return {};
  const bool solid = form.solid();
  Builder builder(steps);
  const bool known = visitAs<Sphere, Cube, Square, Cylinder, Cone, Conic>(
      shape, [&](const auto& s) { add(builder, s, steps); });
  MeshData mesh = known ? builder.finish() : joined(tessellate(shape, steps), solid);
  if (mesh.triangles.empty()) return {};
  mesh.twoSided = !solid;
  return mesh;
}

}  // namespace trace
