// The fields of a struct whose type is known only at run time: what a row of the table of shapes hands to
// readers, writers, panels and tests. base/field.h is how the struct lists them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/field.h"
#include "base/match.h"
#include "geometry/materials.h"
#include "geometry/shape.h"
#include "geometry/shapes/csg.h"
#include "geometry/shapes/heights.h"
#include "math/vec.h"

namespace trace {

namespace detail {
template <class Enum>
std::span<const std::string_view> namesOf() {
  static constexpr auto kNames = names(Enum{});
  return kNames;
}
}  // namespace detail

/// A value of some enum of the values 0, 1, 2, ...: refers to it.
class EnumValue {
 public:
  template <class Enum>
  explicit EnumValue(Enum& value)
      : names_(detail::namesOf<Enum>()),
        value_(&value),
        get_([](const void* at) { return static_cast<std::size_t>(*static_cast<const Enum*>(at)); }),
        set_([](void* at, std::size_t index) { *static_cast<Enum*>(at) = static_cast<Enum>(index); }) {}

  std::span<const std::string_view> names() const { return names_; }
  std::size_t index() const { return get_(value_); }
  std::string_view name() const { return names_[index()]; }
  /// Precondition: the index is one of a name.
  void set(std::size_t index) { set_(value_, index); }

 private:
  std::span<const std::string_view> names_;
  void* value_;
  std::size_t (*get_)(const void*);
  void (*set_)(void*, std::size_t);
};

template <std::size_t N>
using Tuples = std::vector<std::array<Real, N>>;

/// A field and where its value lies.
struct AnyField {
  std::string_view keyword, unit;
  double least, most;
  std::string_view help;
  std::variant<bool*, int*, Real*, Vec3*, std::string*, std::vector<std::string>*, EnumValue,
               std::array<Real, 4>*, Tuples<2>*, Tuples<4>*, Tuples<5>*, Tuples<8>*, Tuples<12>*,
               std::vector<Tuples<2>>*, std::vector<Tuples<3>>*, Heights*, Operands*, MaterialList*>
      value;
};

/// The fields of a shape, to be read only.
std::vector<AnyField> fieldsOf(const Shape& shape);

/// The materials that the shape leads between, or that the points of a mesh have; none for most.
const std::vector<std::uint32_t>& materialsOf(const Shape& shape);

/// Calls visit(field, value) for each field, with the value as it is: a bool, a Real, an EnumValue, ...
template <class Visit>
void forEachField(const Shape& shape, Visit&& visit) {
  for (const AnyField& field : fieldsOf(shape))
    match(field.value, [&](const auto& value) {
      if constexpr (requires { *value; })
        visit(field, std::as_const(*value));
      else
        visit(field, value);
    });
}
/// The same, where visit() may change the values.
template <class Visit>
void editEachField(Shape& shape, Visit&& visit) {
  for (AnyField& field : shape.editFields())
    match(field.value, [&](auto& value) {
      if constexpr (requires { *value; })
        visit(field, *value);
      else
        visit(field, value);
    });
}

}  // namespace trace
