// A lamp whose intensities were measured, by direction, with a goniophotometer: a file of lighting makers
// (IES LM-63) says them.
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
#include "shading/lights/photometry.h"

namespace trace {

struct GoniometricLight {
  static constexpr std::string_view kKeyword = "goniometric_light";
  static constexpr std::string_view kHelp =
      "measured light from a point, by an IES file; attenuated like a point light";
  static constexpr LightOrigin kStarts = LightOrigin::ball;

  Vec3 position{};
  Vec3 direction{0, -1, 0};
  Color color{};
  PhotometryFile file{};
  Vec3 up{0, 0, 1};
  Real perCandela = 0;
  Real constant = 0, linear = 0, quadratic = 1;
  Real radius = 0;

  static constexpr auto fields() {
    return Fields{Field{"position", &GoniometricLight::position, "", -kNoLimit, kNoLimit, "where it is"},
                  Field{"direction", &GoniometricLight::direction, "", -kNoLimit, kNoLimit,
                        "direction of the file's angles 0: for most luminaires straight down"},
                  Field{"color", &GoniometricLight::color, "", 0, kNoLimit,
                        "its intensity in the brightest direction, or the colour that per_candela scales"},
                  Field{"file", &GoniometricLight::file, "", -kNoLimit, kNoLimit,
                        "an IES file (LM-63); without one the light is uniform in all directions"},
                  Field{"up", &GoniometricLight::up, "", -kNoLimit, kNoLimit,
                        "direction of the horizontal angle 0 (types A and B: the up direction)"},
                  Field{"per_candela", &GoniometricLight::perCandela, "", 0, kNoLimit,
                        "a factor for each candela of the file; 0 scales the brightest direction to 1"},
                  fadingFields<GoniometricLight>(),
                  ballField<GoniometricLight>()};
  }
  bool operator==(const GoniometricLight&) const = default;
  bool hasSize() const { return radius > 0; }

  /// By which the file's candelas become factors of the colour.
  Real scale() const {
    if (perCandela > 0) return perCandela;
    const Real brightest = file.data ? file.data->brightest() : 0;
    return brightest > 0 ? 1 / brightest : 0;
  }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    std::optional<Illumination> arriving = fromPlace(*this, p, rules);
    if (!arriving) return {};
    if (file.data) {
      const AimFrame aim(direction, up);
      // As seen along the direction the horizontal angle grows to the left.
      const Vec3& to = arriving->toLight;
      const Real candelas = file.data->at({-dot(to, aim.up), dot(to, aim.right), -dot(to, aim.ahead)});
      if (!(candelas > 0)) return {};
      arriving->attenuation *= candelas * scale();
    }
    towardBall(*arriving, radius, u);
    return arriving;
  }
  LightReach reach(const Rules& rules) const {
    LightReach reach = reachOfLamp(*this, rules);
    if (file.data) {
      reach.axis = normalize(direction);
      reach.around = file.data->widest();
      const Real brightest = file.data->brightest() * scale();
      reach.power *= brightest;
      reach.most = max(reach.most, 1) * max(brightest, 1);
    }
    return reach;
  }
};

}  // namespace trace
