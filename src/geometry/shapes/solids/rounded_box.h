// A box whose edges and corners are rounded: all points within `radius` of a smaller box. It is convex, and
// so is the distance from the smaller box along a ray.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "geometry/solve/span.h"

namespace trace {

struct RoundedBox {
  static constexpr std::string_view kKeyword = "rounded_box";
  static constexpr std::string_view kHelp = "box around the origin with rounded edges and corners";

  Vec3 size{1, 1, 1};
  Real radius = 0.1;

  static constexpr auto fields() {
    return Fields{Field{"size", &RoundedBox::size, "", 0, kNoLimit, "whole width in x, y and z"},
                  Field{"radius", &RoundedBox::radius, "", 0, kNoLimit,
                        "radius of the edges, at most half of the least width"}};
  }
  bool operator==(const RoundedBox&) const = default;

  bool solid() const { return true; }
  bool convex() const { return true; }
  Box3 bounds() const { return {half() * -1, half()}; }

  template <class Visit>
  void crossings(const Ray& ray, const Range& range, Visit&& visit) const {
    const Real r = rounding();
    const Vec3 inner = core();
    const auto distance = [&](Real t) {
      const Vec3 out = outside(ray.at(t), inner);
      const Real l = length(out);
      if (l > 0) return Jet{l - r, dot(out, ray.direction) / l};
      return Jet{-r, 0};
    };
    if (r == 0) return flat(ray, visit);
    convexCrossings(spanIn(roomy(bounds()), ray), range, distance, [&](Real t, int end) {
      visit(Crossing{t, end});
    });
  }

  /// uv as on the six faces of a cube.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    const Vec3 h = half(), inner = core();
    Vec3 p = ray.at(crossing.t);
    const Vec3 out = outside(p, inner);
    const Real l = length(out);
    Vec3 n;
    if (rounding() > 0 && l > 0) {
      n = out / l;
      p = p - out + n * rounding();
    } else {  // sharp: the face that is nearest
      int axis = 0;
      for (int i = 1; i < 3; ++i)
        if (std::abs(p[i]) - h[i] > std::abs(p[axis]) - h[axis]) axis = i;
      n[axis] = p[axis] < 0 ? -1 : 1;
      p[axis] = n[axis] * h[axis];
    }
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], -h[i], h[i]);
    int face = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(n[i]) > std::abs(n[face])) face = i;
    const int a = face == 0 ? 1 : 0, b = face == 2 ? 1 : 2;
    const Real error = maxComponent(h) * gammaError(16);
    return {p, {error, error, error}, n, n, {0.5 + p[a] / (2 * h[a]), 0.5 + p[b] / (2 * h[b])}};
  }

 private:
  Vec3 half() const { return abs(size) * 0.5; }
  Real rounding() const { return std::min({std::abs(radius), half().x, half().y, half().z}); }
  Vec3 core() const { return half() - Vec3{1, 1, 1} * rounding(); }
  static Vec3 outside(const Vec3& p, const Vec3& inner) {
    Vec3 out;
    for (int i = 0; i < 3; ++i)
      out[i] = p[i] > inner[i] ? p[i] - inner[i] : p[i] < -inner[i] ? p[i] + inner[i] : 0;
    return out;
  }
  template <class Visit>
  void flat(const Ray& ray, Visit& visit) const {
    const Span span = spanIn(bounds(), ray);
    if (!span.empty()) {
      visit(Crossing{span.from, 0});
      visit(Crossing{span.to, 1});
    }
  }
};

}  // namespace trace
