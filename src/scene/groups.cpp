#include "scene/groups.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/budget.h"
#include "geometry/traced.h"

namespace trace {
namespace {

std::uint64_t numbersOf(std::size_t objects, const std::vector<GroupUses>& uses,
                        const std::vector<std::uint32_t>& sizes) {
  std::uint64_t sum = objects;
  for (const GroupUses& u : uses) sum += u.list->size() * (std::uint64_t{1} + sizes.at(u.group));
  return sum;
}

[[noreturn]] void tooMany(const SourcePlace& place) {
  throw Error(Fault::limit, place, "expected groups of fewer than 4 billion objects in all, found more",
              "a group counts as many objects as it holds, each time that it is placed");
}

/// Levels of groups in a group, with itself.
int levelsOf(const Scene& scene, std::uint32_t group, const std::vector<int>& before) {
  int most = 0;
  for (const GroupUses& u : scene.groups[group].uses) {
    if (u.group >= group) throw Error(Fault::scene, scene.groups[group].place, "a group is placed in itself");
    most = std::max(most, before[u.group]);
  }
  return most + 1;
}

/// Copies the objects of groups, until there are enough.
class Copier {
 public:
  Copier(const Scene& scene, Scene& copy, std::size_t most) : scene_(scene), copy_(copy), most_(most) {}

  /// Every `step`-th placement.
  void place(const std::vector<GroupUses>& uses, const Affine& outer, std::size_t step) {
    for (const GroupUses& u : uses) {
      const Group& group = scene_.groups[u.group];
      for (std::size_t i = 0; i < u.list->size(); i += step) {
        if (most_ == 0) return;
        checkBudget();
        const Affine world = outer * (*u.list)[i].outFromGroup;
        for (const Object& object : group.objects) {
          if (most_ == 0) return;
          --most_;
          copy_.objects.push_back(object);
          copy_.objects.back().worldFromObject = world * object.worldFromObject;
        }
        place(group.uses, world, 1);
      }
    }
  }

 private:
  const Scene& scene_;
  Scene& copy_;
  std::size_t most_;
};

}  // namespace

std::vector<std::uint32_t> groupSizes(const Scene& scene) {
  std::vector<std::uint32_t> sizes;
  std::vector<int> levels;
  const auto fits = [](std::uint64_t n) { return n < std::numeric_limits<std::uint32_t>::max() - 1; };
  for (std::uint32_t i = 0; i < scene.groups.size(); ++i) {
    const Group& group = scene.groups[i];
    levels.push_back(levelsOf(scene, i, levels));
    if (levels.back() > kMostGroupLevels)
      throw Error(Fault::scene, group.place,
                  "expected at most " + std::to_string(kMostGroupLevels) +
                      " levels of groups in one another, found more");
    const std::uint64_t numbers = numbersOf(group.objects.size(), group.uses, sizes);
    if (!fits(numbers)) tooMany(group.place);
    sizes.push_back(static_cast<std::uint32_t>(numbers));
  }
  if (!fits(numbersOf(scene.objects.size(), scene.uses, sizes))) tooMany(SourcePlace{.file = scene.file});
  return sizes;
}

std::vector<const Object*> allObjects(const Scene& scene) {
  std::vector<const Object*> all;
  all.reserve(scene.objects.size());
  for (const Object& object : scene.objects) all.push_back(&object);
  for (const Group& group : scene.groups)
    for (const Object& object : group.objects) all.push_back(&object);
  return all;
}

std::size_t countUses(const std::vector<GroupUses>& uses) {
  std::size_t sum = 0;
  for (const GroupUses& u : uses) sum += u.list->size();
  return sum;
}

NumberedObject objectOf(const Scene& scene, std::uint32_t number) {
  NumberedObject found;
  if (number < scene.objects.size()) {
    found.object = &scene.objects[number];
    return found;
  }
  const std::vector<std::uint32_t> sizes = groupSizes(scene);
  const std::vector<Object>* objects = &scene.objects;
  const std::vector<GroupUses>* uses = &scene.uses;
  std::uint64_t rest = number;
  while (rest >= objects->size()) {
    rest -= objects->size();
    if (rest < countUses(*uses)) {  // the placement itself
      for (const GroupUses& u : *uses) {
        if (rest < u.list->size()) {
          found.steps.push_back({&u, static_cast<std::size_t>(rest)});
          return found;
        }
        rest -= u.list->size();
      }
    }
    rest -= countUses(*uses);
    const GroupUses* in = nullptr;
    for (const GroupUses& u : *uses) {
      const std::uint64_t all = std::uint64_t{u.list->size()} * sizes[u.group];
      if (rest < all) {
        in = &u;
        break;
      }
      rest -= all;
    }
    if (!in) return {};
    found.steps.push_back({in, static_cast<std::size_t>(rest / sizes[in->group])});
    rest %= sizes[in->group];
    objects = &scene.groups[in->group].objects;
    uses = &scene.groups[in->group].uses;
  }
  found.object = &(*objects)[rest];
  return found;
}

Affine worldFromObject(const NumberedObject& object) {
  Affine all;
  for (const NumberedObject::Step& step : object.steps) all = all * step.use().outFromGroup;
  return object.object ? all * object.object->worldFromObject : all;
}

std::string placementName(const Scene& scene, const NumberedObject& object) {
  std::string text;
  for (const NumberedObject::Step& step : object.steps) {
    const Group& group = scene.groups[step.uses->group];
    const std::uint32_t number = step.use().place;
    const SourcePlace& place = number < scene.usePlaces.size() ? scene.usePlaces[number] : group.place;
    text += (text.empty() ? "" : ", ") + (group.name.empty() ? std::string("group") : group.name) + " #" +
            std::to_string(step.index + 1);
    if (place.line > 0)
      text += " (" + place.file.str().substr(place.file.str().find_last_of('/') + 1) + ":" +
              std::to_string(place.line) + ")";
  }
  return text;
}

std::size_t countPlacedObjects(const Scene& scene) {
  std::vector<std::size_t> sizes;
  const auto count = [&](const std::vector<GroupUses>& uses) {
    std::size_t sum = 0;
    for (const GroupUses& u : uses) sum += u.list->size() * sizes[u.group];
    return sum;
  };
  for (const Group& group : scene.groups) sizes.push_back(group.objects.size() + count(group.uses));
  return count(scene.uses);
}

Scene firstCopies(const Scene& scene, std::size_t most) {
  Scene copy = scene;
  if (scene.uses.empty()) return copy;
  copy.uses.clear();
  copy.groups.clear();
  copy.usePlaces.clear();
  const std::size_t all = countPlacedObjects(scene);  // some everywhere, rather than all at one end
  Copier(scene, copy, most).place(scene.uses, {}, std::max<std::size_t>(1, (all + most - 1) / most));
  return copy;
}

Scene copied(const Scene& scene, std::string_view wants) {
  const std::size_t count = countPlacedObjects(scene);
  if (count > kMostCopies) {
    const Group& group = scene.groups[scene.uses.front().group];
    throw Error(Fault::limit, group.place,
                std::string(wants) + " holds no placements of groups: the scene would become " +
                    std::to_string(count) + " objects, more than " + std::to_string(kMostCopies),
                "the format ray keeps groups and their placements; or place fewer");
  }
  return firstCopies(scene, kMostCopies);
}

bool standsAlone(const Scene& scene, const Object& object) {
  const Material& material = scene.materials[object.material];
  return glows(material) || material.mediumDensity > 0 || check(object.shape).bounds.unbounded();
}

}  // namespace trace
