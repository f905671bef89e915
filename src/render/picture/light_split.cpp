#include "render/picture/light_split.h"

#include <algorithm>
#include <variant>

namespace trace {
namespace {

/// A node's share of the camera ray's radiance, and how often light that it brings is scattered before.
struct Carried {
  Color weight;
  int scattered = 0;
};

/// Whether the term scales all that was added before it: Gather::cover and Gather::dim.
bool isCover(const Term& term, const Color& before) {
  const bool covers = term.kind == Term::Kind::outline || term.kind == Term::Kind::hole ||
                      term.kind == Term::Kind::fog ||
                      (term.medium && term.medium->what == MediumTerm::What::covers);
  return covers && !term.scattered && term.value == before * -1;
}

/// Whether a pane lets light straight through.
bool isPassage(const Term& term, const RayNode& node) {
  return term.kind == Term::Kind::refraction && node.bsdf && whitted(*node.bsdf).passage == Passage::straight;
}

std::uint32_t at(const std::vector<std::uint32_t>& numbers, std::size_t i, std::uint32_t otherwise) {
  return i < numbers.size() ? numbers[i] : otherwise;
}

/// The light that a ray meets, if it ends there.
std::optional<std::uint32_t> metLight(const RayNode& node) {
  for (const RayEnd& end : node.ends)
    if (const auto* met = std::get_if<MetLight>(&end)) return met->light;
  return {};
}

/// The source of the light of a term that no further ray brings, and how often that is scattered there.
struct Source {
  std::uint32_t group;
  int scattered;
};
Source sourceOf(const Term& term, const RayNode& node, const PassFacts& facts) {
  const auto ofObject = [&](std::uint32_t object) { return at(facts.objectGroups, object, facts.other); };
  if (term.scattered) return {at(facts.lightGroups, *term.scattered, facts.other), 1};
  switch (term.kind) {
    case Term::Kind::light:
      return {term.light ? at(facts.lightGroups, term.light->light, facts.other) : facts.other, 1};
    case Term::Kind::emissive:
      if (const auto light = metLight(node)) return {at(facts.lightGroups, *light, facts.other), 0};
      return {node.hit ? ofObject(node.hit->object) : facts.other, 0};
    case Term::Kind::background: return {facts.background, 0};
    case Term::Kind::ambient:
    case Term::Kind::fog: return {facts.ambient, 1};
    case Term::Kind::lamp:
      if (!term.chance || !term.chance->lamp) return {facts.other, 1};
      return {*term.chance->lamp == ChanceTerm::kSky ? facts.background : ofObject(*term.chance->lamp), 1};
    case Term::Kind::medium:
      if (term.medium && term.medium->what == MediumTerm::What::glows)
        return {ofObject(term.medium->object), 0};
      return {term.photons ? facts.other : facts.ambient, term.photons ? 2 : 1};
    default: return {facts.other, 2};  // photons, and what was computed before
  }
}

}  // namespace

void splitLight(const RayTree& tree, const PassFacts& facts, std::size_t groups, LightSplit& split) {
  split.direct.assign(groups, Color(0));
  split.indirect.assign(groups, Color(0));
  if (tree.nodes.empty()) return;
  std::vector<Carried> carried(tree.nodes.size());
  carried[0] = {Color(1), 0};
  std::vector<char> covers;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    if (node.kind == RayKind::shadow || isBlack(carried[i].weight)) continue;
    covers.assign(node.terms.size(), 0);
    Color sum;
    for (std::size_t k = 0; k < node.terms.size(); ++k) {
      covers[k] = isCover(node.terms[k], sum);
      sum += node.terms[k].factor * node.terms[k].value;
    }
    Color weight = carried[i].weight * node.through;
    for (std::size_t k = node.terms.size(); k-- > 0;) {  // what covers dims the terms before it
      const Term& term = node.terms[k];
      if (covers[k]) {
        weight *= Color(1) + term.factor * -1;
        continue;
      }
      if (term.ray >= 0 && rayAt(tree, term.ray).kind != RayKind::shadow) {
        const int more = term.kind == Term::Kind::hole || isPassage(term, node) ? 0 : 1;
        carried[static_cast<std::size_t>(term.ray)] = {weight * term.factor, carried[i].scattered + more};
        continue;
      }
      const Source source = sourceOf(term, node, facts);
      auto& parts = carried[i].scattered + source.scattered <= 1 ? split.direct : split.indirect;
      if (source.group < groups) parts[source.group] += weight * term.factor * term.value;
    }
  }
}

}  // namespace trace
