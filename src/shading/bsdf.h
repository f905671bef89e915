// The scattering of light at a surface point: the material models under the conventions of a render.
//
// A material says what a person wrote; its Bsdf is what light hits. Each model has both, in one header of
// shading/materials/. The contract of all functions here is in shading/scattering.h.
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <vector>

#include "shading/material.h"
#include "shading/scattering.h"

namespace trace {

/// A row of the table of Bsdfs: what a model's Bsdf answers, whatever its type.
struct BsdfRow {
  std::string_view keyword;                  ///< keyword of the model; "mixed" for several
  void (*copy)(void* to, const void* from);  ///< to where nothing is yet
  void (*destroy)(void* bsdf);
  std::vector<ModelField> (*said)(void* bsdf);
  Scatter (*scatter)(const void* bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye);
  Color (*mirrorWeight)(const void* bsdf, Real cosine);
  Color (*passWeight)(const void* bsdf, Real cosine);
  bool (*mirrorIsExact)(const void* bsdf);
  Color (*evaluate)(const void* bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                    Transport transport);
  std::optional<BsdfSample> (*sample)(const void* bsdf, const Frame& frame, const Vec3& toEye, Real choose,
                                      Vec2 u, Transport transport);
  Real (*density)(const void* bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight);
  bool (*scatters)(const void* bsdf);
  bool (*hasGrain)(const void* bsdf);
  /// The mixture of three of this model.
  Bsdf (*mix)(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]);
};

/// The row of each model's Bsdf, and of MixedBsdf; all are in bsdf.cpp.
template <class Model>
struct BsdfRowOf {
  static const BsdfRow kRow;
};

/// The Bsdf of any model, held in place: rays hit very many.
class Bsdf {
 public:
  /// The largest of a model that fits.
  static constexpr std::size_t kMostBytes = 1240;

  Bsdf() : Bsdf(PhongBsdf()) {}
  template <std::derived_from<WhittedTerms> Model>
  Bsdf(const Model& model)  // NOLINT(google-explicit-constructor): a model's Bsdf is a Bsdf
      : row_(&BsdfRowOf<Model>::kRow) {
    static_assert(sizeof(Model) <= kMostBytes && alignof(Model) <= alignof(Real));
    new (data_) Model(model);
  }
  Bsdf(const Bsdf& other) : row_(other.row_) { copyData(other); }
  Bsdf& operator=(const Bsdf& other) {
    if (this == &other) return *this;
    row_->destroy(data_);
    row_ = other.row_;
    copyData(other);
    return *this;
  }
  ~Bsdf() {
    if (!is<PhongBsdf>()) row_->destroy(data_);
  }

  template <class Model>
  bool is() const {
    return row_ == &BsdfRowOf<Model>::kRow;
  }
  /// Null if it is of another model.
  template <class Model>
  const Model* as() const {
    return is<Model>() ? static_cast<const Model*>(data()) : nullptr;
  }

  const BsdfRow& row() const { return *row_; }
  const void* data() const { return data_; }
  /// The terms that every Bsdf begins with.
  const WhittedTerms& terms() const { return *static_cast<const WhittedTerms*>(data()); }
  /// The model's fields at the place; of several what they have in common.
  std::vector<ModelField> said() const { return row_->said(const_cast<std::byte*>(data_)); }

 private:
  void copyData(const Bsdf& other) {
    if (const auto* phong = other.as<PhongBsdf>())
      new (data_) PhongBsdf(*phong);
    else
      row_->copy(data_, other.data_);
  }

  const BsdfRow* row_;
  alignas(Real) std::byte data_[kMostBytes];
};

/// All rows, in the order of the list of models; that of mixtures is the last.
std::vector<const BsdfRow*> bsdfRows();

Bsdf bsdfOf(const MaterialModel& model, const Rules& rules);
Bsdf bsdfAt(const MaterialModel& model, const std::vector<FieldTexture>& textures, const TexturePlace& place,
            const Rules& rules);
/// The BSDF at a place on the material, with its textures.
Bsdf bsdfOf(const Material& material, const TexturePlace& place, const Rules& rules);

inline const WhittedTerms& whitted(const Bsdf& bsdf) { return bsdf.terms(); }

/// The fraction of light from `toLight` that goes toward `toEye` in Whitted's equation, the cosine to the
/// normal included. Here and below Phong's model, the most frequent, is asked without a call.
inline Scatter scatter(const Bsdf& bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->scatter(frame.normal, toLight, toEye);
  return bsdf.row().scatter(bsdf.data(), frame, toLight, toEye);
}

/// The weight of the mirrored ray at that `cosine` to the normal. On a surface that is not smooth this ray
/// stands for the core of the lobe around it, where an integrator sends no ray into that lobe.
inline Color mirrorWeight(const Bsdf& bsdf, Real cosine) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->mirrorWeight(cosine);
  return bsdf.row().mirrorWeight(bsdf.data(), cosine);
}
/// The terms without the rays that stand for lobes, for integrators that follow these; not of Phong's model.
Color exactMirrorWeightOfOther(const Bsdf& bsdf, Real cosine);
inline Color exactMirrorWeight(const Bsdf& bsdf, Real cosine) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->mirrorWeight(cosine);
  return exactMirrorWeightOfOther(bsdf, cosine);
}
/// The weight of the ray that goes straight on, where the passage is straight.
inline Color passWeight(const Bsdf& bsdf, Real cosine) { return bsdf.row().passWeight(bsdf.data(), cosine); }
/// False if `evaluate` has all that is mirrored.
inline bool mirrorIsExact(const Bsdf& bsdf) { return bsdf.row().mirrorIsExact(bsdf.data()); }
/// It mirrors or refracts into a lobe, for the core of which Whitted's rays stand.
bool isOtherGlossy(const Bsdf& bsdf);
inline bool isGlossy(const Bsdf& bsdf) { return !bsdf.is<PhongBsdf>() && isOtherGlossy(bsdf); }

/// f |cos(toLight)|, of what is spread over directions.
inline Color evaluate(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                      Transport transport = Transport::radiance) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->evaluate(frame, toEye, toLight, transport);
  return bsdf.row().evaluate(bsdf.data(), frame, toEye, toLight, transport);
}
/// A direction chosen by three numbers from 0 to 1. Nothing where nothing is scattered to the eye.
inline std::optional<BsdfSample> sample(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, Real choose,
                                        Vec2 u, Transport transport = Transport::radiance) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->sample(frame, toEye, choose, u, transport);
  return bsdf.row().sample(bsdf.data(), frame, toEye, choose, u, transport);
}
/// The density of that choice, per solid angle.
inline Real density(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->density(frame, toEye, toLight);
  return bsdf.row().density(bsdf.data(), frame, toEye, toLight);
}

/// It scatters evenly by the cosine: sample() asks for no number to choose by.
inline bool hasOneLobe(const Bsdf& bsdf) {
  const auto* phong = bsdf.as<PhongBsdf>();
  return phong && phong->isEven();
}

/// Lamps can be seen on it.
inline bool scatters(const Bsdf& bsdf) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) return phong->scatters();
  return bsdf.row().scatters(bsdf.data());
}
/// It asks for Frame::along.
inline bool hasGrain(const Bsdf& bsdf) { return !bsdf.is<PhongBsdf>() && bsdf.row().hasGrain(bsdf.data()); }

/// Parts by weight: of one model their values are mixed, of several what they scatter.
Bsdf mix(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]);

}  // namespace trace
