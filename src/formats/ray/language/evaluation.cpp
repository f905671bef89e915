#include "formats/ray/language/evaluation.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "formats/ray/language/language.h"
#include "math/noise.h"

namespace trace::rayfile {
namespace {

constexpr int kMostEvaluations = 1000;  // one within another, for the sake of the stack
constexpr int kPostfix = 12, kPrefix = 10, kPower = 11;

int precedence(Op op) {
  switch (op) {
    case Op::choose: return 1;
    case Op::either: return 2;
    case Op::both: return 3;
    case Op::range: return 6;
    case Op::add:
    case Op::subtract: return 7;
    case Op::multiply:
    case Op::divide:
    case Op::modulo: return 8;
    case Op::power: return kPower;
    case Op::member:
    case Op::index: return kPostfix;
    case Op::degrees:
    case Op::radians: return 9;
    case Op::otherwise: return -1;
    default: return op >= Op::less && op <= Op::unequal ? 5 : -1;
  }
}

/// The name does not see itself while its value is computed, and has failed if that does not end well.
class Active {
 public:
  explicit Active(Binding& binding) : binding_(binding) { binding_.isActive = binding_.failed = true; }
  ~Active() { binding_.isActive = false; }
  Active(const Active&) = delete;
  Active& operator=(const Active&) = delete;

 private:
  Binding& binding_;
};

bool isConstant(std::string_view name) { return name == "pi" || name == "tau" || name == "time"; }

}  // namespace

Value Evaluator::eval(std::uint32_t index, const Scoped& scope) {
  step(index);
  const Nested nested(evaluations_);
  if (evaluations_ > kMostEvaluations) tooDeep(index);
  switch (kind(index)) {
    case Kind::number: return node(index).number;
    case Kind::word: {
      const std::string_view text = wordAt(index);
      if (const Found found = find(text, scope); found.binding) return valueOf(found, index);
      if (const std::optional<double> number = constant(text)) return *number;
      if (text == "true" || text == "false") return text == "true";
      refuseDash(index, scope);
      return std::string(at(index).text());
    }
    case Kind::tuple: return isGrouping(index) ? eval(index + 1, scope) : listOf(index, scope);
    case Kind::expression: {
      Cursor cursor{children(index)};
      return expression(cursor, 0, scope, true);
    }
    case Kind::call: {
      const std::string_view name = wordAt(index + 1);
      const bool isTuple = kind(index + 2) == Kind::tuple;
      const Found found = findCalled(name, scope);
      if (found.binding && isTuple && !isDefinition(*found.binding)) return called(index, found, scope);
      if (!found.binding && isTuple && findFunction(name)) return builtIn(index, *findFunction(name), scope);
      if (!found.binding && isTuple) refuseUnknownFunction(index, scope);
      return Tree{index, scope};
    }
    case Kind::block: return Tree{index, scope};
    default:
      fail(index, "expected a value, found " + describe(at(index)),
           kind(index) == Kind::entry ? "== compares two values; name = value is a field" : "");
  }
}

void Evaluator::refuseUnknownFunction(std::uint32_t call, const Scoped& scope) const {
  const std::string_view name = wordAt(call + 1);
  if (!degrees_ || beginsObject(name)) return;
  const std::vector<std::uint32_t> arguments = children(call + 2);
  const bool areNumbers = std::all_of(arguments.begin(), arguments.end(), [&](std::uint32_t argument) {
    return kind(argument) == Kind::number || kind(argument) == Kind::expression;
  });
  if (!areNumbers || arguments.empty()) return;  // a texture, or what else a file may call
  std::vector<std::string_view> known;
  for (const Function& function : functions()) known.push_back(function.name);
  for (Scoped outer = scope; outer; outer = outer->parent)
    for (const Binding& binding : outer->bindings) known.push_back(binding.name);
  const std::string hint = didYouMean(name, known);
  fail(call, "no function is called \"" + std::string(name) + "\"",
       hint.empty() ? "let " + std::string(name) + "(a) = 2 * a makes one" : hint);
}

const List& Evaluator::needElements(const Value& value, List& letters, std::uint32_t source) const {
  const List* list = elementsOf(value, letters);
  if (!list) fail(source, "expected a range such as 0..9 or a list, found " + shown(value));
  return *list;
}

Value Evaluator::grouped(std::uint32_t tuple, const Scoped& scope) {
  const bool one = tuple + 1 < after(tuple) && after(tuple + 1) == after(tuple);
  return eval(one ? tuple + 1 : tuple, scope);
}

bool Evaluator::isTrue(const Value& value, std::uint32_t index) {
  return guarded(index, [&] { return needTruth(value, "as a condition"); });
}

std::optional<double> Evaluator::constant(std::string_view name) const {
  if (name == "pi") return kPi;
  if (name == "tau") return degrees_ ? 360 : 2 * kPi;
  if (name == "time") return time_.now();
  return {};
}

Value Evaluator::valueOf(const Found& found, std::uint32_t use) {
  Binding& binding = *found.binding;
  if (binding.value) return *binding.value;
  if (binding.failed) throw FailedBefore{};
  if (isFunctionLet(binding) || isDefinition(binding))
    fail(use, "expected a value, found " + std::string(binding.name) + ", which takes " +
                  std::string(at(binding.node + 2).source()));
  const std::uint32_t value = binding.node + 2;
  const Active active(binding);
  Value result = eval(value, found.scope);
  if (const Tree* tree = result.tree())
    result = Tree{tree->node, std::make_shared<Scope>(
                                  Scope{tree->scope, tree->scope->seed, tree->scope->block, binding.name})};
  binding.failed = false;
  binding.value = result;
  noteRing(found.scope, result);
  return result;
}

Value Evaluator::called(std::uint32_t call, const Found& found, const Scoped& scope) {
  const Binding& binding = *found.binding;
  if (!isFunctionLet(binding)) {
    if (isDefinition(binding)) fail(call, std::string(binding.name) + " makes objects and is no value");
    fail(call, "expected a function, found " + std::string(binding.name) + ", which takes nothing in ( )");
  }
  const std::uint32_t parameters = binding.node + 2, body = after(parameters);
  const std::shared_ptr<Scope> own =
      bound(call, binding.name, parameters, children(call + 2), scope, found.scope, body);
  const FrameScope frame(*this, call, binding.name, *own);
  return eval(body, own);
}

std::shared_ptr<Scope> Evaluator::bound(std::uint32_t call, std::string_view name, std::uint32_t parameters,
                                        const std::vector<std::uint32_t>& arguments, const Scoped& scope,
                                        const Scoped& home, std::uint32_t body) {
  const std::string owner(name);
  auto own = std::make_shared<Scope>(Scope{home, seedAt(call, *scope), body});
  std::vector<std::uint32_t> wanted = children(parameters);
  std::vector<std::optional<Value>> values(wanted.size());
  std::vector<std::string_view> names;
  for (std::uint32_t parameter : wanted) {
    const std::uint32_t word = kind(parameter) == Kind::entry ? parameter + 1 : parameter;
    if (wordAt(word).empty())
      fail(parameter, "expected the name of a parameter, found " + describe(at(parameter)));
    checkName(word, Named::value);
    names.push_back(wordAt(word));
  }
  std::size_t place = 0;
  for (std::uint32_t argument : arguments) {
    const bool named = kind(argument) == Kind::entry;
    std::size_t i = place;
    if (named) {
      i = static_cast<std::size_t>(std::find(names.begin(), names.end(), at(argument + 1).text()) -
                                   names.begin());
      if (i == names.size())
        fail(argument,
             owner + ": expected a parameter of " + std::string(at(parameters).source()) + ", found " +
                 describe(at(argument)),
             didYouMean(at(argument + 1).text(), names));
    } else if (place++ >= names.size()) {
      fail(argument, owner + ": expected " + counted(names.size(), "argument") + ", found more");
    }
    if (values[i]) fail(argument, owner + ": " + std::string(names[i]) + " is given twice");
    values[i] = eval(named ? argument + 2 : argument, scope);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!values[i]) {
      if (kind(wanted[i]) != Kind::entry)
        fail(call, owner + ": expected a value for " + std::string(names[i]) + ", found none",
             "as in " + owner + std::string(at(parameters).source()));
      values[i] = eval(wanted[i] + 2, own);
      noteRing(own, *values[i]);
    }
    own->bindings.push_back({names[i], wanted[i], std::move(values[i])});
  }
  return own;
}

Value Evaluator::listOf(std::uint32_t tuple, const Scoped& scope) {
  List list;
  addItems(tuple, scope, list);
  return list;
}

void Evaluator::addItems(std::uint32_t parent, const Scoped& scope, List& list) {
  for (std::uint32_t child = parent + 1; child < after(parent); child = after(child)) {
    if (kind(child) == Kind::loop) {
      const std::uint32_t name = child + 1, source = name + 1, body = after(source);
      const Value values = eval(source, scope);
      List letters;
      const List& all = needElements(values, letters, source);
      const std::uint64_t seed = seedAt(child, *scope);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto round = std::make_shared<Scope>(Scope{scope, mixBits(seed ^ i), body});
        round->bindings.push_back({at(name).text(), child, all[i]});
        declare(body, *round);
        addItems(body, round, list);
      }
    } else if (kind(child) == Kind::branch) {
      addBranch(child, scope, list);
    } else if (kind(child) != Kind::let && kind(child) != Kind::define) {
      list.push_back(eval(child, scope));
    }
  }
}

void Evaluator::addBranch(std::uint32_t statement, const Scoped& scope, List& list) {
  const std::uint32_t condition = statement + 1, then = after(condition), other = after(then);
  const bool truth = isTrue(grouped(condition, scope), condition);
  if (!truth && other >= after(statement)) return;
  if (!truth && kind(other) == Kind::branch) return addBranch(other, scope, list);
  const std::shared_ptr<Scope> own = inside(truth ? then : other, scope);
  declare(own->block, *own);
  addItems(own->block, own, list);
}

Value Evaluator::builtIn(std::uint32_t call, const Function& function, const Scoped& scope) {
  List arguments;
  addItems(call + 2, scope, arguments);
  if (arguments.size() < function.least || arguments.size() > function.most)
    fail(call, "expected " + std::string(function.name) + "(" + std::string(function.parameters) +
                   "), found " + counted(arguments.size(), "argument"));
  std::uint64_t random = seedAt(call, *scope);
  return guarded(call, [&] {
    if (degrees_ && function.angles == Angles::taken)
      for (Value& angle : arguments) angle = operate(Op::degrees, angle);
    const Value result = function.call(arguments, random);
    return degrees_ && function.angles == Angles::given ? operate(Op::divide, result, kPi / 180) : result;
  });
}

Value Evaluator::expression(Cursor& cursor, int least, const Scoped& scope, bool live) {
  const std::uint32_t start = cursor.nodes[cursor.at];
  Value left;
  if (kind(start) != Kind::op) {
    ++cursor.at;
    if (live) left = operand(start, scope);
  } else {
    ++cursor.at;
    if (cursor.done()) fail(start, "expected a value after the operator");
    left = expression(cursor, opAt(start) == Op::invert ? 4 : kPrefix, scope, live);
    if (live) left = guarded(start, [&] { return operate(opAt(start), left); });
  }
  while (!cursor.done()) {
    const std::uint32_t operation = cursor.nodes[cursor.at];
    const Op op = opAt(operation);
    const int level = precedence(op);
    if (level < least || level < 0) break;
    ++cursor.at;
    left = operated(cursor, operation, op, level, std::move(left), scope, live);
  }
  return left;
}

Value Evaluator::operand(std::uint32_t index, const Scoped& scope) {
  if (kind(index) == Kind::tuple) return grouped(index, scope);
  const std::string_view text = wordAt(index);
  const bool known =
      text.empty() || text == "true" || text == "false" || isConstant(text) || find(text, scope).binding;
  if (!known) {
    refuseDash(index, scope);
    fail(index, "no value is called \"" + std::string(text) + "\"", nameHint(text, scope));
  }
  return eval(index, scope);
}

Value Evaluator::operated(Cursor& cursor, std::uint32_t operation, Op op, int level, Value left,
                          const Scoped& scope, bool live) {
  switch (op) {
    case Op::member:
      return live ? guarded(operation, [&] { return component(left, at(operation).source().back()); }) : left;
    case Op::index: {
      if (!live) return left;
      const Value index = grouped(operation + 1, scope);
      return guarded(operation, [&] { return element(left, index); });
    }
    case Op::degrees:
    case Op::radians: {
      if (!live) return left;
      const bool asIs = degrees_ == (op == Op::degrees);
      return guarded(operation, [&] {
        return asIs       ? operate(Op::multiply, left, 1.0)
               : degrees_ ? operate(Op::divide, left, kPi / 180)
                          : operate(op, left);
      });
    }
    case Op::both:
    case Op::either: {
      const bool first = live && isTrue(left, operation);
      const bool second = live && first == (op == Op::both);  // else the first one decides
      const Value right = expression(cursor, level + 1, scope, second);
      return second ? Value(isTrue(right, operation)) : Value(first);
    }
    case Op::choose: {
      const bool first = live && isTrue(left, operation);
      const Value yes = expression(cursor, level, scope, live && first);
      if (cursor.done() || opAt(cursor.nodes[cursor.at]) != Op::otherwise)
        fail(operation, "expected \":\" and another value after \"?\"");
      ++cursor.at;
      const Value no = expression(cursor, level, scope, live && !first);
      return first ? yes : no;
    }
    default: {
      const Value right = expression(cursor, op == Op::power ? level - 1 : level + 1, scope, live);
      return live ? guarded(operation, [&] { return operate(op, left, right); }) : left;
    }
  }
}

}  // namespace trace::rayfile
