// The grammar of .ray scene files, apart from their meaning: text in, a tree of numbers, words, tuples,
// blocks, entries and calls out. The first step in the life of a picture. Where the text uses the language of
// scenes (docs/language.md), its statements and expressions are nodes too, and expand() (ray_language.h)
// makes the plain tree of them.
//
// One lenient grammar takes both dialects, the dictionaries of 2001 and the tokens of 2005 on
// (docs/ray-format.md): separators `;` and `,` may be left out or repeated, and `name "foo"`
// needs no `=`. The tree is a flat preorder tape, one small record per node and no allocation for any of
// them, since a mesh has a million numbers. Time and memory are linear in the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "math/transform.h"

namespace trace::rayfile {

enum class Kind : std::uint8_t {
  number,
  word,   ///< an identifier or a "string": the grammar makes no difference
  tuple,  ///< ( items )
  block,  ///< { items }
  entry,  ///< key = value: two children
  call,   ///< name { } or name( ): two children, the name and a block or tuple
  // The language, of which expand() leaves nothing:
  expression,  ///< operands and the operators between them, in the order of the text
  op,          ///< an operator, whose Op is `number`; Op::index has a tuple as its child
  let,         ///< name, a tuple of parameters if it is a function, value
  define,      ///< name, tuple of parameters, block
  loop,        ///< name, what it runs through, block
  branch,      ///< condition, block, and for `else` a block or branch
  include,     ///< the name of a file
  // expand() makes these of a name of objects that is used often:
  again,  ///< objects that are a node of the tree already: `number` is an index into Syntax::uses()
};

enum class Op : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,
  power,
  less,
  atMost,
  more,
  atLeast,
  equal,
  unequal,
  both,
  either,
  negate,
  invert,  // before an operand
  member,
  index,
  degrees,
  radians,  // behind one; the component is the last letter of the node's text
  range,
  choose,
  otherwise,
};

struct Node {
  double number = 0;
  std::uint32_t offset = 0;  ///< offset of its first byte in the source
  std::uint32_t length = 0;  ///< length of its source text in bytes
  std::uint32_t end = 0;     ///< index of the first node after its subtree
  Kind kind = Kind::number;
  bool quoted = false;   ///< a quoted word
  bool follows = false;  ///< a block with nothing between it and the call before
  /// A word that no text of the file says is number - 1 of Syntax::spelled; 0 for others.
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
  /// Reads another file into the tree, behind all nodes. Returns its block of items. Throws as the
  /// constructor.
  std::uint32_t include(std::string file, std::string source);
  Syntax(const Syntax&) = delete;
  Syntax& operator=(const Syntax&) = delete;

  /// All items of the file, as one block.
  Item root() const;
  /// The outermost item that begins there; the first of several that a loop has made.
  std::optional<Item> itemAt(std::size_t offset) const;
  std::span<const Node> nodes() const { return nodes_; }
  /// The syntax of the file itself, without what it includes.
  std::string_view source() const { return sources_.front().text; }
  /// The position of the node in its file.
  std::string_view textOf(const Node& node) const {
    const Source& source = sourceOf(node.offset);
    return source.text.substr(node.offset - source.base, node.length);
  }
  /// Is there a call of kKey?
  bool hasKeys() const { return hasKeys_; }
  /// Is there a statement or an expression?
  bool usesLanguage() const { return usesLanguage_; }
  /// Does the file begin with `Trace 1`? Then its angles are in degrees.
  bool isOfKind() const;
  /// Remarks on the text itself, or on what was made of it.
  struct Remark {
    std::uint32_t offset;
    std::string what, hint;
  };
  void remark(Remark remark) { remarks_.push_back(std::move(remark)); }
  const std::vector<Remark>& remarks() const { return remarks_; }
  /// An error in a statement or an expression. The tree lacks the item that has it.
  struct Mistake {
    std::uint32_t offset;
    std::string what, hint;
    std::size_t times = 1;
  };
  /// Throws Error with all mistakes at the twentieth, or where one is made again and again.
  void note(Mistake mistake);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }
  /// Throws Error with all mistakes, in the order of the text, if there are any.
  void throwMistakes() const;
  /// A tree that replace() took over has calls of kKey.
  void noteKeys() { hasKeys_ = true; }
  /// Takes another tree over the same source.
  void replace(std::vector<Node> nodes) {
    nodes_ = std::move(nodes);
    byOffset_.clear();
  }
  /// For nodes of words that no file has: what such a node holds as its number.
  double spell(std::string word) {
    spelled_.push_back(std::move(word));
    return static_cast<double>(spelled_.size());
  }
  const std::string& spelled(double number) const { return spelled_[static_cast<std::size_t>(number) - 1]; }
  const std::string& file() const { return sources_.front().name.str(); }

  /// Nodes that one call of a definition or one round of a loop made.
  struct Frame {
    std::uint32_t first, end;  ///< range of the nodes
    std::uint32_t offset;      ///< offset of the call or loop
    std::string what;          ///< "gear(teeth = 12)", "i = 3"
  };
  /// Sorted by `first`; they nest.
  void setFrames(std::vector<Frame> frames) { frames_ = std::move(frames); }
  /// Objects that are placed once more.
  struct Use {
    Affine transform{};      ///< transform of the objects
    std::uint32_t root = 0;  ///< the node that has them
  };
  /// A node that stands in the tree and is placed more often: the first one, or a copy of it.
  struct Root {
    std::uint32_t root = 0;
    std::uint32_t offset = 0;  ///< offset of the name that placed it
    std::string_view name{};
  };
  const std::vector<Use>& uses() const { return uses_; }
  /// Null if the node is none.
  const Root* rootAt(std::uint32_t node) const {
    if (roots_.empty()) return nullptr;
    const auto found = roots_.find(node);
    return found == roots_.end() ? nullptr : &found->second;
  }
  void setUses(std::vector<Use> uses, std::map<std::uint32_t, Root> roots) {
    uses_ = std::move(uses);
    roots_ = std::move(roots);
  }
  /// The calls and rounds that made the node, the innermost first: "in gear(teeth = 12) at line 7, ..."; ""
  /// if the file has it itself.
  std::string chain(std::uint32_t node) const;

  /// With the whole line of text.
  SourcePlace place(std::size_t offset) const;
  /// The offset of a place in this file, which place() made. Precondition: it is one.
  std::size_t offsetOf(const SourcePlace& place) const {
    return sources_.front().lineStarts[static_cast<std::size_t>(place.line) - 1] +
           static_cast<std::size_t>(place.column) - 1;
  }
  /// Without the text of a long line, to be kept in numbers.
  SourcePlace shortPlace(std::size_t offset) const;
  /// Without any text, to be kept by the million.
  SourcePlace numberedPlace(std::size_t offset) const { return place(offset, 0); }

 private:
  friend class Parser;
  /// A file; its bytes have the offsets from `base` on.
  struct Source {
    FileName name;
    std::string owned;
    std::string_view text;
    std::uint32_t base = 0;
    std::vector<std::uint32_t> lineStarts{0};  ///< from the file's own start
  };
  struct Line {
    std::size_t number, start, end;  ///< from the file's own start
  };
  void parse(Source& source);
  const Source& sourceOf(std::size_t offset) const {
    const Source& file = sources_.front();
    return offset <= file.text.size() ? file : includedSource(offset);
  }
  const Source& includedSource(std::size_t offset) const;
  static Line line(const Source& source, std::size_t at);
  SourcePlace place(std::size_t offset, std::size_t longestLine) const;

  std::deque<Source> sources_;  // the file itself, then what it includes
  std::vector<Node> nodes_;
  mutable std::vector<std::uint32_t> byOffset_;  ///< nodes in the order of the text; made by itemAt()
  std::deque<std::string> spelled_;
  std::vector<Frame> frames_;
  std::vector<Use> uses_;
  std::map<std::uint32_t, Root> roots_;
  std::vector<Remark> remarks_;
  std::vector<Mistake> mistakes_;
  bool hasKeys_ = false, usesLanguage_ = false;
};

/// The first word of the two kinds of file.
inline constexpr std::string_view kCourses = "SBT-raytracer", kKind = "Trace";

/// Has the language a function of that name?
bool isFunction(std::string_view name);

/// A node of a Syntax; two words, passed by value.
class Item {
 public:
  Item(const Syntax& syntax, std::uint32_t index) : syntax_(&syntax), index_(index) {}

  const Syntax& syntax() const { return *syntax_; }
  std::uint32_t index() const { return index_; }  ///< index of its node
  Kind kind() const { return node().kind; }
  bool is(Kind kind) const { return node().kind == kind; }
  double number() const { return node().number; }
  std::size_t offset() const { return node().offset; }
  /// The node as the file has it; of a word that no file has, that word.
  std::string_view source() const {
    if (is(Kind::word) && node().number > 0) return syntax_->spelled(node().number);
    return syntax_->textOf(node());
  }
  /// The calls and rounds of loops that made it (Syntax::chain).
  std::string chain() const { return syntax_->chain(index_); }
  /// A word without its quotes.
  std::string_view text() const {
    const std::string_view text = source();
    return node().quoted ? text.substr(1, text.size() - 2) : text;
  }

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
  std::size_t count() const {
    std::size_t n = 0;
    for (Iterator child = begin(); child != end(); ++child) ++n;
    return n;
  }

 private:
  const Node& node() const { return syntax_->nodes()[index_]; }

  const Syntax* syntax_;
  std::uint32_t index_;
};

/// The text after white space, comments and a byte order mark.
std::string_view skipBlanks(std::string_view source);

/// The text that a message says was found: the item's own text if it is short, else a sketch of it.
std::string describe(const Item& item);

}  // namespace trace::rayfile
