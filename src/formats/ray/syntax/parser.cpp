#include "formats/ray/syntax/parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/names.h"
#include "base/nesting.h"
#include "base/text.h"
#include "image/srgb.h"

namespace trace::rayfile {
namespace {

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Letters of other alphabets; no punctuation, which may look like a quotation mark or a space.
bool isOtherLetter(std::uint32_t code) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code >= 0xC0 && code != 0xD7 && code != 0xF7 && code < 0x1F000 && !within(0x2000, 0x2BFF) &&
         !within(0x3000, 0x303F) && !within(0xE000, 0xF8FF) && !within(0xFE00, 0xFE6F) && code != 0xFEFF &&
         !within(0xFF00, 0xFF20);
}
/// Bytes of the letter that `text` begins with; 0 if it begins with none.
std::size_t letterBytes(std::string_view text) {
  if (text.empty()) return 0;
  if (static_cast<unsigned char>(text[0]) < 0x80) return isLetter(text[0]);
  const auto [bytes, code] = utf8Letter(text);
  return bytes > 0 && isOtherLetter(code) ? bytes : 0;
}
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

/// The character that the text begins with, or its byte if that is none.
std::string shownFirst(std::string_view text);
std::string shown(char c) {
  if (c >= ' ' && c <= '~') return quoted({&c, 1});
  char text[16];
  std::snprintf(text, sizeof text, "byte 0x%02x", static_cast<unsigned char>(c));
  return text;
}

std::string shownFirst(std::string_view text) {
  const auto [bytes, code] = utf8Letter(text);
  return bytes > 1 && code >= 0xA0 ? quoted(text.substr(0, bytes)) : shown(text.empty() ? '\0' : text[0]);
}

/// The word that the text begins with; without one, its first character.
std::string shownWord(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::size_t length = 0;
  while (length < std::min(text.size(), kLongest)) {
    const std::size_t letter = letterBytes(text.substr(length));
    if (letter == 0 && (length == 0 || !isWordPart(text[length]))) break;
    length += letter > 0 ? letter : 1;
  }
  return length > 0 ? quoted(text.substr(0, length)) : shownFirst(text);
}

/// How what stands there is written in Trace, where people write it otherwise; "" elsewhere.
std::string_view hintFor(std::string_view text) {
  for (const std::string_view quote : {"\u201c", "\u201d", "\u201e", "\u2018", "\u2019"})
    if (text.starts_with(quote)) return "text stands in straight quotation marks: \"text\"";
  if (text.starts_with("\u00a0")) return "the blank there is a no-break space; a plain one is wanted";
  if (text.starts_with("=")) return "== compares two values; name = value is a field";
  if (text.starts_with(":")) return "a field gets its value by =, as in diffuse = (1, 0, 0)";
  if (text.starts_with("<")) return "a point or a colour is (x, y, z), and a field name = value";
  return {};
}

constexpr std::string_view kBinary = "+-*/%^<>";

int hexDigit(char c) {
  if (isDigit(c)) return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

}  // namespace

namespace {

class Parser {
 public:
  Parser(const Syntax& syntax, std::string_view source, std::uint32_t base, std::vector<Node>& nodes)
      : syntax_(syntax), source_(source), base_(base), nodes_(nodes) {}

  Parsed file() {
    if (source_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    const std::uint32_t root = open(Kind::block, 0);
    items(0, '\0');
    close(root);
    return parsed_;
  }

 private:
  // --- reading characters ---

  char peek() const { return at_ < source_.size() ? source_[at_] : '\0'; }
  bool atEnd() const { return at_ >= source_.size(); }

  void blanks() {
    while (isBlank(peek())) ++at_;
    if (peek() != '/') return;
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
    node.offset = base_ + static_cast<std::uint32_t>(offset);
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  void close(std::uint32_t index) {
    nodes_[index].length = static_cast<std::uint32_t>(at_ - (nodes_[index].offset - base_));
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
      if (peek() == ')' || peek() == '}' || peek() == ']') failMismatch(opened, closing);
      item();
    }
  }

  void item() {
    if (!startsWord() || atPrefix()) return value("an object, a field or a value");
    const std::uint32_t word = this->word();
    if (statement(word)) return;
    const std::size_t end = at_;
    blanks();
    if (peek() == '=' && next() != '=') {
      const std::uint32_t entry = openAround(word, Kind::entry);
      ++at_;
      value("a value after \"=\"");
      close(entry);
    } else if (callFollows(word, true)) {
      call(word);
      operators(word, false);
    } else if (valueFollows(word)) {
      const std::uint32_t entry = openAround(word, Kind::entry);
      this->word();
      close(entry);
    } else {
      at_ = end;
      noteConstant(word);
      operators(word, false);
    }
  }

  void value(const char* expected) {
    blanks();
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    const bool prefixed = atPrefix();
    if (prefixed) open(Kind::expression, at_);
    prefixes();
    operand(expected);
    operators(first, prefixed);
  }

  // --- statements of the language ---

  bool isWord(std::uint32_t word, std::string_view text) const {
    return !nodes_[word].quoted && Item(syntax_, word).text() == text;
  }

  /// Reads the rest of a statement, if the word begins one.
  bool statement(std::uint32_t word) {
    if (nodes_[word].quoted) return false;
    const std::string_view text = Item(syntax_, word).text();
    if (text != "let" && text != "define" && text != "for" && text != "if" && text != "include" &&
        text != "rotate")
      return false;
    const std::size_t end = at_;
    blanks();
    const bool named = letterHere() > 0;
    if (text == "let" && named) return statement(word, Kind::let, &Parser::let);
    if (text == "define" && named) return statement(word, Kind::define, &Parser::define);
    if (text == "for" && named) return statement(word, Kind::loop, &Parser::loop);
    if (text == "for" && peek() == '(' && syntax_.isOfKind())
      fail(at_, "expected the name of the loop, found " + shown('('),
           "for i in 0..4 { } makes five turns, from i = 0 to i = 4");
    if (text == "if" && peek() == '(') return statement(word, Kind::branch, &Parser::branch);
    if (text == "if" && startsBareCondition()) failWithoutParentheses();
    if (text == "include" && peek() == '"') return statement(word, Kind::include, &Parser::included);
    if (text == "rotate" && peek() >= 'x' && peek() <= 'z' && !isWordPart(next())) return turn(word);
    if (text == "rotate" && syntax_.isOfKind() && (isDigit(peek()) || peek() == '-'))
      fail(at_, "expected an axis after rotate, found " + shown(peek()),
           "rotate takes an axis and degrees: rotate y 45 { ... }");
    at_ = end;
    return false;
  }

  bool statement(std::uint32_t word, Kind kind, void (Parser::*rest)()) {
    parsed_.usesLanguage = true;
    nodes_[word].kind = kind;  // the statement begins where its word does
    (this->*rest)();
    close(word);
    return true;
  }

  void let() {
    name();
    blanks();
    if (peek() == '(') brackets();
    need('=');
    value("a value after \"=\"");
  }
  void define() {
    name();
    blanks();
    if (peek() != '(') failFound("expected \"(\" and the parameters, which may be none");
    brackets();
    body("what a definition makes stands in braces: define ball(r) { scale(r) { sphere { } } }");
  }
  void loop() {
    name();
    blanks();
    if (!atWord("in")) failFound("expected \"in\" after the name of the loop");
    word();
    nodes_.pop_back();
    beforeBody_ = true;
    value("a range such as 0..9, or a list");
    beforeBody_ = false;
    blanks();
    const bool steps = atWord("step") || atWord("by");
    body(steps ? "a range counts by 1; steps(0, 6, 4) is 0, 2, 4, 6, as in for i in steps(0, 6, 4) { }"
               : "what a loop repeats stands in braces: for i in 0..3 { sphere { } }");
  }
  void branch() {
    constexpr std::string_view kCondition =
        "what a condition makes stands in braces: if (a < 1) { sphere { } }";
    brackets();
    body(kCondition);
    const std::size_t end = at_;
    separators();
    if (!startsWord()) return void(at_ = end);
    const std::uint32_t word = this->word();
    if (!isWord(word, "else")) {
      nodes_.pop_back();
      at_ = end;
      return;
    }
    nodes_.pop_back();
    blanks();
    if (peek() == '{') return body(kCondition);
    const std::uint32_t again = startsWord() ? this->word() : 0;
    blanks();
    if (again && isWord(again, "if") && startsBareCondition()) failWithoutParentheses();
    if (!again || !isWord(again, "if") || peek() != '(') failFound("expected { or if after else");
    statement(again, Kind::branch, &Parser::branch);
  }
  void included() { word(); }

  /// Does what follows `if` look like a condition that is not in parentheses?
  bool startsBareCondition() const { return letterHere() > 0 || isDigit(peek()) || peek() == '!'; }
  [[noreturn]] void failWithoutParentheses() const {
    constexpr std::size_t kLongest = 40;
    const std::string_view rest = source_.substr(at_);
    std::string_view condition = rest.substr(0, rest.find_first_of("{};\n"));
    while (!condition.empty() && isBlank(condition.back())) condition.remove_suffix(1);
    if (condition.empty() || condition.size() > kLongest) condition = "a < 1";
    fail(at_, "expected \"(\" after if, found " + shownWord(rest),
         "a condition stands in parentheses: if (" + std::string(condition) + ") { }");
  }

  /// `rotate y 30 deg { }` is rotate(0, 1, 0, 30 deg, { }).
  bool turn(std::uint32_t word) {
    parsed_.usesLanguage = true;
    openAround(word, Kind::call);
    const std::uint32_t arguments = open(Kind::tuple, at_);
    const int axis = peek() - 'x';
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t number = open(Kind::number, at_);
      nodes_[number].number = i == axis;
      nodes_[number].length = 1;
      nodes_[number].end = number + 1;
    }
    ++at_;
    blanks();
    if (peek() == '{') failFound("expected an angle, as in rotate y 30 deg { }");
    beforeBody_ = true;
    value("an angle, as in rotate y 30 deg { }");
    beforeBody_ = false;
    blanks();
    if (atEnd() || peek() == ')' || peek() == '}') failFound("expected the object to rotate");
    if (peek() >= 'x' && peek() <= 'z' && !isWordPart(next())) refuseSecondAxis();
    item();
    close(arguments);
    close(word);
    return true;
  }

  /// `rotate x 45 y 30 { }`.
  void refuseSecondAxis() const {
    std::size_t angle = at_ + 1;
    while (angle < source_.size() && isBlank(source_[angle])) ++angle;
    if (angle < source_.size() && startsNumber(source_[angle]))
      fail(at_, "expected the object to rotate, found " + shown(peek()),
           "one rotation stands in the other: rotate x 45 { rotate y 30 { ... } }");
  }

  void name() {
    blanks();
    if (!letterHere()) failFound("expected a name");
    word();
  }
  void need(char c) {
    blanks();
    if (peek() != c) failFound("expected " + shown(c));
    ++at_;
  }
  void body(std::string_view form) {
    blanks();
    if (peek() != '{') failFound("expected " + shown('{'), form);
    ++bodies_;
    brackets();
    --bodies_;
  }

  // --- expressions ---

  char next() const { return at_ + 1 < source_.size() ? source_[at_ + 1] : '\0'; }

  /// A sign before what is no number, or `not`.
  bool atPrefix() const {
    if (peek() == '!') return true;
    if (peek() == '-')
      return (isLetter(next()) && !parseNumber(source_.substr(at_))) || next() == '(';  // -inf
    return atWord("not");
  }
  bool atWord(std::string_view word) const {
    if (peek() != word.front() || !source_.substr(at_).starts_with(word)) return false;
    const std::size_t end = at_ + word.size();
    return end == source_.size() || !isWordPart(source_[end]);
  }
  void prefixes() {
    for (; atPrefix(); blanks()) op(peek() == '-' ? Op::negate : Op::invert, peek() == 'n' ? 3 : 1);
  }

  /// `pi`, `tau` and `time` are numbers of the language, in the place of a value.
  void noteConstant(std::uint32_t word) {
    parsed_.usesLanguage |= isWord(word, "pi") || isWord(word, "tau") || isWord(word, "time");
  }

  void operand(const char* expected) {
    blanks();
    if (startsWord()) {
      const std::uint32_t word = this->word();
      const std::size_t end = at_;
      blanks();
      if (callFollows(word, false)) {
        call(word);
      } else {
        at_ = end;
        noteConstant(word);
      }
    } else if (peek() == '(' || peek() == '{') {
      brackets();
    } else if (startsNumber(peek())) {
      number();
    } else if (peek() == '#') {
      colour();
    } else if (atEnd()) {
      failAtEnd(expected, {});
    } else {
      const std::string_view text = textAt(at_);
      const std::string_view rest = source_.substr(at_);
      fail(at_, std::string("expected ") + expected + ", found " + shownFirst(rest),
           hintFor(rest).empty() && looksLikeFile(text) ? quotesHint(text) : std::string(hintFor(rest)));
    }
  }

  void op(Op what, std::size_t length) {
    const std::uint32_t node = open(Kind::op, at_);
    nodes_[node].number = static_cast<double>(what);
    at_ += length;
    close(node);
  }

  /// Operators and operands behind the one at `first`, which become one expression with it, if there are any.
  void operators(std::uint32_t first, bool isExpression) {
    for (;;) {
      const std::size_t end = at_;
      blanks();
      const auto [what, length] = operatorHere(at_ > end);
      if (length == 0) {
        at_ = end;
        break;
      }
      if (!isExpression) openBefore(first, Kind::expression);
      isExpression = true;
      op(what, length);
      conditionals_ += what == Op::choose ? 1 : what == Op::otherwise ? -1 : 0;
      if (what == Op::index) {
        const auto node = static_cast<std::uint32_t>(nodes_.size() - 1);
        --at_;
        brackets();
        close(node);
      }
      if (what == Op::member || what == Op::index || what == Op::degrees || what == Op::radians) continue;
      blanks();
      prefixes();
      operand("a value after the operator");
    }
    if (!isExpression) return;
    parsed_.usesLanguage = true;
    close(first);
  }

  struct Operator {
    Op what = Op::add;
    std::size_t length = 0;
  };
  /// `apart`: blanks stand before it. "a -b" are two values, as a list may do without commas; "a - b" and
  /// "a-1" are one.
  Operator operatorHere(bool apart) const {
    const char c = peek(), d = next();
    switch (c) {
      case '+':
      case '-':
        if (apart && !isBlank(d) && d != '\0') return {};
        return {c == '+' ? Op::add : Op::subtract, 1};
      case '*': return {Op::multiply, 1};
      case '/': return {Op::divide, 1};
      case '%': return {Op::modulo, 1};
      case '^': return {Op::power, 1};
      case '<': return d == '=' ? Operator{Op::atMost, 2} : Operator{Op::less, 1};
      case '>': return d == '=' ? Operator{Op::atLeast, 2} : Operator{Op::more, 1};
      case '=': return d == '=' ? Operator{Op::equal, 2} : Operator{};
      case '!': return d == '=' ? Operator{Op::unequal, 2} : Operator{};
      case '?': return {Op::choose, 1};
      case ':': return conditionals_ > 0 ? Operator{Op::otherwise, 1} : Operator{};
      case '[': return apart ? Operator{} : Operator{Op::index, 1};
      case '.':
        if (d == '.') return {Op::range, 2};
        return !apart && isComponent(at_ + 1) ? Operator{Op::member, 2} : Operator{};
      case 'a': return atWord("and") ? Operator{Op::both, 3} : Operator{};
      case 'o': return atWord("or") ? Operator{Op::either, 2} : Operator{};
      case 'd': return atWord("deg") ? Operator{Op::degrees, 3} : Operator{};
      case 'r': return atWord("rad") ? Operator{Op::radians, 3} : Operator{};
      default: return {};
    }
  }
  /// Is the letter there one of x, y, z, r, g, b, by itself?
  bool isComponent(std::size_t at) const {
    return at < source_.size() && std::string_view("xyzrgb").find(source_[at]) != kNone &&
           (at + 1 == source_.size() || !isWordPart(source_[at + 1]) || source_[at + 1] == '-');
  }

  /// Puts a parent before the finished nodes from `first` on.
  void openBefore(std::uint32_t first, Kind kind) {
    Node parent;
    parent.kind = kind;
    parent.offset = nodes_[first].offset;
    nodes_.insert(nodes_.begin() + first, parent);
    for (std::size_t i = first + 1; i < nodes_.size(); ++i) ++nodes_[i].end;
  }

  [[noreturn]] void noColour(std::size_t hash) {
    at_ = hash + 1;
    while (isWordPart(peek())) ++at_;
    const std::string_view word = source_.substr(hash + 1, at_ - hash - 1);
    const bool isOrder = word == "include" || word == "declare" || word == "local" || word == "macro";
    fail(hash, "expected six hexadecimal digits after #, as in #ffb347",
         isOrder ? "Trace has include \"file.ray\", let a = 1 and define f(a) { }, without #" : "");
  }

  /// #rrggbb: the linear colour of an sRGB one.
  void colour() {
    const std::size_t start = at_++;
    std::array<int, 6> digits{};
    for (int& digit : digits) {
      digit = hexDigit(peek());
      if (digit < 0) noColour(start);
      ++at_;
    }
    if (isWordPart(peek())) noColour(start);
    parsed_.usesLanguage = true;
    const std::uint32_t tuple = open(Kind::tuple, start);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t number = open(Kind::number, start);
      nodes_[number].number = linearOfSrgb((16 * digits[2 * i] + digits[2 * i + 1]) / 255.0);
      close(number);
    }
    close(tuple);
  }

  void brackets() {
    const std::size_t opened = at_++;
    if (++depth_ > kMostNesting) failDeep(opened);
    const bool beforeBody = std::exchange(beforeBody_, false);
    const int conditionals = std::exchange(conditionals_, 0);
    const std::uint32_t node = open(source_[opened] == '{' ? Kind::block : Kind::tuple, opened);
    items(opened, source_[opened] == '(' ? ')' : source_[opened] == '[' ? ']' : '}');
    close(node);
    beforeBody_ = beforeBody;
    conditionals_ = conditionals;
    --depth_;
  }

  bool callFollows(std::uint32_t word, bool isItem) const {
    if (nodes_[word].quoted) return false;
    return peek() == '(' ? !onLaterLine(word, isItem) : peek() == '{' && !beforeBody_;
  }
  /// In the language a "(" that begins a line begins a value. Files of the courses may break lines anywhere.
  bool onLaterLine(std::uint32_t word, bool isItem) const {
    if (!syntax_.isOfKind() && bodies_ == 0) return false;
    const std::size_t end = nodes_[word].offset - base_ + nodes_[word].length;
    if (source_.substr(end, at_ - end).find('\n') == kNone) return false;
    const std::string_view name = Item(syntax_, word).text();
    if (isFunction(name) || (isItem && arityOf(name) > 0))
      fail(at_, "expected " + shown('(') + " on the line of " + quoted(name) + ", found it on a later one",
           "a line that begins with ( begins a new value");
    return true;
  }
  /// `name "foo"`, and `name foo`, have no "=" in the materials of some scenes.
  bool valueFollows(std::uint32_t word) const {
    if (nodes_[word].quoted) return false;
    return peek() == '"' || (isLetter(peek()) && Item(syntax_, word).text() == "name");
  }

  void call(std::uint32_t word) {
    const std::string_view name = Item(syntax_, word).text();
    parsed_.hasKeys |= name == Syntax::kKey;
    const std::size_t arity = peek() == '(' ? arityOf(name) : 0;
    parsed_.usesLanguage |= peek() == '(' && arity == 0 && isFunction(name);
    openAround(word, Kind::call);
    brackets();
    close(word);
    if (nodes_[word + 2].kind == Kind::tuple && !beforeBody_) block(word, arity);
  }

  /// The numbers before the object of a transform; 0 if it is none.
  static std::size_t arityOf(std::string_view name) {
    return name == "translate" || name == "scale" ? 3 : name == "rotate" || name == "transform" ? 4 : 0;
  }

  /// `translate(1, 2, 3) { }` is translate(1, 2, 3, { }). Another block right behind a call is marked.
  void block(std::uint32_t call, std::size_t arity) {
    const std::size_t end = at_;
    blanks();
    if (peek() != '{') return void(at_ = end);
    const std::uint32_t tuple = call + 2;
    const std::size_t count = Item(syntax_, tuple).count();
    const bool one = count == 1 && (arity == 3);
    const bool axis = count == 2 && nodes_[call + 1].length == 6 && arity == 4;  // rotate(axis, angle)
    if (arity == 0) {
      const auto index = static_cast<std::uint32_t>(nodes_.size());
      brackets();
      nodes_[index].follows = true;
      return;
    }
    if (count != arity && !one && !axis) return void(at_ = end);
    parsed_.usesLanguage = true;
    brackets();
    close(tuple);
    close(call);
  }

  // --- tokens ---

  std::size_t letterHere() const { return letterBytes(source_.substr(at_)); }
  bool startsWord() const { return letterHere() > 0 || peek() == '"'; }

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
      for (std::size_t part = letterHere(); part > 0; part = isWordPart(peek()) ? 1 : letterHere())
        at_ += part;
    }
    if (at_ - start > Syntax::kLongestWord)
      fail(start, "expected at most " + std::to_string(Syntax::kLongestWord) +
                      " characters in a word, found " + std::to_string(at_ - start));
    nodes_[node].quoted = quotes;
    close(node);
    const bool operates = peek() == '.' && (next() == '.' || isComponent(at_ + 1));
    if (!quotes && !atEnd() && !operates && std::string_view("./\\:").find(peek()) != kNone)
      refuseName(start);
    return node;
  }

  /// The rest of "0.3.0", as the courses' programs read it.
  void skipSecondPoint(std::size_t start, std::size_t length) {
    const std::string_view read = source_.substr(start, length);
    if (atEnd() || peek() != '.' || next() == '.' || read.find('.') == read.npos) return;
    std::size_t end = at_;
    while (end < source_.size() && (isDigit(source_[end]) || source_[end] == '.')) ++end;
    if (end < source_.size() && isWordPart(source_[end])) return;
    at_ = end;
    parsed_.slips.push_back({static_cast<std::uint32_t>(base_ + start),
                             std::string(source_.substr(start, std::min<std::size_t>(end - start, 40))),
                             std::string(read)});
  }

  void number() {
    const std::size_t start = at_;
    auto parsed = parseNumber(source_.substr(start));
    if (parsed && parsed->length > 1 && source_[start + parsed->length - 1] == '.' &&
        source_.substr(start + parsed->length).starts_with('.'))
      --parsed->length;  // "0..9"
    at_ += parsed ? parsed->length : 1;
    if (parsed) skipSecondPoint(start, parsed->length);
    // "2x" is a slip of the pen, not two items.
    const bool unit = atWord("deg") || atWord("rad");
    const bool glued =
        !atEnd() && !unit && (isLetter(peek()) || isDigit(peek()) || (peek() == '.' && next() != '.'));
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

  /// The text at `start`, up to a blank or a mark of the grammar.
  std::string_view textAt(std::size_t start) const {
    const std::string_view rest = source_.substr(start);
    return rest.substr(0, rest.find_first_of(" \t\r\n;,(){}=\""));
  }
  bool looksLikeFile(std::string_view text) const {
    const std::size_t mark = text.find_first_of("./\\:");
    const bool comment = text.find("//") == mark || text.find("/*") == mark;
    const bool divides = text.find_first_of(".\\:") == kNone;
    return mark != kNone && !comment && !divides &&
           std::any_of(text.begin() + static_cast<std::ptrdiff_t>(mark), text.end(), isLetter);
  }
  /// Where `text` looks like the name of a file.
  static std::string quotesHint(std::string_view text) {
    return "the name of a file stands in quotation marks, as in \"" + std::string(text.substr(0, 60)) + "\"";
  }
  /// Fails if the word at `start` is the beginning of a file's name.
  void refuseName(std::size_t start) const {
    const std::string_view text = textAt(start);
    if (!looksLikeFile(text)) return;
    const std::size_t dot = text.size() - 2;
    const bool component = text.size() > 2 && text.find('.') == dot && isLetter(text.back());
    fail(start, "expected a value, found " + quoted(text.substr(0, 40)),
         component ? "components of a point or colour are .x .y .z and .r .g .b" : quotesHint(text));
  }

  [[noreturn]] void fail(std::size_t offset, std::string what, std::string hint = {}) const {
    throw Error(Fault::scene, syntax_.place(base_ + offset), std::move(what), std::move(hint));
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
    const SourcePlace place = syntax_.place(base_ + opened);
    return "the " + shown(source_[opened]) + " at line " + std::to_string(place.line) + ", column " +
           std::to_string(place.column);
  }

  /// Reports that something else was expected here.
  [[noreturn]] void failFound(const std::string& expected, std::string_view hint = {}) const {
    if (atEnd())
      failAtEnd(expected.starts_with("expected ") ? expected.substr(9) : expected, std::string(hint));
    const std::string_view rest = source_.substr(at_);
    fail(at_, expected + ", found " + shownWord(rest), std::string(hint.empty() ? hintFor(rest) : hint));
  }

  const Syntax& syntax_;
  std::string_view source_;
  const std::uint32_t base_;
  std::vector<Node>& nodes_;
  Parsed parsed_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int bodies_ = 0;           ///< number of bodies of statements around the text being read
  int conditionals_ = 0;     ///< question marks whose colon is still to come
  bool beforeBody_ = false;  ///< a block that follows is no part of the value
};

}  // namespace

Parsed parseRay(const Syntax& syntax, std::string_view text, std::uint32_t base, std::vector<Node>& nodes) {
  return Parser(syntax, text, base, nodes).file();
}

std::string_view skipBlanks(std::string_view source) {
  bool unclosed = false;
  const std::size_t start = source.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  return source.substr(skipBlanks(source, start, unclosed));
}

}  // namespace trace::rayfile
