// Cloth with standing fibres on a matt base: dark seen from the front, bright at its edges. Sheen by Estevez
// and Kulla (shading/optics/sheen.h), over Lambert's base, which gets what the sheen leaves on the way in and
// out. Reciprocal. Energy: gives back at most what arrives.
//
// Use it for velvet, felt, peach skin. Not for satin, which shines across its threads (ward, hair).
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/sheen.h"

namespace trace {

struct VelvetBsdf;

struct Velvet : SurfaceFields {
  static constexpr std::string_view kKeyword = "velvet";
  static constexpr std::string_view kHelp = "cloth with standing fibres that shine at its edges";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = VelvetBsdf;

  Color diffuse{0.1}, sheen{0.8};
  Real roughness = 0.4;

  static constexpr auto fields() {
    return Fields{Field{"diffuse", &Velvet::diffuse, "", 0, 1, "colour of the cloth below the fibres"},
                  Field{"sheen", &Velvet::sheen, "", 0, 1, "colour of the fibres"},
                  Field{"roughness", &Velvet::roughness, "", 0, 1, "roughness of the fibres"},
                  SurfaceFields::fields()};
  }
  bool operator==(const Velvet&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse + sheen * 0.2); }
  VelvetBsdf at(const Rules& rules) const;
};

struct VelvetBsdf : LocalBsdf<VelvetBsdf, Velvet> {
  Sheen fibres;

  VelvetBsdf() = default;
  explicit VelvetBsdf(const Velvet& model) : LocalBsdf(model), fibres(Sheen::of(model.roughness)) {}

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.sheen); }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const Real most = min(1, maxComponent(said.sheen));
    const Real through = (1 - most * fibres.albedo(eye.z)) * (1 - most * fibres.albedo(light.z));
    return {said.diffuse * (through * light.z / kPi), said.sheen * fibres.value(eye, light)};
  }
};

inline VelvetBsdf Velvet::at(const Rules&) const { return VelvetBsdf(*this); }

}  // namespace trace
