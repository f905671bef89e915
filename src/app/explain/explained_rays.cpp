#include "app/explain/explained_rays.h"

#include <algorithm>
#include <type_traits>

#include "base/match.h"
#include "base/text.h"
#include "geometry/mesh/mesh.h"
#include "scene/groups.h"

namespace trace {
namespace {

/// `shares`: of the place that was hit. Where none was, as inside a medium, the object's own material counts.
NamedBody namedBody(std::uint32_t index, std::vector<MaterialShare> shares, const Scene& scene) {
  NamedBody body;
  body.name = fillingName(scene, index);
  if (index == Filling::kAir) return body;
  const NumberedObject found = objectOf(scene, index);
  if (!found.object) return body;
  const Object& object = *found.object;
  body.object = index;
  body.ownName = object.name;
  body.shape = object.shape.keyword();
  body.isMesh = object.shape.is<Mesh>();
  body.place = object.place;
  if (shares.empty()) shares.push_back({object.material, 1});
  body.madeOf = materialNames(scene, shares);
  Real most = 0;
  for (const MaterialShare& share : shares) {
    NamedBody::Share named{{}, materialName(scene, share.material), share.weight};
    if (share.material != MaterialMix::kClear) named.material = share.material;
    if (body.material.empty() || share.weight > most) body.material = named.name, most = share.weight;
    body.materials.push_back(std::move(named));
  }
  return body;
}

std::optional<NamedBody> bodyOf(const RayEnd& end, const Scene& scene) {
  return match(end, [&](const auto& why) -> std::optional<NamedBody> {
    if constexpr (requires { why.object; }) return namedBody(why.object, why.materials, scene);
    return {};
  });
}

ExplainedTerm explained(const Term& term, const Scene& scene) {
  ExplainedTerm result;
  const auto ofLight = [&](std::uint32_t light) {
    result.light = lightName(scene, light);
    result.lightKind = scene.lights[light].light.keyword();
    result.lightPlace = scene.lights[light].place;
  };
  if (term.light) ofLight(term.light->light);
  if (term.dark) ofLight(term.dark->light);
  if (term.scattered) ofLight(*term.scattered);
  if (term.medium) result.medium = namedBody(term.medium->object, {}, scene);
  return result;
}

}  // namespace

std::vector<ExplainedRay> explainedRays(const RayTree& tree, const Scene& scene) {
  const std::vector<RaySegment> segments = raySegments(tree);
  std::vector<ExplainedRay> rays(tree.nodes.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    ExplainedRay& ray = rays[i];
    ray.node = &node;
    ray.segment = segments[i];
    ray.sentence = sentence(node, scene);
    if (const auto light = lightOf(tree, static_cast<int>(i))) ray.light = lightName(scene, *light);
    if (node.parent >= 0) rays[static_cast<std::size_t>(node.parent)].children.push_back(static_cast<int>(i));
    if (node.hit) ray.hit = namedBody(node.hit->object, node.materials, scene);
    for (const Ignored& ignored : node.ignored) ray.ignored.push_back(sentence(ignored, scene));
    for (const Filter& filter : node.filters)
      ray.filters.push_back(namedBody(filter.object, filter.materials, scene));
    for (const RayEnd& end : node.ends) ray.ends.push_back(bodyOf(end, scene));
    for (const Term& term : node.terms) ray.terms.push_back(explained(term, scene));
  }
  return rays;
}

std::string raysAsObj(const RayTree& tree, const std::vector<ExplainedRay>& rays) {
  const auto vertex = [](const Vec3& v) {
    return "v " + toText(v.x) + " " + toText(v.y) + " " + toText(v.z) + "\n";
  };
  std::string text = "# rays of pixel " + std::to_string(tree.x) + "," + std::to_string(tree.y) +
                     ", sample " + std::to_string(tree.sample) + "\n";
  int vertices = 0;
  for (std::size_t looks = 0; looks < kRayLooks.size(); ++looks) {
    std::string group;
    for (const ExplainedRay& ray : rays) {
      const RaySegment& segment = ray.segment;
      if (segment.looks != static_cast<RayLooks>(looks)) continue;
      group += "# ray " + std::to_string(segment.node) + (segment.leaves ? ", infinite\n" : "\n");
      group += vertex(segment.from) + vertex(segment.to);
      group += "l " + std::to_string(vertices + 1) + " " + std::to_string(vertices + 2) + "\n";
      vertices += 2;
    }
    if (!group.empty()) text += "g " + std::string(kRayLooks[looks].name) + "\n" + group;
  }
  return text;
}

}  // namespace trace
