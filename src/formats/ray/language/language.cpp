#include "formats/ray/language/language.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/nesting.h"
#include "base/text.h"
#include "formats/ray/language/evaluation.h"
#include "formats/ray/read/objects.h"
#include "formats/ray/read/placement.h"
#include "formats/ray/read/texture.h"
#include "math/noise.h"

namespace trace::rayfile {
namespace {

/// Copies the tree, with what statements, names and calls make in their place.
class Expander : Evaluator {
 public:
  Expander(Syntax& syntax, SceneTime& time, InputFiles& inputs, bool instances)
      : Evaluator(syntax, time, inputs), instances_(instances) {
    for (const std::string_view word : textureKinds()) textureWords_.insert(word);
  }

  void expand() {
    const auto scope = std::make_shared<Scope>();
    result_.reserve(syntax_.nodes().size());
    const std::size_t root = open(0);
    declare(0, *scope);
    statements(1, 0, scope, false);
    close(root);
    remarkOnEmptyLoops();  // before the tree that they stand in goes
    syntax_.replace(std::move(result_));
    syntax_.setFrames(std::move(frames_));
    if (uses_.empty()) return;
    std::map<std::uint32_t, Syntax::Root> roots;
    for (const auto& [key, shared] : shared_)
      if (shared.again)
        for (const auto& [node, copied] : shared.copies) roots.emplace(node, copied);
    syntax_.setUses(std::move(uses_), std::move(roots));
  }

 private:
  // --- writing ---

  std::size_t open(std::uint32_t from) { return open(node(from), from); }
  std::size_t open(const Node& made, std::uint32_t from) {
    if ((made.kind == Kind::tuple || made.kind == Kind::block) && ++depth_ > kMostNesting) tooNested(from);
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
  [[noreturn]] void tooNested(std::uint32_t index) const {
    if (calls_ > 0) tooDeep(index, kMostNesting, "objects and calls within one another");
    fail(index, "expected at most " + std::to_string(kMostNesting) + " levels of brackets, found more");
  }
  /// Names the loop or call of which most was made.
  [[noreturn]] void tooMany() const {
    std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> made;  // how many, and the last
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      auto& entry = made[frames_[i].offset];
      ++entry.first;
      entry.second = i;
    }
    const auto most = std::max_element(made.begin(), made.end(), [](const auto& a, const auto& b) {
      return a.second.first < b.second.first;
    });
    SourcePlace place{syntax_.file(), 0, 0, {}};
    std::string hint;
    if (most != made.end()) {
      place = syntax_.place(most->first);
      hint = "this was done " + std::to_string(most->second.first) + " times, the last one with " +
             whatOf(most->second.second) +
             "; rows { } places millions of copies from a file of numbers, and a name for a group of objects "
             "makes each copy a few numbers";
    }
    throw Error(
        Fault::limit, place,
        "expected a scene of at most " + std::to_string(kMostMadeNodes) + " numbers and words, found more",
        hint);
  }

  // --- statements ---

  /// The items of a block or tuple, with what statements make of them in their place.
  void items(std::uint32_t parent, const Scoped& scope, bool isList) {
    for (std::uint32_t child = parent + 1; child < after(parent);)
      child = item(child, after(parent), scope, isList);
  }
  /// Those of a file, or of a body of a definition, loop or condition, from `child` on: one with a mistake is
  /// noted and left out, for the next may have others.
  void statements(std::uint32_t child, std::uint32_t parent, const Scoped& scope, bool isList) {
    while (child < after(parent)) {
      const Mark mark{result_.size(), uses_.size(), frames_.size(), depth_};
      try {
        child = item(child, after(parent), scope, isList);
        continue;
      } catch (const Failure& failure) {
        if (brackets_ > 0 || (failure.deep && calls_ > 0)) throw;
        syntax_.note(failure.mistake);
      } catch (const FailedBefore&) {
        if (brackets_ > 0) throw;
      }
      dropFrom(mark);
      child = after(child);
    }
  }
  struct Mark {
    std::size_t nodes, uses, frames;
    int depth;
  };
  /// Removes the rest of an item with a mistake.
  void dropFrom(const Mark& mark) {
    result_.resize(mark.nodes);
    uses_.resize(mark.uses);
    frames_.resize(mark.frames);
    depth_ = mark.depth;
    const auto start = static_cast<std::uint32_t>(mark.nodes);
    fixed_.erase(fixed_.lower_bound(start), fixed_.end());
    for (auto& [key, shared] : shared_) {
      shared.copies.erase(shared.copies.lower_bound(start), shared.copies.end());
      if (shared.root >= start) shared.size = 0;
    }
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
          statements(withoutHead(root->second), root->second, scope, false);
        return next;
      }
      case Kind::loop: loop(child, scope, isList); return next;
      case Kind::branch: branch(child, scope, isList); return next;
      case Kind::call: {
        const Found found = findCalled(wordAt(child + 1), scope);
        if (!found.binding) break;
        const bool overridden = next < end && node(next).follows && kind(child + 2) == Kind::tuple;
        made(child, found, scope, overridden ? next : 0);
        return overridden ? after(next) : next;
      }
      case Kind::word: {
        const Found found = find(wordAt(child), scope);
        if (found.binding && isStatement(isList)) refuseValue(found, child);
        if (!found.binding || !isDefinition(*found.binding)) break;
        definition(*found.binding, found.scope, child, {}, scope, 0);
        return next;
      }
      case Kind::entry:
        if (isStatement(isList)) refuseAssignment(child, scope);
        break;
      default: break;
    }
    copy(child, scope);
    return next;
  }
  /// An item that stands where the file's own objects do.
  bool isStatement(bool isList) const { return depth_ == 1 && brackets_ == 0 && !isList; }
  /// `n = n + 1`.
  void refuseAssignment(std::uint32_t entry, const Scoped& scope) const {
    const std::string name(wordAt(entry + 1));
    const Found found = find(name, scope);
    if (!found.binding || name == Material::kKeyword || name == "texture") return;
    fail(entry,
         "\"" + name + "\" has its value from " + placeText(syntax_.place(node(found.binding->node).offset)),
         "a name gets its value once; let and another name hold another value");
  }
  /// `let c = a b`.
  void refuseValue(const Found& found, std::uint32_t word) {
    if (isDefinition(*found.binding) || isFunctionLet(*found.binding)) return;
    const Value value = valueOf(found, word);
    if (value.tree() || value.list()) return;
    const std::string name(found.binding->name);
    fail(word, "expected an object, found " + name + ", which is " + shown(value),
         "an operator joins values, as in 2 * " + name + "; (1, " + name + ") is a list");
  }
  /// An included file may have the first words of a scene.
  std::uint32_t withoutHead(std::uint32_t root) const {
    const std::uint32_t first = root + 1;
    if (first >= after(root) || (wordAt(first) != kCourses && wordAt(first) != kKind)) return first;
    if ((wordAt(first) == kKind) != degrees_)
      fail(first,
           "expected a file of the kind " + std::string(degrees_ ? kKind : kCourses) + ", found " +
               std::string(wordAt(first)),
           "angles in the two are of different units; a file without such a first line goes with both");
    const std::uint32_t second = after(first);
    return second < after(root) && kind(second) == Kind::number ? after(second) : second;
  }
  void loop(std::uint32_t statement, const Scoped& scope, bool isList) {
    const std::uint32_t name = statement + 1, source = name + 1, body = after(source);
    checkName(name, Named::value);
    const Value values = eval(source, scope);
    List letters;
    const List& all = needElements(values, letters, source);
    const std::uint64_t seed = seedAt(statement, *scope);
    turns_[statement] += all.size();
    const std::size_t before = result_.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Value& value = all[i];
      const auto round = std::make_shared<Scope>(Scope{scope, mixBits(seed ^ i), body});
      round->bindings.push_back({at(name).text(), statement, value});
      const FrameScope frame(*this, statement, std::string(at(name).text()) + " = " + shown(value));
      block(body, round, isList);
      refuseFlood(i + 1, all.size(), result_.size() - before);
    }
  }
  /// A loop that will make far too much, as its first turns tell: its last ones might make half as much.
  void refuseFlood(std::size_t turns, std::size_t all, std::size_t made) const {
    constexpr std::size_t kSure = kMostMadeNodes / 8;
    if (made > kSure && made / turns > 2 * kMostMadeNodes / all) tooMany();
  }
  /// Loops that were reached and never made a turn. In an animation others may come later.
  void remarkOnEmptyLoops() {
    if (time_.changesScene()) return;
    for (const auto& [statement, turns] : turns_) {
      if (turns > 0) continue;
      const std::uint32_t source = statement + 2;
      const bool isRange = at(source).source().find("..") != std::string_view::npos;
      syntax_.remark({node(source).offset, "this loop makes no turn: " + describe(at(source)) + " is empty",
                      isRange ? "a range ascends, as in 1..5" : ""});
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
  /// The items of the block of a loop or condition, in a group of their own where they set a material.
  void block(std::uint32_t body, const std::shared_ptr<Scope>& scope, bool isList) {
    declare(body, *scope);
    bool sets = false;
    for (std::uint32_t child = body + 1; child < after(body) && !isList; child = after(child))
      sets |= kind(child) == Kind::entry && wordAt(child + 1) == Material::kKeyword;
    const std::size_t group = sets ? open(body) : 0;
    statements(body + 1, body, scope, isList);
    if (sets) close(group);
  }

  // --- calls ---

  /// The nodes that a call of a name makes. `block` overrides what it is made of; 0 for none.
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
             "a block after a name gives the material of its objects");
      copy(child, scope);
    }
  }
  void definition(const Binding& binding, const Scoped& home, std::uint32_t call,
                  const std::vector<std::uint32_t>& arguments, const Scoped& scope, std::uint32_t block) {
    const std::uint32_t parameters = binding.node + 2, body = after(parameters);
    const std::shared_ptr<Scope> own = bound(call, binding.name, parameters, arguments, scope, home, body);
    const FrameScope frame(*this, call, callText(binding.name, *own, own->bindings.size()));
    const std::size_t group = open(likeness(call, Kind::block), call);
    if (block) overriding(block, scope);
    declare(body, *own);
    statements(body + 1, body, own, false);
    close(group);
    unwrap(group);
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
      case Kind::block: {
        const std::size_t group = result_.size();
        inBrackets(index, scope);
        return unwrap(group);
      }
      case Kind::entry: {
        const std::size_t entry = open(index);
        push(node(index + 1));
        value(index + 2, scope);
        return close(entry);
      }
      case Kind::call: return call(index, scope);
      default: fail(index, "expected a value, found " + describe(at(index)));
    }
  }
  /// A value that is no item of a list or group.
  void value(std::uint32_t index, const Scoped& scope) {
    if (kind(index) == Kind::block)
      inBrackets(index, scope);
    else
      copy(index, scope);
  }
  void inBrackets(std::uint32_t index, const Scoped& scope) {
    const bool isList = kind(index) == Kind::tuple;
    const Nested within(brackets_);
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
    if (const Found found = findCalled(name, scope); found.binding && !isTexture)
      return made(index, found, scope, 0);
    if (!hasBlock && isFunction(name)) return emit(eval(index, scope), index);
    if (hasBlock && name == "group") return copy(index + 2, scope);
    const std::size_t call = open(index);
    push(node(index + 1));
    const bool transforms = !hasBlock && isTransform(at(index));
    if (transforms)
      transform(index + 2, scope);
    else
      value(index + 2, scope);
    close(call);
    if (transforms && !uses_.empty()) intoUse(call, name);
  }
  /// The brackets of a transform: a point or an axis among the numbers stands for its three.
  void transform(std::uint32_t tuple, const Scoped& scope) {
    const bool isMatrix = wordAt(tuple - 1) == "transform";
    const Nested within(brackets_);
    const std::size_t brackets = open(tuple);
    for (std::uint32_t child = tuple + 1; child < after(tuple);) {
      if (isMatrix || !isComputed(child, scope)) {
        refuseUnknown(child, scope);
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
  /// A word in the brackets of a transform is a value or an object.
  void refuseUnknown(std::uint32_t index, const Scoped& scope) const {
    const std::string_view text = wordAt(index);
    if (text.empty() || find(text, scope).binding || constant(text)) return;
    refuseDash(index, scope);
    fail(index, "no value is called \"" + std::string(text) + "\"", nameHint(text, scope));
  }
  /// Is it an expression, rather than an object?
  bool isComputed(std::uint32_t index, const Scoped& scope) const {
    if (kind(index) == Kind::tuple || kind(index) == Kind::expression) return true;
    const bool isCall = kind(index) == Kind::call && kind(index + 2) == Kind::tuple;
    const std::string_view name = wordAt(isCall ? index + 1 : index);
    const Found found = isCall ? findCalled(name, scope) : find(name, scope);
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
      if (instances_ && isObjects(at, tree->scope)) return objects(*tree, unwraps ? at + 2 : at, use);
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

  // --- objects that are used again ---

  /// Objects that a name stands for.
  struct Shared {
    Scoped scope;                    ///< keeps the address that is its key
    std::uint32_t root = 0;          ///< the first node that was made of it
    std::size_t size = 0, made = 0;  ///< nodes of one, and of all
    bool again = false;              ///< some use was not copied
    std::map<std::uint32_t, Syntax::Root> copies{};
  };

  /// Is the node, which a name stands for, of objects?
  bool isObjects(std::uint32_t index, const Scoped& scope) const {
    if (kind(index) != Kind::call) return false;
    const std::string_view name = wordAt(index + 1);
    if (name == "group" || isTransform(at(index)) || findShapeType(name)) return true;
    const Found found = findCalled(name, scope);
    return found.binding && isDefinition(*found.binding);
  }
  /// Objects that a name stands for: copied as long as they are few, then as a node of the kind again.
  void objects(const Tree& tree, std::uint32_t from, std::uint32_t use) {
    Shared& shared = shared_[{tree.node, tree.scope.get()}];
    const auto start = static_cast<std::uint32_t>(result_.size());
    if (shared.size > 0 && shared.made + shared.size > kMostCopied) {
      shared.again = true;
      Node made = likeness(use, Kind::again);
      made.number = static_cast<double>(uses_.size());
      uses_.push_back({{}, shared.root});
      push(made);
      return;
    }
    copy(from, tree.scope);
    Shared& now = shared_[{tree.node, tree.scope.get()}];
    const std::size_t size = result_.size() - start;
    if (size == 0) return;
    if (now.size == 0) {
      now.root = start;
      now.size = size;
      now.scope = tree.scope;
    }
    now.made += size;
    now.copies.emplace(
        start, Syntax::Root{now.root, node(use).offset, wordAt(kind(use) == Kind::call ? use + 1 : use)});
    if (result_[start].kind == Kind::again) fixed_.insert(start);
  }
  /// Is the last node one that a transform around it may be made a part of?
  bool endsWithUse(std::size_t index) const {
    return index + 1 == result_.size() && result_[index].kind == Kind::again &&
           !fixed_.contains(static_cast<std::uint32_t>(index));
  }
  /// Takes the place of nodes from there to the last, which is a use.
  void foldUse(std::size_t index) {
    Node use = result_.back();
    result_.resize(index);
    while (!frames_.empty() && frames_.back().first > index && frames_.back().end > 0) frames_.pop_back();
    push(use);
  }
  /// A group of one use is that.
  void unwrap(std::size_t group) {
    if (!uses_.empty() && endsWithUse(group + 1)) foldUse(group);
  }
  /// A transform of one use is a part of it.
  void intoUse(std::size_t call, std::string_view name) {
    if (!endsWithUse(result_.size() - 1) || result_.size() < call + 4) return;
    std::vector<Real> numbers;
    for (std::size_t i = call + 3; i + 1 < result_.size(); ++i) {
      if (result_[i].kind == Kind::number)
        numbers.push_back(result_[i].number);
      else if (result_[i].kind != Kind::tuple || name != "transform")
        return;
    }
    const std::optional<Affine> own = transformOf(name, numbers, degrees_);
    if (!own) return;
    Affine& transform = uses_[static_cast<std::size_t>(result_.back().number)].transform;
    transform = *own * transform;
    foldUse(call);
  }

  /// Names of objects are copied up to so many nodes: a scene of few things is a plain list of them.
  static constexpr std::size_t kMostCopied = 10'000;

  const bool instances_;
  std::map<std::pair<std::uint32_t, const Scope*>, Shared> shared_;
  std::vector<Syntax::Use> uses_;
  std::set<std::uint32_t> fixed_;  ///< uses that are placed again themselves
  std::set<std::string_view> textureWords_;
  std::map<std::uint32_t, std::size_t> turns_;  ///< turns made by each loop that was reached
  int depth_ = 0;
  int brackets_ = 0;  ///< number of brackets of the text around the item, apart from bodies
};

}  // namespace

void expand(Syntax& syntax, SceneTime& time, InputFiles& inputs, bool instances) {
  if (syntax.usesLanguage()) Expander(syntax, time, inputs, instances).expand();
}

std::vector<FunctionHelp> functionsOfLanguage() {
  std::vector<FunctionHelp> rows;
  for (const Function& function : functions())
    rows.push_back({function.name, function.parameters, function.help});
  return rows;
}

}  // namespace trace::rayfile
