#include "formats/ray/read/objects.h"

#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/read/light.h"
#include "formats/ray/read/placement.h"
#include "formats/ray/read/settings.h"
#include "formats/ray/read/shape_checks.h"
#include "formats/ray/syntax/notes.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/solids/blend.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/surfaces/fur.h"
#include "scene/groups.h"
#include "scene/particles.h"
#include "scene/rows.h"
#include "shading/cameras/camera.h"

namespace trace::rayfile {

std::vector<std::string_view> knownWords() {
  std::vector<std::string_view> words{"trimesh",
                                      "mesh",
                                      Camera::kKeyword,
                                      Material::kKeyword,
                                      Background::kKeyword,
                                      kSettings,
                                      Particles::kKeyword,
                                      Rows::kKeyword};
  for (const ShapeType& type : shapeTypes()) words.push_back(type.keyword);
  addLightWords(words);
  addTransformWords(words);
  return words;
}

namespace {

bool isListOfObjects(const Item& item) {
  return item.is(Kind::entry) && item.key() == "objects" && item.value().is(Kind::block);
}

}  // namespace

void ObjectReader::object(Item item, Affine worldFromObject) { object(item, worldFromObject, true); }

void ObjectReader::object(Item item, Affine worldFromObject, bool mayPlace) {
  for (;;) {
    if (const Syntax::Root* root = mayPlace ? syntax_.rootAt(item.index()) : nullptr;
        root && place(*root, worldFromObject))
      return;
    mayPlace = true;
    if (item.is(Kind::again)) {
      const Syntax::Use& use = syntax_.uses()[static_cast<std::size_t>(item.number())];
      worldFromObject = worldFromObject * use.transform;
      const Syntax::Root* first = syntax_.rootAt(use.root);
      const Syntax::Root root{use.root, static_cast<std::uint32_t>(item.offset()),
                              first ? first->name : std::string_view()};
      if (!place(root, worldFromObject)) object({syntax_, use.root}, worldFromObject, false);
      return;
    }
    if (!isTransform(item)) break;
    const std::optional<Item> child = applyTransform(findings_, item, worldFromObject);
    if (!child) return;
    item = *child;
  }
  if (item.is(Kind::block)) return group(item, worldFromObject);
  if (!item.is(Kind::call)) return noObject(item);
  if (const ShapeType* type = findShapeType(canonical(item.key())))
    shape(*type, item, worldFromObject);
  else
    otherNode(item, worldFromObject);
}

bool ObjectReader::place(const Syntax::Root& root, const Affine& worldFromObject) {
  if (solids_ > 0) return false;
  const Prototype& prototype = prototypeOf(root);
  if (prototype.isCopied) return false;
  if (!invertible(worldFromObject)) {
    findings_.warn(Item(syntax_, root.root),
                   "objects are left out: their transform makes them flat, or infinitely large or small");
    return true;
  }
  for (const Object& one : prototype.alone) {
    scene_.objects.push_back(one);
    scene_.objects.back().worldFromObject = worldFromObject * one.worldFromObject;
  }
  if (prototype.group) uses_[*prototype.group].push_back({worldFromObject, usePlace(root.offset)});
  return true;
}

const ObjectReader::Prototype& ObjectReader::prototypeOf(const Syntax::Root& root) {
  const std::uint32_t material = materials_.index(materials_.current);
  const auto [found, isNew] = prototypes_.try_emplace({root.root, material});
  Prototype& prototype = found->second;
  if (!isNew) return prototype;
  std::vector<Object> objects = std::exchange(scene_.objects, {});
  Uses uses = std::exchange(uses_, {});
  const std::size_t lights = scene_.lights.size();
  prototype.isCopied = true;  // in itself
  object({syntax_, root.root}, {}, false);
  objects.swap(scene_.objects);
  uses.swap(uses_);
  Group group{std::string(root.name), syntax_.shortPlace(syntax_.nodes()[root.root].offset), {}, {}};
  for (const auto& [number, list] : uses)
    for (const auto& [key, other] : prototypes_)
      if (other.group == number) prototype.levels = std::max(prototype.levels, other.levels);
  ++prototype.levels;
  prototype.isCopied = scene_.lights.size() != lights || prototype.levels > kMostGroupLevels;
  if (prototype.isCopied) {
    scene_.lights.resize(lights);
    return prototype;
  }
  for (Object& one : objects)
    (standsAlone(scene_, one) ? prototype.alone : group.objects).push_back(std::move(one));
  group.uses = shared(std::move(uses));
  if (group.objects.empty() && group.uses.empty()) return prototype;
  prototype.group = static_cast<std::uint32_t>(scene_.groups.size());
  scene_.groups.push_back(std::move(group));
  return prototype;
}

std::uint32_t ObjectReader::usePlace(std::uint32_t offset) {
  const auto [found, isNew] =
      usePlaces_.try_emplace(offset, static_cast<std::uint32_t>(scene_.usePlaces.size()));
  if (isNew) scene_.usePlaces.push_back(syntax_.shortPlace(offset));
  return found->second;
}

std::vector<GroupUses> ObjectReader::shared(Uses uses) {
  std::vector<GroupUses> all;
  for (auto& [group, list] : uses) {
    list.shrink_to_fit();
    all.push_back({group, std::make_shared<const GroupUses::List>(std::move(list))});
  }
  return all;
}

void ObjectReader::finish() { scene_.uses = shared(std::exchange(uses_, {})); }

void ObjectReader::group(const Item& block, const Affine& worldFromObject) {
  const NestedSolid nested(*this, block, solids_ > 0);
  if (!nested) return;
  const NotedMaterial outside = materials_.current;
  for (const Item item : block) {
    if (!item.keyed() || item.key() != Material::kKeyword)
      object(item, worldFromObject);
    else if (item.is(Kind::call))
      namedMaterial(item);
    else
      materials_.current = materials_.read(item.value(), materials_.current);
  }
  materials_.current = outside;
}

void ObjectReader::tooDeep(const Item& item) {
  findings_.error(item,
                  "expected at most " + std::to_string(kMostNestedSolids) +
                      " levels of solids or particles in one another, found more",
                  "put more solids into one union in place of unions in unions");
}

void ObjectReader::noObject(const Item& item) {
  if (item.is(Kind::word) && findings_.refuse(item.text(), item)) return;
  std::string hint;
  if (item.is(Kind::word)) {
    const std::string near = nearest(item.text(), knownWords());
    if (near == item.text())
      hint = near == "rotate" && findings_.isOfKind()
                 ? "rotate takes an axis and degrees: rotate y 45 { ... }"
                 : "\"" + near + "\" is followed by { or (";
    else
      hint = didYouMean(item.text(), knownWords());
  }
  findings_.error(item, "expected an object, found " + describe(item), std::move(hint));
}

void ObjectReader::otherNode(const Item& call, const Affine& worldFromObject) {
  const std::string_view key = call.key();
  if (key == Particles::kKeyword) return particles(call, worldFromObject);
  if (key == Rows::kKeyword) return rows(call, worldFromObject);
  const bool topLevelOnly = isLight(key) || key == Camera::kKeyword || key == Background::kKeyword ||
                            key == kSettings || key == Material::kKeyword;
  if (topLevelOnly)
    findings_.error(call, "expected an object, found " + describe(call),
                    std::string(key) + " belongs to the top of a file, outside of transforms and groups");
  else
    findings_.notRendered(key, call, transformed(worldFromObject, call.source()), knownWords());
}

void ObjectReader::shape(const ShapeType& type, const Item& call, const Affine& worldFromObject) {
  // Solids of solids are also written as union(a, b).
  const bool list = type.ofObjects && call.value().is(Kind::tuple);
  const std::optional<Item> block = list ? call.value() : blockOf(findings_, call);
  if (!block) return;
  if (Notes* notes = findings_.notes()) notes->inForce.try_emplace(call.offset(), materials_.current);
  if (type.keyword == Mesh::kKeyword)
    mesh(call, *block, worldFromObject);
  else
    analyticShape(Shape(type), call, *block, worldFromObject);
}

void ObjectReader::mesh(const Item& call, const Item& block, const Affine& worldFromObject) {
  if (namesMeshFile(block)) {
    for (Object& part : meshFiles_.read(block)) {
      part.worldFromObject = worldFromObject * part.worldFromObject;
      add(call, std::move(part));
    }
    return;
  }
  std::optional<MeshNode> node = readMesh(findings_, materials_, sharedMeshes_, block);
  if (node)
    add(call, {std::move(node->name),
               std::move(node->mesh),
               worldFromObject,
               materials_.index(node->material),
               {},
               std::move(node->links)});
}

void ObjectReader::analyticShape(Shape shape, const Item& call, const Item& block, Affine worldFromObject) {
  // In a kind in which y is up, the ground is level.
  if (findings_.isOfKind() && shape.is<Plane>())
    worldFromObject = worldFromObject * Affine{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {}};
  std::string name;
  ObjectLinks links;
  NotedMaterial material = materials_.current;
  const std::size_t errors = findings_.errors();
  const bool ofObjects = shape.type().ofObjects;
  RepeatedFields repeats(findings_, shape.keyword());
  for (const Item item : block) {
    if (ofObjects && (isObject(item) || isListOfObjects(item))) continue;
    if (!isField(findings_, item, call.key())) continue;
    repeats.note(item);
    if (item.key() == Material::kKeyword) {
      material = materials_.read(item.value(), materials_.current);
    } else if (item.key() == "name") {
      rayfile::read(findings_, "name", item.value(), name);
    } else if (assignField(findings_, links, item)) {
    } else if (readMaterials(shape, item, material)) {
    } else if (!assignField(findings_, shape, item)) {
      findings_.unknownField(shape.keyword(), item,
                             keywords(shape, {"material", "name", "lit_by", "not_lit_by"}));
    }
  }
  if (ofObjects) shape.setOperands(operands(call, block, material, mayBeOpen(shape)));
  if (findings_.errors() != errors) return;  // what is wrong is said
  const Tell tell = [&](std::string what, std::string hint) {
    findings_.warn(call, std::move(what), std::move(hint));
  };
  warnOfRanges(shape, block);
  try {
    const std::string_view reason = repair(shape, worldFromObject);
    if (!reason.empty()) return findings_.warn(call, std::string(reason));
    const ShapeFacts facts = check(shape);
    const bool isEmpty = ofObjects && shape.operands().list().empty();  // which is said
    if (!isEmpty) checkShape(shape, facts, tell);
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    return findings_.error(call, error.messages().front().what, error.messages().front().hint);
  }
  if (const auto* julia = shape.as<Julia>())
    if (const std::string excess = julia->excess(); !excess.empty()) findings_.warn(call, excess);
  add(call,
      {std::move(name), std::move(shape), worldFromObject, materials_.index(material), {}, std::move(links)});
}

void ObjectReader::warnOfRanges(const Shape& shape, const Item& block) {
  for (const Item item : block)
    if (item.keyed() && !(shape.is<Cone>() && item.key() == "height")) checkRange(findings_, shape, item);
}

bool ObjectReader::readMaterials(Shape& shape, const Item& item, const NotedMaterial& own) {
  if (item.key() != "materials") return false;
  for (const AnyField& field : shape.editFields()) {
    const auto* materials = std::get_if<MaterialList*>(&field.value);
    if (!materials) continue;
    std::vector<std::uint32_t> list;
    if (!item.value().is(Kind::tuple))
      findings_.expected(item.value(), "materials",
                         "a list of materials, as in (gold, { diffuse = (1, 0, 0); })");
    else
      for (const Item one : item.value()) list.push_back(materials_.index(materials_.read(one, own)));
    (*materials)->indices = std::move(list);
    return true;
  }
  return false;
}

bool ObjectReader::isObject(const Item& item) {
  if (item.is(Kind::block) || item.is(Kind::again) || isTransform(item)) return true;
  return item.is(Kind::call) && findShapeType(canonical(item.key()));
}

std::size_t ObjectReader::mayBeOpen(const Shape& whole) {
  if (whole.is<Fur>()) return std::numeric_limits<std::size_t>::max();
  return whole.is<Clip>() ? 1 : 0;
}

Operands ObjectReader::operands(const Item& call, const Item& block, const NotedMaterial& material,
                                std::size_t mayBeOpen) {
  const NestedSolid nested(*this, call, true);
  if (!nested) return {};
  const NotedMaterial outside = std::exchange(materials_.current, material);
  std::vector<Operand> operands;
  const auto readAll = [&](const Item& items) {
    for (const Item item : items)
      if (isObject(item)) operand(call, item, operands.size() < mayBeOpen, operands);
  };
  readAll(block);
  for (const Item item : block)
    if (isListOfObjects(item)) readAll(item.value());
  materials_.current = outside;
  if (operands.empty()) findings_.warn(call, std::string(call.key()) + " without objects is empty");
  const std::set<std::string_view> mayBeAlone{Union::kKeyword, Blend::kKeyword, Fur::kKeyword};
  if (operands.size() == 1 && !mayBeAlone.contains(call.key()))
    findings_.warn(call, std::string(call.key()) + " of one object changes nothing");
  return Operands(std::move(operands));
}

void ObjectReader::operand(const Item& whole, const Item& item, bool mayBeOpen,
                           std::vector<Operand>& operands) {
  std::vector<Object> found = std::exchange(scene_.objects, {});
  object(item, {});
  found.swap(scene_.objects);
  if (Notes* notes = findings_.notes(); notes && !found.empty()) {
    Notes::OperandText text{item.offset(), {}};
    for (const Object& o : found) text.calls.push_back(syntax_.offsetOf(o.place));
    notes->operands[whole.offset()].push_back(std::move(text));
  }
  std::vector<Operand> parts;
  for (Object& o : found) {
    if (!mayBeOpen && !check(o.shape).solid)
      findings_.error(item, "expected a solid, found " + describe(item),
                      "an open object can only be the first in a clip { }");
    if (o.links != ObjectLinks{})
      findings_.warn(item, "lit_by and not_lit_by of a part of a solid change nothing: the whole says them");
    parts.push_back({std::move(o.name), std::move(o.shape), o.worldFromObject, o.material});
  }
  if (parts.size() > 1)
    parts = {{{}, Union{Operands(std::move(parts))}, {}, materials_.index(materials_.current)}};
  for (Operand& part : parts) operands.push_back(std::move(part));
}

/// Its place is that of the call.
void ObjectReader::add(const Item& call, Object object) {
  if (!invertible(object.worldFromObject))
    return findings_.warn(call,
                          "an object is left out: its transform makes it flat, or infinitely large or small");
  constexpr std::size_t kMany = 10000;  // messages about more than these do without the line's text
  object.place = scene_.objects.size() < kMany ? syntax_.shortPlace(call.offset())
                                               : syntax_.numberedPlace(call.offset());
  scene_.objects.push_back(std::move(object));
}

void ObjectReader::namedMaterial(const Item& call) {
  const NotedMaterial material = materials_.read(call.value(), materials_.current);
  if (material.name.empty())
    findings_.warn(call, "a material without a name is never used",
                   "material = { ... } is that of the objects after it; name = red; in it gives it a name");
}

}  // namespace trace::rayfile
