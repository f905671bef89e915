// One model for most things, by the numbers that artists and glTF give: colour, metalness, roughness, a clear
// coat, sheen and iridescence (Burley, Physically-Based Shading at Disney, SIGGRAPH 2012 course; Khronos,
// glTF 2.0, appendix B, KHR_materials_clearcoat, KHR_materials_sheen, KHR_materials_anisotropy,
// KHR_materials_iridescence, KHR_materials_specular). Where specular_strength is below 1, the rest of the
// base has no layer that mirrors. Variant: GGX; the base is coupled to what lies on it as in
// shading/coating.h, and each layer takes from those below what it gives back itself, on the way in and out.
// Reciprocal. Energy: gives back at most what arrives; with grain within a few percent.
//
// Under Whitted's equation the mirrored ray stands for the facets that lean less than 5 degrees.
#pragma once

#include <string_view>

#include "shading/coating.h"
#include "shading/materials/phong.h"
#include "shading/sheen.h"

namespace trace {

struct PrincipledBsdf;

struct Principled : SurfaceFields {
  static constexpr std::string_view kKeyword = "principled";
  static constexpr std::string_view kHelp =
      "colour, metalness, roughness, clear coat, sheen and iridescence, as glTF has them";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = PrincipledBsdf;

  Color color{0.8};
  Real metallic = 0, roughness = 0.5, index = 1.5;
  Real specularStrength = 1;
  Color specularColor{1};
  Real anisotropy = 0, angle = 0;
  Real clearcoat = 0, clearcoatRoughness = 0.1;
  Color sheen;
  Real sheenRoughness = 0.5;
  Real iridescence = 0, iridescenceIndex = 1.3, iridescenceThickness = 400;

  static constexpr auto fields() {
    return Fields{
        Field{"color", &Principled::color, "", 0, 1, "of the matt base, or what the metal mirrors"},
        Field{"metallic", &Principled::metallic, "", 0, 1, "from 0, plastic, to 1, metal"},
        Field{"roughness", &Principled::roughness, "", 0, 1, "its square is the width of the facets' slopes"},
        Field{"index", &Principled::index, "", 0, kNoLimit, "of refraction, of what is no metal"},
        Field{"specular_strength", &Principled::specularStrength, "", 0, 1,
              "how much of what is no metal mirrors at all"},
        Field{"specular_color", &Principled::specularColor, "", 0, kNoLimit,
              "tints what that mirrors along the normal; no more than all light is mirrored"},
        Field{"anisotropy", &Principled::anisotropy, "", 0, 1, "how much the surface is brushed"},
        Field{"angle", &Principled::angle, "degrees", -360, 360,
              "of the grain to the direction in which u grows"},
        Field{"clearcoat", &Principled::clearcoat, "", 0, 1, "how much of a clear layer lies on it"},
        Field{"clearcoat_roughness", &Principled::clearcoatRoughness, "", 0, 1, "of that layer"},
        Field{"sheen", &Principled::sheen, "", 0, 1, "colour of fibres on it"},
        Field{"sheen_roughness", &Principled::sheenRoughness, "", 0, 1, "how disorderly they stand"},
        Field{"iridescence", &Principled::iridescence, "", 0, 1,
              "how much of a thin film, whose faces make colours, lies on the base"},
        Field{"iridescence_index", &Principled::iridescenceIndex, "", 0, kNoLimit,
              "of refraction of the film"},
        Field{"iridescence_thickness", &Principled::iridescenceThickness, "nanometres", 0, 5000,
              "of the film"},
        SurfaceFields::fields()};
  }
  bool operator==(const Principled&) const = default;

  Phong asPhong() const {
    const Real width = max(0.03, roughness * roughness);
    const Color own = lerp(metallic, plasticMirrors() * specularStrength, color);
    Phong phong = phongLike(*this, color * (1 - metallic), own, 2 / (width * width));
    phong.reflective = own * Microfacets::of(Distribution::ggx, roughness).sharpShare();
    phong.index = index;
    return phong;
  }
  /// Along the normal, of what is no metal.
  Color plasticMirrors() const {
    const Color tinted = specularColor * mirroredAlongNormal(index);
    return {min(1, tinted.r), min(1, tinted.g), min(1, tinted.b)};
  }
  PrincipledBsdf at(const Rules& rules) const;
};

struct PrincipledBsdf : LocalBsdf<PrincipledBsdf, Principled> {
  static constexpr Real kLeastRoughness = 0.01;  ///< smoother ones have no lobe that a lamp could be seen in

  Coating plastic, clear;
  MicrofacetLobe metal;
  Sheen fibres;

  PrincipledBsdf() = default;
  explicit PrincipledBsdf(const Principled& model)
      : LocalBsdf(model),
        plastic(plasticOf(model)),
        metal(plastic.lobe.facets, metalMirrors(1)),
        fibres(Sheen::of(model.sheenRoughness)) {
    said.metallic = max(0, min(1, model.metallic));
    said.specularStrength = max(0, min(1, model.specularStrength));
    said.clearcoat = max(0, min(1, model.clearcoat));
    if (said.clearcoat > 0)
      clear = {Distribution::ggx, max(kLeastRoughness, model.clearcoatRoughness), 0,
               Color(mirroredAlongNormal(1.5))};
    index = model.index;
    reflective = mirrorWeight(1);
  }

  Color mirrorWeight(Real cosine) const {
    const Color below =
        lerp(said.metallic, plastic.fresnel(cosine) * said.specularStrength, metalMirrors(cosine)) *
        plastic.lobe.facets.sharpShare();
    if (!(said.clearcoat > 0)) return below;
    const Real through = 1 - said.clearcoat * schlick(cosine, clear.alongNormal).r;
    return below * (through * through) + clear.mirrorWeight(cosine) * said.clearcoat;
  }

  Scatter value(const Vec3& eye, const Vec3& light) const {
    Scatter sum;
    if (said.metallic < 1) {
      sum = {said.color * plastic.base(eye, light) * (1 - said.metallic),
             plastic.mirrored(eye, light) * (1 - said.metallic)};
      if (const Real s = said.specularStrength; s < 1) {
        const Color bare = said.color * (light.z / kPi * (1 - said.metallic));
        sum = {lerp(s, bare, sum.diffuse), sum.specular * s};
      }
    }
    if (said.metallic > 0)
      sum.specular +=
          metal.value(eye, light, [&](Real cosine) { return metalMirrors(cosine); }) * said.metallic;
    if (!isBlack(said.sheen)) {
      const Real most = min(1, maxComponent(said.sheen));
      cover(sum, (1 - most * fibres.albedo(eye.z)) * (1 - most * fibres.albedo(light.z)),
            said.sheen * fibres.value(eye, light));
    }
    if (said.clearcoat > 0)
      cover(sum, (1 - said.clearcoat * clear.albedo(eye).r) * (1 - said.clearcoat * clear.albedo(light).r),
            clear.mirrored(eye, light) * said.clearcoat);
    return sum;
  }

  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    const Real coat = clearShare();
    if (choose < coat) return clear.lobe.direction(eye, choose / coat, u);
    return plastic.direction(eye, baseWeight(), (choose - coat) / (1 - coat), u);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    const Real coat = clearShare();
    return (coat > 0 ? coat * clear.lobe.density(eye, light) : 0) +
           (1 - coat) * plastic.density(eye, baseWeight(), light);
  }

 private:
  static bool iridesces(const Principled& model) {
    return model.iridescence > 0 && model.iridescenceThickness > 0;
  }
  static ThinFilm filmOf(const Principled& model) {
    return {model.iridescenceIndex, model.index, model.iridescenceThickness};
  }
  static Coating plasticOf(const Principled& model) {
    const Real roughness = max(kLeastRoughness, model.roughness);
    if (iridesces(model))
      return {Distribution::ggx, roughness, model.anisotropy, filmOf(model), min(1, model.iridescence)};
    return {Distribution::ggx, roughness, model.anisotropy, model.plasticMirrors()};
  }
  /// What one facet of metal mirrors.
  Color metalMirrors(Real cosine) const {
    const Color bare = schlick(cosine, said.color);
    if (!iridesces(said)) return bare;
    return lerp(min(1, said.iridescence), bare, filmOf(said).mirroredOn(indexMirroring(said.color), cosine));
  }
  static void cover(Scatter& below, Real through, const Color& layer) {
    below = {below.diffuse * through, below.specular * through + layer};
  }
  Real clearShare() const { return 0.3 * said.clearcoat; }
  /// Against the lobe: metal has no base.
  Real baseWeight() const {
    return (1 - said.metallic) * maxComponent(said.color) + maxComponent(said.sheen) + 0.02;
  }
};

inline PrincipledBsdf Principled::at(const Rules&) const { return PrincipledBsdf(*this); }

}  // namespace trace
