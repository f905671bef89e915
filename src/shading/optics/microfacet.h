// Surfaces of tiny mirrors: how their normals are spread, what of them is seen, and a mirror chosen from
// those that are (Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007; Heitz,
// Understanding the Masking-Shadowing Function, JCGT 3(2), 2014). In the space of a Basis.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "math/elementary.h"
#include "math/vec.h"
#include "shading/scattering.h"

namespace trace {

enum class Distribution { ggx, beckmann };
constexpr std::array<std::string_view, 2> names(Distribution) { return {"ggx", "beckmann"}; }

struct Microfacets {
  Distribution kind = Distribution::ggx;
  Real x = 0.25, y = 0.25;  ///< width of the slopes along and across the grain, above 0

  /// The facets of a roughness as a person gives it, which is the root of the width (Burley, Physically-Based
  /// Shading at Disney, SIGGRAPH 2012 course, section 5.4). `anisotropy` from 0 to 1 draws the highlight out
  /// along the grain.
  static Microfacets of(Distribution kind, Real roughness, Real anisotropy = 0) {
    constexpr Real kLeast = 1e-4;  // narrower lobes would overflow
    const Real width = roughness * roughness, aspect = std::sqrt(1 - 0.9 * min(1, max(0, anisotropy)));
    return {kind, max(kLeast, width / aspect), max(kLeast, width * aspect)};
  }

  /// The density of normals, per solid angle and area of the whole surface; 0 below it.
  Real spread(const Vec3& h) const {
    if (!(h.z > 0)) return 0;
    const Real sx = h.x / x, sy = h.y / y, slopes = sx * sx + sy * sy, c = h.z * h.z;
    if (kind == Distribution::ggx) return 1 / (kPi * x * y * (slopes + c) * (slopes + c));
    return math::exp(-slopes / c) / (kPi * x * y * c * c);
  }
  /// Smith's Lambda for a direction above the surface.
  Real lambda(const Vec3& v) const {
    const Real across = std::sqrt(x * x * v.x * v.x + y * y * v.y * v.y);
    if (!(across > 0)) return 0;
    const Real a = v.z / across;
    if (kind == Distribution::ggx) return (std::sqrt(1 + 1 / (a * a)) - 1) / 2;
    // For large a the difference of nearly equal numbers, which is nearly 0.
    return max(0, (math::exp(-a * a) / (a * std::sqrt(kPi)) - math::erfc(a)) / 2);
  }
  /// The share of mirrors that is seen from one side, and that is both seen and lit.
  Real seen(const Vec3& v) const { return 1 / (1 + lambda(v)); }
  Real seenAndLit(const Vec3& a, const Vec3& b) const { return 1 / (1 + lambda(a) + lambda(b)); }

  /// The density, per solid angle, of the normals that are seen from `eye`; eye.z > 0.
  Real visible(const Vec3& eye, const Vec3& h) const {
    return spread(h) * seen(eye) * max(0, dot(eye, h)) / eye.z;
  }
  /// One of them.
  Vec3 chosen(const Vec3& eye, Vec2 u) const;

  /// The scattering of `light` to `eye` by mirrors of reflectance 1: f cos(light). Both above the surface.
  Real mirrored(const Vec3& eye, const Vec3& light, const Vec3& half) const {
    return spread(half) * seenAndLit(eye, light) / (4 * eye.z);
  }
  /// The density of the direction in which a chosen mirror sends what comes from `eye`.
  Real density(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real facing = dot(eye, half);
    return facing > 0 && half.z > 0 ? visible(eye, half) / (4 * facing) : 0;
  }

  /// The share of mirrors that lean less than 5 degrees: what stays of a sharp mirror image, for integrators
  /// that send one mirrored ray.
  Real sharpShare() const {
    constexpr Real kSquare = 0.0076543;  // tan^2
    const Real widths = x * y;
    return kind == Distribution::ggx ? kSquare / (kSquare + widths) : 1 - math::exp(-kSquare / widths);
  }
};

/// The light from `eye` refracted at the facet; eta = index behind / index before. Precondition: none of it
/// is mirrored totally.
inline Vec3 refractedAt(const Vec3& half, const Vec3& eye, Real eta) {
  const Real cosine = dot(eye, half), behind = std::sqrt(max(0, 1 - (1 - cosine * cosine) / (eta * eta)));
  return normalize(half * (cosine / eta - behind) - eye / eta);
}

/// The share of light that microfacets give back, tabulated; of reflectance 1, and of the part that Schlick's
/// weight (1 - cos)^5 makes of it.
struct MicrofacetAlbedo {
  Real white, schlick;
  /// The albedo of facets that mirror `alongNormal` of light along their normal.
  Color of(const Color& alongNormal) const { return alongNormal * (white - schlick) + Color(schlick); }
};
/// Seen from a unit direction above the surface.
MicrofacetAlbedo microfacetAlbedo(const Microfacets& facets, const Vec3& eye);
/// The mean over all directions, weighed by the cosine.
MicrofacetAlbedo meanMicrofacetAlbedo(const Microfacets& facets);

/// The albedo of facets whose reflectance is any smooth function of the cosine, known at these nodes:
/// Chebyshev's for a polynomial from 0 to 1, which is off by less than 1e-4 for glass (Trefethen,
/// Approximation Theory and Approximation Practice, 2013, chapter 8).
inline constexpr std::size_t kFresnelNodes = 8;
Real fresnelNode(std::size_t k);
/// The share of light for each node by which the reflectance there counts; their sum is the albedo of white
/// facets.
using FacetShares = std::array<Real, kFresnelNodes>;
/// Seen from a unit direction above the surface. With grain within a few percent.
FacetShares facetShares(const Microfacets& facets, const Vec3& eye);
/// The mean over all directions, weighed by the cosine.
FacetShares meanFacetShares(const Microfacets& facets);
/// The scattering of a smooth surface.
const FacetShares& meanFresnelShares();

/// Microfacets that mirror by Schlick's formula or another, and what is lost in it for light that is mirrored
/// several times (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017 course).
struct MicrofacetLobe {
  Microfacets facets;
  Real meanWhite = 1;  ///< mean albedo of white facets
  Color multiple;      ///< reflectance of the lost light: 0 leaves it lost

  MicrofacetLobe() = default;
  /// `alongNormal`: what they mirror of light along their normal.
  MicrofacetLobe(const Microfacets& facets, const Color& alongNormal);

  /// The reflectance of the lost light where that of one facet has this mean over all directions.
  Color multipleOf(const Color& mean) const;

  Real white(const Vec3& v) const { return microfacetAlbedo(facets, v).white; }

  /// f cos(light), where fresnel(cosine) is the reflectance of one facet.
  template <class Fresnel>
  Color value(const Vec3& eye, const Vec3& light, const Fresnel& fresnel) const {
    const Vec3 half = halfway(eye, light);
    Color sum = fresnel(dot(eye, half)) * facets.mirrored(eye, light, half);
    if (meanWhite < 1 && !isBlack(multiple))
      sum += multiple * ((1 - white(eye)) * (1 - white(light)) / (kPi * (1 - meanWhite)) * light.z);
    return sum;
  }
  /// The light reflected to `eye` by facets with Schlick's formula.
  Color albedo(const Vec3& eye, const Color& alongNormal) const {
    const MicrofacetAlbedo once = microfacetAlbedo(facets, eye);
    return once.of(alongNormal) + multiple * (1 - once.white);
  }
  Color meanAlbedo(const Color& alongNormal) const {
    const MicrofacetAlbedo once = meanMicrofacetAlbedo(facets);
    return once.of(alongNormal) + multiple * (1 - once.white);
  }

  /// How often `direction` follows light that is mirrored several times.
  Real multipleShare(const Vec3& eye) const { return 1 - white(eye); }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    return choose < multipleShare(eye) ? cosineDirection(u) : mirroredAt(facets.chosen(eye, u), eye);
  }
  Real density(const Vec3& eye, const Vec3& light) const {
    const Real share = multipleShare(eye);
    return share * cosineDensity(light) + (1 - share) * facets.density(eye, light);
  }
};

}  // namespace trace
