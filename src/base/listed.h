// A value of one of the types of a list, whatever its type: a row of the list's table, and constant data that
// copies share. Code that loops over types or fields asks the row, so that only the table sees all the
// structs.
#pragma once

#include <atomic>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "base/field_value.h"

namespace trace {

/// The members of a row that every list has; a list's own row is derived from it.
template <class AnyField>
struct ListedRow {
  std::string_view keyword;         ///< as in scene files
  std::string_view help;            ///< one sentence, no full stop
  std::size_t index;                ///< in the table
  std::shared_ptr<void> (*make)();  ///< with the defaults, which all share until they are edited
  std::shared_ptr<void> (*copy)(const void* value);
  bool (*equal)(const void* a, const void* b);
  std::vector<AnyField> (*fields)(void* value);

  /// That of a struct, which has kKeyword, kHelp, fields() and ==.
  template <class Struct>
  static ListedRow of(std::size_t index) {
    return {Struct::kKeyword,
            Struct::kHelp,
            index,
            []() -> std::shared_ptr<void> {
              static const std::shared_ptr<void> usual = std::make_shared<Struct>();
              return usual;
            },
            [](const void* at) -> std::shared_ptr<void> {
              return std::make_shared<Struct>(*static_cast<const Struct*>(at));
            },
            [](const void* a, const void* b) {
              return *static_cast<const Struct*>(a) == *static_cast<const Struct*>(b);
            },
            fieldsIn<AnyField, Struct>};
  }
};

/// The row of a struct of the list; each list specialises it.
template <class Row>
const Row& rowCalled(std::string_view keyword);

namespace detail {
template <class Row, class Struct>
const Row& rowOf() {
  static const Row& row = rowCalled<Row>(Struct::kKeyword);
  return row;
}
}  // namespace detail

/// A struct that a list may hold.
template <class Struct>
concept ListedStruct = requires {
  Struct::kKeyword;
  Struct::fields();
};

template <class Row, class AnyField>
class Listed {
 public:
  /// With the defaults of its type.
  explicit Listed(const Row& row) : row_(&row), data_(row.make()) {}
  template <ListedStruct Struct>
  Listed(Struct value)  // NOLINT(google-explicit-constructor): a sphere is a shape
      : row_(&detail::rowOf<Row, Struct>()), data_(std::make_shared<Struct>(std::move(value))) {}

  const Row& type() const { return *row_; }
  std::string_view keyword() const { return row_->keyword; }

  template <class Struct>
  bool is() const {
    return row_ == &detail::rowOf<Row, Struct>();
  }
  /// Null if it is of another type.
  template <class Struct>
  const Struct* as() const {
    return is<Struct>() ? static_cast<const Struct*>(data_.get()) : nullptr;
  }
  /// To be changed; what other copies share stays as it is.
  template <class Struct>
  Struct* edit() {
    return is<Struct>() ? static_cast<Struct*>(own()) : nullptr;
  }

  /// Its fields, to be read only: their pointers are not const for editFields()' sake.
  std::vector<AnyField> fields() const { return row_->fields(data_.get()); }
  /// Its fields, to be changed; what other copies share stays as it is.
  std::vector<AnyField> editFields() { return row_->fields(own()); }

  /// Two that share their data are equal at once.
  bool operator==(const Listed& other) const {
    return row_ == other.row_ && (data_ == other.data_ || row_->equal(data_.get(), other.data_.get()));
  }

 protected:
  const void* data() const { return data_.get(); }

 private:
  /// The data, copied first where others share it.
  void* own() {
    if (data_.use_count() > 1) data_ = row_->copy(data_.get());
    std::atomic_thread_fence(std::memory_order_acquire);  // what others read of it before they let go is past
    return data_.get();
  }

  const Row* row_;
  std::shared_ptr<void> data_;
};

/// Calls visit(field, value) for each field, with the value as it is: a bool, a Real, an EnumValue, ...
template <class Row, class AnyField, class Visit>
void forEachField(const Listed<Row, AnyField>& listed, Visit&& visit) {
  for (const AnyField& field : listed.fields())
    visitValueOf(field, [&](const auto& value) { visit(field, value); });
}
/// The same, where visit() may change the values.
template <class Row, class AnyField, class Visit>
void editEachField(Listed<Row, AnyField>& listed, Visit&& visit) {
  for (AnyField& field : listed.editFields())
    editValueOf(field, [&](auto& value) { visit(std::as_const(field), value); });
}

/// Fields of `from` that are not as its type has them by default go to the fields of `to` that have their
/// keyword and type.
template <class Row, class AnyField>
void takeChangedFields(Listed<Row, AnyField>& to, const Listed<Row, AnyField>& from) {
  const Listed<Row, AnyField> usual(from.type());
  const std::vector<AnyField> said = from.fields(), unsaid = usual.fields();
  for (AnyField& field : to.editFields())
    for (std::size_t i = 0; i < said.size(); ++i)
      if (said[i].keyword == field.keyword && !sameValue(said[i], unsaid[i])) takeValue(field, said[i]);
}

/// Calls visit(const Struct&) if the value is of one of the types named; false if it is of none.
template <class... Struct, class Row, class AnyField, class Visit>
bool visitAs(const Listed<Row, AnyField>& listed, Visit&& visit) {
  const auto tried = [&]<class T>(const T* held) {
    if (held) visit(*held);
    return held != nullptr;
  };
  return (tried(listed.template as<Struct>()) || ...);
}

}  // namespace trace
