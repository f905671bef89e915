#include "formats/ray/ray_syntax.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "base/nesting.h"
#include "base/text.h"

namespace trace::rayfile {
namespace {

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordPart(char c) { return isLetter(c) || isDigit(c) || c == '-'; }
bool startsNumber(char c) { return isDigit(c) || c == '-' || c == '+' || c == '.'; }

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::size_t kNone = std::string_view::npos;

/// The offset of the first byte at or after `at` that is neither white space nor comment. A block comment
/// that is never closed ends the skipping at its start, with `unclosed` set.
std::size_t skipBlanks(std::string_view source, std::size_t at, bool& unclosed) {
  for (;;) {
    while (at < source.size() && isBlank(source[at])) ++at;
    if (at == source.size() || source[at] != '/') return at;
    const std::string_view two = source.substr(at, 2);
    if (two == "//") {
      at = std::min(source.find('\n', at), source.size());
    } else if (two == "/*") {
      const std::size_t end = source.find("*/", at + 2);
      if (end == kNone) {
        unclosed = true;
        return at;
      }
      at = end + 2;
    } else {
      return at;
    }
  }
}

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string shown(char c) {
  if (c >= ' ' && c <= '~') return quoted({&c, 1});
  char text[16];
  std::snprintf(text, sizeof text, "byte 0x%02x", static_cast<unsigned char>(c));
  return text;
}

}  // namespace

/// Writes the tape of one Syntax: recursive descent, one character of lookahead after a word.
class Parser {
 public:
  explicit Parser(Syntax& syntax) : syntax_(syntax), source_(syntax.source_), nodes_(syntax.nodes_) {}

  void file() {
    if (source_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    const std::uint32_t root = open(Kind::block, 0);
    items(0, '\0');
    close(root);
  }

 private:
  // --- reading characters ---

  char peek() const { return at_ < source_.size() ? source_[at_] : '\0'; }
  bool atEnd() const { return at_ >= source_.size(); }

  void blanks() {
    if (!isBlank(peek()) && peek() != '/') return;
    bool unclosed = false;
    at_ = skipBlanks(source_, at_, unclosed);
    if (unclosed) fail(at_, "expected \"*/\", found the end of the file", "this comment is never closed");
  }
  void separators() {
    for (blanks(); peek() == ';' || peek() == ','; blanks()) ++at_;
  }

  // --- writing nodes ---

  std::uint32_t open(Kind kind, std::size_t offset) {
    Node node;
    node.kind = kind;
    node.offset = static_cast<std::uint32_t>(offset);
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  void close(std::uint32_t index) {
    nodes_[index].length = static_cast<std::uint32_t>(at_ - nodes_[index].offset);
    nodes_[index].end = static_cast<std::uint32_t>(nodes_.size());
  }
  /// Puts a parent before the word just written.
  std::uint32_t openAround(std::uint32_t word, Kind kind) {
    nodes_.push_back(nodes_[word]);
    nodes_.back().end = static_cast<std::uint32_t>(nodes_.size());
    nodes_[word].kind = kind;
    nodes_[word].quoted = false;
    return word;
  }

  // --- the grammar ---

  /// Items up to the bracket that closes the one at `opened`, or up to the end of the file.
  void items(std::size_t opened, char closing) {
    for (;;) {
      separators();
      if (atEnd()) {
        if (closing) failUnclosed(opened, closing);
        return;
      }
      if (closing && peek() == closing) {
        ++at_;
        return;
      }
      if (peek() == ')' || peek() == '}') failMismatch(opened, closing);
      item();
    }
  }

  void item() {
    if (!startsWord()) return value("an object, a field or a value");
    const std::uint32_t word = this->word();
    const std::size_t end = at_;
    blanks();
    if (peek() == '=') {
      const std::uint32_t entry = openAround(word, Kind::entry);
      ++at_;
      value("a value after \"=\"");
      close(entry);
    } else if (callFollows(word)) {
      call(word);
    } else if (valueFollows(word)) {
      const std::uint32_t entry = openAround(word, Kind::entry);
      this->word();
      close(entry);
    } else {
      at_ = end;
    }
  }

  void value(const char* expected) {
    blanks();
    if (startsWord()) {
      const std::uint32_t word = this->word();
      const std::size_t end = at_;
      blanks();
      if (callFollows(word))
        call(word);
      else
        at_ = end;
    } else if (peek() == '(' || peek() == '{') {
      brackets();
    } else if (startsNumber(peek())) {
      number();
    } else if (atEnd()) {
      failAtEnd(expected, {});
    } else {
      const std::string_view text = textAt(at_);
      fail(at_, std::string("expected ") + expected + ", found " + shown(peek()),
           looksLikeFile(text) ? quotesHint(text) : std::string());
    }
  }

  void brackets() {
    const std::size_t opened = at_++;
    if (++depth_ > kMostNesting) failDeep(opened);
    const std::uint32_t node = open(source_[opened] == '(' ? Kind::tuple : Kind::block, opened);
    items(opened, source_[opened] == '(' ? ')' : '}');
    close(node);
    --depth_;
  }

  bool callFollows(std::uint32_t word) const {
    return !nodes_[word].quoted && (peek() == '{' || peek() == '(');
  }
  /// `name "foo"`, and `name foo`, have no "=" in the materials of some scenes.
  bool valueFollows(std::uint32_t word) const {
    if (nodes_[word].quoted) return false;
    return peek() == '"' || (isLetter(peek()) && Item(syntax_, word).text() == "name");
  }

  void call(std::uint32_t word) {
    if (Item(syntax_, word).text() == Syntax::kKey) syntax_.hasKeys_ = true;
    openAround(word, Kind::call);
    brackets();
    close(word);
  }

  // --- tokens ---

  bool startsWord() const { return isLetter(peek()) || peek() == '"'; }

  std::uint32_t word() {
    const std::size_t start = at_;
    const bool quotes = peek() == '"';
    const std::uint32_t node = open(Kind::word, start);
    if (quotes) {
      const std::size_t end = std::min(source_.find_first_of("\"\n", start + 1), source_.size());
      if (end == source_.size() || source_[end] == '\n')
        fail(start, "expected a closing quote on the same line, found " +
                        std::string(end == source_.size() ? "the end of the file" : "the end of the line"));
      at_ = end + 1;
    } else {
      while (!atEnd() && isWordPart(peek())) ++at_;
    }
    if (at_ - start > Syntax::kLongestWord)
      fail(start, "expected at most " + std::to_string(Syntax::kLongestWord) +
                      " characters in a word, found " + std::to_string(at_ - start));
    nodes_[node].quoted = quotes;
    close(node);
    if (!quotes && !atEnd() && std::string_view("./\\:").find(peek()) != kNone) refuseName(start);
    return node;
  }

  void number() {
    const std::size_t start = at_;
    const auto parsed = parseNumber(source_.substr(start));
    at_ += parsed ? parsed->length : 1;
    // "1.2.3" and "2x" are slips of the pen, not two items.
    const bool glued = !atEnd() && (isWordPart(peek()) || peek() == '.' || peek() == '+');
    if (!parsed || glued) {
      while (!atEnd() && (isWordPart(peek()) || peek() == '.' || peek() == '+')) ++at_;
      const std::string_view text = textAt(start);
      fail(
          start,
          "expected a number, found " + quoted(source_.substr(start, std::min<std::size_t>(at_ - start, 40))),
          looksLikeFile(text) ? quotesHint(text) : std::string());
    }
    if (!std::isfinite(parsed->value))
      fail(start, "expected a finite number, found " +
                      quoted(source_.substr(start, std::min<std::size_t>(parsed->length, 40))));
    const std::uint32_t node = open(Kind::number, start);
    nodes_[node].number = parsed->value;
    close(node);
  }

  // --- errors ---

  /// What stands at `start`, up to a blank or a mark of the grammar.
  std::string_view textAt(std::size_t start) const {
    const std::string_view rest = source_.substr(start);
    return rest.substr(0, rest.find_first_of(" \t\r\n;,(){}=\""));
  }
  bool looksLikeFile(std::string_view text) const {
    const std::size_t mark = text.find_first_of("./\\:");
    const bool comment = text.find("//") == mark || text.find("/*") == mark;
    return mark != kNone && !comment &&
           std::any_of(text.begin() + static_cast<std::ptrdiff_t>(mark), text.end(), isLetter);
  }
  /// Where `text` looks like the name of a file.
  static std::string quotesHint(std::string_view text) {
    return "the name of a file stands in quotation marks, as in \"" + std::string(text.substr(0, 60)) + "\"";
  }
  /// Fails if the word at `start` is the beginning of a file's name.
  void refuseName(std::size_t start) const {
    const std::string_view text = textAt(start);
    if (looksLikeFile(text))
      fail(start, "expected a value, found " + quoted(text.substr(0, 40)), quotesHint(text));
  }

  [[noreturn]] void fail(std::size_t offset, std::string what, std::string hint = {}) const {
    throw Error(Fault::scene, syntax_.place(offset), std::move(what), std::move(hint));
  }
  /// Points behind the last thing the file has.
  [[noreturn]] void failAtEnd(const std::string& expected, std::string hint) const {
    std::size_t end = source_.size();
    while (end > 0 && isBlank(source_[end - 1])) --end;
    fail(end, "expected " + expected + ", found the end of the file", std::move(hint));
  }
  [[noreturn]] void failDeep(std::size_t opened) const {
    fail(opened, "expected at most " + std::to_string(kMostNesting) + " levels of brackets, found more",
         "transforms that follow one another can be one transform( )");
  }
  [[noreturn]] void failUnclosed(std::size_t opened, char closing) const {
    failAtEnd(shown(closing), hintAt(opened) + " is never closed");
  }
  [[noreturn]] void failMismatch(std::size_t opened, char closing) const {
    if (!closing) fail(at_, "found " + shown(peek()) + ", which closes nothing");
    fail(at_, "expected " + shown(closing) + ", found " + shown(peek()),
         hintAt(opened) + " is not closed yet");
  }
  std::string hintAt(std::size_t opened) const {
    return "the " + shown(source_[opened]) + " at line " + std::to_string(syntax_.place(opened).line);
  }

  Syntax& syntax_;
  std::string_view source_;
  std::vector<Node>& nodes_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Syntax::Syntax(std::string file, std::string_view source) : file_(std::move(file)), source_(source) {
  if (source.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(Fault::limit, Place{file_, 0, 0, {}}, "expected a scene of less than 4 GiB of text");
  lineStarts_.push_back(0);
  for (std::size_t newline = source.find('\n'); newline != kNone; newline = source.find('\n', newline + 1))
    lineStarts_.push_back(static_cast<std::uint32_t>(newline + 1));
  nodes_.reserve(source.size() / 6);  // of a mesh: numbers of five characters and a separator, and brackets
  Parser(*this).file();
}

Item Syntax::root() const { return {*this, 0}; }

std::optional<Item> Syntax::itemAt(std::size_t offset) const {
  const auto found = std::lower_bound(nodes_.begin() + 1, nodes_.end(), offset,
                                      [](const Node& node, std::size_t at) { return node.offset < at; });
  if (found == nodes_.end() || found->offset != offset) return {};
  return Item(*this, static_cast<std::uint32_t>(found - nodes_.begin()));
}

Syntax::Line Syntax::line(std::size_t offset) const {
  const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  std::size_t end = after == lineStarts_.end() ? source_.size() : *after - 1;
  const std::size_t start = *(after - 1);
  if (end > start && source_[end - 1] == '\r') --end;
  return {static_cast<std::size_t>(after - lineStarts_.begin()), start, end};
}

Place Syntax::place(std::size_t offset) const {
  const Line at = line(offset);
  return {file_, static_cast<int>(at.number), static_cast<int>(offset - at.start) + 1,
          std::string(source_.substr(at.start, at.end - at.start))};
}

Place Syntax::shortPlace(std::size_t offset) const {
  constexpr std::size_t kLongLine = 200;
  const Line at = line(offset);
  const bool isLong = at.end - at.start > kLongLine;
  return {file_, static_cast<int>(at.number), static_cast<int>(offset - at.start) + 1,
          std::string(isLong ? std::string_view() : source_.substr(at.start, at.end - at.start))};
}

std::string_view Item::text() const {
  std::string_view text = source();
  if (node().quoted) text = text.substr(1, text.size() - 2);
  return text;
}

std::size_t Item::count() const {
  std::size_t n = 0;
  for (Iterator child = begin(); child != end(); ++child) ++n;
  return n;
}

std::string_view skipBlanks(std::string_view source) {
  bool unclosed = false;
  const std::size_t start = source.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  return source.substr(skipBlanks(source, start, unclosed));
}

std::string describe(const Item& item) {
  const std::string_view text = item.source();
  if (text.size() <= 40 && text.find('\n') == kNone)
    return item.is(Kind::word) ? quoted(item.text()) : std::string(text);
  switch (item.kind()) {
    case Kind::number: return "a number of " + std::to_string(text.size()) + " characters";
    case Kind::word: return quoted(text.substr(0, 37)) + "...";
    case Kind::tuple: return "a list of " + std::to_string(item.count());
    case Kind::block: return "{ ... }";
    case Kind::entry: return std::string(item.key().substr(0, 40)) + " = ...";
    case Kind::call:
      return std::string(item.key().substr(0, 40)) + (item.value().is(Kind::tuple) ? "( ... )" : " { ... }");
  }
  return {};
}

}  // namespace trace::rayfile
