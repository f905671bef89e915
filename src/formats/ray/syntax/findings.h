// Findings of reading one .ray file, besides the scene: errors and warnings, each once with its number, nodes
// that are kept but not rendered, and signs of the dialect it was written in.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/kind_defaults.h"
#include "formats/ray/syntax/notes.h"
#include "formats/ray/syntax/syntax.h"
#include "scene/scene.h"

namespace trace::rayfile {

class Findings {
 public:
  /// `notes`, if not null, are filled.
  Findings(const Syntax& syntax, Scene& scene, Messages& messages, Notes* notes)
      : syntax_(syntax), scene_(scene), messages_(messages), notes_(notes) {}

  Scene& scene() { return scene_; }
  const Syntax& syntax() const { return syntax_; }
  Notes* notes() { return notes_; }

  /// Throws at the twentieth. The same error at the same place, as in a loop, becomes one with its number.
  void error(const Item& at, std::string what, std::string hint = {});
  /// `NAME: expected EXPECTED, found VALUE`.
  void expected(const Item& value, std::string_view name, const std::string& what, std::string hint = {});

  /// Mistakes that left items out, as errors of their own.
  void take(std::span<const Syntax::Mistake> mistakes);

  std::size_t errors() const { return errors_; }

  /// The parts that the file gives of its kind's defaults (formats/kind_defaults.h).
  KindGiven& given() { return given_; }
  /// The file is of the kind `Trace 1`: unknown words are errors.
  bool isOfKind() const { return syntax_.isOfKind(); }

  /// Warnings of one kind, which is their text unless given, become one with the place of the first.
  void warn(const Item& at, std::string what, std::string hint = {}, std::string_view kind = {});
  /// A warning that ends in the sum of `count` over the file.
  void warnOfNumber(const Item& at, std::string what, std::size_t count);

  /// Reports an error if the word of other languages asks for another file, or for something to be computed:
  /// it is not known what is lost without it. False for any other word.
  bool refuse(std::string_view word, const Item& at);
  /// Keeps the text of a node as Unrendered, and warns; an error for what is refused. `known` are the words
  /// it may be a misspelling of.
  void notRendered(std::string_view kind, const Item& node, std::span<const std::string_view> known);
  void notRendered(std::string_view kind, const Item& node, std::string text,
                   std::span<const std::string_view> known);
  /// A field that `owner` does not have: not rendered if the format's relatives have it, else ignored.
  void unknownField(std::string_view owner, const Item& field, std::span<const std::string_view> known);

  /// Was a field of that name not known before?
  bool isUnknown(std::string_view owner, std::string_view field) const;

  // The file may be of 2001, whose shininess is from 0 to 1.
  void signOf2001(const Item& at);
  void sureSignOf2005() { later_ = true; }
  /// `shininess` of a material with a highlight.
  void noteShininess(const Item& at, double shininess);

  /// Hands over the errors, the warnings and what follows from the dialect.
  void finish();

 private:
  struct Warning {
    SourcePlace place;
    std::string what, hint;
    std::size_t times = 0;
    bool sums = false;
  };
  struct Failure {
    std::size_t offset;
    std::string what, hint;
    std::size_t times = 1;
    bool leavesOut = false;  ///< errors behind it on its line may be of what is missing
  };
  /// The warning of that kind if there was one before; it is then counted once more.
  bool again(const std::string& kind);
  void add(const std::string& kind, const Item& at, std::string what, std::string hint);
  void finishDialect();
  void dropFollowing();
  void reportErrors();

  const Syntax& syntax_;
  Scene& scene_;
  Messages& messages_;
  Notes* notes_;
  KindGiven given_;
  std::vector<Failure> failures_;
  std::vector<Warning> warnings_;
  std::map<std::string, std::size_t, std::less<>> kinds_;

  std::optional<SourcePlace> of2001_, smallShininess_;
  std::size_t errors_ = 0;
  bool later_ = false;  ///< than 2001
  bool largeShininess_ = false;
};

/// Warns of the fields of a block that are given again.
class RepeatedFields {
 public:
  RepeatedFields(Findings& findings, std::string_view owner) : findings_(findings), owner_(owner) {}
  void note(const Item& field);

 private:
  Findings& findings_;
  std::string_view owner_;
  std::vector<std::string_view> given_;
};

/// The block of `name { ... }`; reports other brackets.
std::optional<Item> blockOf(Findings& findings, const Item& call);
/// Reports an item that is no field.
bool isField(Findings& findings, const Item& item, std::string_view owner);

/// Does `keyword` belong to a relative of the format, so that "did you mean" would be wrong?
bool isRelative(std::string_view keyword);

}  // namespace trace::rayfile
