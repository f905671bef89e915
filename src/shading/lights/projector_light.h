// A slide projector: a picture, thrown from a point through a pyramid (Pharr, Jakob and Humphreys, Physically
// Based Rendering, 4th edition, 2023, section 12.2.2).
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
#include "shading/pixels.h"

namespace trace {

struct ProjectorLight {
  static constexpr std::string_view kKeyword = "projector_light";
  static constexpr std::string_view kHelp = "a picture projected from a point, as by a slide projector";
  static constexpr LightOrigin kStarts = LightOrigin::ball;

  Vec3 position{};
  Vec3 direction{0, 0, -1};
  Color color{};
  Pixels file{};
  Vec3 up{0, 1, 0};
  Real fov = 40;
  Real aspectRatio = 0;
  bool srgb = false;
  TexelFilter filter = TexelFilter::bilinear;
  Real blur = 0;
  Real constant = 1, linear = 0, quadratic = 0;
  Real radius = 0;

  static constexpr auto fields() {
    return Fields{
        Field{"position", &ProjectorLight::position, "", -kNoLimit, kNoLimit, "where it is"},
        Field{"direction", &ProjectorLight::direction, "", -kNoLimit, kNoLimit,
              "direction of the picture's middle"},
        Field{"color", &ProjectorLight::color, "", 0, kNoLimit, "the intensity of white"},
        Field{"file", &ProjectorLight::file, "", -kNoLimit, kNoLimit,
              "the picture; without one it projects a white frame"},
        Field{"up", &ProjectorLight::up, "", -kNoLimit, kNoLimit, "direction of the picture's upper edge"},
        Field{"fov", &ProjectorLight::fov, "degrees", 0, 180, "vertical angle of the picture"},
        Field{"aspectratio", &ProjectorLight::aspectRatio, "", 0, kNoLimit,
              "width / height of the projection; 0 takes that of the picture"},
        Field{"srgb", &ProjectorLight::srgb, "", 0, 1,
              "its numbers are sRGB and are made linear; otherwise they are used unchanged"},
        Field{"filter", &ProjectorLight::filter, "", -kNoLimit, kNoLimit,
              "texture filter; trilinear and ewa average over the blur"},
        Field{"blur", &ProjectorLight::blur, "", 0, 1, "defocus, as a fraction of the picture's height"},
        fadingFields<ProjectorLight>(),
        ballField<ProjectorLight>()};
  }
  bool operator==(const ProjectorLight&) const = default;
  bool hasSize() const { return radius > 0; }

  /// How much lies between 0 and 1 of a stretch of that length around x: the frame blurs as the picture does.
  static Real within(Real x, Real length) {
    if (!(length > 0)) return x >= 0 && x <= 1 ? 1 : 0;
    return std::clamp((std::min(x + length / 2, 1.0) - std::max(x - length / 2, 0.0)) / length, 0.0, 1.0);
  }

  /// Half the width and height of the picture at distance 1.
  Vec2 half() const {
    const Real high = math::tan(fov * kPi / 360);
    const Real aspect = aspectRatio > 0 ? aspectRatio
                        : file.map      ? static_cast<Real>(file.map->width()) / file.map->height()
                                        : 1;
    return {high * aspect, high};
  }

  std::optional<Illumination> illuminate(const Vec3& p, const Rules& rules, const Vec2& u = kCenter) const {
    std::optional<Illumination> arriving = fromPlace(*this, p, rules);
    if (!arriving) return {};
    const AimFrame aim(direction, up);
    const Real ahead = -dot(arriving->toLight, aim.ahead);
    if (!(ahead > 0)) return {};
    const Vec2 half = this->half();
    const Vec2 uv{0.5 - dot(arriving->toLight, aim.right) / (2 * half.x * ahead),
                  0.5 - dot(arriving->toLight, aim.up) / (2 * half.y * ahead)};
    const Real across = blur * half.y / half.x;  // relative to the picture's width
    const Real inFrame = within(uv.x, across) * within(uv.y, blur);
    if (!(inFrame > 0)) return {};
    arriving->attenuation *= inFrame;
    if (file.map) {
      const Texel texel = file.map->at(uv, {.u = Wrap::clamp,
                                            .v = Wrap::clamp,
                                            .filter = filter,
                                            .srgb = srgb,
                                            .uvX = {across, 0},
                                            .uvY = {0, blur}});
      arriving->color = arriving->color * (texel.color * texel.alpha);
    }
    towardBall(*arriving, radius, u);
    return arriving;
  }
  LightReach reach(const Rules& rules) const {
    LightReach reach = reachOfLamp(*this, rules);
    reach.axis = normalize(direction);
    const Vec2 half = this->half();
    reach.around = math::atan(math::hypot(half.x + blur * half.y, half.y * (1 + blur)));
    return reach;
  }
};

}  // namespace trace
