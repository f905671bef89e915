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

}  // namespace

std::size_t usersOf(const Scene& scene, std::uint32_t material) {
  return static_cast<std::size_t>(
      std::count_if(scene.objects.begin(), scene.objects.end(),
                    [&](const Object& object) { return uses(object.shape, object.material, material); }));
}

}  // namespace trace
