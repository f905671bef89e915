// Thin cylinders too fine to be seen one by one: hair, fur, brushed threads (Kajiya and Kay, Rendering Fur
// with Three Dimensional Textures, SIGGRAPH 1989, equations 14 and 16). Strands run along the grain, which
// `angle` turns. Variant: strands that lie on a surface, whose cosine to the light is a factor; so only light
// on the eye's side counts, and it fades towards the terminator.
// Not reciprocal. Energy: gives back at most `diffuse` and `specular`, which are added.
//
// Use it for brushed threads and satin on a surface. Not for strands with a shape (marschner): it lets no
// light through.
#pragma once

#include <cmath>
#include <string_view>

#include "math/elementary.h"
#include "shading/materials/phong.h"
#include "shading/scattering.h"

namespace trace {

struct HairBsdf;

struct Hair : SurfaceFields {
  static constexpr std::string_view kKeyword = "hair";
  static constexpr std::string_view kHelp = "strands along the grain, by Kajiya and Kay";
  static constexpr bool kReciprocal = false, kKeepsEnergy = true;
  using Bsdf = HairBsdf;

  Color diffuse{0.25, 0.14, 0.06}, specular{0.5};
  Real shininess = 60, angle = 90;

  static constexpr auto fields() {
    return Fields{
        Field{"diffuse", &Hair::diffuse, "", 0, 1, "colour of the strands"},
        Field{"specular", &Hair::specular, "", 0, 1, "strength of the highlight across them"},
        Field{"shininess", &Hair::shininess, "", 0, kNoLimit, "sharpness of the highlight"},
        Field{"angle", &Hair::angle, "degrees", -360, 360,
              "angle from the direction in which u grows to that of the strands; 90 is the direction of v"},
        SurfaceFields::fields()};
  }
  bool operator==(const Hair&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse, specular, shininess); }
  HairBsdf at(const Rules& rules) const;
};

struct HairBsdf : LocalBsdf<HairBsdf, Hair> {
  HairBsdf() = default;
  explicit HairBsdf(const Hair& model) : LocalBsdf(model) {}

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.specular); }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const auto sine = [](Real cosine) { return std::sqrt(max(0, 1 - cosine * cosine)); };
    const Real sinLight = sine(light.x), sinEye = sine(eye.x);
    // The strand mirrors light into a cone around itself; cos(eye, nearest of the cone).
    const Real near = max(0, sinLight * sinEye - light.x * eye.x);
    return {said.diffuse * (sinLight * light.z / kPi),
            said.specular * (math::pow(near, said.shininess) * light.z / kPi)};
  }
};

inline HairBsdf Hair::at(const Rules&) const { return HairBsdf(*this); }

}  // namespace trace
