// An opening through which light comes in from around the scene: it gives none of its own, but tells a path
// tracer where to look for it.
#pragma once

#include <optional>
#include <string_view>

#include "base/field.h"
#include "shading/lights/illumination.h"
#include "shading/lights/light_geometry.h"
#include "shading/lights/light_reach.h"

namespace trace {

struct Portal {
  static constexpr std::string_view kKeyword = "portal";
  static constexpr std::string_view kHelp =
      "a window to the environment, which is sampled through it; it emits nothing";
  static constexpr LightOrigin kStarts = LightOrigin::none;

  Vec3 position{};
  Vec3 u{1, 0, 0}, v{0, 1, 0};

  static constexpr auto fields() {
    return Fields{Field{"position", &Portal::position, "", -kNoLimit, kNoLimit, "its middle"},
                  Field{"u", &Portal::u, "", -kNoLimit, kNoLimit, "first edge, the whole of it"},
                  Field{"v", &Portal::v, "", -kNoLimit, kNoLimit, "second edge"}};
  }
  bool operator==(const Portal&) const = default;
  bool hasSize() const { return false; }

  std::optional<Illumination> illuminate(const Vec3&, const Rules&, const Vec2& = kCenter) const {
    return {};
  }
  LightReach reach(const Rules&) const { return {}; }
};

}  // namespace trace
