#include "formats/ray/write/same.h"

#include <algorithm>

#include "formats/ray/write/transform.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/csg_tree.h"

namespace trace::rayfile {
namespace {

bool sameMaterials(const Scene& a, const std::vector<std::uint32_t>& x, const Scene& b,
                   const std::vector<std::uint32_t>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [&](std::uint32_t i, std::uint32_t j) { return a.materials.at(i) == b.materials.at(j); });
}

bool sameOperands(const Scene& a, const std::vector<Operand>& x, const Scene& b,
                  const std::vector<Operand>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [&](const Operand& p, const Operand& q) { return sameOperand(a, p, b, q); });
}

bool sameMesh(const Scene& a, const MeshData& x, const Scene& b, const MeshData& y) {
  if (&x == &y) return true;
  return x.points == y.points && x.triangles == y.triangles && x.normals == y.normals && x.uvs == y.uvs &&
         x.secondUvs == y.secondUvs && x.tangents == y.tangents && x.generateNormals == y.generateNormals &&
         x.twoSided == y.twoSided && sameMaterials(a, x.materials, b, y.materials);
}

/// Without what is made of numbers of materials, which differ from scene to scene.
Shape withoutNumbers(Shape shape) {
  if (shape.type().ofObjects) shape.setOperands({});
  if (!materialsOf(shape).empty())
    editEachField(shape, []<class Value>(const AnyField&, Value& value) {
      if constexpr (std::is_same_v<Value, MaterialList>) value = {};
    });
  return shape;
}

}  // namespace

bool sameOperand(const Scene& a, const Operand& x, const Scene& b, const Operand& y) {
  return x.name == y.name && a.materials.at(x.material) == b.materials.at(y.material) &&
         nearlyEqual(x.wholeFromOperand, y.wholeFromOperand) && sameShape(a, x.shape, b, y.shape);
}

bool sameShape(const Scene& a, const Shape& x, const Scene& b, const Shape& y) {
  if (&x.type() != &y.type()) return false;
  if (const auto* mesh = x.as<Mesh>()) return sameMesh(a, *mesh->data, b, *y.as<Mesh>()->data);
  return sameOperands(a, x.operands().list(), b, y.operands().list()) &&
         sameMaterials(a, materialsOf(x), b, materialsOf(y)) && withoutNumbers(x) == withoutNumbers(y);
}

bool sameObject(const Scene& a, const Object& x, const Scene& b, const Object& y) {
  return x.name == y.name && x.links == y.links && a.materials.at(x.material) == b.materials.at(y.material) &&
         nearlyEqual(x.worldFromObject, y.worldFromObject) && sameShape(a, x.shape, b, y.shape);
}

bool names(const std::vector<Choice>& choices, std::string_view option) {
  return std::any_of(choices.begin(), choices.end(), [&](const Choice& c) { return c.option == option; });
}

bool sameSettings(const Scene& a, const Scene& b) {
  const Settings x = resolve({a.choices}), y = resolve({b.choices});
  // A quality gives values of its own to what nobody names.
  if (y.quality != Quality::none &&
      std::any_of(b.choices.begin(), b.choices.end(), [&](const Choice& choice) {
        return findOption(choice.option).repeats != Repeats::nothing && !names(a.choices, choice.option);
      }))
    return false;
  return std::all_of(options().begin(), options().end(), [&](const Option& option) {
    return option.repeats == Repeats::nothing || sameValue(option, x, y);
  });
}

}  // namespace trace::rayfile
