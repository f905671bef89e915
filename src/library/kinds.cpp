// The lists of fields, for programs: docstrings, forms, completions.
#include <algorithm>

#include "library/field_values.h"
#include "render/samples/integrator.h"
#include "scene/options.h"
#include "shading/background.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"
#include "shading/lights/light_links.h"
#include "shading/material.h"
#include "shading/texture.h"

namespace traceray {
namespace {

std::string typeOf(const bool&) { return "switch"; }
std::string typeOf(const int&) { return "whole number"; }
std::string typeOf(const double&) { return "number"; }
std::string typeOf(const std::string&) { return "text"; }
std::string typeOf(const trace::Vec3&) { return "vector"; }
std::string typeOf(const trace::Color&) { return "color"; }
std::string typeOf(const trace::Heights&) { return "file"; }
std::string typeOf(const trace::Pixels&) { return "file"; }
std::string typeOf(const trace::PhotometryFile&) { return "file"; }
std::string typeOf(const trace::FormulaText&) { return "formula"; }
std::string typeOf(const trace::EnumValue&) { return "choice"; }
std::string typeOf(const trace::MaterialList&) { return "materials"; }
std::string typeOf(const trace::Operands&) { return "objects"; }
template <class Enum>
requires std::is_enum_v<Enum> std::string typeOf(const Enum&) { return "choice"; }
template <class Element>
std::string typeOf(const std::vector<Element>&) {
  return "list";
}
template <class Element, std::size_t N>
std::string typeOf(const std::array<Element, N>&) {
  return "list";
}

template <class Field_, class Value_>
FieldInfo infoOf(const Field_& field, const Value_& usual) {
  FieldInfo info{.name = std::string(field.keyword),
                 .type = typeOf(usual),
                 .unit = std::string(field.unit),
                 .least = field.least,
                 .most = field.most,
                 .help = std::string(field.help)};
  if constexpr (std::is_same_v<Value_, trace::EnumValue>)
    for (const std::string_view name : usual.names()) info.choices.emplace_back(name);
  else if constexpr (std::is_enum_v<Value_>)
    for (const std::string_view name : names(usual)) info.choices.emplace_back(name);
  if constexpr (!std::is_same_v<Value_, trace::MaterialList> && !std::is_same_v<Value_, trace::Operands>)
    info.usual = valueOf(usual);
  else
    info.usual = Value::List{};
  return info;
}

template <class Struct>
void addFields(Kind& kind, const Struct& usual = {}) {
  trace::forEachField<Struct>(
      [&](const auto& field) { kind.fields.push_back(infoOf(field, usual.*field.member)); });
}

/// The kind of an opaque type, such as a shape, with its defaults.
template <class Any>
Kind kindOf(const char* category, const Any& usual) {
  Kind kind{category, std::string(usual.keyword()), std::string(usual.type().help), {}};
  trace::forEachField(
      usual, [&](const auto& field, const auto& value) { kind.fields.push_back(infoOf(field, value)); });
  return kind;
}

template <class Struct>
Kind kindOf(const char* category) {
  Kind kind{category, std::string(Struct::kKeyword), std::string(Struct::kHelp), {}};
  addFields<Struct>(kind);
  return kind;
}

/// Those of meshes, which are bulk data and no list of fields.
void addMeshFields(Kind& kind) {
  const auto add = [&](const char* name, const char* type, const char* help, Value usual) {
    kind.fields.push_back({.name = name, .type = type, .help = help, .usual = std::move(usual)});
  };
  const Value none = Value::List{};
  add("points", "list", "the corners, (x, y, z) each", none);
  add("faces", "list", "lists of three or more point numbers, from 0; counter-clockwise is the front", none);
  add("normals", "list", "one for each point", none);
  add("texture_uv", "list", "one (u, v) for each point", none);
  add("gennormals", "switch", "makes a normal for each point", false);
  add("two_sided", "switch", "seen from behind, normals are turned to the eye", false);
  add("materials", "materials", "one for each point, mixed across faces", none);
  add("subdivide", "whole number", "levels of subdivision", 0);
  add("file", "file", "a mesh file in place of points and faces: PLY, OBJ, STL, OFF, glTF", "");
}

std::string typeOf(trace::Option::Kind kind) {
  switch (kind) {
    case trace::Option::Kind::boolean: return "switch";
    case trace::Option::Kind::integer: return "whole number";
    case trace::Option::Kind::real: return "number";
    case trace::Option::Kind::color: return "color";
    case trace::Option::Kind::choice: return "choice";
    case trace::Option::Kind::choices: return "choices";
    case trace::Option::Kind::region: return "region";
    case trace::Option::Kind::file: return "file";
    case trace::Option::Kind::place: break;
  }
  return "place";
}

}  // namespace

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const trace::ShapeType& type : trace::shapeTypes()) {
    Kind& kind = all.emplace_back(kindOf("shape", trace::Shape(type)));
    const bool listed = std::any_of(kind.fields.begin(), kind.fields.end(),
                                    [](const FieldInfo& field) { return field.type == "objects"; });
    if (type.ofObjects && !listed)
      kind.fields.push_back({.name = "objects",
                             .type = "objects",
                             .help = "the objects that it is made of",
                             .usual = Value::List{}});
    if (type.keyword == "polymesh") addMeshFields(kind);
    addFields<trace::ObjectLinks>(kind);
  }
  for (const trace::LightType& type : trace::lightTypes()) {
    Kind& kind = all.emplace_back(kindOf("light", trace::Light(type)));
    if (type.starts == trace::LightOrigin::ball)
      kind.fields.push_back({.name = "power",
                             .type = "number",
                             .unit = "watts",
                             .most = trace::kNoLimit,
                             .help = "emitted power, whose tint is color",
                             .usual = 0});
    addFields<trace::LightLinks>(kind);
  }
  for (const trace::ModelType& type : trace::modelTypes())
    addFields<trace::Material>(all.emplace_back(kindOf("material", trace::MaterialModel(type))));
  for (const trace::TextureType& type : trace::textureTypes())
    addFields<trace::TexturePlacement>(all.emplace_back(kindOf("texture", trace::TextureModel(type))));
  Kind& camera = all.emplace_back(kindOf<trace::Camera>("camera"));
  camera.fields.push_back({.name = "look_at",
                           .type = "vector",
                           .help = "a point to look at, in place of viewdir",
                           .usual = Value::List{}});
  camera.fields.push_back({.name = "horizontal_fov",
                           .type = "number",
                           .unit = "degrees",
                           .most = 180,
                           .help = "field of view across the picture, in place of fov",
                           .usual = 0});
  Kind& background = all.emplace_back(kindOf<trace::Background>("background"));
  background.fields.push_back({.name = "color",
                               .type = "color",
                               .help = "one colour for the whole picture, in place of colors",
                               .usual = Value::List{}});
  return all;
}

std::vector<FieldInfo> options() {
  const trace::Settings usual;
  std::vector<FieldInfo> all;
  for (const trace::Option& option : trace::options()) {
    FieldInfo info{.name = std::string(option.name),
                   .type = typeOf(option.kind),
                   .unit = std::string(option.unit),
                   .least = option.least,
                   .most = option.most,
                   .help = std::string(option.help),
                   .usual = option.get(usual)};
    for (const std::string_view name : option.choices) info.choices.emplace_back(name);
    all.push_back(std::move(info));
  }
  return all;
}

}  // namespace traceray
