// Parts common to all Bsdfs: the terms of Whitted's equation, samples, and fields of all materials.
//
// THE CONTRACT. Directions are unit vectors that point away from the surface, those of models in the space of
// a Basis (z is the normal). `evaluate` is f(toEye, toLight) |cos(toLight)|: with the cosine. `density` is
// per solid angle, of the direction that `sample` chooses for a given toEye; over all directions it sums up
// to 1. A direction may be chosen to which nothing is scattered: its weight is 0. All three are of what is
// spread over directions: the one mirrored ray of a smooth surface is mirrorWeight(), and its refracted ray
// is up to the integrator, which knows the media. A light of colour 1 that Whitted's equation knows is one of
// irradiance pi, so scatter() = pi * evaluate(): a white Lambertian surface that faces it has radiance 1.
#pragma once

#include <optional>
#include <type_traits>

#include "base/field.h"
#include "math/color.h"
#include "math/elementary.h"
#include "math/vec.h"
#include "math/warp.h"
#include "shading/frame.h"
#include "shading/interior.h"
#include "shading/rules.h"

namespace trace {

/// The quantity carried from toLight to toEye: radiance, by paths from the eye, or importance, by paths from
/// a lamp, where `toEye` is where the path comes from. They differ where light goes into another medium.
enum class Transport { radiance, importance };

/// The scattering of a light by a surface, in parts.
struct Scatter {
  Color diffuse, specular;
  Color sum() const { return diffuse + specular; }
};

struct BsdfSample {
  Vec3 toLight;
  Color weight;  ///< evaluate / density
  Real density = 0;
};

/// How Whitted's equation weighs the mirrored and the refracted ray: as the material and the options say; by
/// Fresnel's exact formula, whatever they say; or as mirrorWeight() and passWeight() say of a pane that light
/// crosses straight on.
enum class Passage { asSaid, byFresnel, straight };

/// The terms of Whitted's equation for a surface besides its scattering.
struct WhittedTerms {
  Color emissive, ambient;
  Color reflective, transmissive;  ///< weights of the mirrored, along the normal, and of the refracted ray
  Color grazing;                   ///< what the mirrored ray gains at grazing angles
  Real index = 1;                  ///< index of refraction
  Real shadow = 1;                 ///< share of a light that a shadow takes away
  Real priority = 0;               ///< what of overlapping bodies fills a place (shading/interior.h)
  Color attenuation{1};            ///< the transmittance of a unit of length inside
  Dispersion dispersion;           ///< dispersion of the index
  Passage passage = Passage::asSaid;
  Real sharp = 1;           ///< the part of a lobe for which one ray stands, where passage is byFresnel
  bool litThrough = false;  ///< light from behind crosses the body, and `evaluate` knows how much is left

  void fill(const Interior& interior, Real said) {
    priority = interior.priority;
    attenuation = interior.passesPerUnit();
    dispersion = {interior.dispersion, interior.abbe, said};
  }
  bool transmits() const { return !isBlack(transmissive); }
  bool mirrors() const { return !isBlack(reflective) || !isBlack(grazing); }
  bool encloses(bool solid) const { return solid && passage != Passage::straight; }
};

/// Fields of every model but Phong's, which has them among its own.
struct SurfaceFields {
  Color emissive, ambient;
  Real shadow = 1;  ///< how dark shadows on it are: 0 shows none

  static constexpr auto fields() {
    return Fields{Field{"emissive", &SurfaceFields::emissive, "", 0, kNoLimit, "emitted light"},
                  Field{"ambient", &SurfaceFields::ambient, "", 0, 1, "reflectance for ambient light"},
                  Field{"shadow", &SurfaceFields::shadow, "", 0, 1,
                        "fraction of a light that a shadow on the surface takes away"}};
  }
  bool operator==(const SurfaceFields&) const = default;
};

/// Has it any number or colour to be mixed or scaled?
template <class Value>
inline constexpr bool kIsContinuous = std::is_same_v<Value, Real> || std::is_same_v<Value, Color>;

/// Every number and colour mixed linearly; the rest is that of the part of most weight.
template <class Struct>
Struct mixFields(const Struct& a, const Struct& b, const Struct& c, const Real (&w)[3]) {
  Struct m = w[0] >= w[1] && w[0] >= w[2] ? a : w[1] >= w[2] ? b : c;
  forEachField<Struct>([&](const auto& f) {
    if constexpr (kIsContinuous<std::remove_cvref_t<decltype(m.*f.member)>>)
      m.*f.member = (a.*f.member) * w[0] + (b.*f.member) * w[1] + (c.*f.member) * w[2];
  });
  return m;
}

// --- directions chosen at random, in the space of a Basis -------------------------------------------------

inline Vec3 sphericalDirection(Real cosTheta, Real phi) {
  const Real sine = std::sqrt(max(0, 1 - cosTheta * cosTheta));
  const math::SinCos around = math::sincos(phi);
  return {sine * around.cos, sine * around.sin, cosTheta};
}
/// Around the normal with density cos / pi.
inline Vec3 cosineDirection(Vec2 u) {
  const Real r = std::sqrt(u.x);
  const Vec2 circle = onCircle(u.y);
  return {r * circle.x, r * circle.y, std::sqrt(max(0, 1 - u.x))};
}
inline Real cosineDensity(const Vec3& light) { return max(0, light.z) / kPi; }
/// Around the axis z with density (n + 1) / (2 pi) cos^n.
inline Vec3 powerDirection(Real n, Vec2 u) {
  return sphericalDirection(math::pow(1 - u.x, 1 / (n + 1)), 2 * kPi * u.y);
}
inline Real powerDensity(Real n, Real cosine) {
  return cosine > 0 ? (n + 1) / (2 * kPi) * math::pow(cosine, n) : 0;
}

/// The half-way vector of two directions on one side of its plane; 0 if they are opposite.
inline Vec3 halfway(const Vec3& eye, const Vec3& light) {
  const Vec3 h = eye + light;
  const Real l = length(h);
  return l > 0 ? h / l : Vec3{};
}
/// `eye` mirrored at the half-way vector.
inline Vec3 mirroredAt(const Vec3& half, const Vec3& eye) { return half * (2 * dot(eye, half)) - eye; }

// --- models ------------------------------------------------------------------------------------------------

/// Functions that a Bsdf that is computed in the space of a Basis has from its three functions there:
///   Scatter value(eye, light) const         f |cos|, where eye.z > 0 and light.z > 0; finite
///   Vec3 direction(eye, choose, u) const    chosen by the numbers from 0 to 1; eye.z > 0
///   Real directionDensity(eye, light) const of that choice
/// `Said` is the material's model, whose values are kept. Those that scatter to the other side say
/// kTwoSided, or twoSided() of their values, and get any eye and light; those that ask on which side the
/// inside of the body is say kHasInside, and z points out of it. One with a coat whose normal may be another
/// says kHasCoat: its three functions get that normal besides, after `eye` and `light`, or `u`.
template <class Self, class SaidModel>
struct LocalBsdf : WhittedTerms {
  using Said = SaidModel;
  static constexpr bool kTwoSided = false, kHasInside = false, kHasCoat = false;

  Said said;

  LocalBsdf() = default;
  explicit LocalBsdf(const Said& model) : said(model) {
    emissive = model.emissive;
    ambient = model.ambient;
    shadow = model.shadow;
  }

  bool scatters() const { return true; }
  bool twoSided() const { return Self::kTwoSided; }
  /// The mirrored ray is all there is of its lobe; else it stands for a lobe that `evaluate` has, for
  /// integrators that cannot follow that.
  bool mirrorIsExact() const { return false; }
  Color mirrorWeight(Real) const { return reflective; }
  Color passWeight(Real) const { return transmissive; }

  /// Whitted's light does not change where it enters another medium, as its rays do not; importance likewise.
  Scatter scatter(const Frame& frame, const Vec3& toLight, const Vec3& toEye) const {
    const Local local = localOf(frame);
    const Vec3 light = local.basis.toLocal(toLight);
    Vec3 eye = local.basis.toLocal(toEye);
    if (!self().twoSided()) eye.z = std::abs(eye.z);  // normals between vertices may turn from the eye
    const Scatter parts = checked(local, eye, light, Transport::importance);
    return {parts.diffuse * kPi, parts.specular * kPi};
  }
  Color evaluate(const Frame& frame, const Vec3& toEye, const Vec3& toLight, Transport transport) const {
    const Local local = localOf(frame);
    return checked(local, local.basis.toLocal(toEye), local.basis.toLocal(toLight), transport).sum();
  }
  std::optional<BsdfSample> sample(const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                   Transport transport) const {
    const Local local = localOf(frame);
    const Vec3 eye = local.basis.toLocal(toEye);
    if (!self().scatters() || !(self().twoSided() || eye.z > 0)) return {};
    Vec3 light;
    if constexpr (Self::kHasCoat)
      light = self().direction(eye, choose, u, local.coat);
    else
      light = self().direction(eye, choose, u);
    const Real density = densityOf(local, eye, light);
    if (!(density > 0)) return {};
    return BsdfSample{local.basis.toWorld(light), checked(local, eye, light, transport).sum() / density,
                      density};
  }
  Real density(const Frame& frame, const Vec3& toEye, const Vec3& toLight) const {
    const Local local = localOf(frame);
    const Vec3 eye = local.basis.toLocal(toEye);
    if (!self().scatters() || !(self().twoSided() || eye.z > 0)) return 0;
    return densityOf(local, eye, local.basis.toLocal(toLight));
  }

  // Those of a model that scatters as if it were Lambertian, or nearly.
  Vec3 direction(const Vec3&, Real, Vec2 u) const { return cosineDirection(u); }
  Real directionDensity(const Vec3&, const Vec3& light) const { return cosineDensity(light); }

 private:
  struct Local {
    Basis basis;
    Vec3 coat;  ///< in it
  };
  const Self& self() const { return static_cast<const Self&>(*this); }
  Local localOf(Frame frame) const {
    if (Self::kHasInside && frame.inside) frame.normal = -frame.normal;
    Real angle = 0;
    if constexpr (requires { said.angle; }) angle = said.angle * kPi / 180;
    Local local{frame.basis(angle), {0, 0, 1}};
    if (Self::kHasCoat && frame.coat != Vec3{}) local.coat = local.basis.toLocal(frame.coat);
    return local;
  }
  Real densityOf(const Local& local, const Vec3& eye, const Vec3& light) const {
    if constexpr (Self::kHasCoat)
      return self().directionDensity(eye, light, local.coat);
    else
      return self().directionDensity(eye, light);
  }
  Scatter checked(const Local& local, const Vec3& eye, const Vec3& light, Transport transport) const {
    if (!self().scatters()) return {};
    if constexpr (Self::kTwoSided)
      return self().value(eye, light, transport);
    else if (!self().twoSided() && !(eye.z > 0 && light.z > 0))
      return {};
    else if constexpr (Self::kHasCoat)
      return self().value(eye, light, local.coat);
    else
      return self().value(eye, light);
  }
};

}  // namespace trace
