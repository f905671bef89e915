// Anisotropic Phong with Fresnel's effect on a matt base (Ashikhmin and Shirley, An Anisotropic Phong BRDF
// Model, Journal of Graphics Tools 5(2), 2000).
// Reciprocal. Energy: gives back at most what arrives.
//
// Use it to reproduce work that has it: varnished wood with grain, satin. Not for new scenes of metal or
// plastic: conductor and coated keep all light.
#pragma once

#include <string_view>

#include "math/elementary.h"
#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/scattering.h"

namespace trace {

struct AshikhminShirleyBsdf;

struct AshikhminShirley : SurfaceFields {
  static constexpr std::string_view kKeyword = "ashikhmin_shirley";
  static constexpr std::string_view kHelp =
      "anisotropic highlight with Fresnel's effect on a diffuse base, by Ashikhmin and Shirley";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = AshikhminShirleyBsdf;

  Color diffuse{0.5}, specular{0.05};
  Real shininess = 10, shininessAcross = 100, angle = 0;

  static constexpr auto fields() {
    return Fields{Field{"diffuse", &AshikhminShirley::diffuse, "", 0, 1, "colour of the diffuse base"},
                  Field{"specular", &AshikhminShirley::specular, "", 0, 1, "reflectance along the normal"},
                  Field{"shininess", &AshikhminShirley::shininess, "", 0, kNoLimit,
                        "sharpness of the highlight along the direction in which u grows"},
                  Field{"shininess_across", &AshikhminShirley::shininessAcross, "", 0, kNoLimit, "across it"},
                  Field{"angle", &AshikhminShirley::angle, "degrees", -360, 360, "rotates these directions"},
                  SurfaceFields::fields()};
  }
  bool operator==(const AshikhminShirley&) const = default;

  Phong asPhong() const {
    return phongLike(*this, diffuse, specular, std::sqrt(shininess * shininessAcross));
  }
  AshikhminShirleyBsdf at(const Rules& rules) const;
};

struct AshikhminShirleyBsdf : LocalBsdf<AshikhminShirleyBsdf, AshikhminShirley> {
  Real nu = 0, nv = 0;
  static constexpr Real kLobe = 0.5;  ///< how often `direction` follows the highlight

  AshikhminShirleyBsdf() = default;
  explicit AshikhminShirleyBsdf(const AshikhminShirley& model) : LocalBsdf(model) {
    nu = max(0, model.shininess);
    nv = max(0, model.shininessAcross);
  }

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.specular); }
  Real powerAt(const Vec3& half) const {
    const Real flat = half.x * half.x + half.y * half.y;
    return flat > 0 ? (nu * half.x * half.x + nv * half.y * half.y) / flat : nu;
  }
  /// The density of half-way vectors (equation 7).
  Real halfDensity(const Vec3& half) const {
    return std::sqrt((nu + 1) * (nv + 1)) / (2 * kPi) * math::pow(std::abs(half.z), powerAt(half));
  }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real facing = dot(eye, half);
    Scatter parts;
    if (facing > 0)  // equation 4
      parts.specular = schlick(facing, said.specular) *
                       (halfDensity(half) / (4 * facing) * (light.z / max(eye.z, light.z)));
    const auto hidden = [](Real cosine) {
      const Real c = 1 - cosine / 2;
      return 1 - c * c * c * c * c;
    };
    const Color base = said.diffuse * (Color(1) + said.specular * -1);  // equation 5
    parts.diffuse = base * (28 / (23 * kPi) * hidden(eye.z) * hidden(light.z) * light.z);
    return parts;
  }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    if (choose >= kLobe) return cosineDirection(u);
    // Equations 9 and 10, by quarters of the circle.
    const Real quarter = std::floor(u.x * 4), within = u.x * 4 - quarter;
    const bool backwards = quarter == 1 || quarter == 3;
    const Real v = backwards ? 1 - within : within;
    Real phi = math::atan(std::sqrt((nu + 1) / (nv + 1)) * math::tan(kPi * v / 2));
    if (backwards) phi = kPi - phi;
    if (quarter >= 2) phi += kPi;
    const auto [s, c] = math::sincos(phi);
    const Real cosine = math::pow(1 - u.y, 1 / (nu * c * c + nv * s * s + 1));
    return mirroredAt(sphericalDirection(cosine, phi), eye);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real facing = dot(eye, half);
    const Real lobe = facing > 0 ? halfDensity(half) / (4 * facing) : 0;
    return kLobe * lobe + (1 - kLobe) * cosineDensity(light);
  }
};

inline AshikhminShirleyBsdf AshikhminShirley::at(const Rules&) const { return AshikhminShirleyBsdf(*this); }

}  // namespace trace
