// Frosted and ground glass: microfacets that mirror and refract by Fresnel's exact formula (Walter,
// Marschner, Li and Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007, equations
// 16, 17, 20 and 21). Variant: height-correlated masking (Heitz, JCGT 3(2), 2014), visible normals are
// chosen, and one of the two rays by the mirrored share. Reciprocal in the sense of light that changes its
// medium: f(a, b) / n_b^2 = f(b, a) / n_a^2. Energy: what hits several facets is lost, a few percent of
// light on glass of roughness 0.5, unless it is `compensated`: then it is spread evenly to both sides (Kulla
// and Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017 course), as much to each as
// reciprocity and Fresnel's mean ask.
//
// Outside it is air. Under Whitted's equation one mirrored and one refracted ray stand for the facets that
// lean less than 5 degrees, and lamps are seen in the rest; `--glossy` follows the rest too.
//
// Use it for frosted glass, ice, a ground rim. Not for clear glass by whitted, where phong with an index
// casts the courses' shadow, nor for a pane without a thickness (thin_glass).
#pragma once

#include <string_view>

#include "shading/interior.h"
#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/glass_albedo.h"
#include "shading/optics/microfacet.h"

namespace trace {

struct RoughGlassBsdf;

struct RoughGlass : SurfaceFields, Interior {
  static constexpr std::string_view kKeyword = "rough_glass";
  static constexpr std::string_view kHelp = "frosted or clear glass, by microfacets that refract";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = RoughGlassBsdf;

  Color color{1};
  Real index = 1.5, roughness = 0.4;
  Distribution distribution = Distribution::ggx;
  bool compensated = false;

  static constexpr auto fields() {
    return Fields{Field{"color", &RoughGlass::color, "", 0, 1, "transmittance of the surface"},
                  Field{"index", &RoughGlass::index, "", 0, kNoLimit, "index of refraction"},
                  Field{"roughness", &RoughGlass::roughness, "", 0, 1,
                        "from 0, clear glass, to 1; the slope width of the facets is its square"},
                  Field{"distribution", &RoughGlass::distribution, "", 0, kNoLimit,
                        "distribution of the facets' slopes"},
                  Field{"compensated", &RoughGlass::compensated, "", 0, 1,
                        "multiple scattering between facets is not lost"},
                  SurfaceFields::fields(),
                  Interior::fields()};
  }
  bool operator==(const RoughGlass&) const = default;

  Phong asPhong() const {
    Phong phong = phongLike(*this, Color(0), Color(0.5), 200);
    phong.reflective = Color(mirroredAlongNormal(index));
    phong.transmissive = color;
    phong.index = index;
    static_cast<Interior&>(phong) = *this;
    return phong;
  }
  RoughGlassBsdf at(const Rules& rules) const;
};

struct RoughGlassBsdf : LocalBsdf<RoughGlassBsdf, RoughGlass> {
  static constexpr bool kTwoSided = true, kHasInside = true;

  Microfacets facets;
  GlassLoss loss;  ///< loss of light that hits several facets, where it is compensated

  RoughGlassBsdf() = default;
  explicit RoughGlassBsdf(const RoughGlass& model) : LocalBsdf(model) {
    index = model.index;
    transmissive = model.color;
    fill(model, model.index);
    passage = Passage::byFresnel;
    if (scatters()) {
      facets = Microfacets::of(model.distribution, model.roughness);
      sharp = facets.sharpShare();
      if (model.compensated) loss = {model.distribution, facets.x, model.index};
    }
    reflective = Color(mirroredAlongNormal(index) * sharp);
  }

  /// Glass of index 1 is no glass.
  bool scatters() const { return said.roughness > 0 && said.index > 0 && said.index != 1; }
  bool mirrorIsExact() const { return !scatters(); }

  Scatter value(const Vec3& eyeGiven, const Vec3& lightGiven, Transport transport) const {
    const Turned at(*this, eyeGiven, lightGiven);
    const auto& [eye, light, eta] = at;
    if (!(eye.z > 0) || light.z == 0) return {};
    const Real several = loss.none() ? 0 : loss.value(eyeGiven.z, lightGiven.z);
    if (light.z > 0) {
      const Vec3 half = halfway(eye, light);
      return {{},
              Color(fresnelDielectric(dot(eye, half), 1, eta) * facets.mirrored(eye, light, half) + several)};
    }
    Real f = several;
    if (const Bend bend(eye, light, eta); bend.possible) {
      const Real seen = facets.seenAndLit(eye, {light.x, light.y, -light.z});
      f += (1 - fresnelDielectric(bend.eye, 1, eta)) * facets.spread(bend.half) * seen * bend.eye / eye.z *
           bend.density;
    }
    if (transport == Transport::radiance) f /= eta * eta;
    return {{}, said.color * f};
  }
  Vec3 direction(const Vec3& eyeGiven, Real choose, Vec2 u) const {
    const Turned at(*this, eyeGiven, eyeGiven);
    const auto& [eye, same, eta] = at;
    if (!loss.none()) {
      const Real several = loss.of(eyeGiven.z);
      if (choose < several) {
        const bool passes = choose < several * loss.passes(eyeGiven.z), below = passes == (eyeGiven.z > 0);
        const Vec3 light = loss.direction(below, u);
        return below ? Vec3{light.x, light.y, -light.z} : light;
      }
      choose = (choose - several) / (1 - several);
    }
    const Vec3 half = facets.chosen(eye, u);
    const bool mirrors = choose < fresnelDielectric(dot(eye, half), 1, eta);
    const Vec3 light = mirrors ? mirroredAt(half, eye) : refractedAt(half, eye, eta);
    return eyeGiven.z < 0 ? Vec3{light.x, light.y, -light.z} : light;
  }
  Real directionDensity(const Vec3& eyeGiven, const Vec3& lightGiven) const {
    const Turned at(*this, eyeGiven, lightGiven);
    const auto& [eye, light, eta] = at;
    if (!(eye.z > 0)) return 0;
    Real sum = fresnelDielectric(dot(eye, halfway(eye, light)), 1, eta) * facets.density(eye, light);
    if (const Bend bend(eye, light, eta); bend.possible)
      sum += (1 - fresnelDielectric(bend.eye, 1, eta)) * facets.visible(eye, bend.half) * bend.density;
    if (loss.none()) return sum;
    const Real several = loss.of(eyeGiven.z), passes = loss.passes(eyeGiven.z);
    return (1 - several) * sum + several * (light.z > 0 ? 1 - passes : passes) * loss.density(lightGiven.z);
  }

 private:
  /// Directions as if the eye were outside: z is on the eye's side. eta = index behind / index before.
  struct Turned {
    Vec3 eye, light;
    Real eta;
    Turned(const RoughGlassBsdf& bsdf, const Vec3& toEye, const Vec3& toLight)
        : eye(toEye), light(toLight), eta(bsdf.said.index) {
      if (eye.z < 0) {
        eye.z = -eye.z;
        light.z = -light.z;
        eta = 1 / eta;
      }
    }
  };
  /// The facet that refracts light to the eye.
  struct Bend {
    bool possible = false;
    Vec3 half;
    Real eye = 0;      ///< cosine of the eye to the facet
    Real density = 0;  ///< facets per direction of the light: the Jacobian, equation 17
    Bend(const Vec3& toEye, const Vec3& toLight, Real eta) {
      const Vec3 sum = (toEye + toLight * eta) * (eta > 1 ? -1 : 1);
      const Real l = length(sum);
      if (!(l > 0)) return;
      half = sum / l;
      eye = dot(toEye, half);
      const Real light = dot(toLight, half), below = eye + eta * light;
      possible = eye > 0 && light < 0 && half.z > 0 && below != 0;
      if (possible) density = eta * eta * -light / (below * below);
    }
  };
};

inline RoughGlassBsdf RoughGlass::at(const Rules&) const { return RoughGlassBsdf(*this); }

}  // namespace trace
