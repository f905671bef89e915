#include "formats/ray/ray_language.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "base/budget.h"
#include "base/file.h"
#include "base/nesting.h"
#include "base/text.h"
#include "formats/ray/ray_objects.h"
#include "formats/ray/ray_placement.h"
#include "formats/ray/ray_texture.h"
#include "formats/ray/ray_value.h"
#include "formats/text_front.h"
#include "math/noise.h"

namespace trace::rayfile {

/// A name and what it stands for.
struct Binding {
  std::string_view name;
  std::uint32_t node = 0;  ///< the let, define or loop
  std::optional<Value>
      value{};            ///< of a let without parameters, once it was asked for; of a parameter or loop
  bool isActive = false;  ///< its value is being worked out, and does not see itself
};

/// The names of one block, of one call or of one round of a loop.
struct Scope {
  std::shared_ptr<const Scope> parent{};
  std::uint64_t seed = 0;       ///< of its random numbers
  std::uint32_t block = 0;      ///< whose random numbers are counted together
  std::string_view hides = {};  ///< the name whose value is being made: it does not see itself
  mutable std::vector<Binding> bindings{};
};

namespace {

using Scoped = std::shared_ptr<const Scope>;

constexpr std::array<std::string_view, 8> kStatementWords{"let", "define", "for",     "in",
                                                          "if",  "else",   "include", "group"};
constexpr std::array<std::string_view, 5> kConstants{"pi", "tau", "time", "true", "false"};

class Expander {
 public:
  Expander(Syntax& syntax, SceneTime& time, InputFiles& inputs)
      : syntax_(syntax), time_(time), inputs_(inputs) {
    for (const std::string_view word : knownWords()) reserved_.insert(word);
    for (const std::string_view word : textureKinds()) textureWords_.insert(word);
    reserved_.insert(kStatementWords.begin(), kStatementWords.end());
    reserved_.insert(kConstants.begin(), kConstants.end());
  }

  void expand() {
    const auto scope = std::make_shared<Scope>();
    result_.reserve(syntax_.nodes().size());
    const std::size_t root = open(0);
    declare(0, *scope);
    items(0, scope, false);
    close(root);
    syntax_.replace(std::move(result_));
    syntax_.setFrames(std::move(frames_));
  }

 private:
  // --- the tree ---

  const Node& node(std::uint32_t index) const { return syntax_.nodes()[index]; }
  Kind kind(std::uint32_t index) const { return node(index).kind; }
  Item at(std::uint32_t index) const { return {syntax_, index}; }
  std::uint32_t after(std::uint32_t index) const { return node(index).end; }
  /// An unquoted word's text; "" for others.
  std::string_view wordAt(std::uint32_t index) const {
    return kind(index) == Kind::word && !node(index).quoted ? at(index).text() : std::string_view();
  }
  std::vector<std::uint32_t> children(std::uint32_t parent) const {
    std::vector<std::uint32_t> list;
    for (std::uint32_t child = parent + 1; child < after(parent); child = after(child)) list.push_back(child);
    return list;
  }

  // --- writing ---

  std::size_t open(std::uint32_t from) { return open(node(from), from); }
  std::size_t open(const Node& made, std::uint32_t from) {
    if ((made.kind == Kind::tuple || made.kind == Kind::block) && ++depth_ > kMostNesting)
      fail(from, "expected at most " + std::to_string(kMostNesting) + " levels of brackets, found more",
           calls_ > 0 ? "a recursion needs a condition that ends it" : "");
    return push(made);
  }
  void close(std::size_t index) {
    result_[index].end = static_cast<std::uint32_t>(result_.size());
    depth_ -= result_[index].kind == Kind::tuple || result_[index].kind == Kind::block;
  }
  std::size_t push(Node made) {
    if (result_.size() >= kMostMadeNodes) tooMany();
    made.end = static_cast<std::uint32_t>(result_.size() + 1);
    result_.push_back(made);
    return result_.size() - 1;
  }
  /// A node of that kind whose place is that of another.
  Node likeness(std::uint32_t of, Kind kind) const {
    Node made = node(of);
    made.kind = kind;
    made.quoted = made.follows = false;
    made.number = 0;
    return made;
  }

  void step(std::uint32_t index) {
    checkBudget();
    if (++steps_ > kMostSteps) {
      throw Error(Fault::limit, syntax_.place(node(index).offset),
                  "expected a scene of at most " + std::to_string(kMostSteps) + " steps, found more",
                  chain());
    }
  }

  // --- names ---

  void declare(std::uint32_t block, Scope& scope) {
    for (std::uint32_t child = block + 1; child < after(block); child = after(child)) {
      if (kind(child) == Kind::let || kind(child) == Kind::define) add(child, scope);
      if (kind(child) == Kind::include) include(child, scope);
    }
  }

  void add(std::uint32_t statement, Scope& scope) {
    const std::uint32_t name = statement + 1;
    const std::string_view text = at(name).text();
    checkName(name);
    for (const Binding& other : scope.bindings)
      if (other.name == text)
        fail(name, "expected a new name, found \"" + std::string(text) + "\" again",
             "it is defined at " + placeText(syntax_.place(node(other.node).offset)) +
                 "; nothing is assigned twice");
    scope.bindings.push_back({text, statement});
  }

  /// What means something already is no name.
  void checkName(std::uint32_t name) const {
    const std::string_view text = at(name).text();
    if (reserved_.contains(text))
      fail(name, "expected a new name, found \"" + std::string(text) + "\", which has a meaning already");
  }

  void include(std::uint32_t statement, Scope& scope) {
    const std::uint32_t word = statement + 1;
    const std::string name(at(word).text());
    const std::string from = syntax_.place(node(word).offset).file;
    const std::string path = besideFile(from, name);
    if (!included_.insert(path).second) return;
    std::string text;
    try {
      text = readBeside(from, name, inputs_);
    } catch (const Error& error) {
      throw Error(error.fault(), syntax_.place(node(word).offset),
                  "include: " + error.messages().front().what, error.messages().front().hint);
    }
    const TextFront front(path, text);
    const std::uint32_t root = syntax_.include(path, std::string(front.text()));
    roots_.emplace(statement, root);
    declare(root, scope);
  }

  struct Found {
    Binding* binding = nullptr;
    Scoped scope{};
  };
  Found find(std::string_view name, const Scoped& from) const {
    if (name.empty()) return {};
    const Scope* skipped = nullptr;
    for (Scoped scope = from; scope; scope = scope->parent) {
      if (scope->hides == name) skipped = scope->parent.get();
      for (Binding& binding : scope->bindings)
        if (binding.name == name && !binding.isActive && scope.get() != skipped) return {&binding, scope};
    }
    return {};
  }
  bool isFunctionLet(const Binding& binding) const {
    return !binding.value && kind(binding.node) == Kind::let && kind(binding.node + 2) == Kind::tuple &&
           after(binding.node + 2) < after(binding.node);
  }
  bool isDefinition(const Binding& binding) const {
    return !binding.value && kind(binding.node) == Kind::define;
  }

  /// The value of a name that takes no arguments.
  Value valueOf(const Found& found, std::uint32_t use) {
    Binding& binding = *found.binding;
    if (binding.value) return *binding.value;
    if (isFunctionLet(binding) || isDefinition(binding))
      fail(use, "expected a value, found " + std::string(binding.name) + ", which takes " +
                    std::string(at(binding.node + 2).source()));
    const std::uint32_t value = binding.node + 2;
    binding.isActive = true;
    Value result = eval(value, found.scope);
    if (const Tree* tree = result.tree())
      result = Tree{tree->node, std::make_shared<Scope>(
                                    Scope{tree->scope, tree->scope->seed, tree->scope->block, binding.name})};
    binding.isActive = false;
    binding.value = result;
    return result;
  }

  // --- statements ---

  /// The items of a block or tuple, with what statements make of them in their place.
  void items(std::uint32_t parent, const Scoped& scope, bool isList) {
    for (std::uint32_t child = parent + 1; child < after(parent);)
      child = item(child, after(parent), scope, isList);
  }

  /// Returns the item after it.
  std::uint32_t item(std::uint32_t child, std::uint32_t end, const Scoped& scope, bool isList) {
    step(child);
    const std::uint32_t next = after(child);
    switch (kind(child)) {
      case Kind::let:
      case Kind::define: return next;
      case Kind::include: {
        if (const auto root = roots_.find(child); root != roots_.end())
          items(withoutHead(root->second), root->second, scope);
        return next;
      }
      case Kind::loop: loop(child, scope, isList); return next;
      case Kind::branch: branch(child, scope, isList); return next;
      case Kind::call: {
        const Found found = find(wordAt(child + 1), scope);
        if (!found.binding) break;
        const bool overridden = next < end && node(next).follows && kind(child + 2) == Kind::tuple;
        made(child, found, scope, overridden ? next : 0);
        return overridden ? after(next) : next;
      }
      case Kind::word: {
        const Found found = find(wordAt(child), scope);
        if (!found.binding || !isDefinition(*found.binding)) break;
        definition(*found.binding, found.scope, child, {}, scope, 0);
        return next;
      }
      default: break;
    }
    copy(child, scope);
    return next;
  }

  /// An included file may have the first words of a scene.
  std::uint32_t withoutHead(std::uint32_t root) const {
    const std::uint32_t first = root + 1;
    if (first >= after(root) || wordAt(first) != "SBT-raytracer") return first;
    const std::uint32_t second = after(first);
    return second < after(root) && kind(second) == Kind::number ? after(second) : second;
  }
  void items(std::uint32_t first, std::uint32_t root, const Scoped& scope) {
    for (std::uint32_t child = first; child < after(root);) child = item(child, after(root), scope, false);
  }

  void loop(std::uint32_t statement, const Scoped& scope, bool isList) {
    const std::uint32_t name = statement + 1, source = name + 1, body = after(source);
    checkName(name);
    const Value all = eval(source, scope);
    if (!all.list()) fail(source, "expected a range such as 0..9 or a list, found " + shown(all));
    const std::uint64_t seed = seedAt(statement, *scope);
    for (std::size_t i = 0; i < all.list()->size(); ++i) {
      const Value& value = (*all.list())[i];
      const auto round = std::make_shared<Scope>(Scope{scope, mixBits(seed ^ i), body});
      round->bindings.push_back({at(name).text(), statement, value});
      const FrameScope frame(*this, statement, std::string(at(name).text()) + " = " + shown(value));
      block(body, round, isList);
    }
  }

  void branch(std::uint32_t statement, const Scoped& scope, bool isList) {
    const std::uint32_t condition = statement + 1, then = after(condition);
    if (Value truth = grouped(condition, scope); isTrue(truth, condition))
      block(then, inside(then, scope), isList);
    else if (const std::uint32_t other = after(then); other < after(statement)) {
      if (kind(other) == Kind::branch)
        branch(other, scope, isList);
      else
        block(other, inside(other, scope), isList);
    }
  }
  bool isTrue(const Value& value, std::uint32_t index) {
    return guarded(index, [&] { return needTruth(value, "as a condition"); });
  }

  std::shared_ptr<Scope> inside(std::uint32_t block, const Scoped& scope) const {
    return std::make_shared<Scope>(Scope{scope, seedAt(block, *scope), block});
  }

  /// The items of the block of a loop or condition, in a group of their own where they set a material.
  void block(std::uint32_t body, const std::shared_ptr<Scope>& scope, bool isList) {
    declare(body, *scope);
    bool sets = false;
    for (std::uint32_t child = body + 1; child < after(body) && !isList; child = after(child))
      sets |= kind(child) == Kind::entry && wordAt(child + 1) == Material::kKeyword;
    const std::size_t group = sets ? open(body) : 0;
    items(body, scope, isList);
    if (sets) close(group);
  }

  // --- calls ---

  /// What a call of a name makes. `block` overrides what it is made of; 0 for none.
  void made(std::uint32_t call, const Found& found, const Scoped& scope, std::uint32_t block) {
    const Binding& binding = *found.binding;
    const std::uint32_t brackets = call + 2;
    const bool isBlock = kind(brackets) == Kind::block;
    if (isBlock) block = brackets;
    if (isDefinition(binding))
      return definition(binding, found.scope, call,
                        isBlock ? std::vector<std::uint32_t>{} : children(brackets), scope, block);
    const Value value = isBlock ? valueOf(found, call) : called(call, found, scope);
    if (!block) return emit(value, call);
    if (!value.tree()) fail(call, "expected objects before { }, found " + shown(value));
    const std::size_t group = open(likeness(block, Kind::block), block);
    overriding(block, scope);
    emit(value, call);
    close(group);
  }

  /// The materials that a block behind a call sets.
  void overriding(std::uint32_t block, const Scoped& scope) {
    for (std::uint32_t child = block + 1; child < after(block); child = after(child)) {
      if (kind(child) != Kind::entry || wordAt(child + 1) != Material::kKeyword)
        fail(child, "expected material = ..., found " + describe(at(child)),
             "a block behind a name says what its objects are made of");
      copy(child, scope);
    }
  }

  void definition(const Binding& binding, const Scoped& home, std::uint32_t call,
                  const std::vector<std::uint32_t>& arguments, const Scoped& scope, std::uint32_t block) {
    const std::uint32_t parameters = binding.node + 2, body = after(parameters);
    const std::shared_ptr<Scope> own = bound(call, binding.name, parameters, arguments, scope, home, body);
    const FrameScope frame(*this, call, callText(binding.name, *own));
    const std::size_t group = open(likeness(call, Kind::block), call);
    if (block) overriding(block, scope);
    declare(body, *own);
    items(body, own, false);
    close(group);
  }

  /// The value of a call of a function that the scene defines.
  Value called(std::uint32_t call, const Found& found, const Scoped& scope) {
    const Binding& binding = *found.binding;
    if (!isFunctionLet(binding)) {
      if (isDefinition(binding)) fail(call, std::string(binding.name) + " makes objects and is no value");
      fail(call, "expected a function, found " + std::string(binding.name) + ", which takes nothing in ( )");
    }
    const std::uint32_t parameters = binding.node + 2, body = after(parameters);
    const std::shared_ptr<Scope> own =
        bound(call, binding.name, parameters, children(call + 2), scope, found.scope, body);
    const FrameScope frame(*this, call, callText(binding.name, *own));
    return eval(body, own);
  }

  /// A scope in which the parameters have the values of the arguments, by place or by name.
  std::shared_ptr<Scope> bound(std::uint32_t call, std::string_view name, std::uint32_t parameters,
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
      checkName(word);
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
          fail(call, owner + ": expected a value for " + std::string(names[i]) + ", found none");
        values[i] = eval(wanted[i] + 2, own);
      }
      own->bindings.push_back({names[i], wanted[i], std::move(values[i])});
    }
    return own;
  }

  static std::string callText(std::string_view name, const Scope& own) {
    std::string text = std::string(name) + "(";
    for (const Binding& binding : own.bindings)
      text += (text.ends_with('(') ? "" : ", ") + std::string(binding.name) + " = " + shown(*binding.value);
    return text + ")";
  }

  // --- copying ---

  void copy(std::uint32_t index, const Scoped& scope) {
    step(index);
    switch (kind(index)) {
      case Kind::number: push(node(index)); return;
      case Kind::word: return word(index, scope);
      case Kind::expression: return emit(eval(index, scope), index);
      case Kind::tuple:
        if (isGrouping(index)) return emit(eval(index + 1, scope), index);
        return inBrackets(index, scope);
      case Kind::block: return inBrackets(index, scope);
      case Kind::entry: {
        const std::size_t entry = open(index);
        push(node(index + 1));
        copy(index + 2, scope);
        return close(entry);
      }
      case Kind::call: return call(index, scope);
      default: fail(index, "expected a value, found " + describe(at(index)));
    }
  }

  void inBrackets(std::uint32_t index, const Scoped& scope) {
    const bool isList = kind(index) == Kind::tuple;
    const std::size_t brackets = open(index);
    if (isList) {
      items(index, scope, true);
    } else {
      const std::shared_ptr<Scope> own = inside(index, scope);
      declare(index, *own);
      items(index, own, false);
    }
    close(brackets);
  }

  void word(std::uint32_t index, const Scoped& scope) {
    const std::string_view text = wordAt(index);
    if (const Found found = find(text, scope); found.binding) {
      if (isDefinition(*found.binding)) return definition(*found.binding, found.scope, index, {}, scope, 0);
      return emit(valueOf(found, index), index);
    }
    if (const std::optional<double> number = constant(text)) return emit(*number, index);
    refuseDash(index, scope);
    push(node(index));
  }

  void call(std::uint32_t index, const Scoped& scope) {
    const std::string_view name = wordAt(index + 1);
    const bool hasBlock = kind(index + 2) == Kind::block;
    const bool isTexture = hasBlock && textureWords_.contains(name);
    if (const Found found = find(name, scope); found.binding && !isTexture)
      return made(index, found, scope, 0);
    if (!hasBlock && isFunction(name)) return emit(eval(index, scope), index);
    if (hasBlock && name == "group") return copy(index + 2, scope);
    const std::size_t call = open(index);
    push(node(index + 1));
    if (hasBlock || !isTransform(at(index)))
      copy(index + 2, scope);
    else
      transform(index + 2, scope);
    close(call);
  }

  /// The brackets of a transform: a point or an axis among the numbers stands for its three.
  void transform(std::uint32_t tuple, const Scoped& scope) {
    const bool isMatrix = wordAt(tuple - 1) == "transform";
    const std::size_t brackets = open(tuple);
    for (std::uint32_t child = tuple + 1; child < after(tuple);) {
      if (isMatrix || !isComputed(child, scope)) {
        child = item(child, after(tuple), scope, true);
        continue;
      }
      const Value value = kind(child) == Kind::tuple ? grouped(child, scope) : eval(child, scope);
      if (const List* list = value.list())
        for (const Value& number : *list) emit(number, child);
      else
        emit(value, child);
      child = after(child);
    }
    close(brackets);
  }
  /// Is it an expression, rather than an object?
  bool isComputed(std::uint32_t index, const Scoped& scope) const {
    if (kind(index) == Kind::tuple || kind(index) == Kind::expression) return true;
    const bool isCall = kind(index) == Kind::call && kind(index + 2) == Kind::tuple;
    const std::string_view name = wordAt(isCall ? index + 1 : index);
    const Found found = find(name, scope);
    return found.binding ? !isDefinition(*found.binding) : isCall && isFunction(name);
  }

  /// A value in the place of the node `use`.
  void emit(const Value& value, std::uint32_t use) {
    step(use);
    if (const double* number = value.number()) {
      Node made = likeness(use, Kind::number);
      made.number = *number;
      push(made);
    } else if (const Tree* tree = value.tree()) {
      const std::uint32_t at = tree->node;
      const std::string_view name = kind(at) == Kind::call ? wordAt(at + 1) : std::string_view();
      const bool unwraps = (name == Material::kKeyword || name == "group") && kind(at + 2) == Kind::block;
      const Nested nested(calls_);
      if (calls_ > kMostCalls) tooDeep(use);
      copy(unwraps ? at + 2 : at, tree->scope);
    } else if (const List* list = value.list()) {
      const std::size_t tuple = open(likeness(use, Kind::tuple), use);
      for (const Value& element : *list) emit(element, use);
      close(tuple);
    } else {
      Node made = likeness(use, Kind::word);
      made.number = syntax_.spell(value.text() ? *value.text() : *value.truth() ? "true" : "false");
      push(made);
    }
  }

  // --- evaluation ---

  static constexpr int kMostEvaluations = 1000;  // one within another, for the sake of the stack
  struct Nested {
    explicit Nested(int& depth) : depth_(depth) { ++depth_; }
    ~Nested() { --depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;
    int& depth_;
  };

  bool isGrouping(std::uint32_t tuple) const {
    return tuple + 1 < after(tuple) && after(tuple + 1) == after(tuple) &&
           kind(tuple + 1) == Kind::expression;
  }
  /// Of brackets within an expression, which group where they hold one value.
  Value grouped(std::uint32_t tuple, const Scoped& scope) {
    const bool one = tuple + 1 < after(tuple) && after(tuple + 1) == after(tuple);
    return eval(one ? tuple + 1 : tuple, scope);
  }

  static bool isConstant(std::string_view name) { return name == "pi" || name == "tau" || name == "time"; }
  std::optional<double> constant(std::string_view name) const {
    if (name == "pi") return kPi;
    if (name == "tau") return 2 * kPi;
    if (name == "time") return time_.now();
    return {};
  }

  Value eval(std::uint32_t index, const Scoped& scope) {
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
        const Found found = find(name, scope);
        if (found.binding && isTuple && !isDefinition(*found.binding)) return called(index, found, scope);
        if (!found.binding && isTuple && findFunction(name))
          return builtIn(index, *findFunction(name), scope);
        return Tree{index, scope};
      }
      case Kind::block: return Tree{index, scope};
      default: fail(index, "expected a value, found " + describe(at(index)));
    }
  }

  Value listOf(std::uint32_t tuple, const Scoped& scope) {
    List list;
    addItems(tuple, scope, list);
    return list;
  }
  void addItems(std::uint32_t parent, const Scoped& scope, List& list) {
    for (std::uint32_t child = parent + 1; child < after(parent); child = after(child)) {
      if (kind(child) == Kind::loop) {
        const std::uint32_t name = child + 1, source = name + 1, body = after(source);
        const Value all = eval(source, scope);
        if (!all.list()) fail(source, "expected a range such as 0..9 or a list, found " + shown(all));
        const std::uint64_t seed = seedAt(child, *scope);
        for (std::size_t i = 0; i < all.list()->size(); ++i) {
          const auto round = std::make_shared<Scope>(Scope{scope, mixBits(seed ^ i), body});
          round->bindings.push_back({at(name).text(), child, (*all.list())[i]});
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
  void addBranch(std::uint32_t statement, const Scoped& scope, List& list) {
    const std::uint32_t condition = statement + 1, then = after(condition), other = after(then);
    const bool truth = isTrue(grouped(condition, scope), condition);
    if (!truth && other >= after(statement)) return;
    if (!truth && kind(other) == Kind::branch) return addBranch(other, scope, list);
    const std::shared_ptr<Scope> own = inside(truth ? then : other, scope);
    declare(own->block, *own);
    addItems(own->block, own, list);
  }

  Value builtIn(std::uint32_t call, const Function& function, const Scoped& scope) {
    List arguments;
    addItems(call + 2, scope, arguments);
    if (arguments.size() < function.least || arguments.size() > function.most)
      fail(call, "expected " + std::string(function.name) + "(" + std::string(function.parameters) +
                     "), found " + counted(arguments.size(), "argument"));
    std::uint64_t random = seedAt(call, *scope);
    return guarded(call, [&] { return function.call(arguments, random); });
  }

  /// Operands and operators of an expression that are still to come.
  struct Cursor {
    std::vector<std::uint32_t> nodes;
    std::size_t at = 0;
    bool done() const { return at == nodes.size(); }
  };
  static constexpr int kPostfix = 12, kPrefix = 10, kPower = 11;
  static int precedence(Op op) {
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
  Op opAt(std::uint32_t index) const { return static_cast<Op>(static_cast<int>(node(index).number)); }

  /// By precedence climbing. Where it is not `live`, nothing is worked out, and the result means nothing: the
  /// other side of a condition may be a recursion without end.
  Value expression(Cursor& cursor, int least, const Scoped& scope, bool live) {
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

  Value operand(std::uint32_t index, const Scoped& scope) {
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
  std::string nameHint(std::string_view text, Scoped scope) const {
    std::vector<std::string_view> names;
    for (; scope; scope = scope->parent)
      for (const Binding& binding : scope->bindings)
        if (binding.name != text) names.push_back(binding.name);  // it may be the one that is being made
    const std::string hint = didYouMean(text, names);
    return hint.empty() ? "text stands in quotation marks" : hint;
  }

  Value operated(Cursor& cursor, std::uint32_t operation, Op op, int level, Value left, const Scoped& scope,
                 bool live) {
    switch (op) {
      case Op::member:
        return live ? guarded(operation, [&] { return component(left, at(operation).source().back()); })
                    : left;
      case Op::index: {
        if (!live) return left;
        const Value index = grouped(operation + 1, scope);
        return guarded(operation, [&] { return element(left, index); });
      }
      case Op::degrees:
      case Op::radians: return live ? guarded(operation, [&] { return operate(op, left); }) : left;
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

  // --- random numbers ---

  /// For the statement or call: which of its name it is in the block, so that an inserted object moves no
  /// other.
  std::uint64_t seedAt(std::uint32_t index, const Scope& scope) const {
    auto [known, isNew] = ordinals_.try_emplace({scope.block, index}, 0);
    if (isNew) {
      const std::string_view name = nameAt(index);
      for (std::uint32_t i = scope.block; i < index; ++i)
        known->second += kind(i) == kind(index) && nameAt(i) == name;
    }
    std::uint64_t seed = mixBits(scope.seed ^ static_cast<std::uint64_t>(kind(index)));
    for (const char c : nameAt(index)) seed = mixBits(seed ^ static_cast<unsigned char>(c));
    return mixBits(seed ^ known->second);
  }
  std::string_view nameAt(std::uint32_t index) const {
    return kind(index) == Kind::call ? at(index + 1).text() : std::string_view();
  }

  // --- errors ---

  /// Marks what calls or rounds of loops make, for as long as it lives.
  class FrameScope {
   public:
    FrameScope(Expander& expander, std::uint32_t at, std::string what)
        : expander_(expander), index_(expander.frames_.size()) {
      if (++expander_.calls_ > kMostCalls) expander_.tooDeep(at);
      expander_.frames_.push_back({static_cast<std::uint32_t>(expander_.result_.size()), 0,
                                   expander_.node(at).offset, std::move(what)});
      expander_.active_.push_back(index_);
    }
    ~FrameScope() {
      --expander_.calls_;
      expander_.active_.pop_back();
      Syntax::Frame& frame = expander_.frames_[index_];
      frame.end = static_cast<std::uint32_t>(expander_.result_.size());
      if (frame.end == frame.first && index_ + 1 == expander_.frames_.size()) expander_.frames_.pop_back();
    }
    FrameScope(const FrameScope&) = delete;
    FrameScope& operator=(const FrameScope&) = delete;

   private:
    Expander& expander_;
    const std::size_t index_;
  };

  /// The calls and rounds that are being made, the innermost first.
  std::string chain() const {
    constexpr std::size_t kMostFrames = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(kMostFrames, active_.size()); ++i) {
      const Syntax::Frame& frame = frames_[active_[active_.size() - 1 - i]];
      text += (text.empty() ? "in " : ", in ") + frame.what + " at " + placeText(syntax_.place(frame.offset));
    }
    return text;
  }

  [[noreturn]] void fail(std::uint32_t index, std::string what, std::string hint = {}) const {
    const std::string where = chain();
    if (!where.empty()) hint += (hint.empty() ? "" : "; ") + where;
    throw Error(Fault::scene, syntax_.place(node(index).offset), std::move(what), std::move(hint));
  }
  [[noreturn]] void tooDeep(std::uint32_t index) const {
    fail(index,
         "expected at most " + std::to_string(kMostCalls) + " calls and loops within one another, found more",
         "a recursion needs a condition that ends it");
  }
  /// Names the loop or call of which most was made.
  [[noreturn]] void tooMany() const {
    std::map<std::uint32_t, std::pair<std::size_t, std::string>> made;
    for (const Syntax::Frame& frame : frames_) {
      auto& entry = made[frame.offset];
      ++entry.first;
      entry.second = frame.what;
    }
    const auto most = std::max_element(made.begin(), made.end(), [](const auto& a, const auto& b) {
      return a.second.first < b.second.first;
    });
    Place place{syntax_.file(), 0, 0, {}};
    std::string hint;
    if (most != made.end()) {
      place = syntax_.place(most->first);
      hint = "this was done " + std::to_string(most->second.first) + " times, the last one with " +
             most->second.second;
    }
    throw Error(
        Fault::limit, place,
        "expected a scene of at most " + std::to_string(kMostMadeNodes) + " numbers and words, found more",
        hint);
  }
  template <class Work>
  std::invoke_result_t<Work&> guarded(std::uint32_t index, Work&& work) const {
    try {
      return work();
    } catch (const ValueError& error) {
      fail(index, error.what());
    }
  }
  /// "i-1" is one word, since options have dashes in their names.
  void refuseDash(std::uint32_t index, const Scoped& scope) const {
    const std::string_view text = wordAt(index);
    const std::size_t dash = text.find('-');
    if (dash == text.npos || !find(text.substr(0, dash), scope).binding) return;
    fail(index, "no value is called \"" + std::string(text) + "\"",
         "write \"" + std::string(text.substr(0, dash)) + " - " + std::string(text.substr(dash + 1)) +
             "\": names may have dashes in them");
  }

  Syntax& syntax_;
  SceneTime& time_;
  InputFiles& inputs_;
  std::vector<Node> result_;
  std::vector<Syntax::Frame> frames_;
  std::vector<std::size_t> active_;      // frames that are being made
  std::set<std::string_view> reserved_;  // words that are no names
  std::set<std::string_view> textureWords_;
  std::set<std::string> included_;
  std::map<std::uint32_t, std::uint32_t> roots_;  // of included files, by their statements
  mutable std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> ordinals_;
  std::size_t steps_ = 0;
  int depth_ = 0, calls_ = 0, evaluations_ = 0;
};

}  // namespace

void expand(Syntax& syntax, SceneTime& time, InputFiles& inputs) {
  if (syntax.usesLanguage()) Expander(syntax, time, inputs).expand();
}

std::vector<FunctionHelp> functionsOfLanguage() {
  std::vector<FunctionHelp> rows;
  for (const Function& function : functions())
    rows.push_back({function.name, function.parameters, function.help});
  return rows;
}

}  // namespace trace::rayfile
