#include "formats/pov/pov_formula.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/budget.h"
#include "base/text.h"
#include "formats/pov/pov_reader.h"
#include "math/elementary.h"
#include "math/noise.h"

namespace trace::pov {
namespace {

using Args = const Real*;
using Maybe = std::optional<Real>;

constexpr Real kDegree = kPi / 180;

constexpr NumberFunction kFunctions[]{
    {"abs", 1, [](Args a, int) -> Maybe { return std::abs(a[0]); }},
    {"acos", 1, [](Args a, int) -> Maybe { return math::acos(std::clamp(a[0], -1.0, 1.0)); }},
    {"acosh", 1, [](Args a, int) -> Maybe { return a[0] < 1 ? Maybe() : math::acosh(a[0]); }},
    {"asin", 1, [](Args a, int) -> Maybe { return math::asin(std::clamp(a[0], -1.0, 1.0)); }},
    {"asinh", 1, [](Args a, int) -> Maybe { return math::asinh(a[0]); }},
    {"atan", 1, [](Args a, int) -> Maybe { return math::atan(a[0]); }},
    {"atan2", 2, [](Args a, int) -> Maybe { return math::atan2(a[0], a[1]); }},
    {"atanh", 1, [](Args a, int) -> Maybe { return std::abs(a[0]) >= 1 ? Maybe() : math::atanh(a[0]); }},
    {"ceil", 1, [](Args a, int) -> Maybe { return std::ceil(a[0]); }},
    {"cos", 1, [](Args a, int) -> Maybe { return math::cos(a[0]); }},
    {"cosh", 1, [](Args a, int) -> Maybe { return math::cosh(a[0]); }},
    {"degrees", 1, [](Args a, int) -> Maybe { return a[0] / kDegree; }},
    {"div", 2, [](Args a, int) -> Maybe { return a[1] == 0 ? Maybe() : std::trunc(a[0] / a[1]); }},
    {"exp", 1, [](Args a, int) -> Maybe { return math::exp(a[0]); }},
    {"floor", 1, [](Args a, int) -> Maybe { return std::floor(a[0]); }},
    {"int", 1, [](Args a, int) -> Maybe { return std::trunc(a[0]); }},
    {"ln", 1, [](Args a, int) -> Maybe { return a[0] <= 0 ? Maybe() : math::log(a[0]); }},
    {"log", 1, [](Args a, int) -> Maybe { return a[0] <= 0 ? Maybe() : math::log10(a[0]); }},
    {"max", -1, [](Args a, int n) -> Maybe { return *std::max_element(a, a + n); }},
    {"min", -1, [](Args a, int n) -> Maybe { return *std::min_element(a, a + n); }},
    {"mod", 2, [](Args a, int) -> Maybe { return a[1] == 0 ? Maybe() : std::fmod(a[0], a[1]); }},
    {"pow", 2, [](Args a, int) -> Maybe { return math::pow(a[0], a[1]); }},
    {"radians", 1, [](Args a, int) -> Maybe { return a[0] * kDegree; }},
    {"select", 3,
     [](Args a, int n) -> Maybe {
       if (n == 3) return a[0] < 0 ? a[1] : a[2];
       return a[0] < 0 ? a[1] : a[0] == 0 ? a[2] : a[3];
     }},
    {"sin", 1, [](Args a, int) -> Maybe { return math::sin(a[0]); }},
    {"sinh", 1, [](Args a, int) -> Maybe { return math::sinh(a[0]); }},
    {"sqrt", 1, [](Args a, int) -> Maybe { return a[0] < 0 ? Maybe() : std::sqrt(a[0]); }},
    {"tan", 1, [](Args a, int) -> Maybe { return math::tan(a[0]); }},
    {"tanh", 1, [](Args a, int) -> Maybe { return math::tanh(a[0]); }},
    {"bitwise_and", 2,
     [](Args a, int) -> Maybe {
       return static_cast<Real>(static_cast<std::int64_t>(std::clamp(a[0], -1e15, 1e15)) &
                                static_cast<std::int64_t>(std::clamp(a[1], -1e15, 1e15)));
     }},
    {"bitwise_or", 2,
     [](Args a, int) -> Maybe {
       return static_cast<Real>(static_cast<std::int64_t>(std::clamp(a[0], -1e15, 1e15)) |
                                static_cast<std::int64_t>(std::clamp(a[1], -1e15, 1e15)));
     }},
    {"bitwise_xor", 2,
     [](Args a, int) -> Maybe {
       return static_cast<Real>(static_cast<std::int64_t>(std::clamp(a[0], -1e15, 1e15)) ^
                                static_cast<std::int64_t>(std::clamp(a[1], -1e15, 1e15)));
     }},
};

/// The functions that functions.inc names by their numbers, as far as Trace knows them.
enum Internal : int { kRadius = 57, kSphere = 61, kTorus = 70, kNoise = 76, kRoundedBox = 60 };

std::string number(Real value) {
  const std::string text = toText(value);
  return value < 0 ? "(" + text + ")" : text;
}

}  // namespace

const NumberFunction* findNumberFunction(std::string_view name) {
  for (const NumberFunction& f : kFunctions)
    if (f.name == name) return &f;
  return nullptr;
}

Real nextRandom(std::uint64_t& seed) {
  seed = (seed * 1812433253u + 12345u) & 0xffffffffu;
  return static_cast<Real>(seed) / 4294967295.0;
}

Real noiseAt(const Vec3& p) {
  constexpr Real kSpread = 0.48;
  return std::clamp(0.53 + kSpread * gradientNoise<3>({p.x, p.y, p.z}, 7), 0.0, 1.0);
}

Vec3 noiseVectorAt(const Vec3& p) {
  const std::array<Real, 3> at{p.x, p.y, p.z};
  return {gradientNoise<3>(at, 11), gradientNoise<3>(at, 12), gradientNoise<3>(at, 13)};
}

std::optional<Real> Formula::at(const Real* arguments, int count, int depth) const {
  constexpr int kMostDepth = 40;
  if (depth > kMostDepth || pigment || transform || count < static_cast<int>(parameters.size())) return {};
  if (internal >= 0) {
    if (count < 3) return {};
    const Vec3 p{arguments[0], arguments[1], arguments[2]};
    const auto extra = [&](int i) { return count > 3 + i ? arguments[3 + i] : 0; };
    switch (internal) {
      case kRadius: return length(p);
      case kSphere: return length(p) - extra(0);
      case kTorus: return math::hypot(math::hypot(p.x, p.z) - extra(0), p.y) - extra(1);
      case kNoise: return noiseAt(p);
      case kRoundedBox: {
        const Real r = extra(0);
        const Vec3 half{extra(1) - r, extra(2) - r, extra(3) - r};
        const Vec3 out{max(std::abs(p.x) - half.x, 0), max(std::abs(p.y) - half.y, 0),
                       max(std::abs(p.z) - half.z, 0)};
        return length(out) - r;
      }
      default: return {};
    }
  }
  if (spline) return spline->at(arguments[0])[0];
  std::vector<Real> values;
  values.reserve(steps.size());
  for (const Step& s : steps) {
    checkBudget();
    const auto in = [&](std::size_t i) { return values[static_cast<std::size_t>(s.inputs[i])]; };
    switch (s.kind) {
      case Step::Kind::number: values.push_back(s.number); break;
      case Step::Kind::parameter: values.push_back(arguments[s.index]); break;
      case Step::Kind::operation: {
        if (s.operation == 'n') {
          values.push_back(-in(0));
          break;
        }
        if (s.operation == '!') {
          values.push_back(in(0) == 0);
          break;
        }
        if (s.operation == '?') {
          values.push_back(in(0) != 0 ? in(1) : in(2));
          break;
        }
        const std::string_view name = s.operation == 'l'   ? "<="
                                      : s.operation == 'g' ? ">="
                                      : s.operation == '#' ? "!="
                                                           : std::string_view(&s.operation, 1);
        const std::optional<Numbers> r = combined(name, Numbers(in(0)), Numbers(in(1)));
        if (!r) return {};
        values.push_back((*r)[0]);
        break;
      }
      case Step::Kind::call:
      case Step::Kind::user:
      case Step::Kind::spline: {
        std::vector<Real> given;
        for (std::size_t i = 0; i < s.inputs.size(); ++i) given.push_back(in(i));
        const auto n = static_cast<int>(given.size());
        const std::optional<Real> r = s.kind == Step::Kind::call ? s.function->value(given.data(), n)
                                                                 : s.user->at(given.data(), n, depth + 1);
        if (!r) return {};
        values.push_back(*r);
        break;
      }
    }
  }
  if (values.empty() || !std::isfinite(values.back())) return {};
  return values.back();
}

Ref<PigmentNode> Formula::onlyPigment() const {
  if (pigment) return pigment;
  Ref<PigmentNode> only;
  for (const Step& s : steps)
    if (s.user && s.user->pigment) {
      if (only && only != s.user->pigment) return nullptr;
      only = s.user->pigment;
    }
  return only;
}

Real Formula::ofColor(const Numbers& c) const {
  const Real grey = 0.297 * c[0] + 0.589 * c[1] + 0.114 * c[2];
  if (pigment) return grey;
  Formula plain = *this;
  for (Step& s : plain.steps)
    if (s.user && s.user->pigment) {
      s.number = s.index == 5 ? grey : c[s.index];
      s.kind = Step::Kind::number;
    }
  constexpr Real kNowhere[3] = {};
  return plain.at(kNowhere, 3).value_or(0);
}

std::optional<std::string> Formula::text(const std::vector<std::string>& arguments, int depth) const {
  constexpr int kMostDepth = 12;
  constexpr std::size_t kLongest = 20000;
  if (depth > kMostDepth || pigment || spline || transform || arguments.size() < parameters.size()) return {};
  if (internal >= 0) {
    if (arguments.size() < 3) return {};
    const std::string &x = arguments[0], &y = arguments[1], &z = arguments[2];
    const auto extra = [&](std::size_t i) { return arguments.size() > 3 + i ? arguments[3 + i] : "0"; };
    const std::string square = "((" + x + ")^2+(" + y + ")^2+(" + z + ")^2)";
    switch (internal) {
      case kRadius: return "sqrt" + square;
      case kSphere: return "(sqrt" + square + "-(" + extra(0) + "))";
      case kTorus:
        return "(sqrt((sqrt((" + x + ")^2+(" + z + ")^2)-(" + extra(0) + "))^2+(" + y + ")^2)-(" + extra(1) +
               "))";
      case kRoundedBox: {
        const auto out = [&](const std::string& v, std::size_t i) {
          return "max(abs(" + v + ")-((" + extra(i) + ")-(" + extra(0) + ")),0)^2";
        };
        return "(sqrt(" + out(x, 1) + "+" + out(y, 2) + "+" + out(z, 3) + ")-(" + extra(0) + "))";
      }
      default: return {};
    }
  }
  std::vector<std::string> texts;
  for (const Step& s : steps) {
    const auto in = [&](std::size_t i) { return texts[static_cast<std::size_t>(s.inputs[i])]; };
    std::string t;
    switch (s.kind) {
      case Step::Kind::number: t = number(s.number); break;
      case Step::Kind::parameter: t = "(" + arguments[static_cast<std::size_t>(s.index)] + ")"; break;
      case Step::Kind::operation:
        if (s.operation == 'n')
          t = "(-" + in(0) + ")";
        else if (std::string_view("+-*/").find(s.operation) != std::string_view::npos)
          t = "(" + in(0) + s.operation + in(1) + ")";
        else
          return {};
        break;
      case Step::Kind::call: {
        const std::string_view f = s.function->name;
        if (f == "min" || f == "max") {
          t = in(0);
          for (std::size_t i = 1; i < s.inputs.size(); ++i) t = std::string(f) + "(" + t + "," + in(i) + ")";
        } else if (f == "pow") {
          const Step& e = steps[static_cast<std::size_t>(s.inputs[1])];
          t = e.kind == Step::Kind::number && e.number == std::round(e.number) && std::abs(e.number) <= 64
                  ? "(" + in(0) + "^" + toText(e.number) + ")"
                  : "pow(" + in(0) + "," + in(1) + ")";
        } else if (f == "abs" || f == "sqrt" || f == "exp" || f == "sin" || f == "cos" || f == "tan") {
          t = std::string(f) + "(" + in(0) + ")";
        } else if (f == "ln") {
          t = "log(" + in(0) + ")";
        } else if (f == "log") {
          t = "(log(" + in(0) + ")/log(10))";
        } else if (f == "radians" || f == "degrees") {
          t = "(" + in(0) + (f == "radians" ? "*pi/180)" : "*180/pi)");
        } else {
          return {};
        }
        break;
      }
      case Step::Kind::user: {
        std::vector<std::string> given;
        for (std::size_t i = 0; i < s.inputs.size(); ++i) given.push_back(in(i));
        const std::optional<std::string> inner = s.user->text(given, depth + 1);
        if (!inner) return {};
        t = *inner;
        break;
      }
      case Step::Kind::spline: return {};
    }
    if (t.size() > kLongest) return {};
    texts.push_back(std::move(t));
  }
  if (texts.empty()) return {};
  return texts.back();
}

// --- reading one ---

Ref<Formula> Reader::function() {
  auto formula = std::make_shared<Formula>();
  bool named = false;
  if (takesMark("(")) {
    named = true;
    while (!peek().isMark(")")) {
      const Token t = raw();
      if (!t.is(Token::Kind::name)) fail(t, "expected the name of a parameter, found " + describe(t));
      formula->parameters.emplace_back(t.text);
      if (!takesMark(",")) break;
    }
    expectMark(")", "after the parameters");
  }
  if (!named) formula->parameters = {"x", "y", "z"};
  // Without parameters a resolution may stand here, that of a picture.
  if (takesMark(",")) number();
  while (startsNumber() && !peek().isMark("{")) {
    number();
    comma();
  }
  expectMark("{", "before the formula");
  const Token t = peek();
  if (t.isName("pigment") || t.isName("pattern")) {
    const Token at = next();
    auto pattern = std::make_shared<PigmentNode>();
    if (at.isName("pigment")) {
      formula->pigment = pigment();
    } else {
      expectMark("{", "after pattern");
      pigmentBody(*pattern);
      expectMark("}", "after the pattern");
      formula->pigment = pattern;
    }
  } else if (t.isName("internal")) {
    next();
    expectMark("(", "after internal");
    formula->internal = whole();
    expectMark(")", "after the number");
  } else if (t.isName("transform")) {
    next();
    formula->transform = transformBlock();
  } else if (t.isName("spline")) {
    next();
    if (!named) formula->parameters = {"x"};
    formula->spline = spline();
  } else {
    formulaPart(0, formula->steps, formula->parameters);
  }
  expectMark("}", "after the formula");
  return formula;
}

Formula::Part Reader::formulaPart(int least, std::vector<Formula::Step>& steps,
                                  const std::vector<std::string>& parameters) {
  constexpr int kMostDepth = 120;
  if (++depth_ > kMostDepth) fail(peek(), "formulas within each other more than 120 deep");
  struct Deeper {
    int& depth;
    ~Deeper() { --depth; }
  } deeper{depth_};
  const auto binds = [&](const Token& t) {
    if (!t.is(Token::Kind::mark)) return -1;
    switch (t.text[0]) {
      case '*':
      case '/': return 5;
      case '+':
      case '-': return 4;
      case '<':
      case '>':
      case '=': return 3;
      case '!': return t.text == "!=" ? 3 : -1;
      case '&': return 2;
      case '|': return 1;
      case '?': return 0;
      default: return -1;
    }
  };
  const auto add = [&](char op, std::vector<int> inputs) {
    steps.push_back({.kind = Formula::Step::Kind::operation, .operation = op, .inputs = std::move(inputs)});
    return static_cast<int>(steps.size() - 1);
  };
  int left = formulaUnary(steps, parameters);
  for (;;) {
    const Token op = peek();
    const int b = binds(op);
    if (b < least) return left;
    next();
    if (b == 0) {
      const int yes = formulaPart(0, steps, parameters);
      expectMark(":", "between the two values of a ?");
      const int no = formulaPart(0, steps, parameters);
      left = add('?', {left, yes, no});
      continue;
    }
    const int right = formulaPart(b + 1, steps, parameters);
    left = add(op.text == "<="   ? 'l'
               : op.text == ">=" ? 'g'
               : op.text == "!=" ? '#'
                                 : op.text[0],
               {left, right});
  }
}

Formula::Part Reader::formulaUnary(std::vector<Formula::Step>& steps,
                                   const std::vector<std::string>& parameters) {
  bool minus = false, inverts = false;
  for (;;) {
    if (takesMark("-"))
      minus = !minus;
    else if (takesMark("!"))
      inverts = true;
    else if (!takesMark("+"))
      break;
  }
  int part = formulaPrimary(steps, parameters);
  const auto add = [&](char op) {
    steps.push_back({.kind = Formula::Step::Kind::operation, .operation = op, .inputs = {part}});
    part = static_cast<int>(steps.size() - 1);
  };
  if (inverts) add('!');
  if (minus) add('n');
  return part;
}

Formula::Part Reader::formulaPrimary(std::vector<Formula::Step>& steps,
                                     const std::vector<std::string>& parameters) {
  constexpr std::size_t kLongest = 20000;
  const Token t = peek();
  if (steps.size() > kLongest) fail(t, "a formula of more than 20 000 steps");
  const auto add = [&](Formula::Step step) {
    steps.push_back(std::move(step));
    return static_cast<int>(steps.size() - 1);
  };
  if (takesMark("(")) {
    const int part = formulaPart(0, steps, parameters);
    expectMark(")", "in the formula");
    return part;
  }
  if (t.is(Token::Kind::number)) {
    next();
    return add({.kind = Formula::Step::Kind::number, .number = t.number});
  }
  if (!t.is(Token::Kind::name)) expected("a number, a parameter or a function");
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (t.text == parameters[i]) {
      next();
      return add({.kind = Formula::Step::Kind::parameter, .index = static_cast<int>(i)});
    }
  const Value* value = valueOf(t);
  const auto* user = value ? value->as<Ref<Formula>>() : nullptr;
  const auto* curve = value ? value->as<std::shared_ptr<SplineCurve>>() : nullptr;
  if (user || curve || (!value && findNumberFunction(t.text))) {
    Formula::Step step;
    if (user) {
      step.kind = Formula::Step::Kind::user;
      step.user = *user;
    } else if (curve) {
      auto of = std::make_shared<Formula>();
      of->parameters = {"t"};
      of->spline = *curve;
      step.kind = Formula::Step::Kind::user;
      step.user = of;
    } else {
      step.kind = Formula::Step::Kind::call;
      step.function = findNumberFunction(t.text);
    }
    next();
    expectMark("(", "after \"" + std::string(t.text) + "\"");
    while (!peek().isMark(")")) {
      step.inputs.push_back(formulaPart(0, steps, parameters));
      if (!takesMark(",")) break;
    }
    expectMark(")", "after the arguments");
    if (step.function && static_cast<int>(step.inputs.size()) < std::abs(step.function->arguments))
      fail(t, std::string(t.text) + "() has too few arguments");
    if (user && step.inputs.size() < (*user)->parameters.size())
      fail(t, std::string(t.text) + "() has " + std::to_string((*user)->parameters.size()) + " parameters");
    // A component of a function of a pigment may follow.
    if (takesMark(".")) {
      const Token part = next();
      constexpr std::string_view kParts[]{"x", "y", "z", "filter", "transmit"},
          kColors[]{"red", "green", "blue", "f", "t"};
      for (int i = 0; i < 5; ++i)
        if (part.text == kParts[i] || part.text == kColors[i]) step.index = i;
      if (part.isName("gray") || part.isName("grey")) step.index = 5;
    }
    return add(std::move(step));
  }
  return add({.kind = Formula::Step::Kind::number, .number = postfix(primary())[0]});
}

}  // namespace trace::pov
