#include "render/rays/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/match.h"
#include "base/text.h"
#include "scene/groups.h"

namespace trace {
namespace {

bool same(const Color& a, const Color& b) {
  const auto equal = [](double x, double y) {
    return std::isnan(x) ? std::isnan(y) : x == y && std::signbit(x) == std::signbit(y);
  };
  return equal(a.r, b.r) && equal(a.g, b.g) && equal(a.b, b.b);
}

/// For the eye.
std::string shortText(Real x, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

std::string kindName(RayKind kind) { return std::string(name(kind)); }

/// Its secondary rays: "reflection and 5 refractions".
std::string sentOn(const RayNode& node) {
  std::vector<std::pair<std::string_view, int>> kinds;
  for (const Term& term : node.terms) {
    if (!term.goesOn()) continue;
    const std::string_view kind = term.medium ? "bounce" : Term::kNames[static_cast<std::size_t>(term.kind)];
    if (kinds.empty() || kinds.back().first != kind) kinds.emplace_back(kind, 0);
    ++kinds.back().second;
  }
  std::string text;
  for (const auto& [kind, count] : kinds)
    text += (text.empty() ? "" : " and ") + (count > 1 ? std::to_string(count) + " " : "") +
            std::string(kind) + (count > 1 ? "s" : "");
  return text;
}

/// Where a medium sent the path of the ray on, which came no farther; null if none did.
const MediumTerm* turnedBy(const RayNode& node) {
  for (const Term& term : node.terms)
    if (term.goesOn() && term.medium) return &*term.medium;
  return nullptr;
}

/// The object and its position: "sphere (scene.ray:12)".
std::string named(std::string_view keyword, const SourcePlace& place) {
  std::string text(keyword);
  if (const std::string where = shortPlace(place); !where.empty()) text += " (" + where + ")";
  return text;
}

std::string outside(const RayNode& node) { return node.outside ? sentence(*node.outside) : "background"; }

std::string words(const RayEnd& end, const RayNode& node, const Scene& scene) {
  return match(
      end, Overloaded{[&](const LeftScene&) { return "left the scene: " + outside(node); },
                      [&](const CutOff& e) {
                        return objectName(scene, e.object) + " at distance " + shortText(e.t, 6) +
                               (e.t < e.limit ? " is nearer than the camera's near "
                                              : " is farther than the camera's far ") +
                               toText(e.limit) + ": " + outside(node);
                      },
                      [&](const Culled& e) {
                        return "passed through the back of " + objectName(scene, e.object) + " at distance " +
                               shortText(e.t, 6) + ", which --back-faces hides: " + outside(node);
                      },
                      [&](const Opaque&) -> std::string {
                        return node.kind == RayKind::lamp && !isBlack(node.radiance)
                                   ? "reached the lamp"
                                   : "opaque: neither mirror nor glass";
                      },
                      [](const DepthLimit& e) {
                        return "depth limit " + std::to_string(e.limit) + " reached: no " +
                               kindName(e.unsent);
                      },
                      [](const BelowThreshold& e) {
                        if (e.contribution == 0) return "contribution 0: no " + kindName(e.unsent);
                        return "contribution " + toText(e.contribution) + " below threshold " +
                               toText(e.threshold) + ": no " + kindName(e.unsent);
                      },
                      [](const Roulette& e) {
                        return "Russian roulette with survival probability " + shortText(e.chance, 3) +
                               ": no " + kindName(e.unsent);
                      },
                      [](const TotalInternalReflection&) -> std::string {
                        return "total internal reflection: no refraction";
                      },
                      [&](const Blocked& e) { return "blocked by " + objectName(scene, e.object); },
                      [&](const ReachedLight&) -> std::string {
                        if (node.filters.empty()) return "reached the light";
                        const bool none = isBlack(node.radiance);
                        std::string names;
                        std::optional<std::uint32_t> last;  // light enters and leaves the same glass
                        for (const Filter& filter : node.filters)
                          if (!filter.shadowless && std::exchange(last, filter.object) != filter.object)
                            names += (names.empty() ? "" : ", ") + fillingName(scene, filter.object);
                        if (names.empty()) return "reached the light";
                        return (none ? "absorbed by " : "reached the light, filtered by ") + names;
                      },
                      [&](const MetLight& e) {
                        return "met " + lightName(scene, e.light) + " at distance " + shortText(e.t, 6);
                      }});
}

}  // namespace

std::vector<MaterialShare> sharesOf(const MaterialMix& mix) {
  std::vector<MaterialShare> shares;
  for (int i = 0; i < mix.count; ++i) {
    const auto same = std::find_if(shares.begin(), shares.end(), [&](const MaterialShare& share) {
      return share.material == mix.material[i];
    });
    if (same == shares.end())
      shares.push_back({mix.material[i], mix.weight[i]});
    else
      same->weight += mix.weight[i];
  }
  return shares;
}

Color recomputed(const RayTree& tree, int index) {
  const RayNode& node = rayAt(tree, index);
  if (node.kind == RayKind::shadow) {
    if (!node.ends.empty() && std::holds_alternative<Blocked>(node.ends.front())) return Color(0);
    Color passed(1);
    for (const Filter& filter : node.filters) passed *= filter.factor;
    return passed;
  }
  Color sum;
  for (const Term& term : node.terms)
    sum += term.factor * (term.ray < 0 ? term.value : recomputed(tree, term.ray));
  return sum * node.through;
}

bool sumsUp(const RayTree& tree) {
  for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i)
    if (!same(rayAt(tree, i).radiance, recomputed(tree, i))) return false;
  return true;
}

void weigh(RayTree& tree, Real cameraWeight) {
  if (tree.nodes.empty()) return;
  tree.nodes.front().weight = Color(cameraWeight);
  for (const RayNode& node : tree.nodes)
    for (const Term& term : node.terms)
      if (term.ray >= 0)
        tree.nodes[static_cast<std::size_t>(term.ray)].weight = node.weight * node.through * term.factor;
}

const Term* termOf(const RayTree& tree, int index) {
  const int parent = rayAt(tree, index).parent;
  if (parent < 0) return nullptr;
  for (const Term& term : rayAt(tree, parent).terms)
    if (term.ray == index) return &term;
  return nullptr;
}

std::optional<std::uint32_t> lightOf(const RayTree& tree, int node) {
  const Term* term = termOf(tree, node);
  if (!term) return {};
  return term->light ? term->light->light : term->scattered;
}

std::string shortPlace(const SourcePlace& place) {
  std::string text = place.file.str().substr(place.file.str().find_last_of('/') + 1);
  if (place.line > 0) text += ":" + std::to_string(place.line);
  return text;
}

std::string objectName(const Scene& scene, std::uint32_t index) {
  const NumberedObject found = objectOf(scene, index);
  const std::string placement = placementName(scene, found);
  if (!found.object) return placement;
  const Object& object = *found.object;
  const std::string name = object.name.empty() ? named(object.shape.keyword(), object.place) : object.name;
  return placement.empty() ? name : name + " of " + placement;
}

std::string fillingName(const Scene& scene, std::uint32_t object) {
  return object == Filling::kAir ? "air" : objectName(scene, object);
}

std::string fillingText(const Scene& scene, std::uint32_t object, Real priority) {
  const std::string name = fillingName(scene, object);
  return object == Filling::kAir ? name : name + ", priority " + toText(priority);
}

std::string sentence(const Ignored& ignored, const Scene& scene) {
  const Filling &body = ignored.body, &around = ignored.around;
  if (ignored.shadowless)
    return objectName(scene, ignored.object) + " at distance " + shortText(ignored.t, 6) +
           ": it casts no shadow";
  std::string text = (ignored.leaving ? "leaving " : "entering ") + objectName(scene, ignored.object) +
                     " at distance " + shortText(ignored.t, 6) + ": ";
  if (ignored.opacity < 1)
    return text + (ignored.opacity > 0 ? "its opacity there is " + shortText(ignored.opacity, 3) : "a hole");
  if (around.object == ignored.object || around.kind == body.kind)
    return text + "the same material on both sides";
  text += "it is " + fillingName(scene, around.object) + " on both sides, ";
  return text + (around.priority == body.priority
                     ? "entered later, of the same priority " + toText(body.priority)
                     : "whose priority " + toText(around.priority) + " is above " + toText(body.priority));
}

std::string materialName(const Scene& scene, std::uint32_t index) {
  return index == MaterialMix::kClear ? "clear" : nameOf(scene.materials[index], index);
}

std::string materialNames(const Scene& scene, const std::vector<MaterialShare>& materials) {
  std::string text;
  for (const MaterialShare& share : materials) {
    text += (text.empty() ? "" : " + ") + materialName(scene, share.material);
    if (materials.size() > 1) text += " " + shortText(share.weight, 3);
  }
  return text;
}

std::string lightName(const Scene& scene, std::uint32_t index) {
  const LightSource& source = scene.lights[index];
  if (!source.links.name.empty()) return source.links.name;
  return named(source.light.keyword(), source.place);
}

std::string_view sentence(const DarkTerm& dark) {
  return dark.why == DarkTerm::Why::unlinked ? "its links, or the object's, keep it off this object"
                                             : "it shines elsewhere (its cone, flaps, picture or back)";
}

std::string sentence(const RayNode& node, const Scene& scene) {
  std::string text;
  const RayEnd* last = nullptr;
  const MediumTerm* turned = turnedBy(node);
  if (turned)
    text = "scattered by " + (turned->object == Filling::kAir ? "fog" : objectName(scene, turned->object)) +
           " at distance " + shortText(turned->t, 6);
  for (const RayEnd& end : node.ends) {
    if (turned && std::holds_alternative<LeftScene>(end)) continue;  // it did not come so far
    const auto* limit = std::get_if<DepthLimit>(&end);
    if (limit && last && std::holds_alternative<DepthLimit>(*last))
      text += ", no " + kindName(limit->unsent);
    else
      text += (text.empty() ? "" : "; ") + words(end, node, scene);
    last = &end;
  }
  const std::string on = sentOn(node);
  if (!on.empty()) text += (text.empty() ? "continues as " : "; continues as ") + on;
  return text;
}

}  // namespace trace
