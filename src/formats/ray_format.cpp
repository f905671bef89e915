// The meaning of .ray scene files: the tree of ray_syntax.h turned into a Scene, by loops over the lists of
// shapes and lights and their fields. A new shape or light needs nothing here.
//
// Source: the skeletons of the courses (docs/ray-format.md). Where they refuse although the
// intention is clear, this reader accepts: named materials, materials inside groups, missing semicolons,
// unknown fields. What Trace does not render yet is kept as text and reported once per kind. One long file,
// for it is one walk over one tree; what needs only a block of it stands beside it.
#include "formats/ray_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/match.h"
#include "base/nesting.h"
#include "base/text.h"
#include "formats/ray_background.h"
#include "formats/ray_camera.h"
#include "formats/ray_fields.h"
#include "formats/ray_findings.h"
#include "formats/ray_keys.h"
#include "formats/ray_material.h"
#include "formats/ray_mesh.h"
#include "formats/ray_mesh_file.h"
#include "formats/ray_notes.h"
#include "formats/ray_shape_checks.h"
#include "formats/ray_syntax.h"
#include "geometry/blend.h"
#include "geometry/cone.h"
#include "geometry/conic.h"
#include "geometry/csg.h"
#include "geometry/csg_tree.h"
#include "geometry/field_value.h"
#include "geometry/julia.h"
#include "geometry/mesh.h"
#include "geometry/sphere.h"
#include "geometry/traced.h"
#include "scene/options.h"
#include "scene/particles.h"

namespace trace {
namespace rayfile {
namespace {

constexpr std::string_view kMagic = "SBT-raytracer", kSettings = "settings";
constexpr double kNewestVersion = 1.1;

// --- keywords -------------------------------------------------------------------------------------------

/// Calls visit(a null pointer to the type) for the type of the variant with that keyword; false if none has
/// it.
template <class Variant, class Visit>
bool withKeyword(std::string_view keyword, Visit&& visit) {
  bool found = false;
  forEachType<Variant>([&]<class T>(T* type) {
    if (T::kKeyword != keyword) return;
    found = true;
    visit(type);
  });
  return found;
}

template <class Variant>
void addKeywords(std::vector<std::string_view>& words) {
  forEachType<Variant>([&]<class T>(T*) { words.push_back(T::kKeyword); });
}

struct TransformForm {
  std::string_view name, form;
};
constexpr std::array<TransformForm, 4> kTransforms{{
    {"translate", "translate(x, y, z, object)"},
    {"rotate", "rotate(x, y, z, radians, object)"},
    {"scale", "scale(factor, object) or scale(x, y, z, object)"},
    {"transform", "transform((a, b, c, d), (e, f, g, h), (i, j, k, l), (0, 0, 0, 1), object)"},
}};

const TransformForm* findTransform(const Item& item) {
  if (!item.is(Kind::call)) return nullptr;
  for (const TransformForm& transform : kTransforms)
    if (transform.name == item.key()) return &transform;
  return nullptr;
}

std::vector<std::string_view> knownWords() {
  std::vector<std::string_view> words{
      "trimesh",          "mesh", Camera::kKeyword, Phong::kKeyword, Background::kKeyword, kSettings,
      Particles::kKeyword};
  for (const ShapeType& type : shapeTypes()) words.push_back(type.keyword);
  addKeywords<Light>(words);
  for (const TransformForm& transform : kTransforms) words.push_back(transform.name);
  return words;
}

/// Fields that a light cannot do without, if it has them.
bool isRequired(std::string_view field) {
  return field == "position" || field == "direction" || field == "color";
}

// --- transforms -----------------------------------------------------------------------------------------

/// The numbers at the start of a transform; nothing if there are others than `count` numbers.
bool numbers(std::span<const Item> items, std::span<Real> to) {
  if (items.size() != to.size()) return false;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is(Kind::number)) return false;
    to[i] = items[i].number();
  }
  return true;
}

std::optional<Affine> translation(std::span<const Item> items) {
  Real n[3];
  if (!numbers(items, n)) return {};
  return Affine::translation({n[0], n[1], n[2]});
}

std::optional<Affine> scaling(std::span<const Item> items) {
  Real n[3];
  if (numbers(items, std::span(n, 1))) return Affine::scaling({n[0], n[0], n[0]});
  if (!numbers(items, n)) return {};
  return Affine::scaling({n[0], n[1], n[2]});
}

std::string rowText(const Vec3& row, Real last) {
  return "(" + toText(row.x) + ", " + toText(row.y) + ", " + toText(row.z) + ", " + toText(last) + ")";
}

/// `text` inside the transform, for the scene to be written again.
std::string transformed(const Affine& m, std::string_view text) {
  if (m == Affine{}) return std::string(text);
  return "transform(" + rowText(m.row[0], m.offset.x) + ", " + rowText(m.row[1], m.offset.y) + ", " +
         rowText(m.row[2], m.offset.z) + ", (0, 0, 0, 1),\n" + std::string(text) + ")";
}

// --- shapes that need more than their fields ------------------------------------------------------------

// Each makes a shape with its transform one that can be traced. Returns why it cannot be, or "".

/// The courses take the absolute value of a radius, and their cones are never quite cylinders: a slope of
/// less than 0.001 becomes 0.001, widening upward. A cone of height h < 0 reaches from z = 0 down to z = h:
/// it is the mirror image of the cone of height -h, and the mirror goes into the transform.
std::string_view repair(Cone& cone, Affine& worldFromObject) {
  cone.bottomRadius = std::abs(cone.bottomRadius);
  cone.topRadius = std::abs(cone.topRadius);
  if (cone.height < 0) {
    cone.height = -cone.height;
    worldFromObject = worldFromObject * Affine::scaling({1, 1, -1});
  }
  if (cone.height == 0) return "a cone of height 0 is left out";
  if (cone.bottomRadius == 0 && cone.topRadius == 0) return "a cone of radius 0 is left out";
  constexpr Real kLeastSlope = 0.001;
  if (std::abs(cone.topRadius - cone.bottomRadius) < kLeastSlope * cone.height)
    cone.topRadius = cone.bottomRadius + kLeastSlope * cone.height;
  return {};
}

std::string_view repair(const Conic& conic) {
  if (conic.zMin == conic.zMax) return "a conic of height 0 is left out";
  if (conic.bottomRadius == 0 && conic.topRadius == 0) return "a conic of radius 0 is left out";
  return {};
}

std::string_view repair(Shape& shape, Affine& worldFromObject) {
  if (auto* cone = shape.edit<Cone>()) return repair(*cone, worldFromObject);
  if (const auto* conic = shape.as<Conic>()) return repair(*conic);
  return {};
}

// --- the reader -----------------------------------------------------------------------------------------

class Reader {
 public:
  Reader(const Syntax& syntax, Scene& scene, Messages& messages, Real time, Notes* notes)
      : syntax_(syntax),
        time_(time),
        scene_(scene),
        messages_(messages),
        findings_(syntax, scene, messages, notes),
        materials_(findings_),
        meshFiles_(findings_, materials_) {}

  void read() {
    const Item root = syntax_.root();
    auto item = root.begin();
    for (readHeader(item, root.end()); item != root.end(); ++item) topLevel(*item);
    scene_.unusedMaterials = materials_.unused();
    if (Notes* notes = findings_.notes()) notes->last = materials_.current;
    findings_.finish();
    warnOfDarkness();
    messages_.throwIfFailed();
  }

 private:
  // --- the file ---

  /// Leaves `item` after the header.
  void readHeader(Item::Iterator& item, const Item::Iterator& end) {
    if (item == end || !(*item).is(Kind::word) || (*item).text() != kMagic)
      throw Error(Fault::scene, syntax_.place(item == end ? 0 : (*item).offset()),
                  "expected SBT-raytracer 1.0");
    const Item magic = *item;
    if (++item == end || !(*item).is(Kind::number))
      throw Error(Fault::scene, syntax_.place(magic.offset()),
                  "expected a version after SBT-raytracer, as in 1.0");
    if (!((*item).number() > 0 && (*item).number() <= kNewestVersion))
      throw Error(Fault::scene, syntax_.place((*item).offset()),
                  "expected version 1.1 or older of the format, found " + describe(*item));
    ++item;
  }

  void topLevel(const Item& item) {
    if (item.is(Kind::entry)) return topLevelEntry(item);
    if (item.is(Kind::call)) {
      if (item.key() == Phong::kKeyword) return namedMaterial(item);
      if (item.key() == Camera::kKeyword) return camera(item);
      if (item.key() == kSettings) return settings(item);
      if (item.key() == Background::kKeyword) return background(item);
      if (withKeyword<Light>(item.key(), [&]<class L>(L*) { light<L>(item); })) return;
    }
    object(item, {});
  }

  void topLevelEntry(const Item& item) {
    if (item.key() != Phong::kKeyword) return findings_.notRendered(item.key(), item, knownWords());
    findings_.sureSignOf2005();
    materials_.current = materials_.read(item.value(), materials_.current);
  }

  void warnOfDarkness() {
    const Place place{scene_.file, 0, 0, {}};
    if (scene_.objects.empty()) return messages_.warn(place, "no object: the picture will be empty");
    const bool glows = std::any_of(
        scene_.materials.begin(), scene_.materials.end(),
        [](const Material& material) { return !isBlack(std::get_if<Phong>(&material.model)->emissive); });
    if (scene_.lights.empty() && !glows)
      messages_.warn(place, "no light: everything will be black",
                     "add one, as in point_light { position = (0, 0, 5); color = (1, 1, 1); }");
  }

  /// The block of `name { ... }`; reports other brackets.
  std::optional<Item> blockOf(const Item& call) {
    if (call.value().is(Kind::block)) return call.value();
    findings_.expected(call.value(), call.key(), "{ ... }");
    return {};
  }

  /// Reports an item that is no field.
  bool isField(const Item& item, std::string_view owner) {
    if (item.keyed()) return true;
    findings_.expected(item, owner, "a field, as in name = value");
    return false;
  }

  // --- objects ---

  void object(Item item, Affine worldFromObject) {
    while (const TransformForm* transform = findTransform(item)) {
      const std::optional<Item> child = applyTransform(item, *transform, worldFromObject);
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

  /// Materials set in a group hold up to its end.
  void group(const Item& block, const Affine& worldFromObject) {
    const NestedSolid nested(*this, block, solids_ > 0);
    if (!nested) return;
    const NotedMaterial outside = materials_.current;
    for (const Item item : block) {
      if (!item.keyed() || item.key() != Phong::kKeyword)
        object(item, worldFromObject);
      else if (item.is(Kind::call))
        namedMaterial(item);
      else
        materials_.current = materials_.read(item.value(), materials_.current);
    }
    materials_.current = outside;
  }

  /// One level more of solids in solids, if `counts`. Converts to false, after a report, where it is one too
  /// many.
  class NestedSolid {
   public:
    NestedSolid(Reader& reader, const Item& item, bool counts) : reader_(reader), counts_(counts) {
      if (counts_ && ++reader_.solids_ > kMostNestedSolids) reader_.tooDeep(item);
    }
    ~NestedSolid() { reader_.solids_ -= counts_; }
    NestedSolid(const NestedSolid&) = delete;
    NestedSolid& operator=(const NestedSolid&) = delete;
    explicit operator bool() const { return reader_.solids_ <= kMostNestedSolids; }

   private:
    Reader& reader_;
    const bool counts_;
  };

  void tooDeep(const Item& item) {
    findings_.error(item,
                    "expected at most " + std::to_string(kMostNestedSolids) +
                        " levels of solids or particles in one another, found more",
                    "put more solids into one union in place of unions in unions");
  }

  void noObject(const Item& item) {
    std::string hint;
    if (item.is(Kind::word)) {
      const std::string near = nearest(item.text(), knownWords());
      if (near == item.text())
        hint = "\"" + near + "\" is followed by { or (";
      else
        hint = didYouMean(item.text(), knownWords());
    }
    findings_.error(item, "expected an object, found " + describe(item), std::move(hint));
  }

  void otherNode(const Item& call, const Affine& worldFromObject) {
    const std::string_view key = call.key();
    if (key == Particles::kKeyword) return particles(call, worldFromObject);
    const bool topLevelOnly = withKeyword<Light>(key, [](auto*) {}) || key == Camera::kKeyword ||
                              key == Background::kKeyword || key == kSettings || key == Phong::kKeyword;
    if (topLevelOnly)
      findings_.error(call, "expected an object, found " + describe(call),
                      std::string(key) + " belongs to the top of a file, outside of transforms and groups");
    else
      findings_.notRendered(key, call, transformed(worldFromObject, call.source()), knownWords());
  }

  /// Multiplies the transform of the node to `worldFromObject`. Returns what it transforms; nothing, after a
  /// report, if the node is not of its form.
  std::optional<Item> applyTransform(const Item& call, const TransformForm& transform,
                                     Affine& worldFromObject) {
    std::vector<Item> items;
    if (call.value().is(Kind::tuple))
      for (const Item item : call.value()) items.push_back(item);
    const bool hasChild = !items.empty() && !items.back().is(Kind::number) && !items.back().is(Kind::tuple);
    if (!hasChild) return wrongForm(call, transform, "the object is missing");

    const std::optional<Item> child = items.back();
    items.pop_back();
    std::optional<Affine> own;
    if (transform.name == "translate")
      own = translation(items);
    else if (transform.name == "rotate")
      own = rotation(items);
    else if (transform.name == "scale")
      own = scaling(items);
    else
      own = matrix(items);
    if (!own) {
      const bool several = !items.empty() && (items.back().is(Kind::call) || items.back().is(Kind::block));
      return wrongForm(call, transform, several ? "several objects stand in a group { }" : "");
    }
    worldFromObject = worldFromObject * *own;
    return child;
  }

  std::optional<Item> wrongForm(const Item& call, const TransformForm& transform, const char* hint) {
    findings_.error(call, "expected " + std::string(transform.form), hint);
    return {};
  }

  std::optional<Affine> rotation(std::span<const Item> items) {
    Real n[4];
    if (!numbers(items, n)) return {};
    const Real length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 0 && std::isfinite(length))) {
      findings_.error(items[0], "rotate: expected an axis, found one of length " + toText(length));
      return Affine{};
    }
    return Affine::rotation(Vec3{n[0], n[1], n[2]} / length, n[3]);
  }

  std::optional<Affine> matrix(std::span<const Item> rows) {
    Real n[4][4];
    if (rows.size() != 4) return {};
    for (int i = 0; i < 4; ++i)
      if (!rayfile::numbers(rows[i], n[i], 4)) return {};
    const auto& last = n[3];
    const bool homogeneous = last[0] == 0 && last[1] == 0 && last[2] == 0 && last[3] != 0;
    const Real w = homogeneous ? last[3] : 1;
    if (!homogeneous)
      findings_.warn(
          rows[3],
          "transform: expected a last row of (0, 0, 0, 1), found " + describe(rows[3]) + "; it is ignored",
          {}, "last row");
    Affine m;
    for (int i = 0; i < 3; ++i) {
      m.row[i] = Vec3{n[i][0], n[i][1], n[i][2]} / w;
      m.offset[i] = n[i][3] / w;
    }
    return m;
  }

  void shape(const ShapeType& type, const Item& call, const Affine& worldFromObject) {
    // Solids of solids are also written as union(a, b).
    const bool list = type.ofObjects && call.value().is(Kind::tuple);
    const std::optional<Item> block = list ? call.value() : blockOf(call);
    if (!block) return;
    if (Notes* notes = findings_.notes()) notes->inForce.try_emplace(call.offset(), materials_.current);
    if (type.keyword == Mesh::kKeyword)
      mesh(call, *block, worldFromObject);
    else
      analyticShape(Shape(type), call, *block, worldFromObject);
  }

  void mesh(const Item& call, const Item& block, const Affine& worldFromObject) {
    if (namesMeshFile(block)) {
      for (Object& part : meshFiles_.read(block))
        add(call, std::move(part.name), std::move(part.shape), worldFromObject * part.worldFromObject,
            part.material);
      return;
    }
    std::optional<MeshNode> node = readMesh(findings_, materials_, sharedMeshes_, block);
    if (node) add(call, std::move(node->name), std::move(node->mesh), worldFromObject, node->material);
  }

  /// Precondition: the shape has the defaults of its type.
  void analyticShape(Shape shape, const Item& call, const Item& block, Affine worldFromObject) {
    std::string name;
    NotedMaterial material = materials_.current;
    const std::size_t errors = findings_.errors();
    const bool ofObjects = shape.type().ofObjects;
    RepeatedFields repeats(findings_, shape.keyword());
    for (const Item item : block) {
      if (ofObjects && (isObject(item) || isListOfObjects(item))) continue;
      if (!isField(item, call.key())) continue;
      repeats.note(item);
      if (item.key() == Phong::kKeyword) {
        material = materials_.read(item.value(), materials_.current);
      } else if (item.key() == "name") {
        rayfile::read(findings_, "name", item.value(), name);
      } else if (readMaterials(shape, item, material)) {
      } else if (!assignField(findings_, shape, item)) {
        findings_.unknownField(shape.keyword(), item, keywords(shape, {"material", "name"}));
      }
    }
    if (ofObjects) shape.setOperands(operands(call, block, material, shape.is<Clip>()));
    if (findings_.errors() != errors) return;  // what is wrong is said
    const Tell tell = [&](std::string what, std::string hint) {
      findings_.warn(call, std::move(what), std::move(hint));
    };
    warnOfRanges(shape, block);
    try {
      const std::string_view reason = repair(shape, worldFromObject);
      if (!reason.empty()) return findings_.warn(call, std::string(reason));
      const TracedShape form = prepare(shape);
      const bool isEmpty = ofObjects && shape.operands().list().empty();  // which is said
      if (!isEmpty) checkShape(shape, form, tell);
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
      return findings_.error(call, error.messages().front().what, error.messages().front().hint);
    }
    if (const auto* julia = shape.as<Julia>())
      if (const std::string excess = julia->excess(); !excess.empty()) findings_.warn(call, excess);
    add(call, std::move(name), shape, worldFromObject, material);
  }

  /// A cone may be lower than its base.
  void warnOfRanges(const Shape& shape, const Item& block) {
    for (const Item item : block)
      if (item.keyed() && !(shape.is<Cone>() && item.key() == "height")) checkRange(findings_, shape, item);
  }

  /// Materials between which the shape's lead; they inherit from its own as known at this point of the file.
  bool readMaterials(Shape& shape, const Item& item, const NotedMaterial& own) {
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

  /// The particles alive at the frame's time, each as the objects of the block; spheres if there are none.
  void particles(const Item& call, const Affine& worldFromObject) {
    const NestedSolid nested(*this, call, true);
    if (!nested) return;
    const std::optional<Item> block = blockOf(call);
    if (!block) return;
    Particles system;
    NotedMaterial material = materials_.current;
    std::vector<Item> shown;
    for (const Item item : *block) {
      if (isObject(item)) {
        shown.push_back(item);
      } else if (!isField(item, call.key())) {
        continue;
      } else if (item.key() == Phong::kKeyword) {
        material = materials_.read(item.value(), materials_.current);
      } else if (assignField(findings_, system, item)) {
        checkRange(findings_, system, item);
      } else {
        findings_.unknownField(Particles::kKeyword, item, keywords<Particles>({"material"}));
      }
    }
    std::vector<Particle> alive;
    try {
      alive = particlesAt(system, time_);
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
      return findings_.error(call, error.messages().front().what, error.messages().front().hint);
    }
    // The objects are read once for each shade, so that they take it as they take the material.
    constexpr int kShades = 32;
    constexpr std::size_t kMostObjects = 2'000'000;
    std::array<std::vector<Object>, kShades + 1> shades;
    const NotedMaterial outside = materials_.current;
    for (const Particle& particle : alive) {
      const auto shade = static_cast<std::size_t>(std::lround(particle.age * kShades));
      std::vector<Object>& objects = shades[shade];
      if (objects.empty()) {
        materials_.current = material;
        materials_.current.block = NotedMaterial::kNoBlock;
        tint(materials_.current, lerp(static_cast<Real>(shade) / kShades, system.color, system.endColor));
        std::vector<Object> found = std::exchange(scene_.objects, {});
        for (const Item& item : shown) object(item, {});
        if (shown.empty()) add(call, {}, Sphere{}, {}, materials_.current);
        found.swap(scene_.objects);
        objects = std::move(found);
        if (objects.empty()) break;  // nothing to show, and that is reported
      }
      if (alive.size() > kMostObjects / objects.size())
        throw Error(Fault::limit, syntax_.place(call.offset()),
                    "particles: " + std::to_string(alive.size()) + " particles of " +
                        std::to_string(objects.size()) + " objects are more than " +
                        std::to_string(kMostObjects) + " objects",
                    "give a lower rate, a shorter lifetime or fewer objects");
      checkBudget();
      const Real size = system.size + particle.age * (system.endSize - system.size);
      const Affine place = Affine::translation(particle.place) * Affine::scaling({size, size, size});
      for (const Object& o : objects)
        add(call, o.name, o.shape, worldFromObject * place * o.worldFromObject, o.material);
    }
    materials_.current = outside;
  }

  static void tint(Material& material, const Color& color) {
    auto& phong = *std::get_if<Phong>(&material.model);
    phong.emissive = phong.emissive * color, phong.ambient = phong.ambient * color;
    phong.diffuse = phong.diffuse * color;
  }

  /// Not a field of the block it stands in.
  bool isObject(const Item& item) {
    if (item.is(Kind::block) || findTransform(item)) return true;
    return item.is(Kind::call) && findShapeType(canonical(item.key()));
  }
  static bool isListOfObjects(const Item& item) {
    return item.is(Kind::entry) && item.key() == "objects" && item.value().is(Kind::block);
  }

  /// The objects of a block, which may stand in objects = { } as well. They have the material of the whole if
  /// they do not say another.
  Operands operands(const Item& call, const Item& block, const NotedMaterial& material, bool clips) {
    const NestedSolid nested(*this, call, true);
    if (!nested) return {};
    const NotedMaterial outside = std::exchange(materials_.current, material);
    std::vector<Operand> operands;
    const auto readAll = [&](const Item& items) {
      for (const Item item : items)
        if (isObject(item)) operand(call, item, clips && operands.empty(), operands);
    };
    readAll(block);
    for (const Item item : block)
      if (isListOfObjects(item)) readAll(item.value());
    materials_.current = outside;
    if (operands.empty()) findings_.warn(call, std::string(call.key()) + " without objects is empty");
    if (operands.size() == 1 && call.key() != Union::kKeyword && call.key() != Blend::kKeyword)
      findings_.warn(call, std::string(call.key()) + " of one object changes nothing");
    return Operands(std::move(operands));
  }

  /// A group is one operand: the union of its objects.
  void operand(const Item& whole, const Item& item, bool mayBeOpen, std::vector<Operand>& operands) {
    std::vector<Object> found = std::exchange(scene_.objects, {});
    object(item, {});
    found.swap(scene_.objects);
    if (Notes* notes = findings_.notes(); notes && !found.empty())
      notes->operands[whole.offset()].push_back(found.size() > 1 ? Notes::kSeveral
                                                                 : syntax_.offsetOf(found.front().place));
    std::vector<Operand> parts;
    for (Object& o : found) {
      if (!mayBeOpen && !Placed(o.shape, {}).solid())
        findings_.error(item, "expected a solid, found " + describe(item),
                        "an open object can only be the first in a clip { }");
      parts.push_back({std::move(o.name), std::move(o.shape), o.worldFromObject, o.material});
    }
    if (parts.size() > 1)
      parts = {{{}, Union{Operands(std::move(parts))}, {}, materials_.index(materials_.current)}};
    for (Operand& part : parts) operands.push_back(std::move(part));
  }

  void add(const Item& call, std::string name, Shape shape, const Affine& worldFromObject,
           const NotedMaterial& material) {
    add(call, std::move(name), std::move(shape), worldFromObject, materials_.index(material));
  }

  void add(const Item& call, std::string name, Shape shape, const Affine& worldFromObject,
           std::uint32_t material) {
    if (!invertible(worldFromObject))
      return findings_.warn(
          call, "an object is left out: its transform makes it flat, or infinitely large or small");
    scene_.objects.push_back(
        {std::move(name), std::move(shape), worldFromObject, material, syntax_.shortPlace(call.offset())});
  }

  void namedMaterial(const Item& call) {
    const NotedMaterial material = materials_.read(call.value(), materials_.current);
    if (material.name.empty()) findings_.warn(call, "a material without a name is never used");
  }

  // --- camera, lights, settings ---

  void camera(const Item& call) {
    const std::optional<Item> block = blockOf(call);
    if (!block) return;
    if (std::exchange(hasCamera_, true)) findings_.warn(call, "there are several cameras; the last counts");
    scene_.camera = readCamera(findings_, *block);
  }

  void background(const Item& call) {
    if (const std::optional<Item> block = blockOf(call))
      scene_.background = readBackground(findings_, *block);
  }

  template <class L>
  void light(const Item& call) {
    const std::optional<Item> block = blockOf(call);
    if (!block) return;
    L light;
    const std::size_t errors = findings_.errors();
    std::vector<std::string_view> given;
    RepeatedFields repeats(findings_, L::kKeyword);
    for (const Item item : *block) {
      if (!isField(item, L::kKeyword)) continue;
      repeats.note(item);
      if (!assignField(findings_, light, item)) {
        findings_.unknownField(L::kKeyword, item, keywords<L>({"colour"}));
        continue;
      }
      checkRange(findings_, light, item);
      given.push_back(canonical(item.key()));
    }
    forEachField<L>([&](const auto& field) {
      if (isRequired(field.keyword) && std::find(given.begin(), given.end(), field.keyword) == given.end())
        findings_.error(call, std::string(L::kKeyword) + ": expected a " + std::string(field.keyword));
    });
    if (findings_.errors() != errors || !checkDirection(call, light)) return;
    if constexpr (requires { light.fullAngle; })
      if (light.fullAngle > light.angle &&
          std::find(given.begin(), given.end(), std::string_view("full_angle")) != given.end())
        findings_.warn(call, "spot_light: expected a full_angle of at most the angle, found " +
                                 toText(light.fullAngle) + " and " + toText(light.angle));
    scene_.lights.push_back({light, syntax_.shortPlace(call.offset())});
  }

  template <class L>
  bool checkDirection(const Item& call, const L& light) {
    if constexpr (requires { light.direction; }) {
      const Real l = length(light.direction);
      if (l > 0 && std::isfinite(l)) return true;
      findings_.error(call,
                      std::string(L::kKeyword) + ": expected a direction, found one of length " + toText(l));
      return false;
    }
    return true;
  }

  void settings(const Item& call) {
    const std::optional<Item> block = blockOf(call);
    if (!block) return;
    RepeatedFields repeats(findings_, kSettings);
    for (const Item item : *block) {
      if (!isField(item, kSettings)) continue;
      repeats.note(item);
      choice(item);
    }
  }

  void choice(const Item& item) {
    const Choice choice{std::string(item.key()), choiceText(item.value()), syntax_.shortPlace(item.offset())};
    try {
      Settings scratch;
      findOption(choice.option).assign(scratch, choice.value);
      scene_.choices.push_back(choice);
    } catch (const Error& error) {
      const Message& message = error.messages().front();
      const std::string_view what = message.what;
      findings_.error(item, std::string(what.starts_with("--") ? what.substr(2) : what), message.hint);
    }
  }

  /// As on the command line: `(0, 0, 8, 8)` is 0,0,8,8.
  static std::string choiceText(const Item& value) {
    if (value.is(Kind::word)) return std::string(value.text());
    if (value.is(Kind::number) && value.source().starts_with(Syntax::kKey)) return toText(value.number());
    if (!value.is(Kind::tuple)) return std::string(value.source());
    std::string text;
    for (const Item item : value) text += (text.empty() ? "" : ",") + choiceText(item);
    return text;
  }

  const Syntax& syntax_;
  Real time_;  ///< of the frame
  Scene& scene_;
  Messages& messages_;
  Findings findings_;
  Materials materials_;
  MeshFiles meshFiles_;
  SharedMeshes sharedMeshes_;
  bool hasCamera_ = false;
  int solids_ = 0;  ///< how many solids or particles what is read is nested in
};

}  // namespace

Scene readNoted(Syntax& syntax, Messages& messages, Real time, Notes& notes) {
  Scene scene;
  scene.file = syntax.file();
  scene.format = "ray";
  settleKeys(syntax, time);
  Reader(syntax, scene, messages, time, &notes).read();
  return scene;
}

}  // namespace rayfile

bool recognisesRay(std::string_view bytes) { return rayfile::skipBlanks(bytes).starts_with(rayfile::kMagic); }

bool changesWithTime(const std::string& file, std::string_view bytes) {
  const bool mayHave = bytes.find(rayfile::Syntax::kKey) != bytes.npos;  // the look is cheap, the syntax not
  return mayHave && recognisesRay(bytes) && rayfile::Syntax(file, bytes).hasKeys();
}

Scene readRay(const std::string& file, std::string_view bytes, Messages& messages, Real time) {
  Scene scene;
  scene.file = file;
  scene.format = "ray";
  rayfile::Syntax syntax(file, bytes);
  rayfile::settleKeys(syntax, time);
  rayfile::Reader(syntax, scene, messages, time, nullptr).read();
  return scene;
}

}  // namespace trace
