// Values and nodes, and how a scene file writes them: the language of scenes is what programs build scenes
// with, so that a reader of scene files checks everything.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/shape.h"
#include "shading/material.h"
#include "traceray/traceray.h"

namespace traceray {
namespace {

[[noreturn]] void isNo(const char* expected, const Value& value) {
  std::string found = "a node";
  if (!value.isNode()) found = value.inLanguage();
  throw Error(Error::Kind::usage, std::string("expected ") + expected + ", found " + found);
}

std::string numberText(double number) {
  if (!std::isfinite(number))
    throw Error(Error::Kind::usage, "expected a number, found " + trace::toText(number));
  return trace::toText(number);
}

std::string quoted(const std::string& text) {
  if (text.find_first_of("\"\n\r") != text.npos)
    throw Error(Error::Kind::usage,
                "expected a text on one line without quotation marks, found one with: " + text);
  return '"' + text + '"';
}

/// The material of an object: its block says the model as a field. A text is the name of one of the library.
std::string materialText(const Value& value) {
  if (value.isText()) return "{ library = " + value.inLanguage() + "; }";
  if (!value.isNode()) return value.inLanguage();
  const Node& node = value.node();
  std::string text = "{ ";
  if (node.keyword != trace::Material::kKeyword && !node.keyword.empty())
    text += "model = " + quoted(node.keyword) + "; ";
  const std::string whole = Node("", node.fields).inLanguage();
  return text + whole.substr(whole.find('{') + 1);
}

template <class Each>
std::string listText(const Value::List& list, const char* open, const char* between, const char* close,
                     const Each& each) {
  std::string text = open;
  for (const Value& value : list) text += (&value == list.data() ? "" : between) + each(value);
  return text + close;
}

std::string plainText(const Value& value) { return value.inLanguage(); }

/// The text after `name = `.
std::string fieldText(const Field& field) {
  if (field.name == "material") return materialText(field.value);
  if (field.name == "materials" && field.value.isList())
    return listText(field.value.list(), "(", ", ", ")", materialText);
  if (field.name == "objects" && field.value.isList())
    return listText(field.value.list(), "{ ", " ", " }", plainText);
  return field.value.inLanguage();
}

// --- placement ---

constexpr std::string_view kScale = "scale", kRotate = "rotate", kTranslate = "translate",
                           kTransform = "transform";

/// Numbers with commas between, as many as one of the counts.
std::string argumentsOf(const Node& node, std::string_view name, std::initializer_list<std::size_t> counts) {
  const Value& value = *node.find(name);
  const std::vector<double> numbers = value.isNumber() ? std::vector{value.number()} : value.numbers();
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end())
    throw Error(Error::Kind::usage, std::string(name) + " of " + node.keyword + ": expected " +
                                        (name == kRotate  ? "(x, y, z, degrees)"
                                         : name == kScale ? "a number or (x, y, z)"
                                                          : "(x, y, z)") +
                                        ", found " + value.inLanguage());
  std::string text;
  for (const double number : numbers) text += numberText(number) + ", ";
  return text;
}

/// Four rows of four numbers, or sixteen numbers.
std::string rowsOf(const Node& node) {
  std::vector<double> numbers;
  const Value& value = *node.find(kTransform);
  for (const Value& row : value.list()) {
    const std::vector<double> some = row.isNumber() ? std::vector{row.number()} : row.numbers();
    numbers.insert(numbers.end(), some.begin(), some.end());
  }
  if (numbers.size() != 16)
    throw Error(Error::Kind::usage, "transform of " + node.keyword +
                                        ": expected four rows of four numbers, found " + value.inLanguage());
  std::string text;
  for (std::size_t row = 0; row < 4; ++row) {
    text += "(";
    for (std::size_t column = 0; column < 4; ++column)
      text += (column > 0 ? ", " : "") + numberText(numbers[4 * row + column]);
    text += "), ";
  }
  return text;
}

/// Whether the field of the shape places it: a shape may have one of that name of its own.
bool places(const std::string& keyword, std::string_view name) {
  if (name != kScale && name != kRotate && name != kTranslate && name != kTransform) return false;
  const trace::ShapeType* type = trace::findShapeType(keyword);
  if (!type) return keyword == "mesh" || keyword == "trimesh";
  bool own = false;
  trace::forEachField(trace::Shape(*type),
                      [&](const trace::AnyField& field, const auto&) { own = own || field.keyword == name; });
  return !own;
}

}  // namespace

Value::Value(bool value) : value_(value) {}
Value::Value(double value, int) : value_(value) {}
Value::Value(const char* value) : value_(std::string(value)) {}
Value::Value(std::string value) : value_(std::move(value)) {}
Value::Value(std::string_view value) : value_(std::string(value)) {}
Value::Value(List value) : value_(std::move(value)) {}
Value::Value(std::initializer_list<Value> value) : value_(List(value)) {}
Value::Value(Node value) : value_(std::make_shared<const Node>(std::move(value))) {}
Value::Value(const Value&) = default;
Value::Value(Value&&) noexcept = default;
Value& Value::operator=(const Value&) = default;
Value& Value::operator=(Value&&) noexcept = default;
Value::~Value() = default;

bool Value::isBoolean() const { return std::holds_alternative<bool>(value_); }
bool Value::isNumber() const { return std::holds_alternative<double>(value_); }
bool Value::isText() const { return std::holds_alternative<std::string>(value_); }
bool Value::isList() const { return std::holds_alternative<List>(value_); }
bool Value::isNode() const { return value_.index() == 4; }

bool Value::boolean() const {
  if (!isBoolean()) isNo("true or false", *this);
  return std::get<bool>(value_);
}
double Value::number() const {
  if (!isNumber()) isNo("a number", *this);
  return std::get<double>(value_);
}
const std::string& Value::text() const {
  if (!isText()) isNo("a text", *this);
  return std::get<std::string>(value_);
}
const Value::List& Value::list() const {
  if (!isList()) isNo("a list", *this);
  return std::get<List>(value_);
}
const Node& Value::node() const {
  if (!isNode()) isNo("a node", *this);
  return *std::get<4>(value_);
}
std::vector<double> Value::numbers() const {
  std::vector<double> numbers;
  for (const Value& value : list()) numbers.push_back(value.number());
  return numbers;
}

std::string Value::inLanguage() const {
  switch (value_.index()) {
    case 0: return std::get<bool>(value_) ? "true" : "false";
    case 1: return numberText(std::get<double>(value_));
    case 2: return quoted(std::get<std::string>(value_));
    case 3: return listText(std::get<List>(value_), "(", ", ", ")", plainText);
    default: return node().inLanguage();
  }
}

bool Value::operator==(const Value& other) const {
  if (isNode() && other.isNode()) return node() == other.node();
  return value_ == other.value_;
}

Node::Node(std::string word, Fields given) : keyword(std::move(word)), fields(std::move(given)) {}

const Value* Node::find(std::string_view name) const {
  const auto found =
      std::find_if(fields.rbegin(), fields.rend(), [&](const Field& field) { return field.name == name; });
  return found == fields.rend() ? nullptr : &found->value;
}

Node Node::with(std::string name, Value value) const {
  Node node = *this;
  std::erase_if(node.fields, [&](const Field& field) { return field.name == name; });
  node.fields.push_back({std::move(name), std::move(value)});
  return node;
}

std::string Node::inLanguage() const {
  const bool isCall = !fields.empty() && std::all_of(fields.begin(), fields.end(),
                                                     [](const Field& field) { return field.name.empty(); });
  if (isCall) {
    Value::List values;
    for (const Field& field : fields) values.push_back(field.value);
    return keyword + listText(values, "(", ", ", ")", plainText);
  }
  std::string text, behind;
  const auto put = [&](std::string_view name, const auto& argumentsOfIt) {
    if (!find(name) || !places(keyword, name)) return;
    text += std::string(name) + "(" + argumentsOfIt();
    behind += ")";
  };
  put(kTransform, [&] { return rowsOf(*this); });
  put(kTranslate, [&] { return argumentsOf(*this, kTranslate, {3}); });
  put(kRotate, [&] { return argumentsOf(*this, kRotate, {4}); });
  put(kScale, [&] { return argumentsOf(*this, kScale, {1, 3}); });
  text += keyword + " { ";
  for (const Field& field : fields) {
    if (places(keyword, field.name)) continue;
    if (find(field.name) != &field.value) continue;  // a later one counts
    text += field.name + " = " + fieldText(field) + "; ";
  }
  return text + "}" + behind;
}

}  // namespace traceray
