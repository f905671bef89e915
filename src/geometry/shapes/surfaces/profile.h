// Plane curves of lines and cubics: profiles of lathes, outlines of prisms, paths of sweeps. A file gives
// points; how they are joined is the Spline.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "math/vec.h"

namespace trace {

/// How points become a curve.
enum class Spline {
  linear,   ///< straight from point to point
  bezier,   ///< cubic Bezier arcs: end, two handles, end, two handles, end ...
  bspline,  ///< uniform cubic B-spline: near the points, twice differentiable; begins near the second point
  catmull,  ///< Catmull-Rom: through the points but the first and last
};
constexpr std::array<std::string_view, 4> names(Spline) { return {"linear", "bezier", "bspline", "catmull"}; }

/// A cubic in u from 0 to 1 for each of N coordinates: coefficients of 1, u, u^2, u^3.
template <int N>
struct Cubic {
  std::array<std::array<Real, 4>, N> c{};

  Real at(int axis, Real u) const {
    const auto& k = c[static_cast<std::size_t>(axis)];
    return k[0] + u * (k[1] + u * (k[2] + u * k[3]));
  }
  Real slope(int axis, Real u) const {
    const auto& k = c[static_cast<std::size_t>(axis)];
    return k[1] + u * (2 * k[2] + u * 3 * k[3]);
  }
};

/// The arcs of a curve through (or near) the points; fewer points than an arc needs give none. A curve whose
/// arcs share an end has exactly the same numbers there: `ends` are the points between arcs, one more than
/// arcs, and each arc runs from ends[i] to ends[i + 1].
template <int N>
struct Arcs {
  std::vector<Cubic<N>> arcs;
  std::vector<std::array<Real, N>> ends;
};

/// The coefficients of 1, u, u^2, u^3 of an arc of four neighbouring points; a line has the first two.
inline std::array<Real, 4> arcOf(Spline spline, Real a, Real b, Real c, Real d) {
  switch (spline) {
    case Spline::linear: break;
    case Spline::bezier: return {a, 3 * (b - a), 3 * (a - 2 * b + c), d - a + 3 * (b - c)};
    case Spline::bspline:
      return {(a + 4 * b + c) / 6, (c - a) / 2, (a - 2 * b + c) / 2, (d - a + 3 * (b - c)) / 6};
    case Spline::catmull: return {b, (c - a) / 2, (2 * a - 5 * b + 4 * c - d) / 2, (d - a + 3 * (b - c)) / 2};
  }
  return {a, b - a, 0, 0};
}

template <int N>
Arcs<N> arcsOf(Spline spline, const std::vector<std::array<Real, N>>& points) {
  Arcs<N> curve;
  const std::size_t n = points.size();
  const std::size_t step = spline == Spline::bezier ? 3 : 1, reach = spline == Spline::linear ? 2 : 4;
  for (std::size_t i = 0; i + reach <= n; i += step) {
    Cubic<N> arc;
    for (std::size_t axis = 0; axis < N; ++axis) {
      const Real a = points[i][axis], b = points[i + 1][axis];
      const Real c = reach == 4 ? points[i + 2][axis] : 0, d = reach == 4 ? points[i + 3][axis] : 0;
      arc.c[axis] = arcOf(spline, a, b, c, d);
    }
    if (curve.ends.empty()) {
      curve.ends.emplace_back();
      for (int axis = 0; axis < N; ++axis)
        curve.ends.back()[static_cast<std::size_t>(axis)] = arc.c[static_cast<std::size_t>(axis)][0];
    }
    curve.ends.emplace_back();
    for (int axis = 0; axis < N; ++axis) curve.ends.back()[static_cast<std::size_t>(axis)] = arc.at(axis, 1);
    curve.arcs.push_back(arc);
  }
  return curve;
}

/// The closed curve through (or near) the points, which a line closes if nothing else does.
inline Arcs<2> loopOf(Spline spline, std::vector<std::array<Real, 2>> points) {
  if (points.empty()) return {};
  if (spline == Spline::bspline || spline == Spline::catmull) {  // continues over its beginning
    const std::vector begin(points.begin(), points.begin() + std::min<std::ptrdiff_t>(std::ssize(points), 3));
    points.insert(points.end(), begin.begin(), begin.end());
  } else if (points.back() != points.front() && (spline == Spline::linear || points.size() % 3 == 0)) {
    points.push_back(points.front());
  }
  Arcs<2> loop = arcsOf<2>(spline, points);
  if (loop.ends.empty() || loop.ends.back() == loop.ends.front()) return loop;
  const auto a = loop.ends.back(), b = loop.ends.front();
  loop.arcs.push_back({{{{a[0], b[0] - a[0], 0, 0}, {a[1], b[1] - a[1], 0, 0}}}});
  loop.ends.push_back(b);
  return loop;
}

}  // namespace trace
