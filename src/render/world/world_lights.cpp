// The lights of a World: which there are, what each lights, and which of them rays see.
#include <algorithm>
#include <set>

#include "render/world/number_range.h"
#include "render/world/world.h"
#include "scene/scene_features.h"
#include "shading/lights/plain_lights.h"
#include "shading/lights/portal.h"

namespace trace {
namespace {

/// Whether one that is called so is among all, or `only` names it, and `none` does not.
class Chosen {
 public:
  Chosen(const std::vector<std::string>& only, const std::vector<std::string>& none)
      : only_(only.begin(), only.end()), none_(none.begin(), none.end()) {}
  bool all() const { return only_.empty() && none_.empty(); }
  bool operator()(std::string_view name) const {
    return (only_.empty() || only_.contains(name)) && !none_.contains(name);
  }

 private:
  std::set<std::string_view> only_, none_;
};

/// Whether the light lights each object, by their numbers; empty where all are lit. Those of groups have the
/// last ones.
std::vector<bool> litBy(const LightLinks& links, const std::vector<const Object*>& objects) {
  const Chosen byLight(links.lights, links.excludes);
  const auto isLit = [&](const Object* o) {
    return byLight(o->name) && Chosen(o->links.litBy, o->links.notLitBy)(links.name);
  };
  const bool noneSays =
      std::all_of(objects.begin(), objects.end(), [](const Object* o) { return o->links == ObjectLinks{}; });
  if (byLight.all() && noneSays) return {};
  std::vector<bool> lit(objects.size());
  std::transform(objects.begin(), objects.end(), lit.begin(), isLit);
  return lit;
}

}  // namespace

void World::addLights(const Scene& scene, const Settings& settings, Messages& messages) {
  LeftOut leftOut("this light");
  const std::vector<const Object*> objects = allObjects(scene);
  std::vector<LightReach> reaches;
  std::vector<Box3> boxes;  // boxes of the visible ones
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const LightSource& source = scene.lights[i];
    if (!isInRange(source.light)) {
      leftOut.add(source.place);
      continue;
    }
    const Light light = lightWithout(source.light, settings.switchedOff).value_or(source.light);
    if (isAmbient(light)) {
      ambient_ += *light.color() * settings.ambientScale;
      continue;
    }
    const LightGeometry geometry = geometryOf(light);
    if (light.is<Portal>()) {
      portals_.push_back(geometry);
      continue;
    }
    const LightReach& reach = reaches.emplace_back(light.reach(rules_));
    if (light.visible()) {
      visibleLights_.push_back(static_cast<std::uint32_t>(lights_.size()));
      boxes.push_back(reach.box);
    }
    lights_.push_back(light);
    lightGeometries_.push_back(geometry);
    lightSources_.push_back(i);
    castShadows_.push_back(castsShadows(source.links, settings.switchedOff));
    litObjects_.push_back(litBy(source.links, objects));
  }
  leftOut.warn(messages);
  lightTree_ = std::make_shared<const LightTree>(reaches);
  visibleBoxes_ = std::make_shared<const Bvh>(boxes);
}

std::optional<World::Lamp> World::nearestLamp(const Ray& ray, Real t) const {
  std::optional<Lamp> nearest;
  std::uint32_t first = 0;  // the first listed among equals
  NodeCount nodes;
  visibleBoxes_->query(ray.origin, ray.direction, t, true, nodes, [&](std::uint32_t item) {
    const std::uint32_t number = visibleLights_[item];
    const auto seen = lights_[number].seen(ray, rules_);
    if (!seen || !(seen->t < t || (nearest && seen->t == t && number < first))) return false;
    t = seen->t;
    first = number;
    nearest = Lamp{lightSources_[number], *seen};
    return false;
  });
  return nearest;
}

}  // namespace trace
