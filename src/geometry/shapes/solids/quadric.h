// Quadrics: the general one by its ten coefficients, and the named ones by their measures.
// All are traced as a ClippedQuadric.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "geometry/solve/clipped_quadric.h"

namespace trace {

struct Quadric {
  static constexpr std::string_view kKeyword = "quadric";
  static constexpr std::string_view kHelp = "quadric by its ten coefficients, within a box";

  Vec3 squares{1, 1, -1}, products, linear;
  Real constant = -0.25;
  Vec3 low{-1, -1, -1}, high{1, 1, 1};
  bool capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"squares", &Quadric::squares, "", -kNoLimit, kNoLimit, "coefficients of x^2, y^2, z^2"},
        Field{"products", &Quadric::products, "", -kNoLimit, kNoLimit, "coefficients of x y, x z, y z"},
        Field{"linear", &Quadric::linear, "", -kNoLimit, kNoLimit, "coefficients of x, y, z"},
        Field{"constant", &Quadric::constant, "", -kNoLimit, kNoLimit,
              "the constant term; the sum is negative inside"},
        Field{"low", &Quadric::low, "", -kNoLimit, kNoLimit, "corner of the box that cuts it off"},
        Field{"high", &Quadric::high, "", -kNoLimit, kNoLimit, "opposite corner"},
        Field{"capped", &Quadric::capped, "", 0, 1, "closed by faces of the box; else an open sheet"}};
  }
  bool operator==(const Quadric&) const = default;

  ClippedQuadric prepared() const {
    const Box3 box{min(low, high), max(low, high)};
    return {squares, products * 0.5, linear * 0.5, constant, box, box, capped};
  }
};

struct Ellipsoid {
  static constexpr std::string_view kKeyword = "ellipsoid";
  static constexpr std::string_view kHelp = "ellipsoid at the origin";

  Vec3 radii{1, 0.75, 0.5};

  static constexpr auto fields() {
    return Fields{Field{"radii", &Ellipsoid::radii, "", 0, kNoLimit, "half its width in x, y and z"}};
  }
  bool operator==(const Ellipsoid&) const = default;

  ClippedQuadric prepared() const {
    const Vec3 r = abs(radii);
    const Box3 all{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    return {{1 / (r.x * r.x), 1 / (r.y * r.y), 1 / (r.z * r.z)}, {}, {}, -1, all, {-r, r}, true};
  }
};

/// The quadric x^2 / rx^2 + y^2 / ry^2 = a + b z + c z^2 between two heights, at which the ellipse is largest
/// or the waist between them.
inline ClippedQuadric quadricAlongZ(Real rx, Real ry, Real a, Real b, Real c, Real z0, Real z1, bool capped) {
  const auto stretch = [&](Real z) { return a + z * (b + z * c); };
  Real most = max(stretch(z0), stretch(z1));
  if (c < 0 && b == 0 && z0 < 0 && z1 > 0) most = max(most, a);
  const Real s = std::sqrt(max(most, 0));
  return {{1 / (rx * rx), 1 / (ry * ry), -c},
          {},
          {0, 0, -b / 2},
          -a,
          {{-kInfinity, -kInfinity, z0}, {kInfinity, kInfinity, z1}},
          {{-rx * s, -ry * s, z0}, {rx * s, ry * s, z1}},
          capped};
}

struct Paraboloid {
  static constexpr std::string_view kKeyword = "paraboloid";
  static constexpr std::string_view kHelp =
      "bowl: a parabola turned around z, from its lowest point at the origin up";
  static constexpr bool kAlongZ = true;

  Real height = 1, radius = 1;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"height", &Paraboloid::height, "", 0, kNoLimit, "length along z"},
                  Field{"radius", &Paraboloid::radius, "", 0, kNoLimit, "radius at z = height"},
                  Field{"capped", &Paraboloid::capped, "", 0, 1, "closed by a flat end; else an open sheet"}};
  }
  bool operator==(const Paraboloid&) const = default;

  ClippedQuadric prepared() const {
    const Real h = std::abs(height), r = std::abs(radius);
    return quadricAlongZ(r, r, 0, 1 / h, 0, 0, h, capped);
  }
};

struct Hyperboloid {
  static constexpr std::string_view kKeyword = "hyperboloid";
  static constexpr std::string_view kHelp =
      "hyperboloid of one sheet around z: a tower with a waist at z = 0";
  static constexpr bool kAlongZ = true;

  Real height = 2, radius = 1, waist = 0.5;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"height", &Hyperboloid::height, "", 0, kNoLimit,
                        "length along z, half of it on each side of z = 0"},
                  Field{"radius", &Hyperboloid::radius, "", 0, kNoLimit, "radius at both ends"},
                  Field{"waist", &Hyperboloid::waist, "", 0, kNoLimit,
                        "radius at z = 0; above `radius` it makes a barrel"},
                  Field{"capped", &Hyperboloid::capped, "", 0, 1, "closed by flat ends; else an open sheet"}};
  }
  bool operator==(const Hyperboloid&) const = default;

  ClippedQuadric prepared() const {
    const Real h = std::abs(height) / 2, a = waist * waist;
    return quadricAlongZ(1, 1, a, 0, (radius * radius - a) / (h * h), -h, h, capped);
  }
};

struct TwoSheets {
  static constexpr std::string_view kKeyword = "two_sheets";
  static constexpr std::string_view kHelp = "hyperboloid of two sheets around z: two bowls back to back";
  static constexpr bool kAlongZ = true;

  Real height = 2, radius = 1, gap = 0.4;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"height", &TwoSheets::height, "", 0, kNoLimit,
              "length along z, half of it on each side of z = 0"},
        Field{"radius", &TwoSheets::radius, "", 0, kNoLimit, "radius at both ends"},
        Field{"gap", &TwoSheets::gap, "", 0, kNoLimit, "distance between the bowls, less than the height"},
        Field{"capped", &TwoSheets::capped, "", 0, 1, "closed by flat ends; else an open sheet"}};
  }
  bool operator==(const TwoSheets&) const = default;

  ClippedQuadric prepared() const {
    const Real h = std::abs(height) / 2, g = std::min(std::abs(gap) / 2, h), r = std::abs(radius);
    const Real k = g < h ? 1 / (h * h - g * g) : 0;
    return quadricAlongZ(r, r, -g * g * k, 0, k, -h, h, capped);
  }
};

struct EllipticCone {
  static constexpr std::string_view kKeyword = "elliptic_cone";
  static constexpr std::string_view kHelp =
      "cone along z with an elliptic base at z = 0 and its tip at z = height";
  static constexpr bool kAlongZ = true;

  Real height = 1, radiusX = 1, radiusY = 0.5;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"height", &EllipticCone::height, "", 0, kNoLimit, "length along z"},
        Field{"radius_x", &EllipticCone::radiusX, "", 0, kNoLimit, "half the width of the base in x"},
        Field{"radius_y", &EllipticCone::radiusY, "", 0, kNoLimit, "half the width of the base in y"},
        Field{"capped", &EllipticCone::capped, "", 0, 1, "closed by a flat end; else an open sheet"}};
  }
  bool operator==(const EllipticCone&) const = default;

  ClippedQuadric prepared() const {
    const Real h = std::abs(height);
    return quadricAlongZ(std::abs(radiusX), std::abs(radiusY), 1, -2 / h, 1 / (h * h), 0, h, capped);
  }
};

}  // namespace trace
