// The functions of a model's Bsdf, as rows of a table, and mixtures of several models.
#include "shading/bsdf.h"

#include <array>
#include <utility>

#include "shading/material_list.h"

namespace trace {

Bsdf bsdfOf(const Material& material, const TexturePlace& place, const Rules& rules) {
  return bsdfAt(material.model, material.textures, place, rules);
}

struct MixedParts;

/// Parts of different models, by weight: each is asked by itself.
struct MixedBsdf : WhittedTerms {
  std::shared_ptr<const MixedParts> parts;

  /// Fields common to models.
  static constexpr auto fields() {
    const auto named = [](const char* keyword, auto member) {
      return Field{keyword, member, "", 0, kNoLimit, ""};
    };
    return Fields{
        named("emissive", &MixedBsdf::emissive),     named("ambient", &MixedBsdf::ambient),
        named("reflective", &MixedBsdf::reflective), named("transmissive", &MixedBsdf::transmissive),
        named("index", &MixedBsdf::index),           named("shadow", &MixedBsdf::shadow)};
  }

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

Color exactMirrorWeightOfOther(const Bsdf& bsdf, Real cosine) {
  if (const auto* mixed = bsdf.as<MixedBsdf>()) return mixed->exactMirrorWeight(cosine);
  return isGlossy(bsdf) ? Color(0) : mirrorWeight(bsdf, cosine);
}

bool isOtherGlossy(const Bsdf& bsdf) {
  return !bsdf.is<MixedBsdf>() && !mirrorIsExact(bsdf) &&
         (bsdf.terms().mirrors() || bsdf.terms().transmits());
}

// --- mixtures -----------------------------------------------------------------------------------------

struct MixedParts {
  Bsdf of[3];
  Real weight[3];
};

namespace {

/// The sum over the parts of weight times what `ask` gives.
template <class Value, class Ask>
Value weighed(const MixedParts& parts, Value sum, const Ask& ask) {
  for (int i = 0; i < 3; ++i)
    if (parts.weight[i] > 0) sum += parts.weight[i] * ask(parts.of[i]);
  return sum;
}

template <class Test>
bool anyPart(const MixedParts& parts, const Test& test) {
  for (int i = 0; i < 3; ++i)
    if (parts.weight[i] > 0 && test(parts.of[i])) return true;
  return false;
}

WhittedTerms weighedTerms(const MixedParts& parts) {
  const auto all = [&](auto member) {
    return weighed(parts, std::remove_cvref_t<decltype(WhittedTerms{}.*member)>(0),
                   [&](const Bsdf& part) { return whitted(part).*member; });
  };
  WhittedTerms terms;
  terms.emissive = all(&WhittedTerms::emissive);
  terms.ambient = all(&WhittedTerms::ambient);
  terms.reflective = all(&WhittedTerms::reflective);
  terms.transmissive = all(&WhittedTerms::transmissive);
  terms.index = all(&WhittedTerms::index);
  terms.shadow = all(&WhittedTerms::shadow);
  return terms;
}

Bsdf mixedParts(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]) {
  auto parts = std::make_shared<MixedParts>(MixedParts{{a, b, c}, {weight[0], weight[1], weight[2]}});
  return MixedBsdf{weighedTerms(*parts), parts};
}

}  // namespace

bool MixedBsdf::scatters() const {
  return anyPart(*parts, [](const Bsdf& part) { return trace::scatters(part); });
}
bool MixedBsdf::mirrorIsExact() const {
  return !anyPart(*parts, [](const Bsdf& part) { return !trace::mirrorIsExact(part); });
}
Color MixedBsdf::mirrorWeight(Real cosine) const {
  return weighed(*parts, Color(0), [&](const Bsdf& part) { return trace::mirrorWeight(part, cosine); });
}
Color MixedBsdf::exactMirrorWeight(Real cosine) const {
  return weighed(*parts, Color(0), [&](const Bsdf& part) { return trace::exactMirrorWeight(part, cosine); });
}
Color MixedBsdf::passWeight(Real cosine) const {
  return weighed(*parts, Color(0), [&](const Bsdf& part) { return trace::passWeight(part, cosine); });
}
Scatter MixedBsdf::scatter(const Frame& frame, const Vec3& toLight, const Vec3& toEye) const {
  Scatter sum;
  for (int i = 0; i < 3; ++i) {
    if (!(parts->weight[i] > 0)) continue;
    const Scatter part = trace::scatter(parts->of[i], frame, toLight, toEye);
    sum.diffuse += parts->weight[i] * part.diffuse;
    sum.specular += parts->weight[i] * part.specular;
  }
  return sum;
}
Color MixedBsdf::evaluate(const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                          Transport transport) const {
  return weighed(*parts, Color(0),
                 [&](const Bsdf& part) { return trace::evaluate(part, frame, toEye, toLight, transport); });
}
std::optional<BsdfSample> MixedBsdf::sample(const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                            Transport transport) const {
  Real before = 0;
  for (int i = 0; i < 3; ++i) {
    const Real weight = parts->weight[i];
    if (weight > 0 && (choose < before + weight || i == 2)) {
      const auto drawn = trace::sample(parts->of[i], frame, toEye,
                                       min((choose - before) / weight, 0x1.fffffep-1), u, transport);
      if (!drawn) return {};
      const Real density = this->density(frame, toEye, drawn->toLight);
      return BsdfSample{drawn->toLight, evaluate(frame, toEye, drawn->toLight, transport) / density, density};
    }
    before += weight;
  }
  return {};
}
Real MixedBsdf::density(const Frame& frame, const Vec3& toEye, const Vec3& toLight) const {
  return weighed(*parts, Real(0),
                 [&](const Bsdf& part) { return trace::density(part, frame, toEye, toLight); });
}

// --- the rows -----------------------------------------------------------------------------------------

namespace {

template <class Model>
const Model& held(const void* bsdf) {
  return *static_cast<const Model*>(bsdf);
}

/// Phong's scatter() is given the normal alone, as it was before there were others.
template <class Model>
Scatter scatterOf(const void* bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  if constexpr (std::is_same_v<Model, PhongBsdf>)
    return held<Model>(bsdf).scatter(frame.normal, toLight, toEye);
  else
    return held<Model>(bsdf).scatter(frame, toLight, toEye);
}

template <class Model>
std::vector<ModelField> saidBy(void* bsdf) {
  if constexpr (std::is_same_v<Model, PhongBsdf>)
    return fieldsIn<ModelField, PhongBsdf>(bsdf);
  else if constexpr (std::is_same_v<Model, MixedBsdf>)
    return fieldsIn<ModelField, MixedBsdf>(bsdf);
  else
    return fieldsIn<ModelField, typename Model::Said>(&static_cast<Model*>(bsdf)->said);
}

template <class Model>
bool hasGrainOf(const void* bsdf) {
  if constexpr (std::is_same_v<Model, MixedBsdf>)
    return anyPart(*held<MixedBsdf>(bsdf).parts, [](const Bsdf& part) { return hasGrain(part); });
  else
    return requires(const Model& model) { model.said.angle; };
}

/// The mix of three materials of one model that says its values.
template <class Model>
Bsdf mixOf(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]) {
  const Model &x = *a.as<Model>(), &y = *b.as<Model>(), &z = *c.as<Model>();
  if constexpr (std::is_same_v<Model, PhongBsdf>) {
    return mix(x, y, z, weight);
  } else if constexpr (std::is_same_v<Model, MixedBsdf>) {
    return mixedParts(a, b, c, weight);
  } else {
    const auto said = mixFields(x.said, y.said, z.said, weight);
    if constexpr (requires { x.exactFresnel; })
      return Model(said, x.exactFresnel);
    else
      return Model(said);
  }
}

template <class Model>
consteval std::string_view keywordOfBsdf() {
  if constexpr (std::is_same_v<Model, PhongBsdf>)
    return Phong::kKeyword;
  else if constexpr (std::is_same_v<Model, MixedBsdf>)
    return "mixed";
  else
    return Model::Said::kKeyword;
}

}  // namespace

template <class Model>
constinit const BsdfRow BsdfRowOf<Model>::kRow{
    .keyword = keywordOfBsdf<Model>(),
    .copy = [](void* to, const void* from) { new (to) Model(held<Model>(from)); },
    .destroy = [](void* bsdf) { static_cast<Model*>(bsdf)->~Model(); },
    .said = saidBy<Model>,
    .scatter = scatterOf<Model>,
    .mirrorWeight = [](const void* bsdf, Real cosine) { return held<Model>(bsdf).mirrorWeight(cosine); },
    .passWeight = [](const void* bsdf, Real cosine) { return held<Model>(bsdf).passWeight(cosine); },
    .mirrorIsExact = [](const void* bsdf) { return held<Model>(bsdf).mirrorIsExact(); },
    .evaluate =
        [](const void* bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
           Transport transport) { return held<Model>(bsdf).evaluate(frame, toEye, toLight, transport); },
    .sample =
        [](const void* bsdf, const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
           Transport transport) { return held<Model>(bsdf).sample(frame, toEye, choose, u, transport); },
    .density = [](const void* bsdf, const Frame& frame, const Vec3& toEye,
                  const Vec3& toLight) { return held<Model>(bsdf).density(frame, toEye, toLight); },
    .scatters = [](const void* bsdf) { return held<Model>(bsdf).scatters(); },
    .hasGrain = hasGrainOf<Model>,
    .mix = mixOf<Model>};

std::vector<const BsdfRow*> bsdfRows() {
  return []<class... Model>(const std::variant<Model...>*) {
    return std::vector<const BsdfRow*>{&BsdfRowOf<typename Model::Bsdf>::kRow...,
                                       &BsdfRowOf<MixedBsdf>::kRow};
  }(static_cast<const ModelList*>(nullptr));
}

Bsdf mix(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]) {
  if (&a.row() != &b.row() || &a.row() != &c.row()) return mixedParts(a, b, c, weight);
  return a.row().mix(a, b, c, weight);
}

}  // namespace trace
