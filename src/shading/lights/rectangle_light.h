// A window or a panel: a rectangle that shines to one side, or the ellipse in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "shading/lights/illumination.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"
#include "shading/lights/light_seen.h"
#include "shading/lights/panel.h"

namespace trace {

struct RectangleLight {
  static constexpr std::string_view kKeyword = "rectangle_light";
  static constexpr std::string_view kHelp =
      "light from a rectangle with the same radiance in every direction; its falloff follows from its solid "
      "angle";
  static constexpr LightOrigin kStarts = LightOrigin::panel;

  Vec3 position{};
  Vec3 u{1, 0, 0}, v{0, 1, 0};
  Color color{};
  bool round = false, twoSided = false, visible = false;

  static constexpr auto fields() {
    return Fields{
        Field{"position", &RectangleLight::position, "", -kNoLimit, kNoLimit, "its middle"},
        Field{"color", &RectangleLight::color, "", 0, kNoLimit,
              "its radiance: the colour of a white surface that sees nothing but the light"},
        Field{"u", &RectangleLight::u, "", -kNoLimit, kNoLimit, "first edge, the whole of it"},
        Field{"v", &RectangleLight::v, "", -kNoLimit, kNoLimit, "second edge; it shines toward u x v"},
        Field{"round", &RectangleLight::round, "", 0, 1, "only the ellipse in the rectangle shines"},
        Field{"two_sided", &RectangleLight::twoSided, "", 0, 1, "it shines to both sides"},
        Field{"visible", &RectangleLight::visible, "", 0, 1,
              "its shining side is visible, also in mirrors and through glass"}};
  }
  bool operator==(const RectangleLight&) const = default;
  bool hasSize() const { return true; }

  /// E = the integral of color / pi over the light's solid angle, by one place of it, chosen evenly over its
  /// area.
  std::optional<Illumination> illuminate(const Vec3& p, const Rules&, const Vec2& chosen = kCenter) const {
    const Vec3 d = placeOn(*this, chosen) - p, across = cross(u, v);
    const Real l = length(d);
    if (!(l > 0)) return {};
    // The cosine at the light times its area; of an ellipse pi / 4 of the rectangle's.
    Real facing = -dot(d, across) / l;
    if (twoSided) facing = std::abs(facing);
    if (!(facing > 0)) return {};
    return Illumination{d / l, l, color, facing * (round ? kPi / 4 : 1) / (kPi * l * l), {}};
  }
  LightReach reach(const Rules&) const {
    LightReach reach;
    for (const Real x : {-0.5, 0.5})
      for (const Real y : {-0.5, 0.5}) reach.box.extend(position + u * x + v * y);
    const Vec3 across = cross(u, v);
    const Real area = length(across);
    if (!(area > 0)) return reach;  // it is dark
    reach.axis = across / area;
    reach.around = 0;
    reach.beyond = kPi / 2;
    reach.twoSided = twoSided;
    reach.power = strengthOf(color) * area * (round ? kPi / 4 : 1) / kPi;
    return reach;
  }

  std::optional<LightSeen> seen(const Ray& ray, const Rules&) const {
    if (!visible || !(twoSided || dot(ray.direction, cross(u, v)) < 0)) return {};
    const std::optional<Real> t = meetsPanel(*this, ray);
    return t ? std::optional(LightSeen{*t, color}) : std::nullopt;
  }
};

}  // namespace trace
