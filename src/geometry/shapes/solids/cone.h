// Cones, truncated or not, and cylinders: the surface x^2 + y^2 = r(z)^2 with r linear in z, between two
// planes, with flat caps or open (Glassner, section 2.5; the quadric solved without cancellation).
//
// A capped one is traced as the solid it is, the part of a slab inside the round side, so that no ray
// slips through the rim.
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"
#include "math/elementary.h"
#include "math/roots.h"

namespace trace {

/// Radius `r0` at z = 0 and `r1` at z = h, both >= 0, h > 0. What Cone and Cylinder share.
struct Frustum {
  enum Part { side, bottom, top };

  Real r0 = 1, r1 = 1, h = 1;
  bool capped = true;

  Real slope() const { return (r1 - r0) / h; }
  Real radius(Real z) const { return r0 + (r1 - r0) * (z / h); }

  Box3 bounds() const {
    const Real r = std::max(r0, r1);
    return {{-r, -r, 0}, {r, r, h}};
  }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const Vec3 &o = ray.origin, &d = ray.direction;
    Crossing in{-kInfinity, bottom}, out{kInfinity, top};  // between the two planes
    if (d.z != 0) {
      in.t = (0 - o.z) / d.z;
      out.t = (h - o.z) / d.z;
      if (d.z < 0) std::swap(in, out);
    } else if (o.z < 0 || o.z > h) {
      return;
    }

    // Inside the side: A t^2 + 2 B t + C <= 0.
    const Real k = slope(), r = radius(o.z);
    const Real A = d.x * d.x + d.y * d.y - k * k * d.z * d.z;
    const Real B = o.x * d.x + o.y * d.y - k * d.z * r;
    const Real C = o.x * o.x + o.y * o.y - r * r;
    if (A == 0) {  // parallel to a line of the cone, or to a cylinder's axis
      if (B == 0) {
        if (C <= 0) within(in, out, visit);
        return;
      }
      const Crossing root{-C / (2 * B), side};
      if (B > 0)
        within(in, std::min(root, out, byT), visit);
      else
        within(std::max(root, in, byT), out, visit);
      return;
    }
    const Roots2 roots = solveQuadratic(A, B, C, discriminant(o, d, A));
    const Crossing first{roots.t0, side}, last{roots.t1, side};
    if (A > 0) {
      if (roots.count) within(std::max(first, in, byT), std::min(last, out, byT), visit);
    } else if (roots.count) {  // a steep ray: inside each half of the double cone; the planes choose one
      within(in, std::min(first, out, byT), visit);
      within(std::max(last, in, byT), out, visit);
    } else {
      within(in, out, visit);
    }
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t), n;
    const Real extent = std::max({r0, r1, h});
    if (crossing.part != side) {
      p.z = crossing.part == bottom ? 0 : h;
      n = {0, 0, crossing.part == bottom ? -1.0 : 1.0};
    } else {
      p.z = std::clamp(p.z, 0.0, h);
      const Real r = radius(p.z), was = math::hypot(p.x, p.y);
      if (was > 0) {
        p.x *= r / was;
        p.y *= r / was;
      }
      n = was > 0 ? normalize({p.x / was, p.y / was, -slope()}) : Vec3{0, 0, r1 < r0 ? 1.0 : -1.0};
      if (r > 0 && was > 0) n = normalize({p.x / r, p.y / r, -slope()});
    }
    if (!capped && dot(n, ray.direction) > 0) n = -n;
    // On the ends v continues from the rim to the middle, back to where it came from.
    Real v = p.z / h;
    if (crossing.part == bottom) v = 1 - min(1, math::hypot(p.x, p.y) / r0);
    if (crossing.part == top) v = min(1, math::hypot(p.x, p.y) / r1);
    return {p, Vec3{extent, extent, extent} * gammaError(10), n, n, SurfaceUv::around(p, v)};
  }

 private:
  static bool byT(const Crossing& a, const Crossing& b) { return a.t < b.t; }

  /// B^2 - A C, which does not change along the ray, from the ray's point nearest the middle of the axis:
  /// it keeps its digits for far rays, as for the sphere.
  Real discriminant(const Vec3& o, const Vec3& d, Real A) const {
    const Vec3 p = o - d * (dot(o - Vec3{0, 0, h / 2}, d) / dot(d, d));
    const Real k = slope(), r = radius(p.z);
    const Real B = p.x * d.x + p.y * d.y - k * d.z * r;
    return B * B - A * (p.x * p.x + p.y * p.y - r * r);
  }

  template <class Visit>
  void within(const Crossing& in, const Crossing& out, Visit& visit) const {
    if (!(in.t <= out.t)) return;
    if (capped || in.part == side) visit(in);
    if (capped || out.part == side) visit(out);
  }
};

struct Cone {
  static constexpr std::string_view kKeyword = "cone";
  static constexpr std::string_view kHelp = "cone or truncated cone along z, from z = 0 to z = height";
  static constexpr bool kAlongZ = true;

  Real height = 1, bottomRadius = 1, topRadius = 0;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"height", &Cone::height, "", 0, kNoLimit, "length along z"},
                  Field{"bottom_radius", &Cone::bottomRadius, "", 0, kNoLimit, "radius at z = 0"},
                  Field{"top_radius", &Cone::topRadius, "", 0, kNoLimit, "radius at z = height"},
                  Field{"capped", &Cone::capped, "", 0, 1, "closed by flat ends; else an open sheet"}};
  }
  bool operator==(const Cone&) const = default;

  Frustum frustum() const { return {std::abs(bottomRadius), std::abs(topRadius), height, capped}; }
  bool solid() const { return capped; }
  bool convex() const { return capped; }
  Box3 bounds() const { return frustum().bounds(); }
  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    frustum().crossings(ray, visit);
  }
  SurfacePoint surface(const Ray& ray, const Crossing& c) const { return frustum().surface(ray, c); }
};

struct Cylinder {
  static constexpr std::string_view kKeyword = "cylinder";
  static constexpr std::string_view kHelp = "cylinder of radius 1 along z, from z = 0 to z = 1";
  static constexpr bool kAlongZ = true;

  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"capped", &Cylinder::capped, "", 0, 1, "closed by flat ends; else an open sheet"}};
  }
  bool operator==(const Cylinder&) const = default;

  Frustum frustum() const { return {1, 1, 1, capped}; }
  bool solid() const { return capped; }
  bool convex() const { return capped; }
  Box3 bounds() const { return frustum().bounds(); }
  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    frustum().crossings(ray, visit);
  }
  SurfacePoint surface(const Ray& ray, const Crossing& c) const { return frustum().surface(ray, c); }
};

}  // namespace trace
