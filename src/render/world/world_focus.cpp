// The focus of the lens of a World's camera (docs/lens.md).
#include <algorithm>
#include <set>
#include <utility>

#include "base/budget.h"
#include "base/text.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace trace {

void World::focus(const Scene& scene, const Settings& settings) {
  const ScenePlace& place = settings.focusOn;
  if (!place.none()) {
    const Vec3 point = place.point ? *place.point : seenPlaceOf(place.object, scene);
    camera_.optics.lens.focus = camera_.focusOn(point);
    if (!(camera_.optics.lens.focus > 0))
      throw Error(Fault::usage, "--focus-on " + findOption("focus-on").get(settings) +
                                    " lies behind the camera, " + toText(-camera_.optics.lens.focus) +
                                    " units away");
  }
  if (!camera_.wantsMiddle()) return;
  Statistics uncounted;
  const std::optional<Found> found = closest({camera_.eye, camera_.ahead}, Faces::both, uncounted);
  camera_.setMiddle(found ? found->t : kInfinity);
}

/// The number of an object of that name in a group, or of a group of that name: of all placements the one
/// nearest to the camera, and before it if one is.
std::optional<std::uint32_t> World::nearestPlaced(const std::string& name, const Scene& scene) const {
  const auto isNamed = [&](const auto& thing) { return thing.name == name; };
  std::vector<bool> has;  // by group, whether something in it is called so
  for (const trace::Group& group : scene.groups)
    has.push_back(isNamed(group) || std::any_of(group.objects.begin(), group.objects.end(), isNamed) ||
                  std::any_of(group.uses.begin(), group.uses.end(),
                              [&](const GroupUses& uses) { return has[uses.group]; }));
  std::optional<std::uint32_t> nearest;
  std::pair<bool, Real> least;  // behind the camera, and how far away
  const auto add = [&](std::uint32_t number) {
    const Box3 box = boundsOf(number);
    if (box.empty()) return;
    const Vec3 way = box.center() - camera_.eye;
    const std::pair<bool, Real> away{!(dot(way, camera_.ahead) > 0), dot(way, way)};
    if (nearest && !(away < least)) return;
    nearest = number;
    least = away;
  };
  const auto look = [&](const auto& self, const std::vector<Uses>& all, std::uint32_t base,
                        bool whole) -> void {
    for (const Uses& uses : all) {
      if (!whole && !has[uses.group]) continue;
      const Group& group = groups_[uses.group];
      const trace::Group& said = scene.groups[uses.group];
      const bool every = whole || isNamed(said);
      for (std::uint32_t i = 0; i < uses.list->size(); ++i) {
        checkBudget();
        const std::uint32_t first = base + uses.firstObject + i * group.numbers;
        for (std::uint32_t k = 0; k < group.count; ++k)
          if (every || isNamed(said.objects[k])) add(first + k);
        self(self, group.uses, first, every);
      }
    }
  };
  look(look, uses_, 0, false);
  return nearest;
}

Vec3 World::seenPlaceOf(const std::string& name, const Scene& scene) const {
  std::vector<std::uint32_t> named;
  Box3 around;
  bool endless = false;
  std::set<std::string_view> names;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].name.empty()) names.insert(scene.objects[i].name);
    if (scene.objects[i].name != name) continue;
    named.push_back(i);
    const Box3 box = objects_[i].placement.outFromIn() * shapes_[objects_[i].form].bounds();
    endless = endless || box.unbounded();
    if (!box.unbounded()) around.extend(box);
  }
  if (named.empty())
    if (const auto placed = nearestPlaced(name, scene)) {
      named.push_back(*placed);
      around = boundsOf(*placed);
    }
  if (named.empty()) {
    for (const trace::Group& group : scene.groups) {
      if (!group.name.empty()) names.insert(group.name);
      for (const Object& object : group.objects)
        if (!object.name.empty()) names.insert(object.name);
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const bool isShape = std::any_of(scene.objects.begin(), scene.objects.end(),
                                     [&](const Object& object) { return object.shape.keyword() == name; });
    throw Error(Fault::usage, "--focus-on: no object of the scene is called \"" + name + "\"",
                known.empty() || isShape
                    ? "give objects names, as in sphere { name = \"ball\"; }, or name a point x,y,z"
                    : didYouMean(name, known));
  }
  const Vec3 middle = endless || around.empty() ? camera_.eye + camera_.ahead : around.center();
  const bool parallel = camera_.optics.projection == Projection::orthographic;
  const Vec3 along = parallel ? camera_.ahead : normalize(middle - camera_.eye);
  const Ray ray{parallel ? middle - along * dot(middle - camera_.eye, along) : camera_.eye, along};
  Real nearest = kInfinity;
  Statistics uncounted;
  for (const std::uint32_t object : named)
    crossingsOf(object, ray, kInfinity, uncounted, [&](const Found& found) {
      nearest = std::min(nearest, found.t);
      return false;
    });
  return nearest < kInfinity ? ray.at(nearest) : middle;  // the middle of a ring is nothing that rays hit
}

}  // namespace trace
