// What a place of a surface does with light: the material models under the conventions of a render.
//
// A material says what a person wrote; its Bsdf is what light meets. Each model has both
// (shading/materials/phong.h). Directions point away from the surface and are unit vectors.
#pragma once

#include <variant>

#include "base/match.h"
#include "shading/material.h"

namespace trace {

using Bsdf = std::variant<PhongBsdf>;  ///< in the order of MaterialModel

inline Bsdf bsdfOf(const MaterialModel& model, const Rules& rules) {
  return match(model, [&](const auto& said) -> Bsdf { return said.at(rules); });
}

/// Of a place on the material, with its textures.
inline Bsdf bsdfOf(const Material& material, const TexturePlace& place, const Rules& rules) {
  return match(material.model, [&](auto said) -> Bsdf {
    applyTextures(said, material.textures, place);
    return said.at(rules);
  });
}

inline const WhittedTerms& whitted(const Bsdf& bsdf) {
  return match(bsdf, [](const auto& model) -> const WhittedTerms& { return model; });
}

/// What of light from `toLight` goes toward `toEye`, the cosine to the normal included.
inline Scatter scatter(const Bsdf& bsdf, const Vec3& normal, const Vec3& toLight, const Vec3& toEye) {
  return match(bsdf, [&](const auto& model) { return model.scatter(normal, toLight, toEye); });
}

/// Lamps can be seen on it.
inline bool scatters(const Bsdf& bsdf) {
  return match(bsdf, [](const auto& model) { return model.scatters(); });
}

/// Parts of one model, by weight.
inline Bsdf mix(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]) {
  return match(a, [&](const auto& first) -> Bsdf {
    using Kind = std::remove_cvref_t<decltype(first)>;
    return mix(first, std::get<Kind>(b), std::get<Kind>(c), weight);
  });
}

}  // namespace trace
