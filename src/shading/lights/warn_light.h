// A studio's lamp with barn doors (Warn, Lighting Controls for Synthetic Images, SIGGRAPH 1983): light by a
// power of the cosine to its axis, as a highlight of Phong's has it, cut by a cone and by flaps. A flap is a
// plane across an axis of the world, beyond which the light gives nothing.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "math/elementary.h"
#include "shading/lights/illumination.h"
#include "shading/lights/lamp_fields.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"

namespace trace {

struct WarnLight {
  static constexpr std::string_view kKeyword = "warn_light";
  static constexpr std::string_view kHelp =
      "studio light: a power of the cosine to its axis, cut by a cone and by six flaps";
  static constexpr LightOrigin kStarts = LightOrigin::ball;

  Vec3 position{};
  Vec3 direction{0, 0, -1};
  Color color{};
  Real exponent = 1;
  Real angle = 90;  ///< half angle of the cone, degrees
  Real xMin = -kNoLimit, xMax = kNoLimit, yMin = -kNoLimit, yMax = kNoLimit, zMin = -kNoLimit,
       zMax = kNoLimit;
  Real constant = 1, linear = 0, quadratic = 0;
  Real radius = 0;

  static constexpr auto fields() {
    return Fields{
        beamFields<WarnLight>("direction of its axis"),
        Field{"exponent", &WarnLight::exponent, "", 0, kNoLimit,
              "exponent of the cosine to the axis: a larger one makes a narrower beam"},
        Field{"angle", &WarnLight::angle, "degrees", 0, 90,
              "angle between the axis and the side of the cone that cuts it"},
        Field{"x_min", &WarnLight::xMin, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of smaller x"},
        Field{"x_max", &WarnLight::xMax, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of larger x"},
        Field{"y_min", &WarnLight::yMin, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of smaller y"},
        Field{"y_max", &WarnLight::yMax, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of larger y"},
        Field{"z_min", &WarnLight::zMin, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of smaller z"},
        Field{"z_max", &WarnLight::zMax, "", -kNoLimit, kNoLimit, "a flap: it lights nothing of larger z"},
        fadingFields<WarnLight>(),
        ballField<WarnLight>()};
  }
  bool operator==(const WarnLight&) const = default;
  bool hasSize() const { return radius > 0; }

  /// Where the flaps leave its light.
  Box3 open() const { return {{xMin, yMin, zMin}, {xMax, yMax, zMax}}; }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    if (!open().contains(p)) return {};
    std::optional<Illumination> arriving = fromPlace(*this, p, rules);
    if (!arriving) return {};
    const Real cosine = std::min(1.0, -dot(arriving->toLight, normalize(direction)));
    if (!(cosine > 0) || math::acos(cosine) * 180 / kPi > angle) return {};
    arriving->attenuation *= math::pow(cosine, exponent);
    towardBall(*arriving, radius, u);
    return arriving;
  }
  LightReach reach(const Rules& rules) const {
    LightReach reach = reachOfLamp(*this, rules);
    if (open().empty()) reach.power = 0;
    reach.axis = normalize(direction);
    reach.around = std::min(angle * kPi / 180, kPi / 2);
    return reach;
  }
};

}  // namespace trace
