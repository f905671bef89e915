// Instances of every shape on the list, and random scenes of them, made by looping over the lists: a new
// shape is tested without a new line here.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/match.h"
#include "geometry/csg_tree.h"
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
/// Every name of an enum.
template <class Enum>
requires std::is_enum_v<Enum> std::vector<Enum> variations(Enum) {
  std::vector<Enum> all;
  for (std::size_t i = 0; i < names(Enum{}).size(); ++i) all.push_back(static_cast<Enum>(i));
  return all;
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
inline std::vector<Operands> variations(const Operands&) { return {}; }
inline std::vector<MaterialList> variations(const MaterialList&) { return {{{0, 0}}}; }

/// Something to see of the shape: its default, where that is not empty and soon met.
template <class S>
S typical() {
  S shape;
  if constexpr (std::is_same_v<S, Clip>)
    shape.objects = Operands({{"", Sphere{}, {}, 0}, {"", Cube{}, Affine::translation({0.3, 0.2, 0.6}), 0}});
  else if constexpr (requires { shape.trap; })
    shape.iterations = 4;
  else if constexpr (std::is_same_v<S, Plant>)
    shape.iterations = 3, shape.radius = 0.1;
  else if constexpr (std::is_same_v<S, Terrain>)
    shape.points = 33, shape.octaves = 4;
  else if constexpr (requires { shape.objects; })
    shape.objects =
        Operands({{"", Sphere{}, {}, 0},
                  {"", Cube{}, Affine::translation({0.3, 0.2, 0.6}), 0},
                  {"", Cylinder{}, Affine::translation({0, 0, -0.4}) * Affine::scaling({0.5, 0.5, 1}), 0}});
  return shape;
}

/// The typical shape, and one with each field changed.
template <class S>
std::vector<S> samplesOf() {
  std::vector<S> samples{typical<S>()};
  forEachField<S>([&](const auto& field) {
    S changed = typical<S>();
    for (const auto& value : variations(changed.*field.member)) {
      changed.*field.member = value;
      samples.push_back(changed);
    }
  });
  return samples;
}

/// Those of all analytic shapes.
inline std::vector<Shape> analyticShapes() {
  std::vector<Shape> shapes;
  forEachType<Shape>([&]<class S>(S*) {
    if constexpr (!std::is_same_v<S, Mesh>)
      for (const S& sample : samplesOf<S>()) shapes.push_back(sample);
  });
  return shapes;
}

/// Of so many rays, how many a test of the shape sends: fewer where each takes long, so that the tests of a
/// shape end within a few seconds. `./dev test thorough` sends all.
inline int raysFor(const Shape& shape, int rays) {
  if (thorough()) return rays;
  return match(shape, [&]<class S>(const S& s) {
    if constexpr (std::is_same_v<S, Mandelbulb> || std::is_same_v<S, Mandelbox>) return rays / 20;
    if constexpr (std::is_same_v<S, Julia>) return s.iteration >= Iteration::sine ? rays / 50 : rays;
    return rays;
  });
}

inline std::string nameOf(const Shape& shape) {
  return std::string(match(shape, [](const auto& s) { return s.kKeyword; }));
}

/// In order along the ray.
inline std::vector<Crossing> crossingsOf(const TracedShape& shape, const Ray& ray) {
  std::vector<Crossing> found;
  const Range everywhere{-kInfinity, kInfinity};
  match(shape, Overloaded{[](const Mesh&) {},
                          [&](const auto& s) {
                            visitCrossings(formOf(s), ray, everywhere,
                                           [&](const Crossing& c) { found.push_back(c); });
                          }});
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  return found;
}

inline SurfacePoint surfaceOf(const TracedShape& shape, const Ray& ray, const Crossing& crossing) {
  return match(shape, Overloaded{[](const Mesh&) { return SurfacePoint{}; },
                                 [&](const auto& s) { return formOf(s).surface(ray, crossing); }});
}

inline Box3 boundsOf(const TracedShape& shape) {
  return match(shape, Overloaded{[](const Mesh& m) { return bounds(*m.data); },
                                 [](const auto& s) { return formOf(s).bounds(); }});
}

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

inline bool isSolid(const TracedShape& shape) {
  return match(
      shape, Overloaded{[](const Mesh&) { return false; }, [](const auto& s) { return formOf(s).solid(); }});
}

/// Of the part of a solid in the box: the sum of the lengths inside, over n x n parallel rays.
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

/// Shapes that have to be worked out first, for single rays.
template <class S>
requires requires(const S s) { s.prepared(); }
std::vector<Crossing> crossingsOf(const S& shape, const Ray& ray) {
  return crossingsOf(prepare(Shape(shape)), ray);
}
template <class S>
requires requires(const S s) { s.prepared(); }
SurfacePoint surfaceOf(const S& shape, const Ray& ray, const Crossing& crossing) {
  return surfaceOf(prepare(Shape(shape)), ray, crossing);
}
template <class S>
requires requires(const S s) { s.prepared(); }
bool isSolid(const S& shape) { return isSolid(prepare(Shape(shape))); }

}  // namespace trace::test
