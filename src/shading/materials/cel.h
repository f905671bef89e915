// Cel shading: light falls in a few flat steps, and the highlight has a hard edge (Lake, Marshall, Harris and
// Blackstein, Stylized Rendering Techniques for Scalable Real-Time 3D Animation, NPAR 2000).
// Not reciprocal. Energy: steps are rounded up, so that more than arrives may be given back.
#pragma once

#include <cmath>
#include <string_view>

#include "shading/materials/phong.h"
#include "shading/scattering.h"

namespace trace {

struct CelBsdf;

struct Cel : SurfaceFields {
  static constexpr std::string_view kKeyword = "cel";
  static constexpr std::string_view kHelp = "flat steps of light with hard edges, as in drawn films";
  static constexpr bool kReciprocal = false, kKeepsEnergy = false;
  using Bsdf = CelBsdf;

  Color diffuse{0.7}, specular;
  int steps = 2;
  Real softness = 0.02, shade = 0;
  Real highlight = 12;

  static constexpr auto fields() {
    return after(Field{"diffuse", &Cel::diffuse, "", 0, 1, "colour in full light"},
                 Field{"specular", &Cel::specular, "", 0, 1, "colour of the highlight; black has none"},
                 Field{"steps", &Cel::steps, "", 1, 100, "of light, besides the shade"},
                 Field{"softness", &Cel::softness, "", 0, 1, "of the edges, as a share of a step"},
                 Field{"shade", &Cel::shade, "", 0, 1, "share of the light that the side away from it gets"},
                 Field{"highlight", &Cel::highlight, "degrees", 0, 90, "radius of the highlight"});
  }
  bool operator==(const Cel&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse, specular, specular == Color(0) ? 0 : 40); }
  CelBsdf at(const Rules& rules) const;
};

struct CelBsdf : LocalBsdf<CelBsdf, Cel> {
  CelBsdf() = default;
  explicit CelBsdf(const Cel& model) : LocalBsdf(model) {}

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.specular); }
  /// From 0 to 1 around 0, over that width.
  static Real edge(Real x, Real width) {
    if (!(width > 0)) return x > 0 ? 1 : 0;
    const Real t = max(0, min(1, x / width + 0.5));
    return t * t * (3 - 2 * t);
  }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const Real n = said.steps;
    Real level = 0;  // each step begins where the even law passes the level of the step before
    for (int i = 0; i < said.steps; ++i) level += edge(light.z * n - i, max(0, said.softness)) / n;
    const Vec3 half = halfway(eye, light);
    const Real lean = std::acos(min(1, half.z)) * 180 / kPi;
    const Real spot =
        isBlack(said.specular) ? 0 : edge(said.highlight - lean, max(0, said.softness) * said.highlight);
    const Real lit = max(said.shade, level) * (1 - spot);
    return {said.diffuse * (lit / kPi), said.specular * (spot / kPi)};
  }
};

inline CelBsdf Cel::at(const Rules&) const { return CelBsdf(*this); }

}  // namespace trace
