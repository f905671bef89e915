// The scattering of light at a surface point: the material models under the conventions of a render.
//
// A material says what a person wrote; its Bsdf is what light meets. Each model has both, in one header of
// shading/materials/. The contract of all functions here is in shading/scattering.h.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "base/match.h"
#include "shading/material.h"
#include "shading/scattering.h"

namespace trace {

struct MixedParts;

/// Parts of different models, by weight: each is asked by itself.
struct MixedBsdf : WhittedTerms {
  std::shared_ptr<const MixedParts> parts;

  bool scatters() const;
  bool mirrorIsExact() const;
  Color mirrorWeight(Real cosine) const;
  Color exactMirrorWeight(Real cosine) const;
  Color passWeight(Real cosine) const;
  Scatter scatter(const Frame& frame, const Vec3& toLight, const Vec3& toEye) const;
  Color evaluate(const Frame& frame, const Vec3& toEye, const Vec3& toLight, Transport transport) const;
  std::optional<BsdfSample> sample(const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                   Transport transport) const;
  Real density(const Frame& frame, const Vec3& toEye, const Vec3& toLight) const;
};

template <class Models>
struct BsdfVariant;
template <class... Model>
struct BsdfVariant<std::variant<Model...>> {
  using Type = std::variant<typename Model::Bsdf..., MixedBsdf>;
};
/// Those of the models in the order of MaterialModel, and the mixed one.
using Bsdf = BsdfVariant<VariantOf<MaterialModel>>::Type;

Bsdf bsdfOf(const MaterialModel& model, const Rules& rules);
/// The BSDF at a place on the material, with its textures.
Bsdf bsdfOf(const Material& material, const TexturePlace& place, const Rules& rules);

inline const WhittedTerms& whitted(const Bsdf& bsdf) {
  return match(bsdf, [](const auto& model) -> const WhittedTerms& { return model; });
}

/// The fraction of light from `toLight` that goes toward `toEye` in Whitted's equation, the cosine to the
/// normal included. Here and below Phong's model, the most frequent, is asked without a call.
Scatter scatterOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye);
inline Scatter scatter(const Bsdf& bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  if (const auto* phong = std::get_if<PhongBsdf>(&bsdf)) return phong->scatter(frame.normal, toLight, toEye);
  return scatterOfOthers(bsdf, frame, toLight, toEye);
}

/// The weight of the mirrored ray at that `cosine` to the normal. On a surface that is not smooth this ray
/// stands for the core of the lobe around it, where an integrator sends no ray into that lobe.
Color mirrorWeightOfOthers(const Bsdf& bsdf, Real cosine);
inline Color mirrorWeight(const Bsdf& bsdf, Real cosine) {
  if (const auto* phong = std::get_if<PhongBsdf>(&bsdf)) return phong->mirrorWeight(cosine);
  return mirrorWeightOfOthers(bsdf, cosine);
}
/// The terms without the rays that stand for lobes, for integrators that follow these.
Color exactMirrorWeight(const Bsdf& bsdf, Real cosine);
/// The weight of the ray that goes straight on, where the passage is straight.
Color passWeight(const Bsdf& bsdf, Real cosine);
/// False if `evaluate` has all that is mirrored.
bool mirrorIsExact(const Bsdf& bsdf);
/// It mirrors or refracts into a lobe, for the core of which Whitted's rays stand.
bool isGlossyOfOthers(const Bsdf& bsdf);
inline bool isGlossy(const Bsdf& bsdf) {
  return !std::holds_alternative<PhongBsdf>(bsdf) && isGlossyOfOthers(bsdf);
}

/// f |cos(toLight)|, of what is spread over directions.
Color evaluateOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                       Transport transport);
inline Color evaluate(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                      Transport transport = Transport::radiance) {
  if (const auto* phong = std::get_if<PhongBsdf>(&bsdf))
    return phong->evaluate(frame, toEye, toLight, transport);
  return evaluateOfOthers(bsdf, frame, toEye, toLight, transport);
}
/// A direction chosen by three numbers from 0 to 1. Nothing where nothing is scattered to the eye.
std::optional<BsdfSample> sample(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                 Transport transport = Transport::radiance);
/// The density of that choice, per solid angle.
Real densityOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight);
inline Real density(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight) {
  if (const auto* phong = std::get_if<PhongBsdf>(&bsdf)) return phong->density(frame, toEye, toLight);
  return densityOfOthers(bsdf, frame, toEye, toLight);
}

/// It scatters evenly by the cosine: sample() asks for no number to choose by.
inline bool hasOneLobe(const Bsdf& bsdf) {
  const auto* phong = std::get_if<PhongBsdf>(&bsdf);
  return phong && phong->isEven();
}

/// Lamps can be seen on it.
bool scattersOfOthers(const Bsdf& bsdf);
inline bool scatters(const Bsdf& bsdf) {
  if (const auto* phong = std::get_if<PhongBsdf>(&bsdf)) return phong->scatters();
  return scattersOfOthers(bsdf);
}
/// It asks for Frame::along.
bool hasGrainOfOthers(const Bsdf& bsdf);
inline bool hasGrain(const Bsdf& bsdf) {
  return !std::holds_alternative<PhongBsdf>(bsdf) && hasGrainOfOthers(bsdf);
}

/// Parts by weight: of one model their values are mixed, of several what they scatter.
Bsdf mix(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]);

}  // namespace trace
