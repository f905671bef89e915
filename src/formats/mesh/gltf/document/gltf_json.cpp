// Source: RFC 8259, The JavaScript Object Notation (JSON) Data Interchange Format.
#include "formats/mesh/gltf/document/gltf_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "base/nesting.h"
#include "base/text.h"

namespace trace {
namespace {

using nlohmann::json;

/// Takes a text that is not sound JSON, and keeps what is wrong and where.
class WhatIsWrong : public nlohmann::json_sax<json> {
 public:
  explicit WhatIsWrong(std::string_view text) : text_(text) {}

  std::size_t offset = 0;
  std::string what, hint;

  bool parse_error(std::size_t read, const std::string& last, const json::exception& error) override {
    const std::string_view all = error.what();
    const std::string_view message = all.substr(0, all.find("; last read: "));  // where it repeats the file
    const auto says = [&](std::string_view words) { return message.find(words) != message.npos; };
    const bool atEnd = says("unexpected end of input");
    const bool isWhole = says("unexpected string") || says("number") || says("overflow");
    const std::string_view found = atEnd                    ? text_.substr(text_.size())
                                   : says("invalid string") ? stringBefore(read)
                                                            : foundAt(read, isWhole ? last.size() : 0);
    offset = static_cast<std::size_t>(found.data() - text_.data());
    what =
        "expected " + expected(message, all) + ", found " + (atEnd ? "the end of the file" : quoted(found));
    if (found == "]" || found == "}") hint = "JSON allows no comma after the last element";
    if (found.starts_with('/')) hint = "JSON has no comments";
    if (found.starts_with('\'')) hint = "JSON has texts in double quotation marks";
    return false;
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(std::string&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }

 private:
  static std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    const std::string shown(text.substr(0, kLongest));
    return shown.starts_with('"') ? shown : "\"" + shown + "\"";
  }

  /// In our words, of what the library says.
  static std::string expected(std::string_view message, std::string_view all) {
    const auto says = [&](std::string_view words) { return message.find(words) != message.npos; };
    if (says("overflow")) return "a number of at most 1.8e308";
    if (says("closing quote") || says("control character")) return "a quotation mark at the end of the text";
    if (says("invalid string")) return "a text without odd characters";
    const std::size_t at = all.rfind("; expected ");
    const std::string_view rest = at == all.npos ? "a value" : all.substr(at + 11);
    if (rest == "string literal") return "a name in quotation marks";
    if (rest == "end of input") return "nothing after the last bracket";
    if (rest.starts_with("'[', '{'")) return "a value";
    return std::string(rest.substr(0, 40));
  }

  /// From its quotation mark on; the last character read is what it cannot have.
  std::string_view stringBefore(std::size_t read) const {
    const std::size_t end = std::min(read, text_.size());
    std::size_t start = text_.substr(0, end - std::min<std::size_t>(end, 1)).rfind('"');
    while (start != 0 && start != text_.npos && text_[start - 1] == '\\') start = text_.rfind('"', start - 1);
    start = std::min(start, end);
    return text_.substr(start, std::min(text_.find('\n', start), end) - start);
  }

  /// The text that ends after `read` characters and has `length`; if that is 0, the word or mark there.
  std::string_view foundAt(std::size_t read, std::size_t length) const {
    const auto isLetter = [](char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; };
    std::size_t end = std::min(read, text_.size());
    std::size_t start = end - std::min(end, std::max<std::size_t>(length, 1));
    if (length == 0 && start < end && isLetter(text_[start])) {
      while (start > 0 && isLetter(text_[start - 1])) --start;
      while (end < text_.size() && isLetter(text_[end])) ++end;
    }
    return text_.substr(start, end - start);
  }

  std::string_view text_;
};

/// The parser of brackets is recursive. The offset of the bracket that is one too deep; npos if none is.
std::size_t tooDeep(std::string_view text) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMostNesting) return i;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return text.npos;
}

}  // namespace

nlohmann::json parseGltfJson(const SourcePlace& place, std::string_view bytes, std::string_view text) {
  const auto fail = [&](std::size_t offset, std::string what, std::string hint = {}) {
    const bool isText = text.data() == bytes.data();  // lines of a binary file tell a person nothing
    throw Error(Fault::scene, isText ? placeAt(place.file.str(), text, offset) : place, std::move(what),
                std::move(hint));
  };
  if (const std::size_t deep = tooDeep(text); deep != text.npos)
    fail(deep, "expected at most " + std::to_string(kMostNesting) + " levels of brackets, found more");
  json result = json::parse(text.begin(), text.end(), nullptr, false);
  if (result.is_discarded()) {
    WhatIsWrong wrong(text);
    json::sax_parse(text.begin(), text.end(), &wrong);
    fail(wrong.offset, wrong.what, wrong.hint);
  }
  if (!result.is_object()) fail(0, "expected a JSON object, as in { \"asset\": ... }");
  return result;
}

}  // namespace trace
