#include "formats/ray/language/value.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/names.h"
#include "base/text.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "math/noise.h"

namespace trace::rayfile {
namespace {

constexpr std::size_t kLongestList = 10'000'000;

[[noreturn]] void refuse(std::string what) { throw ValueError(std::move(what)); }

double finite(double value) {
  if (!std::isfinite(value)) refuse("the result is not a finite number");
  return value;
}

double ofNumbers(Op op, double a, double b) {
  switch (op) {
    case Op::add: return finite(a + b);
    case Op::subtract: return finite(a - b);
    case Op::multiply: return finite(a * b);
    case Op::divide:
      if (b == 0) refuse("division by 0");
      return finite(a / b);
    case Op::modulo:  // has the sign of b, so that angles and indices wrap
      if (b == 0) refuse("division by 0");
      return finite(a - b * std::floor(a / b));
    default: return finite(math::pow(a, b));
  }
}

bool isCompared(Op op) { return op >= Op::less && op <= Op::unequal; }

bool same(const Value& a, const Value& b) {
  if (a.index() != b.index()) return false;
  if (a.tree()) return a.tree()->node == b.tree()->node && a.tree()->scope == b.tree()->scope;
  if (!a.list())
    return a.number()  ? *a.number() == *b.number()
           : a.truth() ? *a.truth() == *b.truth()
                       : *a.text() == *b.text();
  return std::equal(a.list()->begin(), a.list()->end(), b.list()->begin(), b.list()->end(), same);
}

Value compared(Op op, const Value& a, const Value& b) {
  if (op == Op::equal || op == Op::unequal) return same(a, b) == (op == Op::equal);
  const double x = needNumber(a, "to compare"), y = needNumber(b, "to compare");
  return op == Op::less ? x < y : op == Op::atMost ? x <= y : op == Op::more ? x > y : x >= y;
}

Value rangeOf(const Value& a, const Value& b) {
  const double from = needNumber(a, "as the start of a range"), to = needNumber(b, "as the end of a range");
  if (to - from >= static_cast<double>(kLongestList))
    refuse("a range of more than " + std::to_string(kLongestList) + " numbers");
  List list;
  for (std::size_t i = 0; from + static_cast<double>(i) <= to; ++i)
    list.push_back(from + static_cast<double>(i));
  return list;
}

std::string joined(const Value& value) { return value.text() ? *value.text() : shown(value); }

// --- functions ------------------------------------------------------------------------------------------

using Arguments = std::span<const Value>;

template <double (*F)(double)>
Value ofOne(Arguments a, std::uint64_t&) {
  return finite(F(needNumber(a[0], "as the argument")));
}
std::array<double, 3> needVector(const Value& value) {
  const List* list = value.list();
  if (!list || list->size() != 3) refuse("expected (x, y, z), found " + shown(value));
  std::array<double, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) v[i] = needNumber((*list)[i], "in a vector");
  return v;
}
Value vectorOf(double x, double y, double z) { return List{finite(x), finite(y), finite(z)}; }

Value extreme(Arguments arguments, bool least) {
  const List* list = arguments.size() == 1 ? arguments[0].list() : nullptr;
  const Arguments all = list ? Arguments(*list) : arguments;
  if (all.empty()) refuse("expected at least one number");
  double result = needNumber(all[0], "to compare");
  for (const Value& value : all) {
    const double number = needNumber(value, "to compare");
    result = least ? std::min(result, number) : std::max(result, number);
  }
  return result;
}

/// From 0 up to 1, another each time.
double drawn(std::uint64_t& random) { return unitFromBits(random = mixBits(random)); }

Value hsv(Arguments a, std::uint64_t&) {
  const double h = needNumber(a[0], "as a hue"), s = needNumber(a[1], "as a saturation"),
               v = needNumber(a[2], "as a value");
  const auto channel = [&](double shift) {  // Smith 1978, in the form of its wheel
    const double k = std::fmod(std::fmod(shift + 6 * h, 6) + 6, 6);
    return linearOfSrgb(v - v * s * std::max(0.0, std::min({k, 4 - k, 1.0})));
  };
  return vectorOf(channel(5), channel(3), channel(1));
}

Value steps(Arguments a, std::uint64_t&) {
  const double count = needNumber(a[2], "as a count");
  if (count < 1 || count > static_cast<double>(kLongestList) || count != std::floor(count))
    refuse("expected a whole count from 1, found " + shown(a[2]));
  List list;
  for (double i = 0; i < count; ++i)
    list.push_back(count == 1
                       ? a[0]
                       : operate(Op::add, a[0],
                                 operate(Op::multiply, operate(Op::subtract, a[1], a[0]), i / (count - 1))));
  return list;
}

constexpr std::string_view kX = "x";
constexpr std::array kFunctions{
    Function{"sin", kX, 1, 1, "sine of an angle: sin(30 deg) is 0.5", ofOne<math::sin>, Angles::taken},
    Function{"cos", kX, 1, 1, "cosine of an angle", ofOne<math::cos>, Angles::taken},
    Function{"tan", kX, 1, 1, "tangent of an angle", ofOne<math::tan>, Angles::taken},
    Function{"asin", kX, 1, 1, "the angle of that sine", ofOne<math::asin>, Angles::given},
    Function{"acos", kX, 1, 1, "the angle of that cosine", ofOne<math::acos>, Angles::given},
    Function{"atan", kX, 1, 1, "the angle of that tangent", ofOne<math::atan>, Angles::given},
    Function{"atan2", "y, x", 2, 2, "the angle of the point (x, y)",
             [](Arguments a, std::uint64_t&) -> Value {
               return math::atan2(needNumber(a[0], "as y"), needNumber(a[1], "as x"));
             },
             Angles::given},
    Function{"sqrt", kX, 1, 1, "square root", ofOne<std::sqrt>},
    Function{"exp", kX, 1, 1, "e to that power", ofOne<math::exp>},
    Function{"log", kX, 1, 1, "natural logarithm", ofOne<math::log>},
    Function{"abs", kX, 1, 1, "without its sign", ofOne<std::fabs>},
    Function{"floor", kX, 1, 1, "the next whole number below", ofOne<std::floor>},
    Function{"ceil", kX, 1, 1, "the next whole number above", ofOne<std::ceil>},
    Function{"round", kX, 1, 1, "the nearest whole number", ofOne<std::round>},
    Function{"min", "a, b, ...", 1, 99, "the least of numbers, or of a list",
             [](Arguments a, std::uint64_t&) { return extreme(a, true); }},
    Function{"max", "a, b, ...", 1, 99, "the greatest of numbers, or of a list",
             [](Arguments a, std::uint64_t&) { return extreme(a, false); }},
    Function{"clamp", "x, low, high", 3, 3, "x, moved between low and high",
             [](Arguments a, std::uint64_t&) -> Value {
               return std::max(
                   needNumber(a[1], "as the lower limit"),
                   std::min(needNumber(a[2], "as the upper limit"), needNumber(a[0], "to clamp")));
             }},
    Function{"mix", "a, b, t", 3, 3, "from a, where t is 0, to b, where t is 1: numbers, points or colours",
             [](Arguments a, std::uint64_t&) -> Value {
               return operate(Op::add, operate(Op::multiply, a[0], 1 - needNumber(a[2], "as t")),
                              operate(Op::multiply, a[1], a[2]));
             }},
    Function{"dot", "a, b", 2, 2, "dot product of two vectors",
             [](Arguments a, std::uint64_t&) -> Value {
               const auto u = needVector(a[0]), v = needVector(a[1]);
               return finite(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
             }},
    Function{"cross", "a, b", 2, 2, "cross product of two vectors",
             [](Arguments a, std::uint64_t&) -> Value {
               const auto u = needVector(a[0]), v = needVector(a[1]);
               return vectorOf(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                               u[0] * v[1] - u[1] * v[0]);
             }},
    Function{"length", "v", 1, 1, "length of a vector",
             [](Arguments a, std::uint64_t&) -> Value {
               const auto v = needVector(a[0]);
               return finite(math::hypot(v[0], v[1], v[2]));
             }},
    Function{"normalize", "v", 1, 1, "the vector with length 1",
             [](Arguments a, std::uint64_t&) -> Value {
               const auto v = needVector(a[0]);
               const double length = math::hypot(v[0], v[1], v[2]);
               if (!(length > 0)) refuse("a vector of length 0 has no direction");
               return vectorOf(v[0] / length, v[1] / length, v[2] / length);
             }},
    Function{"count", "list", 1, 1, "how many elements a list has, or letters a text",
             [](Arguments a, std::uint64_t&) -> Value {
               List letters;
               const List* list = elementsOf(a[0], letters);
               if (!list) refuse("expected a list, found " + shown(a[0]));
               return static_cast<double>(list->size());
             }},
    Function{"steps", "a, b, n", 3, 3, "n values from a to b, evenly spaced", steps},
    Function{"random", "[a, b]", 0, 2,
             "a random number from 0 to 1, or from a to b, the same at each reading",
             [](Arguments a, std::uint64_t& random) -> Value {
               if (a.size() == 1) refuse("expected random() or random(a, b)");
               const double t = drawn(random);
               if (a.empty()) return t;
               const double from = needNumber(a[0], "as the lower limit");
               return finite(from + (needNumber(a[1], "as the upper limit") - from) * t);
             }},
    Function{"srgb", "r, g, b", 3, 3, "the linear colour of an sRGB one, from 0 to 1",
             [](Arguments a, std::uint64_t&) -> Value {
               return vectorOf(linearOfSrgb(needNumber(a[0], "as red")),
                               linearOfSrgb(needNumber(a[1], "as green")),
                               linearOfSrgb(needNumber(a[2], "as blue")));
             }},
    Function{"hsv", "h, s, v", 3, 3, "the linear colour of hue, saturation and value, from 0 to 1", hsv},
};

}  // namespace

std::string shown(const Value& value) {
  if (const double* number = value.number()) return toText(*number);
  if (const bool* truth = value.truth()) return *truth ? "true" : "false";
  if (const std::string* text = value.text()) return "\"" + text->substr(0, 40) + "\"";
  if (value.tree()) return "a part of a scene";
  constexpr std::size_t kFew = 4;
  const List& list = *value.list();
  std::string text = "(";
  for (std::size_t i = 0; i < std::min(kFew, list.size()); ++i) text += (i ? ", " : "") + shown(list[i]);
  return text + (list.size() > kFew ? ", ...)" : ")");
}

double needNumber(const Value& value, std::string_view what) {
  if (const double* number = value.number()) return *number;
  refuse("expected a number " + std::string(what) + ", found " + shown(value));
}

bool needTruth(const Value& value, std::string_view what) {
  if (const bool* truth = value.truth()) return *truth;
  refuse("expected true or false " + std::string(what) + ", found " + shown(value));
}

Value operate(Op op, const Value& a, const Value& b) {
  if (op == Op::range) return rangeOf(a, b);
  if (isCompared(op)) return compared(op, a, b);
  if (a.number() && b.number()) return ofNumbers(op, *a.number(), *b.number());
  if (op == Op::add && (a.text() || b.text())) return joined(a) + joined(b);
  const List *left = a.list(), *right = b.list();
  if (left && right && left->size() != right->size())
    refuse("lists of " + std::to_string(left->size()) + " and of " + std::to_string(right->size()) +
           " elements do not go together");
  if (!(left || a.number()) || !(right || b.number()))
    refuse("expected numbers, points or colours, found " + shown(left || a.number() ? b : a));
  List result;
  for (std::size_t i = 0; i < (left ? left : right)->size(); ++i)
    result.push_back(operate(op, left ? (*left)[i] : a, right ? (*right)[i] : b));
  return result;
}

Value operate(Op op, const Value& a) {
  if (op == Op::invert) return !needTruth(a, "after not");
  return operate(Op::multiply, a, op == Op::negate ? -1.0 : op == Op::degrees ? kPi / 180 : 1.0);
}

Value component(const Value& of, char name) {
  const std::size_t index = name == 'x' || name == 'r' ? 0 : name == 'y' || name == 'g' ? 1 : 2;
  if (!of.list() || index >= of.list()->size())
    refuse("expected a point or colour before ." + std::string(1, name) + ", found " + shown(of));
  return (*of.list())[index];
}

const List* elementsOf(const Value& value, List& letters) {
  if (!value.text()) return value.list();
  for (std::string_view rest = *value.text(); !rest.empty();) {
    const std::size_t bytes = std::max<std::size_t>(utf8Letter(rest).bytes, 1);
    letters.push_back(std::string(rest.substr(0, bytes)));
    rest.remove_prefix(bytes);
  }
  return &letters;
}

Value element(const Value& of, const Value& index) {
  List letters;
  const List* list = elementsOf(of, letters);
  if (!list) refuse("expected a list or text before [ ], found " + shown(of));
  const double at = needNumber(index, "in [ ]");
  if (!(at >= 0 && at < static_cast<double>(list->size())) || at != std::floor(at))
    refuse((list->empty() ? "expected a list that is not empty before [ ], found "
                          : "expected a whole number from 0 to " + std::to_string(list->size() - 1) +
                                " in [ ], found ") +
           shown(index));
  return (*list)[static_cast<std::size_t>(at)];
}

std::span<const Function> functions() { return kFunctions; }

const Function* findFunction(std::string_view name) {
  const auto found =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : &*found;
}

bool isFunction(std::string_view name) { return findFunction(name) != nullptr; }

}  // namespace trace::rayfile
