// The material of the courses: emission, ambient light, Lambert's diffuse term, a highlight by Phong
// (CACM 18(6), 1975) or Blinn (SIGGRAPH 1977), and the weights of mirror and refracted rays. Variant: the
// highlight is not multiplied by the cosine to the light, as the courses have it.
// Not reciprocal, for the lack of that cosine. Energy: as `diffuse` and `specular` say; more than arrives is
// possible.
//
// Use it for the scenes of the courses, and where a highlight is all that is wanted. Not for path tracing of
// shiny things: it does not keep energy, and its highlight has no Fresnel effect.
#pragma once

#include <algorithm>
#include <string_view>

#include "math/elementary.h"
#include "shading/scattering.h"

namespace trace {

struct PhongBsdf;

struct Phong : Interior {
  static constexpr std::string_view kKeyword = "phong";
  static constexpr std::string_view kHelp = "Phong or Blinn-Phong surface with mirror and glass terms";
  static constexpr bool kReciprocal = false, kKeepsEnergy = false;
  using Bsdf = PhongBsdf;

  Color emissive, ambient, diffuse, specular, reflective, transmissive;
  Color grazing;             ///< what the mirrored ray gains at grazing angles
  Real shininess = 0;        ///< exponent of the highlight
  Real brilliance = 1;       ///< exponent of the cosine of diffuse light
  Real grazingExponent = 5;  ///< how late the gain comes
  Real index = 1;            ///< index of refraction
  Real shadow = 1;           ///< how dark shadows on it are: 0 shows none

  static constexpr auto fields() {
    return Fields{

        Field{"emissive", &Phong::emissive, "", 0, kNoLimit, "emitted light"},
        Field{"ambient", &Phong::ambient, "", 0, 1, "reflectance for ambient light"},
        Field{"diffuse", &Phong::diffuse, "", 0, 1, "diffuse reflectance"},
        Field{"specular", &Phong::specular, "", 0, 1, "strength of the highlight"},
        Field{"reflective", &Phong::reflective, "", 0, 1, "weight of the mirrored ray"},
        Field{"grazing", &Phong::grazing, "", 0, 1,
              "what the mirrored ray gains in weight at grazing angles"},
        Field{"transmissive", &Phong::transmissive, "", 0, 1,
              "weight of the refracted ray, and the colour of shadows"},
        Field{"shininess", &Phong::shininess, "", 0, kNoLimit, "sharpness of the highlight"},
        Field{"brilliance", &Phong::brilliance, "", 0, kNoLimit,
              "exponent of the cosine of diffuse light: above 1 it looks like metal"},
        Field{"grazing_exponent", &Phong::grazingExponent, "", 0, kNoLimit,
              "how close to grazing angles the mirrored ray gains: exponent of 1 minus the cosine"},
        Field{"index", &Phong::index, "", 0, kNoLimit, "index of refraction"},
        Field{"shadow", &Phong::shadow, "", 0, 1,
              "fraction of a light that a shadow on the surface takes away"},
        Interior::fields()};
  }
  bool operator==(const Phong&) const = default;

  /// No `reflective` was given after the last `specular`: some conventions then mirror with `specular`.
  bool mirrorsSpecular = false;

  bool transmits() const { return !isBlack(transmissive); }
  bool mirrors() const { return !isBlack(reflective) || !isBlack(grazing); }

  const Phong& asPhong() const { return *this; }
  /// The surface as light hits it.
  PhongBsdf at(const Rules& rules) const;
};

/// Under the conventions of a render.
struct PhongBsdf : WhittedTerms {
  Color diffuse, specular;
  Real shininess = 0, brilliance = 1, grazingExponent = 5;
  Highlight highlight = Highlight::blinn;
  bool litFromBehind = false;  ///< light from behind comes through: |N.L|, and a highlight straight ahead

  static constexpr auto fields() {  // those that mixtures mix, named as the material's
    const auto named = [](const char* keyword, auto member) {
      return Field{keyword, member, "", 0, kNoLimit, ""};
    };
    return Fields{
        named("emissive", &PhongBsdf::emissive),     named("ambient", &PhongBsdf::ambient),
        named("diffuse", &PhongBsdf::diffuse),       named("specular", &PhongBsdf::specular),
        named("reflective", &PhongBsdf::reflective), named("transmissive", &PhongBsdf::transmissive),
        named("shininess", &PhongBsdf::shininess),   named("index", &PhongBsdf::index),
        named("shadow", &PhongBsdf::shadow),         named("grazing", &PhongBsdf::grazing),
        named("brilliance", &PhongBsdf::brilliance), named("grazing_exponent", &PhongBsdf::grazingExponent)};
  }

  bool scatters() const { return !isBlack(diffuse) || !isBlack(specular); }
  /// Light of one side is scattered by the cosine.
  bool isEven() const { return isBlack(specular) && !litFromBehind && brilliance == 1; }
  bool mirrorIsExact() const { return true; }
  Color mirrorWeight(Real cosine) const {
    if (isBlack(grazing)) return reflective;
    return reflective + grazing * math::pow(std::clamp(1 - cosine, 0.0, 1.0), grazingExponent);
  }
  Color passWeight(Real) const { return transmissive; }

  /// The fraction of light from `toLight` that goes toward `toEye` at a surface of normal `n` (all unit
  /// vectors). The highlight is not multiplied by N.L.
  Scatter scatter(const Vec3& n, const Vec3& toLight, const Vec3& toEye) const {
    const Real cosLight = dot(n, toLight);
    const Real lit = litFromBehind ? std::abs(cosLight) : std::max(0.0, cosLight);
    Scatter scatter{diffuse * (brilliance == 1 ? lit : math::pow(lit, brilliance)), {}};
    if (isBlack(specular)) return scatter;
    Real cosHighlight;
    if (highlight == Highlight::blinn) {
      const Vec3 half = toLight + toEye;
      const Real l = length(half);
      cosHighlight = l > 0 ? dot(n, half) / l : 0;
    } else {
      const Real cosMirror = litFromBehind ? std::max(0.0, cosLight) : cosLight;
      cosHighlight = dot(n * (2 * cosMirror) - toLight, toEye);
    }
    if (cosHighlight > 0 || shininess == 0)
      scatter.specular = specular * math::pow(std::max(0.0, cosHighlight), shininess);
    return scatter;
  }

  /// The scattering for light transport: only light on the eye's side of the surface, or either side where
  /// it is lit from behind.
  Color evaluate(const Frame& frame, const Vec3& toEye, const Vec3& toLight, Transport) const {
    if (!(dot(frame.normal, toEye) > 0) || !(litFromBehind || dot(frame.normal, toLight) > 0))
      return Color(0);
    return scatter(frame.normal, toLight, toEye).sum() / kPi;
  }
  std::optional<BsdfSample> sample(const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                   Transport transport) const {
    if (!scatters() || !(dot(frame.normal, toEye) > 0)) return {};
    if (isEven()) {
      const Vec3 light = cosineDirection(u);
      if (!(light.z > 0)) return {};
      return BsdfSample{frame.basis().toWorld(light), diffuse, light.z / kPi};
    }
    const Basis basis = frame.basis();
    const Vec3 eye = basis.toLocal(toEye);
    const Real highlightShare = shareOfHighlight();
    Vec3 light;
    if (choose >= highlightShare) {
      light = cosineDirection(u);
      if (litFromBehind && choose >= (1 + highlightShare) / 2) light.z = -light.z;
    } else if (highlight == Highlight::blinn) {
      light = mirroredAt(powerDirection(shininess, u), eye);
    } else {
      const Frame mirrored{{-eye.x, -eye.y, eye.z}};
      light = mirrored.basis().toWorld(powerDirection(shininess, u));
    }
    const Vec3 toLight = basis.toWorld(light);
    const Real density = this->density(frame, toEye, toLight);
    if (!(density > 0)) return {};
    return BsdfSample{toLight, evaluate(frame, toEye, toLight, transport) / density, density};
  }
  Real density(const Frame& frame, const Vec3& toEye, const Vec3& toLight) const {
    const Real cosLight = dot(frame.normal, toLight);
    if (!scatters() || !(dot(frame.normal, toEye) > 0)) return 0;
    const Real even = litFromBehind ? std::abs(cosLight) / (2 * kPi) : max(0, cosLight) / kPi;
    const Real share = shareOfHighlight();
    if (!(share > 0)) return even;
    Real lobe = 0;
    if (highlight == Highlight::blinn) {
      const Vec3 half = halfway(toEye, toLight);
      const Real facing = dot(half, toEye);
      lobe = facing > 0 ? powerDensity(shininess, std::abs(dot(half, frame.normal))) / (4 * facing) : 0;
    } else {
      lobe = powerDensity(shininess, dot(mirroredAt(frame.normal, toEye), toLight));
    }
    return even + (lobe - even) * share;
  }

 private:
  /// How often `sample` chooses the highlight.
  Real shareOfHighlight() const {
    const Real even = maxComponent(diffuse), lobe = maxComponent(specular);
    return lobe > 0 ? lobe / (lobe + even) : 0;
  }
};

inline PhongBsdf Phong::at(const Rules& rules) const {
  PhongBsdf bsdf;
  bsdf.emissive = emissive;
  bsdf.ambient = ambient;
  bsdf.diffuse = diffuse;
  bsdf.specular = specular;
  bsdf.reflective = mirrorsSpecular && rules.mirrorDefault == MirrorDefault::specular ? specular : reflective;
  bsdf.transmissive = transmissive;
  bsdf.grazing = grazing;
  bsdf.grazingExponent = grazingExponent;
  bsdf.brilliance = brilliance;
  bsdf.shininess = shininess * rules.shininessScale;
  bsdf.index = index;
  bsdf.fill(*this, index);
  bsdf.shadow = shadow;
  bsdf.highlight = rules.highlight;
  bsdf.litFromBehind = rules.diffuseSides == DiffuseSides::bothOnGlass && transmits();
  return bsdf;
}

/// Every field mixed linearly: the materials of a triangle's corners.
inline PhongBsdf mix(const PhongBsdf& a, const PhongBsdf& b, const PhongBsdf& c, const Real (&w)[3]) {
  PhongBsdf m = a;
  forEachField<PhongBsdf>([&](const auto& f) {
    m.*f.member = (a.*f.member) * w[0] + (b.*f.member) * w[1] + (c.*f.member) * w[2];
  });
  return m;
}

/// The nearest to another model.
inline Phong phongLike(const SurfaceFields& surface, const Color& diffuse, const Color& specular = {},
                       Real shininess = 0) {
  Phong phong;
  phong.emissive = surface.emissive;
  phong.ambient = surface.ambient;
  phong.shadow = surface.shadow;
  phong.diffuse = diffuse;
  phong.specular = specular;
  phong.shininess = shininess;
  return phong;
}

}  // namespace trace
