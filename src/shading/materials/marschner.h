// A strand of hair as a fibre of glass: light is mirrored by it (R), goes through it (TT), and comes back
// after one mirroring inside (TRT) (Marschner, Jensen, Cammarano, Worley and Hanrahan, Light Scattering from
// Human Hair Fibers, SIGGRAPH 2003). Variant: the lobes along and around the strand of d'Eon and others (EGSR
// 2011) and Chiang and others (A Practical and Controllable Hair and Fur Model, Eurographics 2016), with the
// directions of all further mirrorings spread evenly.
// Not reciprocal: widths around the strand are those of the eye's angle. Energy: at most what arrives; all of
// it if `color` is white.
//
// It is meant for strands that have a shape: cylinders, capsules, sweeps. Where on its breadth a strand is
// hit follows from the normal. Light from behind shines through the strand, as if its object were not in its
// own way.
//
// Use it for hair and fur made of strands. Not for a surface with a grain (hair, ward).
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/scattering.h"

namespace trace {

struct MarschnerBsdf;

struct Marschner : SurfaceFields {
  static constexpr std::string_view kKeyword = "marschner";
  static constexpr std::string_view kHelp = "a strand of hair that reflects and transmits light";
  static constexpr bool kReciprocal = false, kKeepsEnergy = true;
  using Bsdf = MarschnerBsdf;

  Color color{0.35, 0.18, 0.08};
  Real eumelanin = 0, pheomelanin = 0;
  Real roughness = 0.3, roughnessAround = 0.3, index = 1.55, tilt = 2, angle = 90;

  static constexpr auto fields() {
    return Fields{
        Field{"color", &Marschner::color, "", 0, 1,
              "colour of a head of hair; the absorption of a strand follows from it"},
        Field{"eumelanin", &Marschner::eumelanin, "", 0, kNoLimit,
              "concentration of brown pigment, in place of `color`: blond has 0.3, brown 1.3, black 8"},
        Field{"pheomelanin", &Marschner::pheomelanin, "", 0, kNoLimit,
              "concentration of red pigment, in place of `color`: red hair has about 1"},
        Field{"roughness", &Marschner::roughness, "", 0, 1, "roughness along the strand"},
        Field{"roughness_around", &Marschner::roughnessAround, "", 0, 1, "roughness around the strand"},
        Field{"index", &Marschner::index, "", 1, kNoLimit, "index of refraction"},
        Field{"tilt", &Marschner::tilt, "degrees", -20, 20,
              "tilt of the scales on the strand, which separates the highlights"},
        Field{"angle", &Marschner::angle, "degrees", -360, 360,
              "angle from the direction in which u grows to that of the strand; 90 is the direction of v"},
        SurfaceFields::fields()};
  }
  bool operator==(const Marschner&) const = default;

  Phong asPhong() const { return phongLike(*this, headColor(), Color(0.3), 40); }
  /// The absorption along one radius of a strand: of its pigments, if it has any, else by `color`.
  Color absorption() const;
  /// The colour of a head of such hair: `color`, unless there are pigments.
  Color headColor() const;
  MarschnerBsdf at(const Rules& rules) const;
};

struct MarschnerBsdf : LocalBsdf<MarschnerBsdf, Marschner> {
  static constexpr bool kTwoSided = true;
  static constexpr std::size_t kLobes = 4;  ///< R, TT, TRT, and the rest

  std::array<Real, kLobes> variance{};  ///< along the strand
  Real scale = 0;                       ///< scale of the logistic curve around it
  Color absorption;                     ///< along one radius

  MarschnerBsdf() = default;
  explicit MarschnerBsdf(const Marschner& model);

  Scatter value(const Vec3& eye, const Vec3& light, Transport) const;
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const;
  Real directionDensity(const Vec3& eye, const Vec3& light) const;

 private:
  struct Seen;  ///< what follows from the eye alone
  /// How dense the lobe is towards the light, per solid angle.
  Real lobe(std::size_t p, const Seen& seen, const Vec3& light) const;
};

inline MarschnerBsdf Marschner::at(const Rules&) const { return MarschnerBsdf(*this); }

}  // namespace trace
