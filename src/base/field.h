// A struct of a scene lists its fields once, with everything a person or a program needs to know of
// each. Readers, writers, inspector panels, reference pages and generic tests are loops over that list.
//
//   struct Cone {
//     static constexpr std::string_view kKeyword = "cone";
//     double height = 1;
//     static constexpr auto fields() {
//       return std::tuple{Field{"height", &Cone::height, "units", 0, kNoLimit, "length along the z axis"}};
//     }
//   };
#pragma once

#include <limits>
#include <string_view>
#include <tuple>

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

/// Calls visit(field) for each field of Struct.
template <class Struct, class Visit>
constexpr void forEachField(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Struct::fields());
}

}  // namespace trace
