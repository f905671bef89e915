// A lamp: a point, or a ball, that shines to all sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "shading/lights/illumination.h"
#include "shading/lights/lamp_fields.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"
#include "shading/lights/light_seen.h"

namespace trace {

struct PointLight {
  static constexpr std::string_view kKeyword = "point_light";
  static constexpr std::string_view kHelp =
      "light from a point, attenuated by 1 / (a + b d + c d^2) at distance d";
  static constexpr LightOrigin kStarts = LightOrigin::ball;

  Vec3 position{};
  Color color{};
  Real constant = 0, linear = 0, quadratic = 1;
  Color extraHighlight{};
  Real radius = 0;
  bool visible = false;

  static constexpr auto fields() {
    return Fields{Field{"position", &PointLight::position, "", -kNoLimit, kNoLimit, "where it is"},
                  Field{"color", &PointLight::color, "", 0, kNoLimit, "its intensity"},
                  fadingFields<PointLight>(),
                  Field{"extra_highlight", &PointLight::extraHighlight, "", -kNoLimit, kNoLimit,
                        "added to color in highlights"},
                  ballField<PointLight>(),
                  Field{"visible", &PointLight::visible, "", 0, 1,
                        "the sphere is visible, also in mirrors and through glass"}};
  }
  bool operator==(const PointLight&) const = default;
  bool hasSize() const { return radius > 0; }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    std::optional<Illumination> arriving = fromPlace(*this, p, rules);
    if (arriving) {  // one object all the way: copies of what was just written wait for memory
      arriving->extraHighlight = extraHighlight;
      towardBall(*arriving, radius, u);
    }
    return arriving;
  }
  LightReach reach(const Rules& rules) const {
    LightReach reach = reachOfLamp(*this, rules);
    reach.power = max(strengthOf(color), strengthOf(color + extraHighlight));
    return reach;
  }

  /// A ray from outside that hits the ball sees what lights a surface there as the whole light does.
  std::optional<LightSeen> seen(const Ray& ray, const Rules& rules) const {
    if (!visible || !(radius > 0)) return {};
    const Vec3 toMiddle = position - ray.origin;
    const Real away2 = dot(toMiddle, toMiddle), radius2 = radius * radius;
    if (!(away2 > radius2)) return {};
    const Real along = dot(toMiddle, ray.direction), off2 = away2 - along * along;
    if (!(along > 0) || off2 > radius2) return {};
    const Real sine2 = radius2 / away2, solidAngle = 2 * kPi * sine2 / (1 + std::sqrt(1 - sine2));
    return LightSeen{along - std::sqrt(radius2 - off2),
                     color * (faded(*this, std::sqrt(away2), rules) * kPi / solidAngle)};
  }
};

}  // namespace trace
