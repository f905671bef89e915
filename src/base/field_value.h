// The fields of a struct whose type is known only at run time: what a row of a table of types hands to
// readers, writers, panels and tests. base/field.h is how the struct lists them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/field.h"
#include "base/match.h"

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
  bool operator==(const EnumValue& other) const {
    return names_.data() == other.names_.data() && index() == other.index();
  }

 private:
  std::span<const std::string_view> names_;
  void* value_;
  std::size_t (*get_)(const void*);
  void (*set_)(void*, std::size_t);
};

/// A field and where its value lies: an EnumValue, or a pointer to one of the types `Value`.
template <class... Value>
struct FieldValue {
  std::string_view keyword, unit;
  double least, most;
  std::string_view help;
  std::variant<Value*..., EnumValue> value;
};

/// Those of the struct at `at`, in the order of its list.
template <class AnyField, class Struct>
std::vector<AnyField> fieldsIn(void* at) {
  constexpr std::size_t kCount = [] {
    std::size_t count = 0;
    forEachField<Struct>([&](const auto&) { ++count; });
    return count;
  }();
  std::vector<AnyField> all;
  all.reserve(kCount);
  Struct& target = *static_cast<Struct*>(at);
  forEachField<Struct>([&](const auto& f) {
    auto& value = target.*f.member;
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(value)>>)
      all.push_back({f.keyword, f.unit, f.least, f.most, f.help, EnumValue(value)});
    else
      all.push_back({f.keyword, f.unit, f.least, f.most, f.help, &value});
  });
  return all;
}

/// Calls visit(value) with the value as it is: a bool&, a Real&, an EnumValue&, ...
template <class... Value, class Visit>
void editValueOf(FieldValue<Value...>& field, Visit&& visit) {
  match(field.value, [&](auto& value) {
    if constexpr (requires { *value; })
      visit(*value);
    else
      visit(value);
  });
}
template <class... Value, class Visit>
void visitValueOf(const FieldValue<Value...>& field, Visit&& visit) {
  match(field.value, [&](const auto& value) {
    if constexpr (requires { *value; })
      visit(std::as_const(*value));
    else
      visit(value);
  });
}

/// The value, of a type that it must have.
template <class Held, class... Value>
const Held& valueOf(const FieldValue<Value...>& field) {
  if constexpr (std::is_same_v<Held, EnumValue>)
    return std::get<EnumValue>(field.value);
  else
    return *std::get<Held*>(field.value);
}
/// The values are equal; false if they are not of one type.
template <class... Value>
bool sameValue(const FieldValue<Value...>& a, const FieldValue<Value...>& b) {
  return a.value.index() == b.value.index() && match(a.value, [&]<class Held>(const Held& value) {
           const Held& other = *std::get_if<Held>(&b.value);
           if constexpr (requires { *value; })
             return *value == *other;
           else
             return value == other;
         });
}
/// Gives `to` the value of `from`, if they are of one type.
template <class... Value>
void takeValue(FieldValue<Value...>& to, const FieldValue<Value...>& from) {
  if (to.value.index() != from.value.index()) return;
  match(to.value, [&]<class Held>(Held& value) {
    const Held& other = *std::get_if<Held>(&from.value);
    if constexpr (requires { *value; })
      *value = *other;
    else if (value.names().data() == other.names().data())
      value.set(other.index());
  });
}

}  // namespace trace
