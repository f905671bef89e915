// A value to be written as JSON. Only json.cpp sees the library, which is slow to compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace trace {

/// A member of an object. A template, for its Json is complete only after the class.
template <class Value>
struct JsonMember {
  std::string key;
  Value value;
};

/// Null, a truth value, a number, a text, a list, or an object, whose members keep their order.
class Json {
 public:
  using Member = JsonMember<Json>;

  Json(std::nullptr_t = nullptr) {}
  Json(bool value) : value_(value) {}
  Json(double value) : value_(value) {}
  Json(std::signed_integral auto value) : value_(std::int64_t{value}) {}
  Json(std::unsigned_integral auto value) : value_(std::uint64_t{value}) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::initializer_list<Member> members);  // an object

  static Json object() { return Json(std::initializer_list<Member>{}); }
  static Json list(std::initializer_list<Json> values = {});

  /// The member of an object, made if it is missing. Null becomes an object.
  Json& operator[](std::string_view key);

  /// At the end of a list.
  void add(Json value);

  /// On one line, or with so many spaces for each level. What is no UTF-8 is replaced; a number that is not
  /// finite is null.
  std::string text(int indent = -1) const;

 private:
  friend struct JsonWriter;
  using List = std::vector<Json>;
  using Object = std::vector<Member>;

  std::variant<std::nullptr_t, bool, double, std::int64_t, std::uint64_t, std::string, List, Object> value_;
};

}  // namespace trace
