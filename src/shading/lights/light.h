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
#include "shading/materials/phong.h"

namespace trace {

struct Illumination {
  Vec3 toLight;            ///< unit
  Real distance;           ///< beyond it nothing casts a shadow; infinite for directional lights
  Color color;             ///< of the source
  Real attenuation = 1;    ///< by distance
  Color extraHighlight{};  ///< added to `color` in highlights
  Color intensity() const { return color * attenuation; }
  /// What a surface gives back that scatters so.
  Color scattered(const Scatter& scatter) const {
    return intensity() * scatter.sum() + extraHighlight * attenuation * scatter.specular;
  }
};

struct PointLight {
  static constexpr std::string_view kKeyword = "point_light";
  static constexpr std::string_view kHelp =
      "light from a point, attenuated by 1 / (a + b d + c d^2) at distance d";

  Vec3 position{};
  Color color{};
  Real constant = 0, linear = 0, quadratic = 1;
  Color extraHighlight{};

  static constexpr auto fields() {
    return std::tuple{Field{"position", &PointLight::position, "", -kNoLimit, kNoLimit, "where it is"},
                      Field{"color", &PointLight::color, "", 0, kNoLimit, "its intensity"},
                      Field{"constant_attenuation_coeff", &PointLight::constant, "", 0, kNoLimit, "a"},
                      Field{"linear_attenuation_coeff", &PointLight::linear, "", 0, kNoLimit, "b"},
                      Field{"quadratic_attenuation_coeff", &PointLight::quadratic, "", 0, kNoLimit, "c"},
                      Field{"extra_highlight", &PointLight::extraHighlight, "", -kNoLimit, kNoLimit,
                            "added to color in highlights"}};
  }
  bool operator==(const PointLight&) const = default;

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules) const {
    const Vec3 d = position - p;
    const Real l = length(d);
    if (!(l > 0)) return {};
    const Real attenuation = 1 / (constant + linear * l + quadratic * l * l);
    return Illumination{d / l, l, color, rules.limitAttenuation ? std::min(1.0, attenuation) : attenuation,
                        extraHighlight};
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

  std::optional<Illumination> illuminate(const Vec3&, const Rules&) const {
    return Illumination{normalize(-direction), kInfinity, color};
  }
};

struct SpotLight {
  static constexpr std::string_view kKeyword = "spot_light";
  static constexpr std::string_view kHelp =
      "light from a point into a cone, attenuated as that of a point light";

  Vec3 position{};
  Vec3 direction{0, 0, -1};
  Color color{};
  Real angle = 45,
       fullAngle = 45;  ///< half angles of the cone, and of the part where it does not fade; degrees
  Real exponent = 0;
  Real constant = 1, linear = 0, quadratic = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"position", &SpotLight::position, "", -kNoLimit, kNoLimit, "where it is"},
        Field{"direction", &SpotLight::direction, "", -kNoLimit, kNoLimit, "where the cone's axis points to"},
        Field{"color", &SpotLight::color, "", 0, kNoLimit, "its intensity on the axis"},
        Field{"angle", &SpotLight::angle, "degrees", 0, 180, "between the axis and the side of the cone"},
        Field{"full_angle", &SpotLight::fullAngle, "degrees", 0, 180,
              "from here to the side of the cone the light falls off to nothing, by degrees"},
        Field{"exponent", &SpotLight::exponent, "", 0, kNoLimit, "of the cosine to the axis, a factor"},
        Field{"constant_attenuation_coeff", &SpotLight::constant, "", 0, kNoLimit, "a"},
        Field{"linear_attenuation_coeff", &SpotLight::linear, "", 0, kNoLimit, "b"},
        Field{"quadratic_attenuation_coeff", &SpotLight::quadratic, "", 0, kNoLimit, "c"}};
  }
  bool operator==(const SpotLight&) const = default;

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules) const {
    const Vec3 d = position - p;
    const Real l = length(d);
    if (!(l > 0)) return {};
    const Real cosine = std::clamp(-dot(d, normalize(direction)) / l, -1.0, 1.0);
    const Real off = std::acos(cosine) * 180 / kPi;
    if (off > angle) return {};
    const Real attenuation = 1 / (constant + linear * l + quadratic * l * l);
    Real factor = rules.limitAttenuation ? std::min(1.0, attenuation) : attenuation;
    if (exponent > 0) factor *= std::pow(std::max(0.0, cosine), exponent);
    if (off > fullAngle) factor *= (angle - off) / (angle - fullAngle);
    return Illumination{d / l, l, color, factor, {}};
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

  std::optional<Illumination> illuminate(const Vec3&, const Rules&) const { return {}; }
};

using Light = std::variant<PointLight, DirectionalLight, SpotLight, AmbientLight>;

}  // namespace trace
