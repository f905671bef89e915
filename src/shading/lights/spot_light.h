// A spot light: a point, or a ball, that shines into a cone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "math/elementary.h"
#include "shading/lights/illumination.h"
#include "shading/lights/lamp_fields.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"

namespace trace {

/// How a spot light falls off between `full_angle` and `angle`: evenly in the angle, or by a cubic without a
/// corner in its cosine, as POV-Ray has it.
enum class SpotEdge { linear, smooth };
constexpr std::array<std::string_view, 2> names(SpotEdge) { return {"linear", "smooth"}; }

struct SpotLight {
  static constexpr std::string_view kKeyword = "spot_light";
  static constexpr std::string_view kHelp = "light from a point into a cone, attenuated like a point light";
  static constexpr LightOrigin kStarts = LightOrigin::ball;

  Vec3 position{};
  Vec3 direction{0, 0, -1};
  Color color{};
  Real angle = 45,
       fullAngle = 45;  ///< half angles of the cone, and of the part where it does not fade; degrees
  SpotEdge edge = SpotEdge::linear;
  Real exponent = 0;
  Real constant = 1, linear = 0, quadratic = 0;
  Real radius = 0;

  static constexpr auto fields() {
    return Fields{beamFields<SpotLight>("direction of the cone's axis"),
                  Field{"angle", &SpotLight::angle, "degrees", 0, 180,
                        "angle between the axis and the side of the cone"},
                  Field{"full_angle", &SpotLight::fullAngle, "degrees", 0, 180,
                        "from this angle to the side of the cone the light falls off to nothing"},
                  Field{"edge", &SpotLight::edge, "", -kNoLimit, kNoLimit,
                        "how it falls off: linear in the angle, or smooth in its cosine"},
                  Field{"exponent", &SpotLight::exponent, "", 0, kNoLimit,
                        "exponent of the cosine to the axis, a factor on the light"},
                  fadingFields<SpotLight>(),
                  ballField<SpotLight>()};
  }
  bool operator==(const SpotLight&) const = default;
  bool hasSize() const { return radius > 0; }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    std::optional<Illumination> arriving = fromPlace(*this, p, rules);
    if (!arriving) return {};
    const Real cosine = std::clamp(-dot(position - p, normalize(direction)) / arriving->distance, -1.0, 1.0);
    const Real off = math::acos(cosine) * 180 / kPi;
    if (off > angle) return {};
    Real& factor = arriving->attenuation;
    if (exponent > 0) factor *= math::pow(std::max(0.0, cosine), exponent);
    if (off > fullAngle)
      factor *= edge == SpotEdge::linear ? (angle - off) / (angle - fullAngle) : smoothEdge(cosine);
    towardBall(*arriving, radius, u);
    return arriving;
  }
  Real smoothEdge(Real cosine) const {
    const Real outer = math::cos(angle * kPi / 180), inner = math::cos(fullAngle * kPi / 180);
    const Real t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    return t * t * (3 - 2 * t);
  }
  LightReach reach(const Rules& rules) const {
    LightReach reach = reachOfLamp(*this, rules);
    reach.axis = normalize(direction);
    reach.around = std::min(angle * kPi / 180, kPi);
    return reach;
  }
};

}  // namespace trace
