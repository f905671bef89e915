// A sun: light from infinitely far away.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "math/elementary.h"
#include "shading/lights/illumination.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"

namespace trace {

struct DirectionalLight {
  static constexpr std::string_view kKeyword = "directional_light";
  static constexpr std::string_view kHelp = "parallel light from infinitely far away";
  static constexpr LightOrigin kStarts = LightOrigin::parallel;

  Vec3 direction{0, 0, -1};
  Color color{};
  Real size = 0;

  static constexpr auto fields() {
    return Fields{Field{"direction", &DirectionalLight::direction, "", -kNoLimit, kNoLimit,
                        "the direction in which its light travels"},
                  Field{"color", &DirectionalLight::color, "", 0, kNoLimit, "its intensity"},
                  Field{"size", &DirectionalLight::size, "degrees", 0, 180,
                        "its angular diameter: the sun has 0.53; above 0 its shadows are soft"}};
  }
  bool operator==(const DirectionalLight&) const = default;
  bool hasSize() const { return size > 0; }

  std::optional<Illumination> illuminate(const Vec3&, const Rules&, const Vec2& u = kCenter) const {
    Illumination arriving{normalize(-direction), kInfinity, color};
    if (size > 0) arriving.toLight = toCone(u, arriving.toLight, math::cos(size * kPi / 360));
    return arriving;
  }
  LightReach reach(const Rules&) const {
    LightReach reach;
    reach.axis = normalize(direction);
    reach.power = strengthOf(color);
    reach.everywhere = true;
    return reach;
  }
};

}  // namespace trace
