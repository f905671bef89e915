// A value typed into a field takes effect when the field is left, by Enter or for another; Esc restores the
// old one. A window shows the value as it was until then, and tells in every frame what the text says.
#pragma once

#include <map>
#include <optional>
#include <utility>

namespace trace {

template <class Value>
class TypedValue {
 public:
  /// For each frame, counted by `frame`, in which the field is drawn. `typing`: it takes text now; `text`:
  /// what that says, if it is not the value as it was. Returns the value to be taken over, if any.
  std::optional<Value> update(unsigned field, int frame, bool typing, bool escaped,
                              std::optional<Value> text) {
    if (typing) {
      typed_[field] = {std::move(text), frame};
      return {};
    }
    const auto found = typed_.find(field);
    if (found == typed_.end()) return {};
    const Typed last = std::move(found->second);
    typed_.erase(found);
    if (escaped || last.frame + 1 < frame) return {};  // a field that was hidden meanwhile begins anew
    return text ? std::move(text) : last.value;
  }
  /// The field was typed into in the frame before.
  bool holds(unsigned field) const { return typed_.contains(field); }

 private:
  struct Typed {
    std::optional<Value> value;
    int frame = 0;
  };
  std::map<unsigned, Typed> typed_;
};

}  // namespace trace
