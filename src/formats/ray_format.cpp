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
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

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
#include "formats/ray_syntax.h"
#include "geometry/csg_tree.h"
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
  addKeywords<Shape>(words);
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

/// Makes a shape with its transform one that can be traced. Returns why it cannot be, or "".
template <class S>
std::string_view repair(S&, Affine&) {
  return {};
}

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

std::string_view repair(Conic& conic, Affine&) {
  if (conic.zMin == conic.zMax) return "a conic of height 0 is left out";
  if (conic.bottomRadius == 0 && conic.topRadius == 0) return "a conic of radius 0 is left out";
  return {};
}

// --- the reader -----------------------------------------------------------------------------------------

/// What is nested is read by recursion. Functions on its way keep little on the stack (base/nesting.h): what
/// is large lies on the heap, and steps without recursion, [[gnu::noinline]], have frames of their own.
class Reader {
 public:
  Reader(const Syntax& syntax, Scene& scene, Messages& messages, Real time)
      : syntax_(syntax),
        time_(time),
        scene_(scene),
        messages_(messages),
        findings_(syntax, scene, messages),
        materials_(findings_),
        meshFiles_(findings_, materials_) {}

  void read() {
    const Item root = syntax_.root();
    auto item = root.begin();
    for (readHeader(item, root.end()); item != root.end(); ++item) topLevel(*item);
    scene_.unusedMaterials = materials_.unused();
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
    if ((*item).number() > kNewestVersion)
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
    if (!withKeyword<Shape>(canonical(item.key()), [&]<class S>(S*) { shape<S>(item, worldFromObject); }))
      otherNode(item, worldFromObject);
  }

  /// Materials set in a group hold up to its end.
  void group(const Item& block, const Affine& worldFromObject) {
    const NestedSolid nested(*this, block, solids_ > 0);
    if (!nested) return;
    const auto outside = std::make_unique<Material>(materials_.current);
    for (const Item item : block) {
      if (!item.keyed() || item.key() != Phong::kKeyword)
        object(item, worldFromObject);
      else
        setMaterial(item);
    }
    materials_.current = *outside;
  }

  [[gnu::noinline]] void setMaterial(const Item& item) {
    if (item.is(Kind::call)) return namedMaterial(item);
    materials_.current = materials_.read(item.value(), materials_.current);
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

  [[gnu::noinline]] void tooDeep(const Item& item) {
    findings_.error(item,
                    "expected at most " + std::to_string(kMostNestedSolids) +
                        " levels of solids or particles in one another, found more",
                    "put more solids into one union in place of unions in unions");
  }

  [[gnu::noinline]] void noObject(const Item& item) {
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

  [[gnu::noinline]] void otherNode(const Item& call, const Affine& worldFromObject) {
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
  [[gnu::noinline]] std::optional<Item> applyTransform(const Item& call, const TransformForm& transform,
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
    const bool plain = last[0] == 0 && last[1] == 0 && last[2] == 0 && last[3] != 0;
    if (!plain) findings_.warn(rows[3], "transform: expected a last row of (0, 0, 0, 1); it is ignored");
    const Real w = plain ? last[3] : 1;
    Affine m;
    for (int i = 0; i < 3; ++i) {
      m.row[i] = Vec3{n[i][0], n[i][1], n[i][2]} / w;
      m.offset[i] = n[i][3] / w;
    }
    return m;
  }

  template <class S>
  void shape(const Item& call, const Affine& worldFromObject) {
    // Solids of solids are also written as union(a, b).
    const bool list = requires { S{}.objects; }
    &&call.value().is(Kind::tuple);
    const std::optional<Item> block = list ? call.value() : blockOf(call);
    if (!block) return;
    if constexpr (std::is_same_v<S, Mesh>)
      mesh(call, *block, worldFromObject);
    else
      analyticShape<S>(call, *block, worldFromObject);
  }

  [[gnu::noinline]] void mesh(const Item& call, const Item& block, const Affine& worldFromObject) {
    if (namesMeshFile(block)) {
      for (Object& part : meshFiles_.read(block))
        add(call, std::move(part.name), std::move(part.shape), worldFromObject * part.worldFromObject,
            part.material);
      return;
    }
    std::optional<MeshNode> node = readMesh(findings_, materials_, sharedMeshes_, block);
    if (node) add(call, std::move(node->name), std::move(node->mesh), worldFromObject, node->material);
  }

  /// A shape as its block describes it.
  template <class S>
  struct Described {
    S shape;
    std::string name;
    Material material;
    std::size_t errorsBefore;
  };

  template <class S>
  void analyticShape(const Item& call, const Item& block, const Affine& worldFromObject) {
    constexpr bool kOfObjects = requires(S s) { s.objects; };
    const auto described = std::make_unique<Described<S>>();
    readFields(call, block, *described);
    if constexpr (kOfObjects)
      described->shape.objects = operands(call, block, described->material, std::is_same_v<S, Clip>);
    addDescribed(call, block, *described, worldFromObject);
  }

  template <class S>
  [[gnu::noinline]] void readFields(const Item& call, const Item& block, Described<S>& described) {
    described.material = materials_.current;
    described.errorsBefore = findings_.errors();
    constexpr bool kOfObjects = requires(S s) { s.objects; };
    for (const Item item : block) {
      if (kOfObjects && (isObject(item) || isListOfObjects(item))) continue;
      if (!isField(item, call.key())) continue;
      if (item.key() == Phong::kKeyword) {
        if (item.is(Kind::call)) findings_.sureSignOf2001(item);
        described.material = materials_.read(item.value(), materials_.current);
      } else if (item.key() == "name") {
        rayfile::read(findings_, "name", item.value(), described.name);
      } else if (readMaterials(described.shape, item, described.material)) {
      } else if (!assignField(findings_, described.shape, item)) {
        findings_.unknownField(S::kKeyword, item, keywords<S>({"material", "name"}));
      }
    }
  }

  template <class S>
  [[gnu::noinline]] void addDescribed(const Item& call, const Item& block, Described<S>& described,
                                      Affine worldFromObject) {
    S& shape = described.shape;
    if constexpr (requires { shape.prepared(); }) {
      if (findings_.errors() != described.errorsBefore) return;  // what is wrong is said
      try {
        shape.prepared();
      } catch (const Error& error) {
        return findings_.error(call, error.messages().front().what, error.messages().front().hint);
      }
    }
    const std::string_view reason = repair(shape, worldFromObject);
    if (!reason.empty()) return findings_.warn(call, std::string(reason));
    for (const Item item : block)
      if (item.keyed()) checkRange(findings_, shape, item);
    add(call, std::move(described.name), shape, worldFromObject, described.material);
  }

  /// Materials between which the shape's lead; they inherit from its own as known at this point of the file.
  template <class S>
  bool readMaterials(S& shape, const Item& item, const Material& own) {
    if constexpr (requires { shape.materials.indices; }) {
      if (item.key() != "materials") return false;
      std::vector<std::uint32_t> list;
      if (!item.value().is(Kind::tuple))
        findings_.expected(item.value(), "materials",
                           "a list of materials, as in (gold, { diffuse = (1, 0, 0); })");
      else
        for (const Item one : item.value()) list.push_back(materials_.index(materials_.read(one, own)));
      shape.materials.indices = std::move(list);
      return true;
    }
    return false;
  }

  /// A system of particles as its block describes it, and its objects in each shade that they take.
  struct Shower {
    static constexpr int kShades = 32;

    Particles system;
    Material material;
    std::vector<Item> shown;
    std::vector<Particle> alive;
    std::array<std::vector<Object>, kShades + 1> shades;
  };

  /// The particles alive at the frame's time, each as the objects of the block; spheres if there are none.
  void particles(const Item& call, const Affine& worldFromObject) {
    const NestedSolid nested(*this, call, true);
    if (!nested) return;
    const auto shower = std::make_unique<Shower>();
    if (!readShower(call, *shower)) return;
    const auto outside = std::make_unique<Material>(materials_.current);
    for (const Particle& particle : shower->alive) {
      std::vector<Object>& objects = shower->shades[shadeOf(particle)];
      if (objects.empty()) {
        setShade(*shower, particle);
        std::vector<Object> found = std::exchange(scene_.objects, {});
        for (const Item& item : shower->shown) object(item, {});
        if (shower->shown.empty()) addSphere(call);
        found.swap(scene_.objects);
        objects = std::move(found);
        if (objects.empty()) break;  // nothing to show, and that is reported
      }
      addParticle(call, worldFromObject, *shower, particle);
    }
    materials_.current = *outside;
  }

  /// False after a report.
  [[gnu::noinline]] bool readShower(const Item& call, Shower& shower) {
    const std::optional<Item> block = blockOf(call);
    if (!block) return false;
    shower.material = materials_.current;
    for (const Item item : *block) {
      if (isObject(item)) {
        shower.shown.push_back(item);
      } else if (!isField(item, call.key())) {
        continue;
      } else if (item.key() == Phong::kKeyword) {
        shower.material = materials_.read(item.value(), materials_.current);
      } else if (assignField(findings_, shower.system, item)) {
        checkRange(findings_, shower.system, item);
      } else {
        findings_.unknownField(Particles::kKeyword, item, keywords<Particles>({"material"}));
      }
    }
    try {
      shower.alive = particlesAt(shower.system, time_);
    } catch (const Error& error) {
      findings_.error(call, error.messages().front().what, error.messages().front().hint);
      return false;
    }
    return true;
  }

  static std::size_t shadeOf(const Particle& particle) {
    return static_cast<std::size_t>(std::lround(particle.age * Shower::kShades));
  }

  /// The objects are read once for each shade, so that they take it as they take the material.
  [[gnu::noinline]] void setShade(const Shower& shower, const Particle& particle) {
    const Real share = static_cast<Real>(shadeOf(particle)) / Shower::kShades;
    materials_.current = shower.material;
    tint(materials_.current, lerp(share, shower.system.color, shower.system.endColor));
  }

  [[gnu::noinline]] void addSphere(const Item& call) { add(call, {}, Sphere{}, {}, materials_.current); }

  [[gnu::noinline]] void addParticle(const Item& call, const Affine& worldFromObject, const Shower& shower,
                                     const Particle& particle) {
    const Particles& system = shower.system;
    const Real size = system.size + particle.age * (system.endSize - system.size);
    const Affine place = Affine::translation(particle.place) * Affine::scaling({size, size, size});
    for (const Object& o : shower.shades[shadeOf(particle)])
      add(call, o.name, o.shape, worldFromObject * place * o.worldFromObject, o.material);
  }

  static void tint(Material& material, const Color& color) {
    auto& phong = *std::get_if<Phong>(&material.model);
    phong.emissive = phong.emissive * color, phong.ambient = phong.ambient * color;
    phong.diffuse = phong.diffuse * color;
  }

  /// Not a field of the block it stands in.
  bool isObject(const Item& item) {
    if (item.is(Kind::block) || findTransform(item)) return true;
    return item.is(Kind::call) && withKeyword<Shape>(canonical(item.key()), [](auto*) {});
  }
  static bool isListOfObjects(const Item& item) {
    return item.is(Kind::entry) && item.key() == "objects" && item.value().is(Kind::block);
  }

  /// The objects of a block, which may stand in objects = { } as well. They have the material of the whole if
  /// they do not say another.
  Operands operands(const Item& call, const Item& block, const Material& material, bool clips) {
    const NestedSolid nested(*this, call, true);
    if (!nested) return {};
    const auto outside = std::make_unique<Material>(std::exchange(materials_.current, material));
    std::vector<Operand> operands;
    const auto readAll = [&](const Item& items) {
      for (const Item item : items)
        if (isObject(item)) operand(item, clips && operands.empty(), operands);
    };
    readAll(block);
    for (const Item item : block)
      if (isListOfObjects(item)) readAll(item.value());
    materials_.current = *outside;
    if (operands.empty()) warnOfNothing(call);
    return Operands(std::move(operands));
  }

  [[gnu::noinline]] void warnOfNothing(const Item& call) {
    findings_.warn(call, std::string(call.key()) + " without objects is empty");
  }

  /// A group is one operand: the union of its objects.
  void operand(const Item& item, bool mayBeOpen, std::vector<Operand>& operands) {
    std::vector<Object> found = std::exchange(scene_.objects, {});
    object(item, {});
    found.swap(scene_.objects);
    addOperand(item, mayBeOpen, std::move(found), operands);
  }

  [[gnu::noinline]] void addOperand(const Item& item, bool mayBeOpen, std::vector<Object> found,
                                    std::vector<Operand>& operands) {
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
           const Material& material) {
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
    findings_.sureSignOf2001(call);
    const Material material = materials_.read(call.value(), materials_.current);
    if (material.name.empty()) findings_.warn(call, "a material without a name is never used");
  }

  // --- camera, lights, settings ---

  void camera(const Item& call) {
    if (const std::optional<Item> block = blockOf(call)) scene_.camera = readCamera(findings_, *block);
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
    for (const Item item : *block) {
      if (!isField(item, L::kKeyword)) continue;
      if (!assignField(findings_, light, item)) {
        findings_.unknownField(L::kKeyword, item, keywords<L>({"colour"}));
        continue;
      }
      checkRange(findings_, light, item);
      const std::string_view key = canonical(item.key());
      const bool again = std::find(given.begin(), given.end(), key) != given.end();
      if (again)
        findings_.warn(
            item, std::string(key) + " of " + std::string(L::kKeyword) + " given again; the last counts");
      else
        given.push_back(key);
    }
    forEachField<L>([&](const auto& field) {
      if (isRequired(field.keyword) && std::find(given.begin(), given.end(), field.keyword) == given.end())
        findings_.error(call, std::string(L::kKeyword) + ": expected a " + std::string(field.keyword));
    });
    if (findings_.errors() != errors || !checkDirection(call, light)) return;
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
    for (const Item item : *block)
      if (isField(item, kSettings)) choice(item);
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
  int solids_ = 0;  ///< how many solids or particles what is read is nested in
};

}  // namespace
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
  rayfile::Reader(syntax, scene, messages, time).read();
  return scene;
}

}  // namespace trace
