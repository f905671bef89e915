#include "app/explain/path_ways.h"

#include <algorithm>
#include <tuple>

#include "app/explain/ray_segments.h"
#include "base/text.h"
#include "scene/integrators.h"

namespace trace {
namespace {

/// The rays of the path from a light, in order: the first reaches its second place.
std::vector<int> lightPath(const RayTree& tree) {
  std::vector<int> rays;
  for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i)
    if (rayAt(tree, i).kind == RayKind::light && rayAt(tree, i).parent == (rays.empty() ? -1 : rays.back()))
      rays.push_back(i);
  return rays;
}

}  // namespace

std::vector<PathWay> pathWays(const RayTree& tree) {
  const std::vector<int> fromLight = lightPath(tree);
  std::vector<PathWay> ways;
  for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i) {
    const RayNode& node = rayAt(tree, i);
    for (const Term& term : node.terms) {
      if (!term.connection) continue;
      PathWay way{term.connection->light,
                  term.connection->camera,
                  i,
                  -1,
                  term.ray,
                  term.connection->share,
                  node.weight * node.through * term.factor * term.value};
      const auto before = static_cast<std::size_t>(std::max(0, way.light - 2));
      if (way.light > 1 && before < fromLight.size()) way.start = fromLight[before];
      ways.push_back(way);
    }
  }
  for (int i = 0; i < static_cast<int>(tree.nodes.size());
       ++i) {  // those that the camera sees from the light's end
    const RayNode& node = rayAt(tree, i);
    const auto from = std::find(fromLight.begin(), fromLight.end(), node.parent);
    if (node.kind != RayKind::shadow || from == fromLight.end()) continue;
    ways.push_back({static_cast<int>(from - fromLight.begin()) + 2, 1, -1, *from, i, 0, {}});
  }
  std::stable_sort(ways.begin(), ways.end(), [](const PathWay& a, const PathWay& b) {
    return a.places() != b.places() ? a.places() < b.places() : a.light < b.light;
  });
  return ways;
}

std::string whyNoWays(const RayTree& tree, const Settings& settings) {
  if (hasTrait(settings, Trait::byChains))
    return "The random numbers of this sample chose one strategy, and found no such path.";
  const RayNode& camera = rayAt(tree, 0);
  if (!camera.hit && !scatteredIn(camera))
    return "The camera ray hit nothing, so there is no vertex to connect with a light.";
  std::string text = "No paths were joined in this sample";
  const char* joint = " with ";
  for (const auto& [places, end, option] :
       {std::tuple(settings.lightVertices, "light", "light-vertices"),
        std::tuple(settings.cameraVertices, "camera", "camera-vertices")}) {
    if (places < 0) continue;
    text += joint + counted(places, "place") + " from the " + end + "'s end, as " + option + " says";
    joint = ", and ";
  }
  return text + ". Another sample may have some.";
}

std::vector<int> raysOf(const RayTree& tree, const PathWay& way) {
  std::vector<int> rays;
  for (int i = way.end; i >= 0; i = rayAt(tree, i).parent) rays.push_back(i);
  std::reverse(rays.begin(), rays.end());
  if (way.between >= 0) rays.push_back(way.between);
  for (int i = way.start; i >= 0; i = rayAt(tree, i).parent) rays.push_back(i);
  return rays;
}

std::string sentence(const PathWay& way, const RayTree& tree, const Scene& scene) {
  if (way.light == 0) {
    const RayNode& end = rayAt(tree, way.end);
    return end.hit ? "met " + objectName(scene, end.hit->object) + ", which shines" : "met the background";
  }
  if (way.camera == 1) {
    const RayNode& ray = rayAt(tree, way.between);
    return isBlack(ray.radiance) ? "not seen by the camera: " + sentence(ray, scene)
                                 : "seen by the camera, elsewhere in the picture";
  }
  std::string text = way.light == 1 ? "sampled a light" : "connected both paths";
  if (way.between < 0) return text;
  const RayNode& ray = rayAt(tree, way.between);
  if (const Term* term = termOf(tree, way.between); term && !isBlack(term->factor * term->value)) {
    const bool lamp = ray.kind == RayKind::lamp && ray.hit;
    return lamp ? "asked " + objectName(scene, ray.hit->object) : text;
  }
  return text + ": " + sentence(ray, scene);
}

}  // namespace trace
