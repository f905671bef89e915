#include "library/field_values.h"

#include <algorithm>
#include <cmath>

#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/plane.h"

namespace traceray {
namespace {

/// From a level plane, as the kind `Trace 1` has it, to the shape's own, z = 0.
const trace::Affine kUpright{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {}};

}  // namespace

bool isSayable(const Value& value) {
  if (value.isNumber()) return std::isfinite(value.number());
  return !value.isList() || std::all_of(value.list().begin(), value.list().end(), isSayable);
}

Value operandsOf(const trace::Scene& scene, const trace::Shape& shape) {
  Value::List objects;
  for (const trace::Operand& part : shape.operands().list())
    objects.push_back(nodeOf(scene, part.shape, part.name, part.material, part.wholeFromOperand));
  return objects;
}

Node nodeOf(const trace::Texture& texture) {
  const trace::TextureNode& from = *texture;
  Node node(std::string(from.model.keyword()));
  if (!from.name.empty()) node.fields.push_back({"name", from.name});
  trace::forEachField(from.model, [&](const auto& field, const auto& value) {
    node.fields.push_back({std::string(field.keyword), texturedValueOf(from.inputs, field.keyword, value)});
  });
  const trace::TexturePlacement usual;
  trace::forEachField<trace::TexturePlacement>([&](const auto& field) {
    const auto& value = from.placement.*field.member;
    if (value != usual.*field.member) node.fields.push_back({std::string(field.keyword), valueOf(value)});
  });
  std::erase_if(node.fields, [](const Field& field) { return !isSayable(field.value); });
  return node;
}

Node nodeOf(const trace::Material& material) {
  Node node(std::string(material.model.keyword()));
  if (!material.name.empty()) node.fields.push_back({"name", material.name});
  trace::Material usual;
  usual.model = material.model;
  std::vector<Field> same;  // the material's own fields
  trace::forEachField<trace::Material>([&](const auto& field) {
    if (material.*field.member == usual.*field.member && !textureOf(material.textures, field.keyword))
      same.push_back({std::string(field.keyword), false});
  });
  const auto* phong = material.model.as<trace::Phong>();
  forEachValue(material, [&](std::string_view name, Value value) {
    if (phong && phong->mirrorsSpecular && name == "reflective") value = "specular";  // as a file says it
    const bool isUsual =
        std::any_of(same.begin(), same.end(), [&](const Field& f) { return f.name == name; });
    if (!isUsual && isSayable(value)) node.fields.push_back({std::string(name), std::move(value)});
  });
  return node;
}

Node nodeOf(const trace::Scene& scene, const trace::Shape& shape, const std::string& name,
            std::uint32_t material, const trace::Affine& transform) {
  Node node{std::string(shape.keyword())};
  if (!name.empty()) node.fields.push_back({"name", name});
  forEachValue(scene, shape, [&](std::string_view field, Value value) {
    if (isSayable(value)) node.fields.push_back({std::string(field), std::move(value)});
  });
  node.fields.push_back({"material", nodeOf(scene.materials[material])});
  // The reader lays planes level, which is undone here.
  const trace::Affine placed = shape.is<trace::Plane>() ? transform * kUpright : transform;
  if (placed == trace::Affine{}) return node;
  Value::List rows;
  const double offset[] = {placed.offset.x, placed.offset.y, placed.offset.z};
  for (int i = 0; i < 3; ++i) {
    const trace::Vec3& row = placed.row[i];
    rows.push_back(Value::List{row.x, row.y, row.z, offset[i]});
  }
  rows.push_back(Value::List{0, 0, 0, 1});
  node.fields.push_back({"transform", std::move(rows)});
  return node;
}

}  // namespace traceray
