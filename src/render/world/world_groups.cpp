// The groups of a World: hierarchies over their objects and placements, and what numbers of placed objects
// stand for (scene/groups.h).
#include <algorithm>

#include "base/budget.h"
#include "render/world/number_range.h"
#include "render/world/world.h"

namespace trace {

std::vector<World::Uses> World::usesOf(const std::vector<GroupUses>& uses, std::size_t objects) const {
  std::vector<Uses> all;
  auto use = static_cast<std::uint32_t>(objects);
  auto object = static_cast<std::uint32_t>(objects + countUses(uses));
  for (const GroupUses& u : uses) {
    if (u.list->empty()) continue;
    all.push_back({u.group, use, object, u.list});
    use += static_cast<std::uint32_t>(u.list->size());
    object += static_cast<std::uint32_t>(u.list->size()) * groups_[u.group].numbers;
  }
  return all;
}

void World::addBoxes(const std::vector<Uses>& uses, std::vector<BoxedItem>* items, Box3& all) const {
  for (const Uses& u : uses) {
    const Box3& box = groups_[u.group].box;
    std::uint32_t number = u.firstUse;
    for (const GroupUse& use : *u.list) {
      if (number % 4096 == 0) checkBudget();
      const Box3 placed = use.outFromGroup * box;
      const bool isThere =
          isInRange(use.outFromGroup) && invertible(use.outFromGroup) && !placed.empty() && isInRange(placed);
      if (isThere && items) items->push_back(boxedItem(placed, number));
      if (isThere) all.extend(placed);
      ++number;
    }
  }
}

/// Precondition: objects_ has all objects of the groups.
void World::addGroups(const Scene& scene, const Settings& settings) {
  if (scene.groups.empty()) return;
  const std::vector<std::uint32_t> sizes = groupSizes(scene);
  std::uint32_t first = plain_;
  Work work("building groups", static_cast<std::int64_t>(scene.groups.size()));
  for (std::size_t i = 0; i < scene.groups.size(); ++i) {
    work.reached(static_cast<std::int64_t>(i));
    Group group;
    group.first = first;
    group.count = static_cast<std::uint32_t>(scene.groups[i].objects.size());
    group.numbers = sizes[i];
    group.uses = usesOf(scene.groups[i].uses, group.count);
    std::vector<BoxedItem> items;
    for (std::uint32_t k = 0; k < group.count; ++k) {
      const Instance& object = objects_[first + k];
      group.holds |= object.holds;
      if (object.bounds.empty()) continue;
      items.push_back(boxedItem(object.bounds, k));
      group.box.extend(object.bounds);
    }
    for (const Uses& u : group.uses) group.holds |= groups_[u.group].holds;
    addBoxes(group.uses, &items, group.box);
    group.bvh = std::make_shared<const Bvh>(
        settings.accel == Accel::none ? Bvh::bruteForce(items)
                                      : Bvh(std::move(items), Bvh::Leaves::single, settings.threads));
    first += group.count;
    groups_.push_back(std::move(group));
  }
  uses_ = usesOf(scene.uses, plain_);
  addBoxes(uses_, nullptr, bounds_);
  for (const Uses& u : uses_) placedHold_ |= groups_[u.group].holds;
}

std::shared_ptr<const Bvh> World::topHierarchy(const std::vector<Box3>& boxes,
                                               const Settings& settings) const {
  const Work work("building the hierarchy of placements");
  std::vector<BoxedItem> items;
  items.reserve(boxes.size() + placementCount());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty() && !boxes[i].unbounded()) items.push_back(boxedItem(boxes[i], i));
  Box3 all;
  addBoxes(uses_, &items, all);
  return std::make_shared<const Bvh>(settings.accel == Accel::none
                                         ? Bvh::bruteForce(items)
                                         : Bvh(std::move(items), Bvh::Leaves::single, settings.threads));
}

World::Located World::locate(std::uint32_t number) const {
  Located at;
  if (number < plain_) {
    at.object = number;
    return at;
  }
  const std::vector<Uses>* all = &uses_;
  for (;;) {
    // The last list that begins at it or before, among placements or among objects.
    const bool isUse = number < all->front().firstObject;
    const auto after = std::upper_bound(
        all->begin(), all->end(), number,
        [&](std::uint32_t n, const Uses& u) { return n < (isUse ? u.firstUse : u.firstObject); });
    const Uses& uses = *std::prev(after);
    const Group& group = groups_[uses.group];
    const std::uint32_t rest = number - (isUse ? uses.firstUse : uses.firstObject),
                        index = isUse ? rest : rest / group.numbers;
    at.steps[at.levels++] = &(*uses.list)[index].outFromGroup;
    if (isUse) {
      at.object = Bvh::kNoItem;
      return at;
    }
    number = rest % group.numbers;
    if (number < group.count) {
      at.object = group.first + number;
      return at;
    }
    all = &group.uses;
  }
}

Affine World::placedTransform(std::uint32_t number) const {
  const Located at = locate(number);
  Affine all = *at.steps[0];
  for (int level = 1; level < at.levels; ++level) all = all * *at.steps[level];
  return at.object == Bvh::kNoItem ? all : all * objects_[at.object].placement.outFromIn();
}

Box3 World::placedBounds(std::uint32_t number) const {
  const Located at = locate(number);
  Box3 box = objects_[at.object].bounds;
  for (int level = at.levels; level-- > 0;) box = *at.steps[level] * box;
  return box;
}

std::vector<std::uint32_t> World::kindsOfObjects() const {
  std::vector<std::uint32_t> numbers(plain_);
  for (std::uint32_t i = 0; i < plain_; ++i) numbers[i] = i;
  std::vector<std::uint32_t> first(groups_.size(), Bvh::kNoItem);  // where each group is placed first
  for (const Uses& u : uses_)
    if (first[u.group] == Bvh::kNoItem) first[u.group] = u.firstObject;
  for (std::size_t i = groups_.size(); i-- > 0;) {  // a group is placed in later ones only
    if (first[i] == Bvh::kNoItem) continue;
    for (const Uses& u : groups_[i].uses)
      if (first[u.group] == Bvh::kNoItem) first[u.group] = first[i] + u.firstObject;
    for (std::uint32_t k = 0; k < groups_[i].count; ++k) numbers.push_back(first[i] + k);
  }
  return numbers;
}

Box3 World::placedThatSendOn(bool varnish, bool follow) const {
  std::vector<bool> sends(groups_.size());
  Box3 all;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const Group& group = groups_[i];
    for (std::uint32_t k = 0; k < group.count && !sends[i]; ++k)
      sends[i] = sendsOnOf(objects_[group.first + k], varnish, follow);
    for (const Uses& u : group.uses) sends[i] = sends[i] || sends[u.group];
  }
  for (const Uses& u : uses_)
    if (sends[u.group]) addBoxes({u}, nullptr, all);
  return all;
}

}  // namespace trace
