// Plastic, glazed clay, varnished wood: a matt base below a clear layer (shading/optics/coating.h); with a
// thin film on it oil on wet asphalt, the shells of beetles, pearl (shading/optics/thin_film.h). Reciprocal.
// Energy: gives back at most what arrives, all of it if the base is white.
//
// Under Whitted's equation a smooth layer sends one mirrored ray; of a rough one the ray stands for the
// facets that lean less than 5 degrees. Both follow Schlick's approximation, or Fresnel's formula where the
// rules say so.
//
// Use it for plastic, paint, glazed clay, varnish. Not for bare metal (conductor), nor for a layer of its own
// thickness or colour: model that as an object of glass.
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/coating.h"

namespace trace {

struct CoatedBsdf;

struct Coated : SurfaceFields {
  static constexpr std::string_view kKeyword = "coated";
  static constexpr std::string_view kHelp = "plastic or varnish: a diffuse base below a clear layer";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = CoatedBsdf;

  Color diffuse{0.6};
  Real index = 1.5, roughness = 0.2;
  Real film = 0, filmIndex = 1.45;
  Distribution distribution = Distribution::ggx;

  static constexpr auto fields() {
    return Fields{
        Field{"diffuse", &Coated::diffuse, "", 0, 1, "colour of the base"},
        Field{"index", &Coated::index, "", 0, kNoLimit, "index of refraction of the layer"},
        Field{"roughness", &Coated::roughness, "", 0, 1,
              "roughness of the layer, from 0, a mirror, to 1; the slope width of the facets is its square"},
        Field{"distribution", &Coated::distribution, "", 0, kNoLimit, "distribution of the facets' slopes"},
        Field{"film", &Coated::film, "nanometres", 0, 5000,
              "thickness of an interference film on the layer; 0 is none"},
        Field{"film_index", &Coated::filmIndex, "", 1, kNoLimit, "index of refraction of the film"},
        SurfaceFields::fields()};
  }
  bool operator==(const Coated&) const = default;

  Phong asPhong() const {
    const Real width = max(0.03, roughness * roughness);
    const Color own(mirroredAlongNormal(index));
    Phong phong = phongLike(*this, diffuse, own + Color(0.2), 2 / (width * width));
    phong.reflective = own * Microfacets::of(distribution, roughness).sharpShare();
    phong.index = index;
    return phong;
  }
  CoatedBsdf at(const Rules& rules) const;
};

struct CoatedBsdf : LocalBsdf<CoatedBsdf, Coated> {
  bool exactFresnel = false;
  Coating coat;

  CoatedBsdf() = default;
  CoatedBsdf(const Coated& model, bool exact)
      : LocalBsdf(model),
        exactFresnel(exact),
        coat(model.distribution, model.roughness, 0,
             LayerFresnel(Color(mirroredAlongNormal(model.index)), model.index, exact)
                 .withFilm(model.filmIndex, model.film, 1)) {
    index = model.index;
    reflective = coat.mirrorWeight(1);
  }

  bool mirrorIsExact() const { return coat.smooth; }
  Color mirrorWeight(Real cosine) const { return coat.mirrorWeight(cosine); }

  Scatter value(const Vec3& eye, const Vec3& light) const {
    return {said.diffuse * coat.base(eye, light), coat.mirrored(eye, light)};
  }
  Real baseWeight() const { return maxComponent(said.diffuse); }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    return coat.direction(eye, baseWeight(), choose, u);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    return coat.density(eye, baseWeight(), light);
  }
};

inline CoatedBsdf Coated::at(const Rules& rules) const { return {*this, rules.exactFresnel}; }

}  // namespace trace
