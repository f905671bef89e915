// Names of the language of scenes (ray_language.h): which are known where, what they stand for, and the calls
// and rounds of loops that are under way, for messages. The base of what works out values (ray_evaluation.h).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "formats/ray/language/value.h"
#include "formats/ray/syntax/syntax.h"
#include "scene/input_files.h"

namespace trace::rayfile {

/// A name and what it stands for.
struct Binding {
  std::string_view name;
  std::uint32_t node = 0;  ///< the let, define or loop
  /// The value of a parameter or loop; of a let without parameters, once it was asked for.
  std::optional<Value> value{};
  bool isActive = false;  ///< its value is being computed, and does not see itself
  bool failed = false;    ///< its value has a mistake, which was noted
};

/// The names of one block, of one call or of one round of a loop.
struct Scope {
  std::shared_ptr<const Scope> parent{};
  std::uint64_t seed = 0;       ///< seed of its random numbers
  std::uint32_t block = 0;      ///< whose random numbers are counted together
  std::string_view hides = {};  ///< the name whose value is being made: it does not see itself
  mutable std::vector<Binding> bindings{};
};

using Scoped = std::shared_ptr<const Scope>;

class Names {
 public:
  Names(Syntax& syntax, InputFiles& inputs);
  ~Names();
  Names(const Names&) = delete;
  Names& operator=(const Names&) = delete;

 protected:
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

  /// Counts what is done, and hears the budget. Throws Error(Fault::limit) for more than kMostSteps.
  void step(std::uint32_t index);

  // --- names ---

  /// All names of a block, before anything of it is computed.
  void declare(std::uint32_t block, Scope& scope);
  /// Words of statements and constants are no names. Words that begin an object, such as `rows`, name values
  /// only: behind them, brackets make the object.
  enum class Named { value, call };
  void checkName(std::uint32_t name, Named what) const;

  struct Found {
    Binding* binding = nullptr;
    Scoped scope{};
  };
  /// The innermost binding of the name that is seen from there.
  Found find(std::string_view name, const Scoped& from) const;
  /// The definition of a name with brackets behind it.
  Found findCalled(std::string_view name, const Scoped& from) const {
    return objects_.contains(name) ? Found{} : find(name, from);
  }
  /// The word means an object or the like with brackets behind it.
  bool beginsObject(std::string_view word) const { return objects_.contains(word); }
  bool isFunctionLet(const Binding& binding) const {
    return !binding.value && kind(binding.node) == Kind::let && kind(binding.node + 2) == Kind::tuple &&
           after(binding.node + 2) < after(binding.node);
  }
  bool isDefinition(const Binding& binding) const {
    return !binding.value && kind(binding.node) == Kind::define;
  }
  /// A suggestion for an unknown name.
  std::string nameHint(std::string_view text, Scoped scope) const;
  /// "i-1" is one word, since options have dashes in their names.
  void refuseDash(std::uint32_t index, const Scoped& scope) const;
  /// The scope of a block.
  std::shared_ptr<Scope> inside(std::uint32_t block, const Scoped& scope) const;
  /// For the statement or call: which of its name it is in the block, so that an inserted object moves no
  /// other.
  std::uint64_t seedAt(std::uint32_t index, const Scope& scope) const;

  /// A value that holds a part of the file holds the scope of that part, which may be the one that holds the
  /// value: such rings are opened at the end.
  void noteRing(const Scoped& scope, const Value& value);

  // --- errors ---

  /// Counts what lies within itself.
  struct Nested {
    explicit Nested(int& depth) : depth_(depth) { ++depth_; }
    ~Nested() { --depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;
    int& depth_;
  };
  /// Marks what calls or rounds of loops make, for as long as it lives.
  class FrameScope {
   public:
    FrameScope(Names& names, std::uint32_t at, std::string what);
    /// For a function. Its text is made only where a message or a node needs it.
    FrameScope(Names& names, std::uint32_t at, std::string_view function, const Scope& own);
    ~FrameScope();
    FrameScope(const FrameScope&) = delete;
    FrameScope& operator=(const FrameScope&) = delete;

    std::size_t index() const { return index_; }
    std::string what() const;

   private:
    Names& names_;
    const std::size_t index_;
    std::string_view function_{};
    const Scope* own_ = nullptr;
    std::size_t parameters_ = 0;
  };
  /// "gear(teeth = 12)", of the first `parameters` names of the call's scope.
  static std::string callText(std::string_view name, const Scope& own, std::size_t parameters);
  /// The text of a frame.
  std::string whatOf(std::size_t frame) const;
  /// Thrown by fail(). `deep`: a recursion without an end, of which no part is made.
  struct Failure {
    Syntax::Mistake mistake;
    bool deep = false;
  };
  /// Thrown where a name is used whose value has a mistake that was noted.
  struct FailedBefore {};
  /// The calls and rounds that are being made, the innermost first; a recursion is one.
  std::string chain() const;
  [[noreturn]] void fail(std::uint32_t index, std::string what, std::string hint = {}) const;
  /// So many `levels` of calls and the like.
  [[noreturn]] void tooDeep(std::uint32_t index, int most, const std::string& levels) const;
  [[noreturn]] void tooDeep(std::uint32_t index) const;
  /// Gives a ValueError its place.
  template <class Work>
  std::invoke_result_t<Work&> guarded(std::uint32_t index, Work&& work) const {
    try {
      return work();
    } catch (const ValueError& error) {
      fail(index, error.what());
    }
  }

  Syntax& syntax_;
  InputFiles& inputs_;
  std::vector<Node> result_;  // the tree that is being made
  std::vector<Syntax::Frame> frames_;
  std::vector<const FrameScope*> active_;         // frames that are being made
  std::map<std::uint32_t, std::uint32_t> roots_;  // roots of included files, by their statements
  int calls_ = 0;

 private:
  void add(std::uint32_t statement, Scope& scope);
  void include(std::uint32_t statement, Scope& scope);
  std::string_view nameAt(std::uint32_t index) const;

  std::set<std::string_view> reserved_;  // words that are no names
  std::set<std::string_view> objects_;   // words that mean something with brackets behind them
  std::set<std::string> included_;
  std::vector<Scoped> rings_;
  mutable std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> ordinals_;
  std::size_t steps_ = 0;
};

}  // namespace trace::rayfile
