#include "app/scene_changes.h"

#include "geometry/field_value.h"
#include "geometry/shapes/csg_tree.h"

namespace trace {
namespace {

bool uses(const Shape& shape, std::uint32_t own, std::uint32_t material) {
  const std::vector<std::uint32_t>& others = materialsOf(shape);
  const std::vector<Operand>& operands = shape.operands().list();
  return own == material || std::find(others.begin(), others.end(), material) != others.end() ||
         std::any_of(operands.begin(), operands.end(),
                     [&](const Operand& operand) { return uses(operand.shape, operand.material, material); });
}

const std::string& nameOf(const Object& object) { return object.name; }
const std::string& nameOf(const LightSource& source) { return source.links.name; }

template <class Thing>
std::string newlyShared(const std::vector<Thing>& before, const std::vector<Thing>& after) {
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::string& name = nameOf(after[i]);
    const bool renamed = i >= before.size() || nameOf(before[i]) != name;
    if (!renamed || name.empty()) continue;
    const auto isOfIt = [&](const Thing& thing) { return nameOf(thing) == name; };
    const auto users = std::count_if(after.begin(), after.end(), isOfIt);
    if (users > 1 && users > std::count_if(before.begin(), before.end(), isOfIt)) return name;
  }
  return "";
}

}  // namespace

std::string sharedName(const Scene& before, const Scene& after) {
  const std::string ofObjects = newlyShared(before.objects, after.objects);
  return ofObjects.empty() ? newlyShared(before.lights, after.lights) : ofObjects;
}

std::size_t usersOf(const Scene& scene, std::uint32_t material) {
  return static_cast<std::size_t>(
      std::count_if(scene.objects.begin(), scene.objects.end(),
                    [&](const Object& object) { return uses(object.shape, object.material, material); }));
}

}  // namespace trace
