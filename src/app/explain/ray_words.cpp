#include "app/explain/ray_words.h"

#include <algorithm>
#include <cstdio>

#include "base/match.h"

namespace trace {
namespace {

Real passed(const RayNode& node) { return std::max(maxComponent(node.radiance), 0.0); }

std::string shortWords(const RayEnd& end, const RayNode& node) {
  return match(end, Overloaded{[](const LeftScene&) { return std::string("left the scene"); },
                               [](const CutOff&) { return std::string("cut off"); },
                               [](const Culled&) { return std::string("back face"); },
                               [](const Opaque&) { return std::string("opaque"); },
                               [](const DepthLimit& e) { return "depth limit " + std::to_string(e.limit); },
                               [](const BelowThreshold&) { return std::string("threshold"); },
                               [](const Roulette&) { return std::string("roulette"); },
                               [](const TotalInternalReflection&) { return std::string("total reflection"); },
                               [](const Blocked&) { return std::string("blocked"); },
                               [&](const ReachedLight&) {
                                 return isFiltered(node) ? "filtered to " + percent(passed(node))
                                                         : "reached it";
                               },
                               [](const MetLight&) { return std::string("met a light"); }});
}

/// "from floor" for a ray that leaves a surface.
std::string fromParent(const RayTree& tree, const Scene& scene, const RayNode& node) {
  if (node.parent < 0) return "";
  const RayNode& parent = rayAt(tree, node.parent);
  return parent.hit ? " from " + objectName(scene, parent.hit->object) : "";
}

std::string shadowStep(const RayTree& tree, const Scene& scene, int ray) {
  const RayNode& node = rayAt(tree, ray);
  const auto light = lightOf(tree, ray);
  const std::string to = light ? shortLightName(scene, *light) : "the light",
                    from = fromParent(tree, scene, node);
  for (const RayEnd& end : node.ends)
    if (const auto* stop = std::get_if<Blocked>(&end))
      return objectName(scene, stop->object) + " blocks " + to + from;
  if (!isFiltered(node)) return "reaches " + to + from;
  return "reaches " + to + from + ", filtered by " + filtersOf(node, scene) + " to " + percent(passed(node));
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

std::string shortLightName(const Scene& scene, std::uint32_t light) {
  const LightSource& source = scene.lights[light];
  if (!source.links.name.empty()) return source.links.name;
  int number = 0, all = 0;
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const LightSource& other = scene.lights[i];
    if (!other.links.name.empty() || other.light.keyword() != source.light.keyword()) continue;
    ++all;
    if (i <= light) ++number;
  }
  return std::string(source.light.keyword()) + (all > 1 ? " " + std::to_string(number) : "");
}

bool isFiltered(const RayNode& node) {
  constexpr Real kAll = 0.995;
  const bool any = std::any_of(node.filters.begin(), node.filters.end(),
                               [](const Filter& filter) { return !filter.shadowless; });
  return any && passed(node) < kAll;
}

std::string filtersOf(const RayNode& node, const Scene& scene) {
  std::vector<std::string> names;
  for (const Filter& filter : node.filters) {
    const std::string name = fillingName(scene, filter.object);
    if (!filter.shadowless && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return listed(names);
}

std::string percent(Real share) {
  char text[16];
  std::snprintf(text, sizeof text, share < 0.0995 && share > 0 ? "%.1f %%" : "%.0f %%", 100 * share);
  return text;
}

std::string shortEnd(const RayNode& node) {
  std::string text;
  for (const RayEnd& end : node.ends)
    if (const std::string words = shortWords(end, node); text.find(words) == std::string::npos)
      text += (text.empty() ? "" : ", ") + words;
  return text.empty() ? "continues" : text;
}

std::string stepOf(const RayTree& tree, const Scene& scene, int ray) {
  const RayNode& node = rayAt(tree, ray);
  const std::string kind = std::string(name(node.kind)) + " ray: ";
  if (node.kind == RayKind::shadow) return kind + shadowStep(tree, scene, ray);
  if (!node.hit) return kind + sentence(node, scene);
  const bool opaque = node.ends.size() == 1 && std::holds_alternative<Opaque>(node.ends.front());
  const std::string what = opaque ? ", which neither mirrors nor transmits" : "; " + sentence(node, scene);
  return kind + "hits " + objectName(scene, node.hit->object) + what;
}

}  // namespace trace
