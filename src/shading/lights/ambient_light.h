// Light from everywhere, without shadows.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/field.h"
#include "shading/lights/illumination.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"

namespace trace {

struct AmbientLight {
  static constexpr std::string_view kKeyword = "ambient_light";
  static constexpr std::string_view kHelp = "light from everywhere, without shadows; all of them are added";
  static constexpr LightOrigin kStarts = LightOrigin::none;

  Color color{};

  static constexpr auto fields() {
    return Fields{Field{"color", &AmbientLight::color, "", 0, kNoLimit, "its intensity"}};
  }
  bool operator==(const AmbientLight&) const = default;
  bool hasSize() const { return false; }

  std::optional<Illumination> illuminate(const Vec3&, const Rules&, const Vec2& = kCenter) const {
    return {};
  }
  LightReach reach(const Rules&) const { return {}; }
};

}  // namespace trace
