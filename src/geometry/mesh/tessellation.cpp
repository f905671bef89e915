#include "geometry/mesh/tessellation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/budget.h"
#include "base/unique.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/tessellate.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/traced.h"
#include "math/elementary.h"

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
        const Real phi = 2 * kPi * k / steps_, c = math::cos(phi), s = math::sin(phi);
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
      point({radius * math::cos(phi), radius * math::sin(phi), z}, normal);
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
  const int rows = std::max(2, steps / 2);
  const auto angle = [&](int i) { return kPi * (static_cast<Real>(i) / rows - 0.5); };
  // Exactly at the poles, so that their triangles have no area.
  const auto out = [&](int i) { return i == 0 || i == rows ? 0.0 : math::cos(angle(i)); };
  const auto row = [&](int i) { return std::pair{out(i), math::sin(angle(i))}; };
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

/// The triangles of any shape with equal corners joined.
MeshData joined(const std::vector<SurfaceCorner>& corners) {
  using Key = std::array<float, 6>;
  Unique<Key> numbers;
  MeshData mesh;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f p(corners[i + k].point), n(corners[i + k].normal);
      triangle[k] = numbers.number({p.x, p.y, p.z, n.x, n.y, n.z});
      if (triangle[k] == mesh.points.size()) {
        mesh.points.push_back(p);
        mesh.normals.push_back(n);
      }
    }
    mesh.triangles.push_back(triangle);
    if (faceNormal(mesh, static_cast<std::uint32_t>(mesh.triangles.size() - 1)) == Vec3{})
      mesh.triangles.pop_back();
  }
  return mesh;
}

/// The texture coordinates of the place on the shape that is nearest to p along the normal.
std::optional<Vec2> uvAt(const TracedShape& form, const Vec3& p, const Vec3& normal, Real reach) {
  const Ray ray{p + normal * reach, -normal};
  std::optional<Crossing> nearest;
  const auto look = [&](const Crossing& crossing) {
    if (!nearest || std::abs(crossing.t - reach) < std::abs(nearest->t - reach)) nearest = crossing;
  };
  form.crossings(ray, {0, 2 * reach}, look);
  if (!nearest) return {};
  const Vec2 uv = form.surface(ray, *nearest).uv;
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return {};
  return uv;
}

/// The mesh with the texture coordinates of the shape. Each corner is asked a little inside its triangle, so
/// that those on a line where coordinates start again, or at a pole, have them as their triangle does. A
/// triangle that lies across such a line continues with them.
MeshData withTextureCoordinates(const MeshData& mesh, const TracedShape& form, Real size) {
  constexpr Real kInside = 0x1p-8, kReach = 0.02, kTorn = 0.25;
  struct Key {
    std::uint32_t point;
    float u, v;
  };
  Unique<Key> numbers;
  MeshData mapped;
  mapped.twoSided = mesh.twoSided;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    checkBudget();
    const Corners v = corners(mesh, i);
    const Vec3 middle = (v.a + v.b + v.c) / 3, normal = normalize(faceNormal(mesh, i));
    const Vec2 around = uvAt(form, middle, normal, kReach * size).value_or(Vec2{});
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 corner = k == 0 ? v.a : k == 1 ? v.b : v.c;
      Vec2 uv = uvAt(form, corner + (middle - corner) * kInside, normal, kReach * size).value_or(around);
      const Real far = max(std::abs(uv.x - around.x), std::abs(uv.y - around.y));
      if (far > 2 * kTorn) {
        const Vec2 halfway = uvAt(form, (corner + middle) / 2, normal, kReach * size).value_or(around);
        const auto goneOn = [](Real from, Real between, Real to) {
          return std::abs(between - (from + to) / 2) > kTorn ? to - std::round(to - from) : to;
        };
        uv = {goneOn(around.x, halfway.x, uv.x), goneOn(around.y, halfway.y, uv.y)};
      }
      const std::uint32_t point = mesh.triangles[i][k];
      triangle[k] = numbers.number({point, static_cast<float>(uv.x), static_cast<float>(uv.y)});
      if (triangle[k] < mapped.points.size()) continue;
      mapped.points.push_back(mesh.points[point]);
      mapped.normals.push_back(mesh.normals[point]);
      mapped.uvs.push_back(uv);
    }
    mapped.triangles.push_back(triangle);
  }
  return mapped;
}

}  // namespace

std::optional<MeshData> tessellated(const Shape& shape, int steps, bool mapped, int* followed, bool wanted) {
  if (followed) *followed = steps;
  if (shape.is<Mesh>()) return {};
  const TracedShape form = prepare(shape);
  const Box3 box = form.bounds();
  if (box.empty() || !isFinite(box.size())) return {};
  const bool solid = form.solid();
  Builder builder(steps);
  const bool known = visitAs<Sphere, Cube, Square, Cylinder, Cone, Conic>(
      shape, [&](const auto& s) { add(builder, s, steps); });
  MeshData mesh = known ? builder.finish() : joined(tessellate(shape, steps, kFarthest, followed, wanted));
  if (mesh.triangles.empty()) return {};
  mesh.twoSided = !solid;
  return mapped ? withTextureCoordinates(mesh, form, maxComponent(box.size())) : mesh;
}

}  // namespace trace
