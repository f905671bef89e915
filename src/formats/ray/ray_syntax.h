// The grammar of .ray scene files, apart from their meaning: text in, a tree of numbers, words, tuples,
// blocks, entries and calls out. The first step in the life of a picture.
//
// One lenient grammar takes both dialects, the dictionaries of 2001 and the tokens of 2005 on
// (docs/ray-format.md): separators `;` and `,` may be left out or repeated, and `name "foo"`
// needs no `=`. The tree is a flat preorder tape, one small record per node and no allocation for any of
// them, since a mesh has a million numbers. Time and memory are linear in the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace trace::rayfile {

enum class Kind : std::uint8_t {
  number,
  word,   ///< an identifier or a "string": the grammar makes no difference
  tuple,  ///< ( items )
  block,  ///< { items }
  entry,  ///< key = value: two children
  call,   ///< name { } or name( ): two children, the name and a block or tuple
};

struct Node {
  double number = 0;
  std::uint32_t offset = 0;  ///< of its first byte in the source
  std::uint32_t length = 0;  ///< of its source text in bytes
  std::uint32_t end = 0;     ///< index of the first node after its subtree
  Kind kind = Kind::number;
  bool quoted = false;  ///< of a word
};

class Item;

/// A parsed file. Refers to the bytes it was made from.
class Syntax {
 public:
  /// A string or identifier may have this many bytes.
  static constexpr std::size_t kLongestWord = 4096;
  /// The call that stands for a value that changes with time (ray_keys.h).
  static constexpr std::string_view kKey = "key";

  /// Throws Error(Fault::scene) where the text is not of the grammar, or holds a number that is not finite.
  Syntax(std::string file, std::string_view source);
  Syntax(const Syntax&) = delete;
  Syntax& operator=(const Syntax&) = delete;

  /// All items of the file, as one block.
  Item root() const;
  /// The outermost item that begins there.
  std::optional<Item> itemAt(std::size_t offset) const;
  std::span<const Node> nodes() const { return nodes_; }
  std::string_view source() const { return source_; }
  /// Is there a call of kKey?
  bool hasKeys() const { return hasKeys_; }
  /// Takes another tree over the same source.
  void replace(std::vector<Node> nodes) {
    nodes_ = std::move(nodes);
    hasKeys_ = false;
  }
  const std::string& file() const { return file_; }

  /// With the whole line of text.
  Place place(std::size_t offset) const;
  /// The offset of a place in this file, which place() made. Precondition: it is one.
  std::size_t offsetOf(const Place& place) const {
    return lineStarts_[static_cast<std::size_t>(place.line) - 1] + static_cast<std::size_t>(place.column) - 1;
  }
  /// Without the text of a long line, to be kept in numbers.
  Place shortPlace(std::size_t offset) const;

 private:
  friend class Parser;
  struct Line {
    std::size_t number, start, end;
  };
  Line line(std::size_t offset) const;

  std::string file_;
  std::string_view source_;
  std::vector<std::uint32_t> lineStarts_;
  std::vector<Node> nodes_;
  bool hasKeys_ = false;
};

/// A node of a Syntax; two words, passed by value.
class Item {
 public:
  Item(const Syntax& syntax, std::uint32_t index) : syntax_(&syntax), index_(index) {}

  Kind kind() const { return node().kind; }
  bool is(Kind kind) const { return node().kind == kind; }
  double number() const { return node().number; }
  std::size_t offset() const { return node().offset; }
  /// The node as the file has it.
  std::string_view source() const { return syntax_->source().substr(node().offset, node().length); }
  /// A word without its quotes.
  std::string_view text() const;

  /// Is it an entry, or a call with a block or tuple?
  bool keyed() const { return is(Kind::entry) || is(Kind::call); }
  /// Precondition of both: keyed().
  std::string_view key() const { return Item(*syntax_, index_ + 1).text(); }
  Item value() const { return {*syntax_, index_ + 2}; }

  class Iterator {
   public:
    Iterator(const Syntax& syntax, std::uint32_t index) : syntax_(&syntax), index_(index) {}
    Item operator*() const { return {*syntax_, index_}; }
    Iterator& operator++() {
      index_ = syntax_->nodes()[index_].end;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    const Syntax* syntax_;
    std::uint32_t index_;
  };
  Iterator begin() const { return {*syntax_, index_ + 1}; }
  Iterator end() const { return {*syntax_, node().end}; }
  /// How many children it has. Linear in them.
  std::size_t count() const;

 private:
  const Node& node() const { return syntax_->nodes()[index_]; }

  const Syntax* syntax_;
  std::uint32_t index_;
};

/// The text after white space, comments and a byte order mark.
std::string_view skipBlanks(std::string_view source);

/// What a message says was found: the item's own text if it is short, else a sketch of it.
std::string describe(const Item& item);

}  // namespace trace::rayfile
