// A pane whose two faces lie so close together that light goes straight through it: windows, glasses of
// spectacles, soap bubbles. Light that is mirrored to and fro inside it is summed: of a pane thick against
// the wavelength by its power, of a film with its phase (shading/optics/thin_film.h). Fresnel's formula is
// exact. Reciprocal: what goes straight on and what is mirrored is the same from both sides. Energy: all of
// it, except for what `color` takes.
//
// It encloses nothing: what is inside of a bubble is air.
//
// Use it for windows and bubbles. Not for a glass object: it does not refract.
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/thin_film.h"

namespace trace {

struct ThinGlassBsdf;

struct ThinGlass : SurfaceFields {
  static constexpr std::string_view kKeyword = "thin_glass";
  static constexpr std::string_view kHelp = "a window pane or a soap bubble: reflects, and does not refract";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = ThinGlassBsdf;

  Color color{1};
  Real index = 1.5, film = 0;

  static constexpr auto fields() {
    return Fields{Field{"color", &ThinGlass::color, "", 0, 1, "transmittance along the normal"},
                  Field{"index", &ThinGlass::index, "", 0, kNoLimit, "index of refraction"},
                  Field{"film", &ThinGlass::film, "nanometres", 0, 5000,
                        "thickness of an interference film, 100 to 1000 for soap; 0 is a plain pane"},
                  SurfaceFields::fields()};
  }
  bool operator==(const ThinGlass&) const = default;

  struct Shares {
    Color mirrored, passed;
  };
  /// Where light goes that arrives at that cosine to the normal.
  Shares shares(Real cosine) const {
    if (film > 0) {
      const Color r = ThinFilm{index, 1, film}.mirrored(cosine);
      return {r, (Color(1) + r * -1) * color};
    }
    const Real c = max(0, min(1, cosine)), square = 1 - (1 - c * c) / (index * index);
    if (!(square > 0)) return {Color(1), Color(0)};
    const Reflectance face = reflectanceDielectric(c, 1, index);
    const Color crossed = color == Color(1) ? color : pow(color, 1 / std::sqrt(square));  // Beer's law
    Shares sum;
    for (const Real r : {face.s, face.p}) {
      const auto channel = [&](Real t, Real& mirrored, Real& passed) {
        const Real to = 1 - r, all = 1 - r * r * t * t;
        mirrored += all > 0 ? (r + to * to * r * t * t / all) / 2 : 0.5;
        passed += all > 0 ? to * to * t / all / 2 : 0;
      };
      channel(crossed.r, sum.mirrored.r, sum.passed.r);
      channel(crossed.g, sum.mirrored.g, sum.passed.g);
      channel(crossed.b, sum.mirrored.b, sum.passed.b);
    }
    return sum;
  }

  Phong asPhong() const {
    const Shares along = shares(1);
    Phong phong = phongLike(*this, Color(0), Color(0.5), 200);
    phong.reflective = along.mirrored;
    phong.transmissive = along.passed;
    return phong;
  }
  ThinGlassBsdf at(const Rules& rules) const;
};

struct ThinGlassBsdf : LocalBsdf<ThinGlassBsdf, ThinGlass> {
  ThinGlassBsdf() = default;
  explicit ThinGlassBsdf(const ThinGlass& model) : LocalBsdf(model) {
    const ThinGlass::Shares along = model.shares(1);
    reflective = along.mirrored;
    transmissive = along.passed;
    passage = Passage::straight;
  }

  bool scatters() const { return false; }
  bool mirrorIsExact() const { return true; }
  Color mirrorWeight(Real cosine) const { return said.shares(cosine).mirrored; }
  Color passWeight(Real cosine) const { return said.shares(cosine).passed; }
  Scatter value(const Vec3&, const Vec3&) const { return {}; }
};

inline ThinGlassBsdf ThinGlass::at(const Rules&) const { return ThinGlassBsdf(*this); }

}  // namespace trace
