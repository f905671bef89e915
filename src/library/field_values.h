// The values of fields of a scene's structs, as programs see them.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "base/field.h"
#include "geometry/field_value.h"
#include "scene/scene.h"
#include "shading/formula_text.h"
#include "shading/lights/photometry.h"
#include "shading/pixels.h"
#include "traceray/traceray.h"

namespace traceray {

inline Value valueOf(bool value) { return value; }
inline Value valueOf(int value) { return value; }
inline Value valueOf(double value) { return value; }
inline Value valueOf(const std::string& value) { return value; }
inline Value valueOf(const trace::Vec3& v) { return Value::List{v.x, v.y, v.z}; }
inline Value valueOf(const trace::Color& c) { return Value::List{c.r, c.g, c.b}; }
inline Value valueOf(const trace::Heights& heights) { return heights.file; }
inline Value valueOf(const trace::Pixels& pixels) { return pixels.file; }
inline Value valueOf(const trace::PhotometryFile& file) { return file.file; }
inline Value valueOf(const trace::FormulaText& formula) { return formula.text(); }
inline Value valueOf(const trace::EnumValue& value) { return value.name(); }
template <class Enum>
requires std::is_enum_v<Enum> Value valueOf(Enum value) { return valueOf(trace::EnumValue(value)); }
template <class Element, std::size_t N>
Value valueOf(const std::array<Element, N>& values);
template <class Element>
Value valueOf(const std::vector<Element>& values) {
  Value::List list;
  for (const Element& value : values) list.push_back(valueOf(value));
  return list;
}
template <class Element, std::size_t N>
Value valueOf(const std::array<Element, N>& values) {
  Value::List list;
  for (const Element& value : values) list.push_back(valueOf(value));
  return list;
}

/// The texture with all its fields.
Node nodeOf(const trace::Texture& texture);
/// The material: its model as the keyword, all fields of it, and its own that differ from the defaults.
Node nodeOf(const trace::Material& material);
/// An operand of a solid, or an object: its shape with all fields, `name`, `material` and `transform`.
Node nodeOf(const trace::Scene& scene, const trace::Shape& shape, const std::string& name,
            std::uint32_t material, const trace::Affine& transform);

/// The nodes of what a solid is made of.
Value operandsOf(const trace::Scene& scene, const trace::Shape& shape);

/// The value of the field of a struct with textures: the texture, if it has one.
template <class Value_>
Value texturedValueOf(const std::vector<trace::FieldTexture>& textures, std::string_view field,
                      const Value_& constant) {
  if constexpr (trace::kIsContinuous<Value_>)
    if (const trace::Texture* texture = textureOf(textures, field)) {
      if (constant == Value_(1)) return nodeOf(*texture);
      return Node("texture", {{"", nodeOf(*texture)}, {"", valueOf(constant)}});
    }
  return valueOf(constant);
}

/// Calls visit(keyword, value) for each field of the shape. `scene` has its materials.
template <class Visit>
void forEachValue(const trace::Scene& scene, const trace::Shape& shape, Visit&& visit) {
  trace::forEachField(shape, [&](const trace::AnyField& field, const auto& value) {
    using Value_ = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value_, trace::MaterialList>) {
      Value::List list;
      for (const std::uint32_t index : value.indices) list.push_back(nodeOf(scene.materials[index]));
      visit(field.keyword, Value(std::move(list)));
    } else if constexpr (!std::is_same_v<Value_, trace::Operands>) {
      visit(field.keyword, valueOf(value));
    }
  });
  if (shape.type().ofObjects) visit(std::string_view("objects"), operandsOf(scene, shape));
}
/// The fields of a struct that lists them.
template <class Struct, class Visit>
void forEachValue(const Struct& from, Visit&& visit) {
  trace::forEachField<Struct>([&](const auto& field) { visit(field.keyword, valueOf(from.*field.member)); });
}
/// The fields of a light.
template <class Visit>
void forEachValue(const trace::Light& light, Visit&& visit) {
  trace::forEachField(light, [&](const trace::LightField& field, const auto& value) {
    visit(field.keyword, valueOf(value));
  });
}
/// The fields of a material: those of its model, and its own.
template <class Visit>
void forEachValue(const trace::Material& material, Visit&& visit) {
  const auto one = [&](const auto& field, const auto& value) {
    visit(field.keyword, texturedValueOf(material.textures, field.keyword, value));
  };
  trace::forEachField(material.model, one);
  trace::forEachField(material, one);
}

/// Infinite numbers stand for no limit, which is what there is without the field.
bool isSayable(const Value& value);

}  // namespace traceray
