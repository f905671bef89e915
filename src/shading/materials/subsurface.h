// Marble, milk, skin, jade, wax: light goes in, is scattered many times and comes out elsewhere, below a
// clear layer (shading/optics/coating.h) that mirrors. What is said are the coefficients of Jensen,
// Marschner, Levoy and Hanrahan (SIGGRAPH 2001), whose table of measured ones is part of the library of
// materials.
//
// All integrators follow light through the body (render/paths/subsurface.h), by one of three ways to tell how
// far it gets. As the model below it comes out where it went in: the limit of a body that is large against
// the way of light in it. So the model is reciprocal, and gives back at most what arrives; all of it where
// nothing is absorbed.
//
// Use it for marble, milk, skin, wax, of the size that the scene says in millimetres. Not for leaves and
// paper, which are thinner than the way of light in them, nor for smoke (the medium of a material).
#pragma once

#include <array>
#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/coating.h"
#include "shading/optics/diffusion.h"

namespace trace {

struct SubsurfaceBsdf;

/// By what light spreads: two profiles of a flat body, or step by step as it is scattered.
enum class Spreading { dipole, diffusion, walk };
constexpr std::array<std::string_view, 3> names(Spreading) { return {"dipole", "diffusion", "walk"}; }

struct Subsurface : SurfaceFields {
  static constexpr std::string_view kKeyword = "subsurface";
  static constexpr std::string_view kHelp = "marble, milk, skin, jade: light is scattered inside the object";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = SubsurfaceBsdf;

  Color scatters{2.19, 2.62, 3.00}, absorbs{0.0021, 0.0041, 0.0071};  // marble
  Real millimetres = 10;
  Real index = 1.5, roughness = 0.2;
  Spreading spreading = Spreading::diffusion;

  static constexpr auto fields() {
    return Fields{
        Field{"scatters", &Subsurface::scatters, "per millimetre", 0, kNoLimit,
              "reduced scattering coefficient, per millimetre"},
        Field{"absorbs", &Subsurface::absorbs, "per millimetre", 0, kNoLimit,
              "absorption coefficient, per millimetre"},
        Field{"millimetres", &Subsurface::millimetres, "", 0, kNoLimit,
              "millimetres per unit of the scene: fewer make it more translucent"},
        Field{"index", &Subsurface::index, "", 1, kNoLimit, "index of refraction"},
        Field{
            "roughness", &Subsurface::roughness, "", 0, 1,
            "roughness of the surface, from 0, a mirror, to 1; the slope width of the facets is its square"},
        Field{"spreading", &Subsurface::spreading, "", 0, kNoLimit,
              "method: one of two profiles, or a random walk"},
        SurfaceFields::fields()};
  }
  bool operator==(const Subsurface&) const = default;

  /// The surface's albedo: the share that comes out of what goes in.
  Color albedo() const {
    return {Dipole(scatters.r, absorbs.r, index).albedo, Dipole(scatters.g, absorbs.g, index).albedo,
            Dipole(scatters.b, absorbs.b, index).albedo};
  }
  Phong asPhong() const {
    const Real width = max(0.03, roughness * roughness);
    const Color own(mirroredAlongNormal(index));
    Phong phong = phongLike(*this, albedo(), own + Color(0.2), 2 / (width * width));
    phong.reflective = own * Microfacets::of(Distribution::ggx, roughness).sharpShare();
    phong.index = index;
    return phong;
  }
  SubsurfaceBsdf at(const Rules& rules) const;
};

struct SubsurfaceBsdf : LocalBsdf<SubsurfaceBsdf, Subsurface> {
  /// whole: light comes out where it went in. surface: without what goes in. exit: what goes in there of
  /// light that comes out elsewhere, in all 1; the eye does not matter.
  enum class Part { whole, surface, exit };

  bool exactFresnel = false;
  Coating coat;
  Color albedo;
  Part part = Part::whole;

  SubsurfaceBsdf() = default;
  SubsurfaceBsdf(const Subsurface& model, bool exact)
      : LocalBsdf(model),
        exactFresnel(exact),
        coat(Distribution::ggx, model.roughness, 0,
             LayerFresnel(Color(mirroredAlongNormal(model.index)), model.index, exact)),
        albedo(model.albedo()) {
    index = model.index;
    reflective = coat.mirrorWeight(1);
  }
  SubsurfaceBsdf only(Part one) const {
    SubsurfaceBsdf other = *this;
    other.part = one;
    if (one == Part::exit) other.emissive = other.ambient = other.reflective = Color(0);
    return other;
  }

  /// The fraction of light to the eye that leaves the object.
  Color passes(Real cosine) const {
    const Color mirrored = coat.albedo({0, 0, max(0, min(1, cosine))});
    return {max(0, 1 - mirrored.r), max(0, 1 - mirrored.g), max(0, 1 - mirrored.b)};
  }

  /// The light that enters from there, over the light that enters from everywhere.
  Color enters(Real cosine) const {
    const Color in = passes(cosine);
    const auto share = [](Real a, Real mirrored) { return mirrored < 1 ? a / (1 - mirrored) : 0; };
    return {share(in.r, coat.meanAlbedo.r), share(in.g, coat.meanAlbedo.g), share(in.b, coat.meanAlbedo.b)};
  }

  bool scatters() const { return part != Part::surface || !coat.smooth; }
  bool mirrorIsExact() const { return coat.smooth; }
  Color mirrorWeight(Real cosine) const { return part == Part::exit ? Color(0) : coat.mirrorWeight(cosine); }

  Scatter value(const Vec3& eye, const Vec3& light) const {
    if (part == Part::exit) {
      const Color in = passes(light.z), mean = Color(1) + coat.meanAlbedo * -1;
      const auto share = [&](Real a, Real all) { return all > 0 ? a * light.z / (kPi * all) : 0; };
      return {{share(in.r, mean.r), share(in.g, mean.g), share(in.b, mean.b)}, {}};
    }
    return {part == Part::surface ? Color(0) : albedo * coat.base(eye, light), coat.mirrored(eye, light)};
  }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    return part == Part::exit ? cosineDirection(u) : coat.direction(eye, baseWeight(), choose, u);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    return part == Part::exit ? cosineDensity(light) : coat.density(eye, baseWeight(), light);
  }

 private:
  Real baseWeight() const { return part == Part::surface ? 0 : maxComponent(albedo); }
};

inline SubsurfaceBsdf Subsurface::at(const Rules& rules) const { return {*this, rules.exactFresnel}; }

}  // namespace trace
