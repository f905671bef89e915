// Groups that are used many times, and the numbers of the objects in them (docs/language.md#instances).
//
// Numbers of objects: those of Scene::objects come first. Behind them each placement of a group has a number,
// then the objects of the first placement of the first group, those of its second placement, and so on.
// Within a group the same holds. So the number of an object says where it stands, without a table of all.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace trace {

/// Groups may be nested this deep.
inline constexpr int kMostGroupLevels = 8;
/// More copies of the objects of groups are not made.
inline constexpr std::size_t kMostCopies = 1'000'000;

/// How many numbers the objects and placements of a group take, by group. Throws Error(Fault::limit) where
/// they are more than 32 bits count, Error(Fault::scene) where groups are nested too deep.
std::vector<std::uint32_t> groupSizes(const Scene& scene);

/// The objects of the scene, then those of each group.
std::vector<const Object*> allObjects(const Scene& scene);

/// How many placements the lists have.
std::size_t countUses(const std::vector<GroupUses>& uses);

/// An object with that number.
struct NumberedObject {
  const Object* object = nullptr;  ///< null for the number of a placement
  /// Its placements, the outermost first; none for one of Scene::objects.
  struct Step {
    const GroupUses* uses;
    std::size_t index;
    const GroupUse& use() const { return (*uses->list)[index]; }
  };
  std::vector<Step> steps{};
};
/// Precondition: the scene has an object or a placement of that number.
NumberedObject objectOf(const Scene& scene, std::uint32_t number);
Affine worldFromObject(const NumberedObject& object);
/// "tree #4711 (forest.ray:12)"; "" for an object without placements.
std::string placementName(const Scene& scene, const NumberedObject& object);

/// How many objects of groups there are, each counted as often as it is placed.
std::size_t countPlacedObjects(const Scene& scene);

/// The scene with copies in place of groups: of all placements, or of the first so many objects. Throws
/// Error(Fault::limit) for more than kMostCopies, which names what `wants` them, where that is not empty.
Scene copied(const Scene& scene, std::string_view wants);
Scene firstCopies(const Scene& scene, std::size_t most);

/// Objects whose light is chosen among lights, that a medium fills, or that have no end: they are not placed
/// with a group, but copied to each of its placements.
bool standsAlone(const Scene& scene, const Object& object);

}  // namespace trace
