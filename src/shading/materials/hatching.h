// Pen and ink: paper where light is brighter than a screen, ink where it is darker (ordered dither, Bayer
// 1973, with a drawing for a screen). `screen` is meant to have a texture: of waves it makes strokes, which
// grow thicker as it gets darker; of two crossed waves it hatches crosswise; of spots it makes the dots of
// printed pictures (after Praun, Hoppe, Webb and Finkelstein, Real-Time Hatching, SIGGRAPH 2001, whose
// strokes are pictures). Meant for one light. Not reciprocal, and no energy is kept: paper is as bright under
// any angle.
//
// Use it for drawings with one light, by whitted. Not where light bounces.
#pragma once

#include <cmath>
#include <string_view>

#include "shading/materials/phong.h"
#include "shading/scattering.h"
#include "shading/textures/pattern.h"

namespace trace {

struct HatchingBsdf;

struct Hatching : SurfaceFields {
  static constexpr std::string_view kKeyword = "hatching";
  static constexpr std::string_view kHelp = "pen and ink: strokes or dots by a texture, thicker in the shade";
  static constexpr bool kReciprocal = false, kKeepsEnergy = false;
  using Bsdf = HatchingBsdf;

  Color paper{0.95, 0.93, 0.88}, ink{0.05, 0.05, 0.08};
  Real screen = 0.5, softness = 0.1, gain = 1;

  static constexpr auto fields() {
    return Fields{Field{"paper", &Hatching::paper, "", 0, 1, "colour of the paper"},
                  Field{"ink", &Hatching::ink, "", 0, 1, "colour of the strokes"},
                  Field{"screen", &Hatching::screen, "", 0, kNoLimit,
                        "light below which there is ink, usually a texture from 0 to 1"},
                  Field{"softness", &Hatching::softness, "", 0, 1, "width of the edges of strokes"},
                  Field{"gain", &Hatching::gain, "", 0, kNoLimit, "factor on the light, before the screen"},
                  SurfaceFields::fields()};
  }
  bool operator==(const Hatching&) const = default;

  Phong asPhong() const { return phongLike(*this, paper); }
  HatchingBsdf at(const Rules& rules) const;
};

struct HatchingBsdf : LocalBsdf<HatchingBsdf, Hatching> {
  static constexpr bool kTwoSided = true;  // what turns away from the light is drawn, too

  HatchingBsdf() = default;
  explicit HatchingBsdf(const Hatching& model) : LocalBsdf(model) {}

  Scatter value(const Vec3& eye, const Vec3& light, Transport) const {
    const Real facing = eye.z < 0 ? -light.z : light.z, lit = max(0, facing) * said.gain;
    const Real over = lit - said.screen, width = said.softness;
    const Real bare = width > 0 ? smoothStep(over / width + 0.5) : over > 0 ? 1 : 0;
    return {lerp(bare, said.ink, said.paper) / kPi, {}};
  }
  Vec3 direction(const Vec3&, Real, Vec2 u) const { return sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y); }
  Real directionDensity(const Vec3&, const Vec3&) const { return 1 / (4 * kPi); }
};

inline HatchingBsdf Hatching::at(const Rules&) const { return HatchingBsdf(*this); }

}  // namespace trace
