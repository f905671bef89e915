// Changes of the text of a .ray file that touch nothing else: comments, layout and the order of things stay.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/read/fields.h"
#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

/// The place behind the item.
inline std::size_t endOf(const Item& item) { return item.offset() + item.source().size(); }

/// Whether a number or list is the value of a name or an expression, and stands nowhere as it is.
bool isComputed(const Item& value);

/// The last field of that keyword in a block, or its synonym, which is the one that counts.
std::optional<Item> fieldOf(const Item& block, std::string_view keyword);

class TextEdits {
 public:
  explicit TextEdits(const Syntax& syntax);

  const Syntax& syntax() const { return syntax_; }

  /// Throws Error(Fault::scene) for a place that is not in the file itself, but in one that it includes.
  void replace(std::size_t begin, std::size_t end, std::string text);
  void replace(const Item& item, std::string text) {
    replace(item.offset(), item.offset() + item.source().size(), std::move(text));
  }
  void insert(std::size_t at, std::string text) { replace(at, at, std::move(text)); }

  /// Makes of a value what `text` says. Numbers, words and lists that are equal stay as they are written.
  void change(const Item& value, const std::string& text);
  /// Adds a field as the last one of a block. `field` is `name = value`.
  void addField(const Item& block, const std::string& field);
  /// Takes out the item and its separator, and the line if nothing else stands there.
  void erase(const Item& item);
  /// A line of its own after the first words of the file, and after the comment that stands at its head.
  void addOnTop(std::string line);
  /// At the end of the file.
  void append(std::string text) { appended_ += std::move(text); }

  /// The blanks at the start of the line there.
  std::string_view indentAt(std::size_t at) const;

  /// Values of `key(...)` that became a number or list of numbers.
  const std::vector<std::size_t>& lostKeys() const { return lostKeys_; }
  /// Names and expressions that became a value.
  const std::vector<Item>& lostExpressions() const { return lostExpressions_; }

  bool empty() const { return edits_.empty() && fields_.empty() && appended_.empty(); }
  std::string text() const { return text(0, syntax_.source().size()) + tail(); }
  /// The part of the text between these places, changed.
  std::string text(std::size_t begin, std::size_t end) const;

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };

  bool isBlank(std::size_t begin, std::size_t end) const;
  std::size_t lineStart(std::size_t at) const;
  std::size_t lineEnd(std::size_t at) const;  ///< before its line break
  /// Behind the blank line that ends the comment lines behind the line that ends there; nothing without one.
  std::optional<std::size_t> endOfHead(std::size_t line) const;
  std::vector<Edit> edits() const;
  Edit addition(const Item& block, const std::vector<std::string>& fields) const;
  std::string tail() const;
  /// With the file's line breaks.
  std::string broken(std::string_view text) const;

  const Syntax& syntax_;
  std::string_view source_;
  std::string lineBreak_ = "\n";
  std::vector<Edit> edits_;
  std::map<std::size_t, std::pair<Item, std::vector<std::string>>> fields_;
  std::string appended_;
  std::vector<std::size_t> lostKeys_;
  std::vector<Item> lostExpressions_;
};

/// The text with line breaks after fields where a line would be too long; `indent` begins the new ones.
std::string laidOut(std::string_view text, std::string_view indent);

/// Makes the field of the block say the text, or adds it; erases it where the text is empty.
void sayField(TextEdits& edits, const Item& block, std::string_view keyword, const std::string& text);
template <class Value>
void changeField(TextEdits& edits, const Item& block, std::string_view keyword, const Value& value) {
  if constexpr (std::is_same_v<Value, Real>)
    if (value == kNoLimit) return sayField(edits, block, keyword, {});  // what there is without it
  sayField(edits, block, keyword, written(value, 0));
}

/// Changes the fields of a block in which two structs differ. Objects and materials are changed elsewhere.
template <class Struct>
void changeFields(TextEdits& edits, const Item& block, const Struct& from, const Struct& to) {
  forEachField<Struct>([&](const auto& f) {
    const auto& value = to.*f.member;
    if (from.*f.member != value) changeField(edits, block, f.keyword, value);
  });
}
/// Edits of shapes or lights of one type.
void changeFields(TextEdits& edits, const Item& block, const Shape& from, const Shape& to);
void changeFields(TextEdits& edits, const Item& block, const Light& from, const Light& to);

}  // namespace trace::rayfile
