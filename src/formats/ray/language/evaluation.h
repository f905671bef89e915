// Values of the language of scenes (ray_language.h): what expressions, names and calls of functions come to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/language/scope.h"
#include "formats/scene_time.h"

namespace trace::rayfile {

class Evaluator : protected Names {
 public:
  Evaluator(Syntax& syntax, SceneTime& time, InputFiles& inputs)
      : Names(syntax, inputs), degrees_(syntax.isOfKind()), time_(time) {}

 protected:
  /// The value of a node.
  Value eval(std::uint32_t index, const Scoped& scope);
  /// The value of brackets within an expression, which group where they hold one value.
  Value grouped(std::uint32_t tuple, const Scoped& scope);
  bool isTrue(const Value& value, std::uint32_t index);
  /// The value of a name that takes no arguments.
  Value valueOf(const Found& found, std::uint32_t use);
  /// The value of a call of a function that the scene defines.
  Value called(std::uint32_t call, const Found& found, const Scoped& scope);
  /// A scope in which the parameters have the values of the arguments, by place or by name.
  std::shared_ptr<Scope> bound(std::uint32_t call, std::string_view name, std::uint32_t parameters,
                               const std::vector<std::uint32_t>& arguments, const Scoped& scope,
                               const Scoped& home, std::uint32_t body);
  /// The elements that a loop goes through; fails at its `source` if there are none.
  const List& needElements(const Value& value, List& letters, std::uint32_t source) const;
  bool isGrouping(std::uint32_t tuple) const {
    return tuple + 1 < after(tuple) && after(tuple + 1) == after(tuple) &&
           kind(tuple + 1) == Kind::expression;
  }
  std::optional<double> constant(std::string_view name) const;

  const bool degrees_;  ///< is that the unit of angles? else radians
  SceneTime& time_;

 private:
  Value listOf(std::uint32_t tuple, const Scoped& scope);
  void addItems(std::uint32_t parent, const Scoped& scope, List& list);
  void addBranch(std::uint32_t statement, const Scoped& scope, List& list);
  /// Fails for a call of numbers that nothing is called.
  void refuseUnknownFunction(std::uint32_t call, const Scoped& scope) const;
  Value builtIn(std::uint32_t call, const Function& function, const Scoped& scope);

  /// Operands and operators of an expression that are still to come.
  struct Cursor {
    std::vector<std::uint32_t> nodes;
    std::size_t at = 0;
    bool done() const { return at == nodes.size(); }
  };
  Op opAt(std::uint32_t index) const { return static_cast<Op>(static_cast<int>(node(index).number)); }
  /// By precedence climbing. Where it is not `live`, nothing is computed, and the result means nothing: the
  /// other side of a condition may be a recursion infinite.
  Value expression(Cursor& cursor, int least, const Scoped& scope, bool live);
  Value operand(std::uint32_t index, const Scoped& scope);
  Value operated(Cursor& cursor, std::uint32_t operation, Op op, int level, Value left, const Scoped& scope,
                 bool live);

  int evaluations_ = 0;
};

}  // namespace trace::rayfile
