// Things of a scene: their fields read and set. A light, the camera and the background are written, changed
// as text and read again, so that the reader of scene files checks them; objects and materials are changed in
// their place.
#include "formats/ray/file/part.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "formats/model.h"
#include "formats/ray/language/language.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/read/material.h"
#include "formats/ray/read/shape_checks.h"
#include "formats/ray/write/writer.h"
#include "formats/textures.h"
#include "geometry/traced.h"
#include "library/field_values.h"
#include "library/guard.h"
#include "library/part_state.h"

namespace traceray {
namespace {

namespace rayfile = trace::rayfile;

constexpr std::string_view kCategories[] = {"object", "light", "material", "camera", "background"};

/// Fields of one node, parsed, with what reading them needs.
class ParsedFields {
 public:
  /// `label` stands for the file in messages, and has its folder. `scene` takes the materials that are read.
  ParsedFields(const std::string& label, const Fields& fields, trace::Scene& scene)
      : text_(textOf(fields)), syntax_(label, text_), findings_(syntax_, scene, messages_, nullptr) {
    trace::SceneTime moment(0);
    settle(syntax_, moment, scene.inputs);
    syntax_.throwMistakes();
  }

  rayfile::Findings& findings() { return findings_; }
  const std::string& text() const { return text_; }
  /// The block `{ ... }`.
  rayfile::Item block() const {
    auto item = syntax_.root().begin();
    ++ ++item;
    return (*item).value();
  }
  /// Throws trace::Error if something was wrong; else hands over the warnings.
  std::vector<trace::Message> finish() {
    findings_.finish();
    messages_.throwIfFailed();
    return messages_.all();
  }

 private:
  /// On the line of the header, so that a message is about line 1.
  static std::string textOf(const Fields& fields) { return "Trace 1 " + Node("part", fields).inLanguage(); }

  const std::string text_;
  rayfile::Syntax syntax_;
  trace::Messages messages_;
  rayfile::Findings findings_;
};

bool gives(const Fields& fields, std::string_view name) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
}

// --- transforms ---

trace::Affine affineOf(const std::vector<double>& m) {
  for (const double number : m)
    if (!std::isfinite(number))
      throw Error(Error::Kind::usage, "transform: expected numbers that are finite");
  if (m.size() != 16 || m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
    throw Error(Error::Kind::usage, "transform: expected four rows of four numbers, the last (0, 0, 0, 1)");
  trace::Affine affine;
  for (std::size_t i = 0; i < 3; ++i) affine.row[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
  affine.offset = {m[3], m[7], m[11]};
  return affine;
}

void checkInvertible(const trace::Affine& affine) {
  if (!invertible(affine))
    throw Error(
        Error::Kind::usage,
        "transform: expected one that can be undone, found one that makes the object flat, or infinitely "
        "large or small");
}

/// The transform of move(): a sphere so placed, read by the reader.
trace::Affine placementOf(const Fields& fields) {
  for (const Field& field : fields)
    if (field.name != "scale" && field.name != "rotate" && field.name != "translate" &&
        field.name != "transform")
      throw Error(Error::Kind::usage,
                  "move: expected scale, rotate, translate or transform, found " + field.name);
  trace::Scene scene;
  trace::Messages messages;
  rayfile::readPart("move", Node("sphere", fields).inLanguage(), scene, messages);
  if (scene.objects.empty()) checkInvertible(trace::Affine::scaling({}));
  return scene.objects.front().worldFromObject;
}

// --- texts of things that are read again ---

/// `name = value;` of each field that is not given anew.
template <class Struct>
Fields otherFields(const Struct& from, const Fields& given) {
  Fields fields;
  forEachValue(from, [&](std::string_view name, Value value) {
    if (!gives(given, name) && isSayable(value)) fields.push_back({std::string(name), std::move(value)});
  });
  return fields;
}

/// An empty text or list, which no scene says.
bool isEmpty(const Value& value) {
  return (value.isText() && value.text().empty()) || (value.isList() && value.list().empty());
}

void drop(Fields& fields, std::initializer_list<std::string_view> names) {
  std::erase_if(fields, [&](const Field& field) {
    return std::find(names.begin(), names.end(), field.name) != names.end();
  });
}

/// The node that says the same as before except for the given fields, which stand first.
Node changed(std::string_view keyword, const Fields& given, Fields others) {
  Node node(std::string(keyword), given);
  node.fields.insert(node.fields.end(), others.begin(), others.end());
  return node;
}

}  // namespace

std::size_t PartState::index() const {
  if (category == kMaterial) return static_cast<std::size_t>(id);
  const std::vector<std::uint64_t>& ids = category == kObject ? owner->objectIds : owner->lightIds;
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end())
    throw Error(Error::Kind::usage, "the " + categoryName() + " was taken out of the scene");
  return static_cast<std::size_t>(found - ids.begin());
}

std::string PartState::categoryName() const { return std::string(kCategories[category]); }

std::string PartState::keyword() const {
  const trace::Scene& scene = owner->scene;
  switch (category) {
    case kObject: return std::string(scene.objects[index()].shape.keyword());
    case kLight: return std::string(scene.lights[index()].light.keyword());
    case kMaterial: return std::string(scene.materials[index()].model.keyword());
    case kCamera: return std::string(trace::Camera::kKeyword);
    default: return std::string(trace::Background::kKeyword);
  }
}

std::string PartState::name() const {
  switch (category) {
    case kObject: return owner->scene.objects[index()].name;
    case kLight: return owner->scene.lights[index()].links.name;
    case kMaterial: return owner->scene.materials[index()].name;
    default: return "";
  }
}

Fields PartState::all() const {
  const trace::Scene& scene = owner->scene;
  Fields fields;
  const auto put = [&](std::string_view name, Value value) {
    fields.push_back({std::string(name), std::move(value)});
  };
  switch (category) {
    case kObject: {
      const trace::Object& object = scene.objects[index()];
      put("name", object.name);
      forEachValue(scene, object.shape, put);
      put("material", nodeOf(scene.materials[object.material]));
      forEachValue(object.links, put);
      break;
    }
    case kLight: {
      const trace::LightSource& source = scene.lights[index()];
      forEachValue(source.light, put);
      forEachValue(source.links, put);
      break;
    }
    case kMaterial: {
      const trace::Material& material = scene.materials[index()];
      put("name", material.name);
      forEachValue(material, put);
      break;
    }
    case kCamera: forEachValue(scene.camera, put); break;
    default: forEachValue(scene.background, put);
  }
  return fields;
}

std::vector<std::string> PartState::fields() const {
  std::vector<std::string> names;
  for (Field& field : all()) names.push_back(std::move(field.name));
  return names;
}

Value PartState::get(std::string_view field) const {
  const Fields fields = all();
  std::vector<std::string_view> names;
  for (const Field& known : fields) {
    if (known.name == field) return known.value;
    names.push_back(known.name);
  }
  throw Error(Error::Kind::usage, keyword() + " has no field \"" + std::string(field) + "\"",
              trace::didYouMean(field, names));
}

Node PartState::node() const {
  const trace::Scene& scene = owner->scene;
  if (category == kMaterial) return nodeOf(scene.materials[index()]);
  if (category == kObject) {
    const trace::Object& object = scene.objects[index()];
    return nodeOf(scene, object.shape, object.name, object.material, object.worldFromObject);
  }
  Node node(keyword());
  for (Field& field : all())
    if (isSayable(field.value) && !isEmpty(field.value)) node.fields.push_back(std::move(field));
  return node;
}

void PartState::set(const Fields& fields) {
  if (fields.empty()) return;
  guarded([&] {
    const trace::ReadScope scope = owner->readScope();
    switch (category) {
      case kObject: return setObject(fields);
      case kLight: return setLight(fields);
      case kMaterial: return setMaterial(fields);
      case kCamera: return setCamera(fields);
      default: return setBackground(fields);
    }
  });
}

void PartState::setObject(const Fields& fields) {
  trace::Scene& scene = owner->scene;
  const std::size_t materials = scene.materials.size();
  trace::Object object = scene.objects[index()];
  try {
    ParsedFields parsed(owner->folder() + std::string(object.shape.keyword()), fields, scene);
    rayfile::Findings& findings = parsed.findings();
    rayfile::Materials reader(findings);
    for (const rayfile::Item item : parsed.block()) {
      const std::string_view key = item.key();
      if (key == trace::Material::kKeyword) {
        // A new one, since others may have the old one.
        scene.materials.push_back(reader.completed(reader.read(item.value(), reader.current)));
        object.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
      } else if (key == "name") {
        rayfile::read(findings, key, item.value(), object.name);
      } else if (assignField(findings, object.links, item)) {
      } else if (assignField(findings, object.shape, item)) {
        checkRange(findings, object.shape, item);
      } else {
        findings.unknownField(object.shape.keyword(), item,
                              rayfile::keywords(object.shape, {"material", "name", "lit_by", "not_lit_by"}));
      }
    }
    std::vector<trace::Message> warnings = parsed.finish();
    if (const std::string_view reason = rayfile::repair(object.shape, object.worldFromObject);
        !reason.empty())
      throw Error(Error::Kind::scene, std::string(reason));
    check(object.shape);
    owner->loadTextures();
    owner->dropWarnings(kObject, id, fields);
    const std::uint32_t before = scene.objects[index()].material;
    const auto users = std::count_if(scene.objects.begin(), scene.objects.end(),
                                     [&](const trace::Object& o) { return o.material == before; });
    if (object.material != before && users == 1) owner->dropWarnings(kMaterial, before, {});
    owner->warn(kObject, id, warnings, parsed.text());
  } catch (...) {
    scene.materials.resize(materials);
    throw;
  }
  scene.objects[index()] = std::move(object);
}

void PartState::setMaterial(const Fields& fields) {
  trace::Scene& scene = owner->scene;
  const trace::Material before = scene.materials[index()];
  ParsedFields parsed(owner->folder() + std::string(trace::Material::kKeyword), fields, scene);
  rayfile::Materials reader(parsed.findings());
  trace::Material after = reader.read(parsed.block(), rayfile::NotedMaterial(before));
  if (!gives(fields, "name")) after.name = before.name;
  const std::vector<trace::Message> warnings = parsed.finish();
  scene.materials[index()] = std::move(after);
  try {
    owner->loadTextures();
  } catch (...) {
    scene.materials[index()] = before;
    throw;
  }
  const bool isOther = gives(fields, "model") || gives(fields, "library");
  const Fields dropped = isOther ? Fields{{"material", ""}} : fields;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].material == id) owner->dropWarnings(kObject, owner->objectIds[i], dropped);
  owner->dropWarnings(kMaterial, id, isOther ? Fields{} : fields);
  owner->warn(kMaterial, id, warnings, parsed.text());
}

rayfile::PartGiven PartState::readAgain(const Node& node, trace::Scene& into) const {
  trace::Messages messages;
  rayfile::PartGiven said;
  // The parts of the scene that nodes name stay known.
  into.file = owner->scene.file;
  const std::string text = node.inLanguage();
  try {
    said = rayfile::readPart(owner->folder() + keyword(), text, into, messages);
    trace::Messages reported;  // by allWarnings()
    if (!loadTextures(into, reported)) owner->lacksTextures = true;
  } catch (const trace::Error& error) {
    std::vector<trace::Message> all = error.messages();
    for (trace::Message& message : all)
      if (message.place.line > 1) --message.place.line;  // that of the header
    throw trace::Error(error.fault(), std::move(all));
  }
  owner->dropWarnings(category, id, {});
  owner->warn(category, id, messages.all(), text, 2);
  return said;
}

void PartState::setLight(const Fields& fields) {
  trace::LightSource& source = owner->scene.lights[index()];
  Fields others = otherFields(source.light, fields);
  for (Field& field : otherFields(source.links, fields))
    if (!isEmpty(field.value)) others.push_back(std::move(field));
  trace::Scene one;
  rayfile::PartGiven said = readAgain(changed(keyword(), fields, std::move(others)), one);
  if (one.lights.size() != 1) throw Error(Error::Kind::scene, keyword() + ": expected fields of a light");
  source.light = one.lights.front().light;
  source.links = one.lights.front().links;
  std::vector<std::size_t>& fading = owner->given.fading;
  std::erase(fading, index());
  if (!said.kind.fading.empty()) fading.push_back(index());
}

void PartState::setCamera(const Fields& fields) {
  Fields others = otherFields(owner->scene.camera, fields);
  if (gives(fields, "look_at") || gives(fields, "quaternian")) drop(others, {"viewdir"});
  if (gives(fields, "quaternian")) drop(others, {"updir"});
  if (gives(fields, "horizontal_fov")) drop(others, {"fov"});
  const trace::KindGiven& given = owner->given;
  if (owner->isBuilt) {  // what nobody said stays free
    if (!given.cameraPosition) drop(others, {"position"});
    if (!given.cameraDirection) drop(others, {"viewdir", "updir"});
    if (!given.aspect) drop(others, {"aspectratio"});
  }
  trace::Scene one;
  rayfile::PartGiven said = readAgain(changed(trace::Camera::kKeyword, fields, std::move(others)), one);
  owner->scene.camera = one.camera;
  said.kind.fading = given.fading;
  said.kind.horizontalFov |= given.horizontalFov && !gives(fields, "fov");
  owner->given = said.kind;
  if (gives(fields, "aspectratio")) owner->scene.freeAspect = {};
}

void PartState::setBackground(const Fields& fields) {
  Fields others = otherFields(owner->scene.background, fields);
  if (gives(fields, "color") || gives(fields, "colors")) drop(others, {"colors", "limits"});
  if (gives(fields, "gradient")) drop(others, {"elevations"});
  std::erase_if(others,
                [](const Field& field) { return field.value.isText() && field.value.text().empty(); });
  trace::Scene one;
  readAgain(changed(trace::Background::kKeyword, fields, std::move(others)), one);
  owner->scene.background = one.background;
}

trace::Object& PartState::object() const {
  if (category != kObject)
    throw Error(Error::Kind::usage, "expected an object, found the " + categoryName() + " " + keyword());
  return owner->scene.objects[index()];
}

PartState PartState::material() const { return {owner, kMaterial, object().material}; }

std::array<double, 16> PartState::transform() const {
  const trace::Affine& m = object().worldFromObject;
  return {m.row[0].x, m.row[0].y, m.row[0].z, m.offset.x, m.row[1].x, m.row[1].y, m.row[1].z, m.offset.y,
          m.row[2].x, m.row[2].y, m.row[2].z, m.offset.z, 0,          0,          0,          1};
}

void PartState::setTransform(const std::array<double, 16>& worldFromObject) {
  const trace::Affine affine = affineOf({worldFromObject.begin(), worldFromObject.end()});
  checkInvertible(affine);
  object().worldFromObject = affine;
}

void PartState::move(const Fields& fields) {
  guarded([&] {
    const trace::Affine affine = placementOf(fields) * object().worldFromObject;
    checkInvertible(affine);
    object().worldFromObject = affine;
  });
}

void PartState::remove() {
  const auto at = static_cast<std::ptrdiff_t>(index());
  if (category == kObject) {
    owner->scene.objects.erase(owner->scene.objects.begin() + at);
    owner->objectIds.erase(owner->objectIds.begin() + at);
  } else if (category == kLight) {
    owner->scene.lights.erase(owner->scene.lights.begin() + at);
    owner->lightIds.erase(owner->lightIds.begin() + at);
    std::vector<std::size_t>& fading = owner->given.fading;
    std::erase(fading, static_cast<std::size_t>(at));
    for (std::size_t& number : fading) number -= number > static_cast<std::size_t>(at);
  } else {
    throw Error(Error::Kind::usage, "expected an object or a light to take out, found the " + categoryName());
  }
}

Part::Part(std::shared_ptr<PartState> state) : state_(std::move(state)) {}
std::string Part::category() const { return state_->categoryName(); }
std::string Part::keyword() const { return state_->keyword(); }
std::string Part::name() const { return state_->name(); }
std::vector<std::string> Part::fields() const { return state_->fields(); }
Value Part::get(std::string_view field) const { return state_->get(field); }
Node Part::node() const { return state_->node(); }
void Part::set(const std::string& field, Value value) { state_->set({{field, std::move(value)}}); }
void Part::set(const Fields& fields) { state_->set(fields); }
Part Part::material() const { return Part(std::make_shared<PartState>(state_->material())); }
std::array<double, 16> Part::transform() const { return state_->transform(); }
void Part::setTransform(const std::array<double, 16>& worldFromObject) {
  state_->setTransform(worldFromObject);
}
void Part::move(const Fields& fields) { state_->move(fields); }
void Part::remove() { state_->remove(); }

}  // namespace traceray
