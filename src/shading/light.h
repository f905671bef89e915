// THE list of lights. A light tells, for a point, where its light comes from and how much arrives there
// if nothing is in the way. Lights are not affected by transforms and are not seen as objects.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

#include "base/field.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

struct Illumination {
  Vec3 toLight;          ///< unit
  Real distance;         ///< beyond it nothing casts a shadow; infinite for directional lights
  Color color;           ///< of the source
  Real attenuation = 1;  ///< by distance
  Color intensity() const { return color * attenuation; }
};

struct PointLight {
  static constexpr std::string_view kKeyword = "point_light";
  static constexpr std::string_view kHelp =
      "light from a point, attenuated by 1 / (a + b d + c d^2) at distance d";

  Vec3 position{};
  Color color{};
  Real constant = 0, linear = 0, quadratic = 1;

  static constexpr auto fields() {
    return std::tuple{Field{"position", &PointLight::position, "", -kNoLimit, kNoLimit, "where it is"},
                      Field{"color", &PointLight::color, "", 0, kNoLimit, "its intensity"},
                      Field{"constant_attenuation_coeff", &PointLight::constant, "", 0, kNoLimit, "a"},
                      Field{"linear_attenuation_coeff", &PointLight::linear, "", 0, kNoLimit, "b"},
                      Field{"quadratic_attenuation_coeff", &PointLight::quadratic, "", 0, kNoLimit, "c"}};
  }
  bool operator==(const PointLight&) const = default;

  bool atMostOne = true;  ///< attenuation never amplifies; set by compile() from the conventions

  std::optional<Illumination> illuminate(const Vec3& p) const {
    const Vec3 d = position - p;
    const Real l = length(d);
    if (!(l > 0)) return {};
    const Real attenuation = 1 / (constant + linear * l + quadratic * l * l);
    return Illumination{d / l, l, color, atMostOne ? std::min(1.0, attenuation) : attenuation};
  }
};

struct DirectionalLight {
  static constexpr std::string_view kKeyword = "directional_light";
  static constexpr std::string_view kHelp = "parallel light from infinitely far away";

  Vec3 direction{0, 0, -1};
  Color color{};

  static constexpr auto fields() {
    return std::tuple{Field{"direction", &DirectionalLight::direction, "", -kNoLimit, kNoLimit,
                            "where its light travels to"},
                      Field{"color", &DirectionalLight::color, "", 0, kNoLimit, "its intensity"}};
  }
  bool operator==(const DirectionalLight&) const = default;

  std::optional<Illumination> illuminate(const Vec3&) const {
    return Illumination{normalize(-direction), kInfinity, color};
  }
};

struct AmbientLight {
  static constexpr std::string_view kKeyword = "ambient_light";
  static constexpr std::string_view kHelp = "light from everywhere, without shadows; all of them are added";

  Color color{};

  static constexpr auto fields() {
    return std::tuple{Field{"color", &AmbientLight::color, "", 0, kNoLimit, "its intensity"}};
  }
  bool operator==(const AmbientLight&) const = default;

  std::optional<Illumination> illuminate(const Vec3&) const { return {}; }
};

using Light = std::variant<PointLight, DirectionalLight, AmbientLight>;

}  // namespace trace
