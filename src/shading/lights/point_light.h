// A lamp: a point, or a ball, that shines to all sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "shading/lights/illumination.h"

namespace trace {

struct PointLight {
  static constexpr std::string_view kKeyword = "point_light";
  static constexpr std::string_view kHelp =
      "light from a point, attenuated by 1 / (a + b d + c d^2) at distance d";

  Vec3 position{};
  Color color{};
  Real constant = 0, linear = 0, quadratic = 1;
  Color extraHighlight{};
  Real radius = 0;

  static constexpr auto fields() {
    return Fields{Field{"position", &PointLight::position, "", -kNoLimit, kNoLimit, "where it is"},
                  Field{"color", &PointLight::color, "", 0, kNoLimit, "its intensity"},
                  Field{"constant_attenuation_coeff", &PointLight::constant, "", 0, kNoLimit, "a"},
                  Field{"linear_attenuation_coeff", &PointLight::linear, "", 0, kNoLimit, "b"},
                  Field{"quadratic_attenuation_coeff", &PointLight::quadratic, "", 0, kNoLimit, "c"},
                  Field{"extra_highlight", &PointLight::extraHighlight, "", -kNoLimit, kNoLimit,
                        "added to color in highlights"},
                  Field{"radius", &PointLight::radius, "units", 0, kNoLimit,
                        "of the ball that shines; more than 0 makes shadows soft"}};
  }
  bool operator==(const PointLight&) const = default;
  bool hasSize() const { return radius > 0; }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    const Vec3 d = position - p;
    const Real l = length(d);
    if (!(l > 0)) return {};
    const Real attenuation = 1 / (constant + linear * l + quadratic * l * l);
    Illumination arriving{d / l, l, color, rules.limitAttenuation ? std::min(1.0, attenuation) : attenuation,
                          extraHighlight};
    towardBall(arriving, radius, u);
    return arriving;
  }
};

}  // namespace trace
