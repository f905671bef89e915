#include "app/editing/scene_changes.h"

#include <map>
#include <type_traits>

#include "geometry/field_value.h"
#include "geometry/shapes/solids/csg_tree.h"

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

/// The old names of what is called otherwise now, each with the new one.
template <class Thing>
std::map<std::string, std::string> newNames(const std::vector<Thing>& before,
                                            const std::vector<Thing>& after) {
  std::map<std::string, std::string> names;
  if (before.size() != after.size()) return names;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (const std::string& old = nameOf(before[i]); !old.empty() && old != nameOf(after[i]))
      names[old] = nameOf(after[i]);
  for (const Thing& thing : after) names.erase(nameOf(thing));
  return names;
}

template <class Links>
void follow(Links& links, const std::map<std::string, std::string>& names) {
  forEachField<Links>([&](const auto& field) {
    auto& value = links.*field.member;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::vector<std::string>>)
      for (std::string& name : value)
        if (const auto found = names.find(name); found != names.end() && !found->second.empty())
          name = found->second;
  });
}

}  // namespace

void followNames(const Scene& before, Scene& after) {
  const auto objects = newNames(before.objects, after.objects);
  const auto lights = newNames(before.lights, after.lights);
  if (!objects.empty())
    for (LightSource& light : after.lights) follow(light.links, objects);
  if (!lights.empty())
    for (Object& object : after.objects) follow(object.links, lights);
}

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
