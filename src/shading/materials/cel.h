// Cel shading: light falls in a few flat steps, and the highlight has a hard edge (Lake, Marshall, Harris and
// Blackstein, Stylized Rendering Techniques for Scalable Real-Time 3D Animation, NPAR 2000). A ramp gives the
// colours of the light instead, from the side away from it to full light. `--outlines` draws outlines.
// Not reciprocal. Energy: steps are rounded up, so that more than arrives may be given back.
//
// Use it for drawings, by whitted. Not where light bounces: it may give back more than arrives.
#pragma once

#include <cmath>
#include <string_view>

#include "math/elementary.h"
#include "shading/materials/phong.h"
#include "shading/scattering.h"
#include "shading/textures/pattern.h"

namespace trace {

struct CelBsdf;

struct Cel : SurfaceFields {
  static constexpr std::string_view kKeyword = "cel";
  static constexpr std::string_view kHelp = "flat steps of light with hard edges, as in drawn films";
  static constexpr bool kReciprocal = false, kKeepsEnergy = false;
  using Bsdf = CelBsdf;

  Color diffuse{0.7}, specular, shadeColor;
  ColorRamp ramp;
  int steps = 2;
  Real softness = 0.02, shade = 0;
  Real highlight = 12;

  static constexpr auto fields() {
    return Fields{
        Field{"diffuse", &Cel::diffuse, "", 0, 1, "colour in full light"},
        Field{"specular", &Cel::specular, "", 0, 1, "colour of the highlight; black has none"},
        Field{"shade_color", &Cel::shadeColor, "", 0, 1, "colour of unlit parts, which the steps blend into"},
        Field{"ramp", &Cel::ramp, "", -kNoLimit, kNoLimit,
              "((light, red, green, blue), ...): colours for increasing light from 0 to 1, in place of "
              "steps; they scale diffuse"},
        Field{"steps", &Cel::steps, "", 1, 100, "number of light steps, without the shade"},
        Field{"softness", &Cel::softness, "", 0, 1, "softness of the edges, as a fraction of a step"},
        Field{"shade", &Cel::shade, "", 0, 1, "fraction of the light on the side away from it"},
        Field{"highlight", &Cel::highlight, "degrees", 0, 90, "radius of the highlight"},
        SurfaceFields::fields()};
  }
  bool operator==(const Cel&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse, specular, specular == Color(0) ? 0 : 40); }
  CelBsdf at(const Rules& rules) const;
};

struct CelBsdf : LocalBsdf<CelBsdf, Cel> {
  static constexpr bool kTwoSided = true;  // what turns away from the light is painted, too

  CelBsdf() = default;
  explicit CelBsdf(const Cel& model) : LocalBsdf(model) {}

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.specular); }
  /// From 0 to 1 around 0, over that width.
  static Real edge(Real x, Real width) {
    if (!(width > 0)) return x > 0 ? 1 : 0;
    const Real t = max(0, min(1, x / width + 0.5));
    return t * t * (3 - 2 * t);
  }
  Scatter value(const Vec3& toEye, const Vec3& light, Transport) const {
    const Vec3 eye{toEye.x, toEye.y, std::abs(toEye.z)};
    const Real n = said.steps;
    const Real spot = light.z > 0 ? spotOf(eye, light) : 0;
    const Color highlight = said.specular * (spot / kPi);
    if (!said.ramp.empty())  // its first colour is that of the side away
      return {said.diffuse * colorAt(said.ramp, light.z) * ((1 - spot) / kPi), highlight};
    Real level = 0;  // each step begins where the even law passes the level of the step before
    for (int i = 0; i < said.steps; ++i) level += edge(light.z * n - i, max(0, said.softness)) / n;
    const Real lit = max(said.shade, level) * (1 - spot);
    Color painted = said.diffuse * (lit / kPi);
    if (!isBlack(said.shadeColor)) painted += said.shadeColor * ((1 - spot - lit) / kPi);
    return {painted, highlight};
  }
  Vec3 direction(const Vec3&, Real, Vec2 u) const { return sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y); }
  Real directionDensity(const Vec3&, const Vec3&) const { return 1 / (4 * kPi); }

 private:
  /// Inside the highlight 1.
  Real spotOf(const Vec3& eye, const Vec3& light) const {
    if (isBlack(said.specular)) return 0;
    const Real lean = math::acos(min(1, halfway(eye, light).z)) * 180 / kPi;
    return edge(said.highlight - lean, max(0, said.softness) * said.highlight);
  }
};

inline CelBsdf Cel::at(const Rules&) const { return CelBsdf(*this); }

}  // namespace trace
