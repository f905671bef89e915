// The table of shapes, made of their list, and what is asked of a shape or its form whatever its type.
#include <stdexcept>
#include <string>
#include <type_traits>

#include "base/match.h"
#include "geometry/field_value.h"
#include "geometry/shape_list.h"

namespace trace {
namespace {

/// The parts of a form are numbered below this.
template <class Form>
std::int64_t partCountOf(const Form& form) {
  constexpr std::int64_t kEnough = std::int64_t{1} << 24;
  if constexpr (requires { form.partCount(); })
    return form.partCount();
  else
    return kEnough;
}

template <class S>
constexpr bool kTraceable = Traceable<std::remove_cvref_t<decltype(formOf(formFor(std::declval<S>())))>>;
template <>
constexpr bool kTraceable<Mesh> = true;

/// A shape without checked() has the facts of its form.
template <class S>
ShapeFacts factsOf(const S& shape) {
  if constexpr (requires { shape.checked(); }) {
    return shape.checked();
  } else if constexpr (std::is_same_v<S, Mesh>) {
    return {true, trace::bounds(*shape.data), static_cast<std::int64_t>(shape.data->triangles.size())};
  } else {
    const auto form = formFor(shape);
    return {formOf(form).solid(), formOf(form).bounds(), partCountOf(formOf(form))};
  }
}

template <class S>
constexpr bool alongZOf() {
  if constexpr (requires { S::kAlongZ; })
    return S::kAlongZ;
  else
    return false;
}

template <class S, std::size_t kIndex>
TracedShape prepared(const void* at, const MeshTrees& made) {
  TracedShape::Held held{AnyForm(std::in_place_index<kIndex>, formFor(*static_cast<const S*>(at), made)), {}};
  if constexpr (!std::is_same_v<S, Mesh>)
    held.approach = Approach(formOf(*std::get_if<kIndex>(&held.form)).bounds());
  return TracedShape(shapeTypes()[kIndex], std::make_shared<const TracedShape::Held>(std::move(held)));
}

template <class S, std::size_t kIndex>
ShapeType rowFor() {
  static_assert(kTraceable<S>, "the shape lacks one of the functions that shape_list.h asks for");
  constexpr bool kOfObjects = requires(S s) { s.objects.list(); };
  return {ShapeType::of<S>(kIndex), kOfObjects, alongZOf<S>(), prepared<S, kIndex>,
          [](const void* at) { return factsOf(*static_cast<const S*>(at)); }};
}

constexpr std::size_t kTypes = std::variant_size_v<ShapeList>;
static_assert(kTypes <= kMostShapeTypes);

std::array<ShapeType, kTypes> makeTable() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{rowFor<std::variant_alternative_t<I, ShapeList>, I>()...};
  }
  (std::make_index_sequence<kTypes>{});
}

/// Calls visit(form) with the form, unless it is a mesh: then other().
template <class Visit, class Other>
auto withForm(const TracedShape& shape, Visit&& visit, Other&& other) {
  return match(shape.held().form, Overloaded{[&](const Mesh& mesh) { return other(mesh); },
                                             [&](const auto& form) { return visit(formOf(form)); }});
}

}  // namespace

// --- the table ----------------------------------------------------------------------------------------

std::span<const ShapeType> shapeTypes() {
  static const std::array<ShapeType, kTypes> kTable = makeTable();
  return kTable;
}

const ShapeType* findShapeType(std::string_view keyword) {
  for (const ShapeType& type : shapeTypes())
    if (type.keyword == keyword) return &type;
  return nullptr;
}

template <>
const ShapeType& rowCalled<ShapeType>(std::string_view keyword) {
  if (const ShapeType* type = findShapeType(keyword)) return *type;
  throw std::logic_error("no shape of the list is called " + std::string(keyword));
}

// --- shapes -------------------------------------------------------------------------------------------

const std::vector<std::uint32_t>& materialsOf(const Shape& shape) {
  static const std::vector<std::uint32_t> kNone;
  if (const auto* mesh = shape.as<Mesh>()) return mesh->data->materials;
  for (const AnyField& field : shape.fields())
    if (const auto* materials = std::get_if<MaterialList*>(&field.value)) return (*materials)->indices;
  return kNone;
}

const Operands& Shape::operands() const {
  static const Operands kNone;
  if (type().ofObjects)
    for (const AnyField& field : fields())
      if (const auto* objects = std::get_if<Operands*>(&field.value)) return **objects;
  return kNone;
}

void Shape::setOperands(Operands operands) {
  for (const AnyField& field : editFields())
    if (const auto* objects = std::get_if<Operands*>(&field.value)) **objects = std::move(operands);
}

// --- forms --------------------------------------------------------------------------------------------

ShapeFacts check(const Shape& shape) { return shape.type().check(shape.data()); }

TracedShape prepare(const Shape& shape, const MeshTrees& made) {
  return shape.type().prepare(shape.data(), made);
}

std::shared_ptr<const MeshData> TracedShape::mesh() const {
  const Mesh* mesh = std::get_if<Mesh>(&held_->form);
  return mesh ? mesh->data : nullptr;
}

bool TracedShape::solid() const {
  return withForm(
      *this, [](const auto& form) { return form.solid(); }, [](const Mesh&) { return false; });
}

Box3 TracedShape::bounds() const {
  return withForm(
      *this, [](const auto& form) -> Box3 { return form.bounds(); },
      [](const Mesh& mesh) { return trace::bounds(*mesh.data); });
}

bool TracedShape::convex() const {
  return withForm(
      *this,
      [](const auto& form) {
        if constexpr (requires { form.convex(); })
          return form.convex();
        else
          return false;
      },
      [](const Mesh&) { return false; });
}

bool TracedShape::strands() const {
  return withForm(
      *this,
      [](const auto& form) {
        if constexpr (requires { form.strands(); })
          return form.strands();
        else
          return false;
      },
      [](const Mesh&) { return false; });
}

bool TracedShape::ofSeveralMaterials() const {
  return withForm(
      *this,
      [](const auto& form) {
        return requires { form.material(std::int64_t{}, std::uint32_t{}); };
      },
      [](const Mesh&) { return false; });
}

MaterialMix TracedShape::material(std::int64_t part, std::uint32_t own) const {
  return withForm(
      *this,
      [&](const auto& form) {
        if constexpr (requires { form.material(part, own); })
          return form.material(part, own);
        else
          return MaterialMix::only(own);
      },
      [&](const Mesh&) { return MaterialMix::only(own); });
}

MaterialMix TracedShape::inside(std::int64_t part, std::uint32_t own) const {
  return withForm(
      *this,
      [&](const auto& form) {
        if constexpr (requires { form.inside(part, own); })
          return form.inside(part, own);
        else
          return material(part, own);
      },
      [&](const Mesh&) { return MaterialMix::only(own); });
}

void TracedShape::addMaterials(std::vector<std::uint32_t>& all) const {
  withForm(
      *this,
      [&](const auto& form) {
        if constexpr (requires { form.addMaterials(all); }) form.addMaterials(all);
      },
      [](const Mesh&) {});
}

std::int64_t TracedShape::partCount() const {
  return withForm(
      *this, [](const auto& form) { return partCountOf(form); },
      [](const Mesh& mesh) { return static_cast<std::int64_t>(mesh.data->triangles.size()); });
}

void TracedShape::addMeshTrees(MeshTrees& trees) const {
  withForm(
      *this,
      [&](const auto& form) {
        if constexpr (requires { form.addMeshTrees(trees); }) form.addMeshTrees(trees);
      },
      [](const Mesh&) {});
}

}  // namespace trace
