// The fields of a listed value by their keyword, for code that does not know its struct.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "base/listed.h"

namespace trace {

/// The value of the field of that keyword and type; null if there is none.
template <class Held, class Row, class AnyField>
const Held* findValue(const Listed<Row, AnyField>& listed, std::string_view keyword) {
  for (const AnyField& field : listed.fields())
    if (Held* const* held = std::get_if<Held*>(&field.value); held && field.keyword == keyword) return *held;
  return nullptr;
}
/// That value to be changed, as long as no copy is made; null if there is none.
template <class Held, class Row, class AnyField>
Held* editableValue(Listed<Row, AnyField>& listed, std::string_view keyword) {
  for (const AnyField& field : listed.editFields())
    if (Held* const* held = std::get_if<Held*>(&field.value); held && field.keyword == keyword) return *held;
  return nullptr;
}

/// The fields of `to` get the values of those fields of `from` that have their keyword and type.
template <class Row, class AnyField>
void takeFields(Listed<Row, AnyField>& to, const Listed<Row, AnyField>& from) {
  const std::vector<AnyField> given = from.fields();
  for (AnyField& field : to.editFields())
    for (const AnyField& other : given)
      if (other.keyword == field.keyword) takeValue(field, other);
}

}  // namespace trace
