// Technical illustration: sides that face the light are warm, others cool, so that shape shows without dark
// shades (Gooch, Gooch, Shirley and Cohen, A Non-Photorealistic Lighting Model for Automatic Technical
// Illustration, SIGGRAPH 1998, equation 2, and Blinn's highlight).
// Not reciprocal, and no energy is kept: light from behind still gives the cool colour.
//
// Use it for technical drawings with one light, by whitted. Not where light bounces.
#pragma once

#include <string_view>

#include "math/elementary.h"
#include "shading/materials/phong.h"
#include "shading/scattering.h"

namespace trace {

struct GoochBsdf;

struct Gooch : SurfaceFields {
  static constexpr std::string_view kKeyword = "gooch";
  static constexpr std::string_view kHelp = "from cool to warm colours, as in technical illustrations";
  static constexpr bool kReciprocal = false, kKeepsEnergy = false;
  using Bsdf = GoochBsdf;

  Color diffuse{0.6}, cool{0, 0, 0.55}, warm{0.3, 0.3, 0}, specular{0.6};
  Real coolShare = 0.25, warmShare = 0.5, shininess = 60;

  static constexpr auto fields() {
    return Fields{
        Field{"diffuse", &Gooch::diffuse, "", 0, 1, "colour of the object"},
        Field{"cool", &Gooch::cool, "", 0, 1, "colour away from the light"},
        Field{"warm", &Gooch::warm, "", 0, 1, "colour towards the light"},
        Field{"cool_share", &Gooch::coolShare, "", 0, 1, "fraction of the object's colour in the cool one"},
        Field{"warm_share", &Gooch::warmShare, "", 0, 1, "fraction of the object's colour in the warm one"},
        Field{"specular", &Gooch::specular, "", 0, 1, "strength of the highlight"},
        Field{"shininess", &Gooch::shininess, "", 0, kNoLimit, "its sharpness"},
        SurfaceFields::fields()};
  }
  bool operator==(const Gooch&) const = default;

  Phong asPhong() const { return phongLike(*this, warm + diffuse * warmShare, specular, shininess); }
  GoochBsdf at(const Rules& rules) const;
};

struct GoochBsdf : LocalBsdf<GoochBsdf, Gooch> {
  static constexpr bool kTwoSided = true;  // what turns away from the light is drawn, too

  GoochBsdf() = default;
  explicit GoochBsdf(const Gooch& model) : LocalBsdf(model) {}

  Scatter value(const Vec3& eye, const Vec3& light, Transport) const {
    const Color cool = said.cool + said.diffuse * said.coolShare,
                warm = said.warm + said.diffuse * said.warmShare;
    const Vec3 half = halfway(eye, light);
    const Real facing = max(0, min(1, (1 + light.z) / 2));
    const Real spot = half.z > 0 && light.z > 0 ? math::pow(half.z, said.shininess) : 0;
    return {lerp(facing, cool, warm) / kPi, said.specular * (spot / kPi)};
  }
  Vec3 direction(const Vec3&, Real, Vec2 u) const { return sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y); }
  Real directionDensity(const Vec3&, const Vec3&) const { return 1 / (4 * kPi); }
};

inline GoochBsdf Gooch::at(const Rules&) const { return GoochBsdf(*this); }

}  // namespace trace
