// Instances of every shape on the list, and random scenes of them, made by looping over the lists: a new
// shape is tested without a new line here.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/match.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/mandelbox.h"
#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/fractals/plant.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/curves.h"
#include "geometry/shapes/surfaces/fur.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/terrain.h"
#include "geometry/traced.h"
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

// Other values for a field: flags flipped, numbers and vectors scaled.
inline std::vector<bool> variations(bool value) { return {!value}; }
inline std::vector<Real> variations(Real value) {
  return {value == 0 ? 0.25 : value * 0.25, value == 0 ? 0.75 : value * 0.75};
}
inline std::vector<Vec3> variations(const Vec3& value) {
  return {Vec3{value.x * 0.5 + 0.125, value.y * 0.75, value.z * 0.875}};
}

inline std::vector<int> variations(int value) { return {value / 2, value + 1}; }
inline std::vector<std::string> variations(const std::string& text) {
  if (text == Plant{}.axiom) return {"F[+X]FX"};
  return {"z - 0.3 * sin(4 * x) * cos(3 * y)"};
}
inline std::vector<std::vector<std::string>> variations(const std::vector<std::string>&) {
  return {{"X = F[+X]F[-X]", "X = F[^X]F"}};
}
inline std::vector<Heights> variations(const Heights&) {
  auto grid = std::make_shared<HeightGrid>(5, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) grid->at(x, y) = static_cast<float>((3 * x + 5 * y) % 7) / 7;
  return {{"heights.png", grid}};
}
inline std::vector<std::vector<BezierPatches::Points>> variations(
    const std::vector<BezierPatches::Points>& patches) {
  auto two = patches;
  two.push_back(patches[0]);
  for (auto& point : two.back()) point[0] += 2, point[2] *= -0.5;
  return {two};
}
inline std::vector<std::array<Real, 4>> variations(const std::array<Real, 4>& v) {
  return {{v[0] * 0.75, v[1] * 0.75, v[2] + 0.125, v[3]}};
}
/// Lists of tuples: squeezed.
template <std::size_t N>
std::vector<std::vector<std::array<Real, N>>> variations(std::vector<std::array<Real, N>> list) {
  for (auto& tuple : list) tuple[0] *= 0.75;
  return {list};
}
inline std::vector<std::vector<Prism::Outline>> variations(const std::vector<Prism::Outline>&) {
  return {{{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.2, 0.3}}}};
}
inline std::vector<std::vector<Curves::Strand>> variations(const std::vector<Curves::Strand>& strands) {
  auto two = strands;
  two.push_back(strands[0]);
  for (auto& point : two.back()) point[0] *= 0.5, point[2] += 0.75;
  return {two};
}
inline std::vector<Operands> variations(const Operands&) { return {}; }
inline std::vector<MaterialList> variations(const MaterialList&) { return {{{0, 0}}}; }

/// Something to see of a shape of that type: its default, where that is not empty and soon met.
inline Shape typical(const ShapeType& type) {
  Shape shape(type);
  if (type.ofObjects) {
    std::vector<Operand> operands{{"", Sphere{}, {}, 0},
                                  {"", Cube{}, Affine::translation({0.3, 0.2, 0.6}), 0}};
    if (!shape.is<Clip>())
      operands.push_back(
          {"", Cylinder{}, Affine::translation({0, 0, -0.4}) * Affine::scaling({0.5, 0.5, 1}), 0});
    shape.setOperands(Operands(std::move(operands)));
  }
  if (auto* fractal = shape.edit<Julia>()) fractal->iterations = 4;
  if (auto* fractal = shape.edit<Mandelbulb>()) fractal->iterations = 4;
  if (auto* fractal = shape.edit<Mandelbox>()) fractal->iterations = 4;
  if (auto* plant = shape.edit<Plant>()) {
    plant->iterations = 3;
    plant->radius = 0.1;
  }
  if (auto* fur = shape.edit<Fur>()) {
    fur->count = 60;
    fur->width = 0.1, fur->tipWidth = 0.05;
  }
  if (auto* terrain = shape.edit<Terrain>()) {
    terrain->points = 33;
    terrain->octaves = 4;
  }
  return shape;
}

/// The shape with each other value of the field of that number, one at a time.
inline std::vector<Shape> varied(const Shape& shape, std::size_t field) {
  std::vector<Shape> all;
  match(shape.fields()[field].value, [&](const auto& value) {
    if constexpr (requires { *value; }) {
      for (const auto& other : variations(*value)) {
        all.push_back(shape);
        *std::get<std::remove_cvref_t<decltype(value)>>(all.back().editFields()[field].value) = other;
      }
    } else {
      for (std::size_t i = 0; i < value.names().size(); ++i) {
        all.push_back(shape);
        std::get<EnumValue>(all.back().editFields()[field].value).set(i);
      }
    }
  });
  return all;
}

/// The typical shape, and one with each field changed.
inline std::vector<Shape> samplesOf(const ShapeType& type) {
  std::vector<Shape> samples{typical(type)};
  for (std::size_t field = 0; field < samples[0].fields().size(); ++field)
    for (Shape& other : varied(samples[0], field)) samples.push_back(std::move(other));
  return samples;
}

/// Those of all analytic shapes.
inline std::vector<Shape> analyticShapes() {
  std::vector<Shape> shapes;
  for (const ShapeType& type : shapeTypes())
    if (type.keyword != Mesh::kKeyword)
      for (Shape& sample : samplesOf(type)) shapes.push_back(std::move(sample));
  return shapes;
}

/// How many of so many rays a test of the shape sends: fewer where each takes long, so that the tests of a
/// shape end within a few seconds. `./dev test thorough` sends all.
inline int raysFor(const Shape& shape, int rays) {
  if (thorough()) return rays;
  if (shape.is<Mandelbulb>() || shape.is<Mandelbox>()) return rays / 20;
  const auto* julia = shape.as<Julia>();
  return julia && julia->iteration >= Iteration::sine ? rays / 50 : rays;
}

inline std::string nameOf(const Shape& shape) { return std::string(shape.keyword()); }

/// In order along the ray.
inline std::vector<Crossing> crossingsOf(const TracedShape& shape, const Ray& ray) {
  std::vector<Crossing> found;
  const auto add = [&](const Crossing& c) { found.push_back(c); };
  const Real everywhere = kInfinity;
  shape.crossings(ray, Range{-kInfinity, everywhere}, add);
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  return found;
}

inline SurfacePoint surfaceOf(const TracedShape& shape, const Ray& ray, const Crossing& crossing) {
  return shape.surface(ray, crossing);
}

inline Box3 boundsOf(const TracedShape& shape) { return shape.bounds(); }

/// Without those at infinity.
inline std::vector<Crossing> placesOf(const TracedShape& shape, const Ray& ray) {
  std::vector<Crossing> found = crossingsOf(shape, ray);
  std::erase_if(found, [](const Crossing& c) { return !std::isfinite(c.t); });
  return found;
}

/// The shape's bounds, cut off a few units from the origin where it has no end.
inline Box3 closeBoundsOf(const TracedShape& shape) {
  const Box3 box = boundsOf(shape);
  return {max(box.low, Vec3{-3, -3, -3}), min(box.high, Vec3{3, 3, 3})};
}

inline bool isSolid(const TracedShape& shape) { return shape.solid(); }

/// The volume of the part of a solid in the box: the sum of the lengths inside, over n x n parallel rays.
inline double volume(const Shape& plain, const Box3& box, int n) {
  const TracedShape shape = prepare(plain);
  const Vec3 size = box.size();
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Ray ray{{box.low.x - 1, box.low.y + size.y * (i + 0.5) / n, box.low.z + size.z * (j + 0.5) / n},
                    {1, 0, 0}};
      const std::vector<Crossing> c = crossingsOf(shape, ray);
      for (std::size_t k = 0; k + 1 < c.size(); k += 2) sum += c[k + 1].t - c[k].t;
    }
  return sum * size.y * size.z / n / n;
}

/// What a closed mesh whose faces look outward encloses, by the divergence theorem.
inline double volumeOf(const MeshData& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(Vec3(mesh.points[t[0]]), cross(Vec3(mesh.points[t[1]]), Vec3(mesh.points[t[2]]))) / 6;
  return sum;
}

/// The same of a single shape, for single rays.
template <class S>
requires requires { S::kKeyword; }
std::vector<Crossing> crossingsOf(const S& shape, const Ray& ray) {
  return crossingsOf(prepare(Shape(shape)), ray);
}
template <class S>
requires requires { S::kKeyword; }
SurfacePoint surfaceOf(const S& shape, const Ray& ray, const Crossing& crossing) {
  return surfaceOf(prepare(Shape(shape)), ray, crossing);
}
template <class S>
requires requires { S::kKeyword; }
bool isSolid(const S& shape) { return isSolid(prepare(Shape(shape))); }

}  // namespace trace::test
