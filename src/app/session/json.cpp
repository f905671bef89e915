#include "app/session/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/match.h"

namespace trace {

struct JsonWriter {
  static nlohmann::ordered_json converted(const Json& json) {
    using nlohmann::ordered_json;
    return match(json.value_, Overloaded{[](const Json::List& list) {
                                           ordered_json values = ordered_json::array();
                                           for (const Json& value : list) values.push_back(converted(value));
                                           return values;
                                         },
                                         [](const Json::Object& object) {
                                           ordered_json members = ordered_json::object();
                                           for (const Json::Member& m : object)
                                             members[m.key] = converted(m.value);
                                           return members;
                                         },
                                         [](const auto& value) { return ordered_json(value); }});
  }
};

Json::Json(std::initializer_list<Member> members) : value_(Object(members)) {}

Json Json::list(std::initializer_list<Json> values) {
  Json json;
  json.value_ = List(values);
  return json;
}

Json& Json::operator[](std::string_view key) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object{};
  Object& members = std::get<Object>(value_);
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
  if (found != members.end()) return found->value;
  return members.emplace_back(Member{std::string(key), {}}).value;
}

void Json::add(Json value) { std::get<List>(value_).push_back(std::move(value)); }

std::string Json::text(int indent) const {
  return JsonWriter::converted(*this).dump(indent, ' ', false,
                                           nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace trace
