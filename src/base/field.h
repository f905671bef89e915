// A struct of a scene lists its fields once, with everything a person or a program needs to know of
// each. Readers, writers, inspector panels, reference pages and generic tests are loops over that list.
//
//   struct Cone {
//     static constexpr std::string_view kKeyword = "cone";
//     double height = 1;
//     static constexpr auto fields() {
//       return Fields{Field{"height", &Cone::height, "units", 0, kNoLimit, "length along the z axis"}};
//     }
//   };
#pragma once

#include <limits>
#include <string_view>

namespace trace {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

template <class Struct, class Value>
struct Field {
  std::string_view keyword;  ///< as in scene files
  Value Struct::*member;
  std::string_view unit;  ///< "" for pure numbers
  double least, most;     ///< the range of each component; outside it a reader warns
  std::string_view help;  ///< one sentence, no full stop
};
template <class Struct, class Value>
Field(const char*, Value Struct::*, const char*, double, double, const char*) -> Field<Struct, Value>;

/// A list of fields, in order: of `Field`s, and of the lists of base classes. It does what a std::tuple
/// would, which takes ten times as long to compile.
template <std::size_t, class Entry>
struct FieldEntry {
  Entry entry;
};
template <class Index, class... Entry>
struct FieldEntries;
template <std::size_t... I, class... Entry>
struct FieldEntries<std::index_sequence<I...>, Entry...> : FieldEntry<I, Entry>... {
  constexpr FieldEntries(const Entry&... entry) : FieldEntry<I, Entry>{entry}... {}
};

template <class... Entry>
struct Fields : FieldEntries<std::index_sequence_for<Entry...>, Entry...> {
  using FieldEntries<std::index_sequence_for<Entry...>, Entry...>::FieldEntries;
};
template <class... Entry>
Fields(Entry...) -> Fields<Entry...>;

template <class Struct, class Value, class Visit>
constexpr void visitFields(const Field<Struct, Value>& field, Visit& visit) {
  visit(field);
}
template <std::size_t... I, class... Entry, class Visit>
constexpr void visitFields(const FieldEntries<std::index_sequence<I...>, Entry...>& fields, Visit& visit) {
  (visitFields(static_cast<const FieldEntry<I, Entry>&>(fields).entry, visit), ...);
}

/// Calls visit(field) for each field of Struct.
template <class Struct, class Visit>
constexpr void forEachField(Visit&& visit) {
  visitFields(Struct::fields(), visit);
}

/// Calls visit(field, value) for each field of the struct; those of base/listed.h have the same.
template <class Struct, class Visit>
requires requires { Struct::fields(); }
constexpr void forEachField(const Struct& target, Visit&& visit) {
  forEachField<Struct>([&](const auto& f) { visit(f, target.*f.member); });
}
/// The same, where visit() may change the values.
template <class Struct, class Visit>
requires requires { Struct::fields(); }
constexpr void editEachField(Struct& target, Visit&& visit) {
  forEachField<Struct>([&](const auto& f) { visit(f, target.*f.member); });
}

}  // namespace trace
