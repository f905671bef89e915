// Values of the language of scenes (ray_language.h), and its functions of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

struct Scope;

/// A part of the file that becomes objects, a material or a texture where it is used.
struct Tree {
  std::uint32_t node = 0;
  std::shared_ptr<const Scope> scope{};  ///< whose names it sees
};

struct Value;
using List = std::vector<Value>;

/// A number, a switch, text, a list (so are points and colours), or a part of the file.
struct Value : std::variant<double, bool, std::string, List, Tree> {
  using variant::variant;
  const double* number() const { return std::get_if<double>(this); }
  const bool* truth() const { return std::get_if<bool>(this); }
  const std::string* text() const { return std::get_if<std::string>(this); }
  const List* list() const { return std::get_if<List>(this); }
  const Tree* tree() const { return std::get_if<Tree>(this); }
};

/// A value in words, for messages: "3", "(1, 2, 3)", "text", "an object".
std::string shown(const Value& value);

/// An error in the values of an operation, without a place.
class ValueError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Operators work on numbers, and on lists element by element; + joins texts. Throws ValueError.
Value operate(Op op, const Value& a, const Value& b);
Value operate(Op op, const Value& a);
/// The component behind a dot. Throws ValueError.
Value component(const Value& of, char name);
/// The elements of a list, or the letters of a text, which are kept in `letters`; null of another value.
const List* elementsOf(const Value& value, List& letters);
/// The element or letter of that number, from 0. Throws ValueError.
Value element(const Value& of, const Value& index);
/// Throws ValueError, which says what it is `for`, if the value is something else.
double needNumber(const Value& value, std::string_view what);
bool needTruth(const Value& value, std::string_view what);

/// Which of a function's numbers are angles, in radians.
enum class Angles { none, taken, given };

/// A function of the language. `random` gives numbers from 0 up to 1, one after another.
struct Function {
  std::string_view name, parameters;
  std::size_t least, most;  ///< arguments
  std::string_view help;
  Value (*call)(std::span<const Value> arguments, std::uint64_t& random);
  Angles angles = Angles::none;
};
std::span<const Function> functions();
const Function* findFunction(std::string_view name);

}  // namespace trace::rayfile
