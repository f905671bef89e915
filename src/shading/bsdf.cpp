#include "shading/bsdf.h"

#include <utility>

namespace trace {

Bsdf bsdfOf(const MaterialModel& model, const Rules& rules) {
  return match(model, [&](const auto& said) -> Bsdf { return said.at(rules); });
}

Bsdf bsdfOf(const Material& material, const TexturePlace& place, const Rules& rules) {
  return match(material.model, [&](auto said) -> Bsdf {
    applyTextures(said, material.textures, place);
    return said.at(rules);
  });
}

namespace {

/// Phong's scatter() is given the normal alone, as it was before there were others.
Scatter scatterOf(const PhongBsdf& model, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  return model.scatter(frame.normal, toLight, toEye);
}
template <class Model>
Scatter scatterOf(const Model& model, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  return model.scatter(frame, toLight, toEye);
}

}  // namespace

Scatter scatterOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toLight, const Vec3& toEye) {
  return match(bsdf, [&](const auto& model) { return scatterOf(model, frame, toLight, toEye); });
}

Color mirrorWeightOfOthers(const Bsdf& bsdf, Real cosine) {
  return match(bsdf, [&](const auto& model) { return model.mirrorWeight(cosine); });
}

Color exactMirrorWeight(const Bsdf& bsdf, Real cosine) {
  if (const auto* mixed = std::get_if<MixedBsdf>(&bsdf)) return mixed->exactMirrorWeight(cosine);
  return isGlossy(bsdf) ? Color(0) : mirrorWeight(bsdf, cosine);
}

Color passWeight(const Bsdf& bsdf, Real cosine) {
  return match(bsdf, [&](const auto& model) { return model.passWeight(cosine); });
}

bool mirrorIsExact(const Bsdf& bsdf) {
  return match(bsdf, [](const auto& model) { return model.mirrorIsExact(); });
}

bool isGlossyOfOthers(const Bsdf& bsdf) {
  return !std::holds_alternative<MixedBsdf>(bsdf) && !mirrorIsExact(bsdf) &&
         (whitted(bsdf).mirrors() || whitted(bsdf).transmits());
}

Color evaluateOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight,
                       Transport transport) {
  return match(bsdf, [&](const auto& model) { return model.evaluate(frame, toEye, toLight, transport); });
}

std::optional<BsdfSample> sample(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, Real choose, Vec2 u,
                                 Transport transport) {
  return match(bsdf, [&](const auto& model) { return model.sample(frame, toEye, choose, u, transport); });
}

Real densityOfOthers(const Bsdf& bsdf, const Frame& frame, const Vec3& toEye, const Vec3& toLight) {
  return match(bsdf, [&](const auto& model) { return model.density(frame, toEye, toLight); });
}

bool scattersOfOthers(const Bsdf& bsdf) {
  return match(bsdf, [](const auto& model) { return model.scatters(); });
}

// --- mixtures
// -----------------------------------------------------------------------------------------------

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

/// The mix of three materials of one model that says its values.
template <class Model>
requires requires { typename Model::Said; }
Bsdf mixOf(const Model& a, const Model& b, const Model& c, const Real (&weight)[3]) {
  const auto said = mixFields(a.said, b.said, c.said, weight);
  if constexpr (requires { a.exactFresnel; })
    return Model(said, a.exactFresnel);
  else
    return Model(said);
}
Bsdf mixOf(const PhongBsdf& a, const PhongBsdf& b, const PhongBsdf& c, const Real (&weight)[3]) {
  return mix(a, b, c, weight);
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

bool hasGrainOfOthers(const Bsdf& bsdf) {
  return match(bsdf, Overloaded{[](const MixedBsdf& mixed) {
                                  return anyPart(*mixed.parts,
                                                 [](const Bsdf& part) { return hasGrain(part); });
                                },
                                [](const PhongBsdf&) { return false; },
                                [](const auto& model) {
                                  return requires { model.said.angle; };
                                }});
}

Bsdf mix(const Bsdf& a, const Bsdf& b, const Bsdf& c, const Real (&weight)[3]) {
  if (a.index() != b.index() || a.index() != c.index()) return mixedParts(a, b, c, weight);
  return match(a, Overloaded{[&](const MixedBsdf&) { return mixedParts(a, b, c, weight); },
                             [&](const auto& first) -> Bsdf {
                               using Kind = std::remove_cvref_t<decltype(first)>;
                               return mixOf(first, std::get<Kind>(b), std::get<Kind>(c), weight);
                             }});
}

}  // namespace trace
