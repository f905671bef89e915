// One model for most things, by the numbers that artists and glTF give: colour, metalness, roughness, a clear
// coat, sheen and iridescence (Burley, Physically-Based Shading at Disney, SIGGRAPH 2012 course; Khronos,
// glTF 2.0, appendix B, KHR_materials_clearcoat, KHR_materials_sheen, KHR_materials_anisotropy,
// KHR_materials_iridescence, KHR_materials_specular). Where specular_strength is below 1, the rest of the
// base has no layer that mirrors. Where it is transparent it is a thin sheet: what its facets do not mirror
// continues as a lobe that lies as the mirrored one does, on the other side (KHR_materials_transmission).
// Variant: GGX; the base is coupled to what lies on it as in shading/optics/coating.h, and each layer takes
// from those below what it gives back itself, on the way in and out. Reciprocal. Energy: gives back at most
// what arrives; with grain within a few percent.
//
// Under Whitted's equation the mirrored ray stands for the facets that lean less than 5 degrees.
//
// Use it for files of other programs, and where one material changes from metal to cloth. Not for solid glass
// (rough_glass, phong with an index), nor for skin (subsurface).
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/coating.h"
#include "shading/optics/sheen.h"

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
  Real transmission = 0;
  Real specularStrength = 1;
  Color specularColor{1};
  Real anisotropy = 0, angle = 0;
  Real clearcoat = 0, clearcoatRoughness = 0.1, clearcoatBump = 0;
  bool clearcoatApart = false;
  Color sheen;
  Real sheenRoughness = 0.5;
  Real iridescence = 0, iridescenceIndex = 1.3, iridescenceThickness = 400;

  static constexpr auto fields() {
    return Fields{
        Field{"color", &Principled::color, "", 0, 1, "colour of the diffuse base, or of the metal"},
        Field{"metallic", &Principled::metallic, "", 0, 1, "from 0, plastic, to 1, metal"},
        Field{"roughness", &Principled::roughness, "", 0, 1, "the slope width of the facets is its square"},
        Field{"index", &Principled::index, "", 0, kNoLimit, "index of refraction of the non-metal"},
        Field{"transmission", &Principled::transmission, "", 0, 1,
              "fraction of light transmitted by the non-metal, as through a thin sheet"},
        Field{"specular_strength", &Principled::specularStrength, "", 0, 1,
              "strength of the non-metal's reflection"},
        Field{"specular_color", &Principled::specularColor, "", 0, kNoLimit,
              "tint of that reflection along the normal; at most all light is reflected"},
        Field{"anisotropy", &Principled::anisotropy, "", 0, 1, "how much the surface is brushed"},
        Field{"angle", &Principled::angle, "degrees", -360, 360,
              "angle of the grain to the direction in which u grows"},
        Field{"clearcoat", &Principled::clearcoat, "", 0, 1, "strength of the clear coat"},
        Field{"clearcoat_roughness", &Principled::clearcoatRoughness, "", 0, 1,
              "roughness of the clear coat"},
        Field{"clearcoat_bump", &Principled::clearcoatBump, "units of the object", -kNoLimit, kNoLimit,
              "apparent height of the clear coat where its texture is white, if clearcoat_apart is on"},
        Field{"clearcoat_apart", &Principled::clearcoatApart, "", -kNoLimit, kNoLimit,
              "the clear coat ignores `bump` and uses `clearcoat_bump`"},
        Field{"sheen", &Principled::sheen, "", 0, 1, "colour of fibres on it"},
        Field{"sheen_roughness", &Principled::sheenRoughness, "", 0, 1, "roughness of the fibres"},
        Field{"iridescence", &Principled::iridescence, "", 0, 1,
              "strength of an interference film on the base"},
        Field{"iridescence_index", &Principled::iridescenceIndex, "", 0, kNoLimit,
              "index of refraction of the film"},
        Field{"iridescence_thickness", &Principled::iridescenceThickness, "nanometres", 0, 5000,
              "of the film"},
        SurfaceFields::fields()};
  }
  bool operator==(const Principled&) const = default;

  Phong asPhong() const {
    const Real width = max(0.03, roughness * roughness);
    const Color own = lerp(metallic, plasticMirrors() * specularStrength, color);
    const Real passes = transmission * (1 - metallic);
    Phong phong = phongLike(*this, color * (1 - metallic - passes), own, 2 / (width * width));
    const Real sharp = Microfacets::of(Distribution::ggx, roughness).sharpShare();
    phong.reflective = own * sharp;
    phong.transmissive = color * (passes * sharp);
    phong.index = passes > 0 ? 1 : index;  // a sheet
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
  static constexpr bool kHasCoat = true;
  static constexpr Real kClearIndex = 1.5;
  static constexpr Real kLeastRoughness = 0.01;  ///< smoother ones have no lobe that a lamp could be seen in

  bool exactFresnel = false;
  Coating plastic, clear;
  Real passing = 0;  ///< share of light that continues through the sheet
  MicrofacetLobe metal;
  Sheen fibres;

  PrincipledBsdf() = default;
  PrincipledBsdf(const Principled& model, bool exact)
      : LocalBsdf(model),
        exactFresnel(exact),
        plastic(Distribution::ggx, max(kLeastRoughness, model.roughness), model.anisotropy,
                LayerFresnel(model.plasticMirrors(), model.index, exact)
                    .withFilm(model.iridescenceIndex, model.iridescenceThickness, model.iridescence)),
        metal(plastic.lobe.facets, metalMirrors(1)),
        fibres(Sheen::of(model.sheenRoughness)) {
    said.metallic = max(0, min(1, model.metallic));
    said.specularStrength = max(0, min(1, model.specularStrength));
    said.clearcoat = max(0, min(1, model.clearcoat));
    if (said.clearcoat > 0)
      clear = {Distribution::ggx, max(kLeastRoughness, model.clearcoatRoughness), 0,
               LayerFresnel(Color(mirroredAlongNormal(kClearIndex)), kClearIndex, exact)};
    index = model.index;
    reflective = mirrorWeight(1);
    passing = max(0, min(1, model.transmission)) * (1 - said.metallic);
    if (!(passing > 0)) return;
    passage = Passage::straight;
    transmissive = passWeight(1);
  }

  bool twoSided() const { return passing > 0; }

  Color passWeight(Real cosine) const {
    const Vec3 toEye{std::sqrt(max(0, 1 - cosine * cosine)), 0, cosine};
    return passed(cosine) * (plastic.lobe.facets.sharpShare() * layers(toEye, toEye, {0, 0, 1}));
  }
  Color mirrorWeight(Real cosine) const {
    const Color below =
        lerp(said.metallic, plastic.fresnel(cosine) * said.specularStrength, metalMirrors(cosine)) *
        plastic.lobe.facets.sharpShare();
    if (!(said.clearcoat > 0)) return below;
    const Real through = 1 - said.clearcoat * clear.fresnel(cosine).r;
    return below * (through * through) + clear.mirrorWeight(cosine) * said.clearcoat;
  }

  Scatter value(const Vec3& eye, const Vec3& light, const Vec3& coat) const {
    if (!(eye.z > 0) || light.z == 0) return {};  // only of a sheet that is asked for
    if (light.z < 0) {
      const Vec3 mirrored{light.x, light.y, -light.z}, half = halfway(eye, mirrored);
      return {{},
              passed(dot(eye, half)) *
                  (plastic.lobe.facets.mirrored(eye, mirrored, half) * layers(eye, mirrored, coat))};
    }
    Scatter sum;
    if (said.metallic < 1) {
      sum = {said.color * plastic.base(eye, light) * (1 - said.metallic - passing),
             plastic.mirrored(eye, light) * (1 - said.metallic)};
      if (const Real s = said.specularStrength; s < 1) {
        const Color bare = said.color * (light.z / kPi * (1 - said.metallic - passing));
        sum = {lerp(s, bare, sum.diffuse), sum.specular * s};
      }
    }
    if (said.metallic > 0)
      sum.specular +=
          metal.value(eye, light, [&](Real cosine) { return metalMirrors(cosine); }) * said.metallic;
    if (!isBlack(said.sheen)) cover(sum, throughSheen(eye, light), said.sheen * fibres.value(eye, light));
    if (said.clearcoat > 0) {
      const Clear at = clearAt(eye, light, coat);
      cover(sum, throughClear(at),
            at.eye.z > 0 && at.light.z > 0 ? clear.mirrored(at.eye, at.light) * said.clearcoat : Color(0));
    }
    return sum;
  }

  Vec3 direction(const Vec3& eye, Real choose, Vec2 u, const Vec3& coat) const {
    if (const Real below = belowShare(); below > 0) {
      if (choose < below) {
        const Vec3 light = mirroredAt(plastic.lobe.facets.chosen(eye, u), eye);
        return {light.x, light.y, -light.z};
      }
      choose = (choose - below) / (1 - below);
    }
    const Clear at = clearAt(eye, eye, coat);
    const Real layer = clearShare(at);
    if (choose < layer) return at.back(clear.lobe.direction(at.eye, choose / layer, u));
    return plastic.direction(eye, baseWeight(), (choose - layer) / (1 - layer), u);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light, const Vec3& coat) const {
    if (!(eye.z > 0)) return 0;
    const Clear at = clearAt(eye, light, coat);
    const Real layer = clearShare(at), below = belowShare();
    const Real above = (layer > 0 ? layer * clear.lobe.density(at.eye, at.light) : 0) +
                       (1 - layer) * plastic.density(eye, baseWeight(), light);
    if (!(below > 0)) return above;
    return below * plastic.lobe.facets.density(eye, {light.x, light.y, -light.z}) + (1 - below) * above;
  }

 private:
  /// The reflectance of one facet of metal.
  Color metalMirrors(Real cosine) const {
    const Color bare = schlick(cosine, said.color);
    if (!(said.iridescence > 0 && said.iridescenceThickness > 0)) return bare;
    const ThinFilm film{said.iridescenceIndex, 1, said.iridescenceThickness};
    return clamp01(bare + film.changeOn(said.color, cosine) * min(1, said.iridescence));
  }
  static void cover(Scatter& below, Real through, const Color& layer) {
    below = {below.diffuse * through, below.specular * through + layer};
  }
  /// The transmittance of a facet at that cosine, and of the colour below.
  Color passed(Real cosine) const {
    const Color mirrors = plastic.fresnel(cosine) * said.specularStrength;
    return said.color * (Color(1) + mirrors * -1) * passing;
  }
  /// The transmittance of the layers from one direction to another.
  Real layers(const Vec3& eye, const Vec3& light, const Vec3& coat) const {
    Real through = isBlack(said.sheen) ? 1 : throughSheen(eye, light);
    if (said.clearcoat > 0) through *= throughClear(clearAt(eye, light, coat));
    return through;
  }
  Real throughSheen(const Vec3& eye, const Vec3& light) const {
    const Real most = min(1, maxComponent(said.sheen));
    return (1 - most * fibres.albedo(eye.z)) * (1 - most * fibres.albedo(light.z));
  }

  /// Directions around the normal of the clear coat.
  struct Clear {
    Vec3 eye, light;
    bool own = false;
    Basis basis{};
    Vec3 back(const Vec3& v) const { return own ? basis.toWorld(v) : v; }
  };
  static Clear clearAt(const Vec3& eye, const Vec3& light, const Vec3& coat) {
    if (coat == Vec3{0, 0, 1}) return {eye, light};
    const Basis basis = Frame{coat}.basis();
    return {basis.toLocal(eye), basis.toLocal(light), true, basis};
  }
  Real throughClear(const Clear& at) const {
    const auto passes = [&](const Vec3& v) { return 1 - said.clearcoat * clear.albedo(v).r; };
    if (!at.own) return passes(at.eye) * passes(at.light);
    constexpr Real kGrazing = 0.01;  // what the coat turns its back to, it lets through as little
    const auto facing = [](Vec3 v) {
      if (v.z < kGrazing) v.z = kGrazing;
      return normalize(v);
    };
    return passes(facing(at.eye)) * passes(facing(at.light));
  }
  Real clearShare(const Clear& at) const { return at.eye.z > 0 ? 0.3 * said.clearcoat : 0; }
  /// How often `direction` goes through.
  Real belowShare() const { return 0.9 * passing * min(1, maxComponent(said.color)); }
  /// Against the lobe: metal has no base.
  Real baseWeight() const {
    return (1 - said.metallic - passing) * maxComponent(said.color) + maxComponent(said.sheen) + 0.02;
  }
};

inline PrincipledBsdf Principled::at(const Rules& rules) const { return {*this, rules.exactFresnel}; }

}  // namespace trace
