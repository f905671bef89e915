// How long each shape takes to answer a ray: the nearest hit of random rays through its box, on one thread.
// Prints a Markdown table; `bench_shapes NAME` only the shapes whose name holds NAME.
#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>

#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/mandelbox.h"
#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/fractals/menger.h"
#include "geometry/shapes/fractals/plant.h"
#include "geometry/shapes/solids/blend.h"
#include "geometry/shapes/solids/copies.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/supertoroid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/puff.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/shapes/surfaces/sweep.h"
#include "geometry/shapes/surfaces/terrain.h"
#include "geometry/traced.h"
#include "stopwatch.h"

namespace trace {
namespace {

struct Case {
  std::string name;
  Shape shape;
};

Operands spheres(int count) {
  std::vector<Operand> parts;
  for (int i = 0; i < count; ++i)
    parts.push_back(
        {"", i == 0 ? Shape(Cube{}) : Shape(Sphere{}), Affine::translation({0.4 * i, 0.3 * i, 0.5}), 0});
  return Operands(std::move(parts));
}

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&]<class S>(std::string name, S shape, auto&& change) {
    change(shape);
    all.push_back({std::move(name), Shape(std::move(shape))});
  };
  const auto plain = [](auto&) {};
  add("sphere", Sphere{}, plain);
  add("paraboloid", Paraboloid{}, plain);
  add("rounded_box", RoundedBox{}, plain);
  add("torus", Torus{}, plain);
  add("superellipsoid", Superellipsoid{}, plain);
  add("supertoroid", Supertoroid{}, plain);
  add("lathe, bezier", Lathe{}, plain);
  add("lathe, linear", Lathe{}, [](Lathe& s) { s.spline = Spline::linear; });
  add("prism, linear", Prism{}, plain);
  add("prism, bspline", Prism{}, [](Prism& s) { s.spline = Spline::bspline; });
  add("prism, twisted by 90 degrees", Prism{}, [](Prism& s) { s.twist = 90; });
  add("sphere_sweep, one arc", SphereSweep{}, plain);
  add("sweep, one arc", Sweep{}, plain);
  add("plant", Plant{}, plain);
  add("bezier_patches, one", BezierPatches{}, plain);
  add("metaballs, two", Metaballs{}, plain);
  add("isosurface, degree 4", Isosurface{},
      [](Isosurface& s) { s.formula = "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4"; });
  add("height_field, 65 x 65", HeightField{}, plain);
  add("... smooth", HeightField{}, [](HeightField& s) { s.smooth = true; });
  add("terrain, 1025 x 1025", Terrain{}, [](Terrain& s) { s.points = 1025; });
  add("menger, level 3", Menger{}, plain);
  add("sierpinski, level 4", Sierpinski{}, plain);
  add("sierpinski, level 10", Sierpinski{}, [](Sierpinski& s) { s.levels = 10; });
  add("julia, 10 iterations", Julia{}, plain);
  add("julia, cube", Julia{}, [](Julia& s) { s.iteration = Iteration::cube; });
  add("julia, hypercomplex", Julia{}, [](Julia& s) { s.iteration = Iteration::hypercomplex; });
  add("julia, sine, 3 iterations", Julia{},
      [](Julia& s) { s.iteration = Iteration::sine, s.iterations = 3; });
  add("mandelbulb, 3 iterations", Mandelbulb{}, plain);
  add("mandelbox, 5 iterations", Mandelbox{}, plain);
  add("blend of two", Blend{}, [](Blend& s) { s.objects = spheres(2); });
  add("blend of three", Blend{}, [](Blend& s) { s.objects = spheres(3); });
  add("puff", Puff{}, plain);
  return all;
}

std::vector<Ray> raysThrough(const Box3& box, std::size_t count) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<Real> uniform(0, 1);
  const auto point = [&](Real scale) {
    const Vec3 r{uniform(generator), uniform(generator), uniform(generator)};
    const Vec3 size = box.size() * scale;
    return box.center() + Vec3{(r.x - 0.5) * size.x, (r.y - 0.5) * size.y, (r.z - 0.5) * size.z};
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3 from = point(8);
    rays.push_back({from, normalize(point(1) - from)});
  }
  return rays;
}

/// Nanoseconds a ray: the least of several passes of a tenth of a second.
double timeOf(const Shape& shape, std::size_t& hits) {
  const TracedShape traced = prepare(shape);
  const std::vector<Ray> rays = raysThrough(traced.bounds(), 2000);
  double least = 1e9;
  for (int pass = 0; pass < 5; ++pass) {
    const double begin = bench::threadSeconds();
    std::size_t done = 0;
    double taken = 0;
    while (taken < 0.1) {
      hits = 0;
      for (const Ray& ray : rays) {
        Real nearest = kInfinity;
        const auto visit = [&](const Crossing& c) {
          if (c.t > 0 && c.t < nearest) nearest = c.t;
        };
        traced.crossings(ray, Range{0, nearest}, visit);
        hits += nearest < kInfinity;
      }
      done += rays.size();
      taken = bench::threadSeconds() - begin;
    }
    least = std::min(least, 1e9 * taken / static_cast<double>(done));
  }
  return least;
}

}  // namespace
}  // namespace trace

int main(int count, char** arguments) {
  const std::string_view wanted = count > 1 ? arguments[1] : "";
  std::puts("| shape | ns | hits, % |\n|---|---:|---:|");
  for (const trace::Case& shape : trace::cases()) {
    if (shape.name.find(wanted) == std::string::npos) continue;
    std::size_t hits = 0;
    const double time = trace::timeOf(shape.shape, hits);
    std::printf("| %s | %.0f | %.0f |\n", shape.name.c_str(), time, static_cast<double>(hits) / 20);
    std::fflush(stdout);
  }
}
