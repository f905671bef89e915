#include "app/explain/light_shares.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"

namespace trace {
namespace {

/// Name of the object that emits, reflects or scatters there.
std::string placeOf(const RayNode& node, const Scene& scene) {
  return node.hit ? objectName(scene, node.hit->object) : "air";
}

std::string sourceOf(const Term& term, const RayNode& node, const RayTree& tree, const Scene& scene) {
  using TermKind = Term::Kind;
  const std::string here = placeOf(node, scene);
  if (term.light) return lightName(scene, term.light->light) + " on " + here;
  if (term.scattered) return lightName(scene, *term.scattered) + " in the air or a medium";
  switch (term.kind) {
    case TermKind::emissive: return node.hit ? here + ", which shines" : "a light that is seen";
    case TermKind::ambient: return "ambient light on " + here;
    case TermKind::caustic:
    case TermKind::photons: return "photons on " + here;
    case TermKind::irradiance: return "the irradiance cache on " + here;
    case TermKind::lamp: {
      const RayNode& asked = rayAt(tree, term.ray);
      return (asked.hit ? objectName(scene, asked.hit->object) : "the sky") + " on " + here;
    }
    case TermKind::joined: return "a path from a light that was joined with one on " + here;
    case TermKind::background: return node.outside ? "the environment" : "the background";
    case TermKind::fog: return "fog";
    case TermKind::medium: return "a medium";
    case TermKind::hole: return "holes of " + here;
    case TermKind::outline: return "an outline";
    default: return std::string(Term::kNames[static_cast<std::size_t>(term.kind)]) + " on " + here;
  }
}

}  // namespace

std::string wayText(int ray, const RayTree& tree, const Scene& scene) {
  int first = ray, more = 0;
  for (int parent = rayAt(tree, ray).parent; parent > 0; parent = rayAt(tree, parent).parent) {
    first = parent;
    ++more;
  }
  const RayNode& node = rayAt(tree, first);
  if (node.parent < 0) return "";
  const std::string kind(name(node.kind));
  return ", by " + kind + " in " + placeOf(rayAt(tree, node.parent), scene) +
         (more == 0 ? "" : " and " + std::to_string(more) + (more == 1 ? " more ray" : " more rays"));
}

std::vector<LightShare> lightShares(const RayTree& tree, const Scene& scene) {
  std::vector<LightShare> shares;
  double all = 0;
  for (int ray = 0; ray < static_cast<int>(tree.nodes.size()); ++ray) {
    const RayNode& node = rayAt(tree, ray);
    if (node.kind == RayKind::shadow || node.kind == RayKind::light || node.kind == RayKind::lamp) continue;
    for (const Term& term : node.terms) {
      const Color brings = node.weight * node.through * term.factor * term.value;
      if (term.goesOn() || term.dark || isBlack(brings) || !isFinite(brings)) continue;
      const std::string from = sourceOf(term, node, tree, scene) + wayText(ray, tree, scene);
      const auto same = std::find_if(shares.begin(), shares.end(),
                                     [&](const LightShare& share) { return share.from == from; });
      if (same == shares.end())
        shares.push_back({from, brings});
      else
        same->brings += brings;
    }
  }
  for (const LightShare& share : shares) all += std::abs(luminanceOf(share.brings));
  for (LightShare& share : shares) share.share = all > 0 ? std::abs(luminanceOf(share.brings)) / all : 0;
  std::stable_sort(shares.begin(), shares.end(),
                   [](const LightShare& a, const LightShare& b) { return a.share > b.share; });
  return shares;
}

}  // namespace trace
