#include "formats/ray/syntax/layout.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "formats/ray/syntax/syntax.h"

namespace trace {
namespace rayfile {
namespace {

/// A mark, a string, a comment, or any run of other characters, in which blanks count for nothing else.
struct Token {
  enum class Kind { run, mark, lineComment, blockComment } kind = Kind::run;
  std::string_view text;
  int lines = 0;       ///< line breaks before it
  bool apart = false;  ///< something blank stands before it
  bool isMark(char c) const { return kind == Kind::mark && text[0] == c; }
  bool isComment() const { return kind == Kind::lineComment || kind == Kind::blockComment; }
  bool opens() const { return isMark('(') || isMark('{') || isMark('['); }
  bool closes() const { return isMark(')') || isMark('}') || isMark(']'); }
};

bool isGap(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// "=" that gives a value, rather than a part of "==" or "<=".
bool isAssignment(std::string_view text, std::size_t at) {
  const char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < text.size() ? text[at + 1] : ' ';
  return text[at] == '=' && after != '=' && std::string_view("=<>!").find(before) == text.npos;
}

bool isMark(std::string_view text, std::size_t at) {
  return std::string_view("(){}[];,").find(text[at]) != text.npos || isAssignment(text, at);
}

std::vector<Token> tokensOf(std::string_view text) {
  std::vector<Token> tokens;
  std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  while (at < text.size()) {
    Token token;
    for (; at < text.size() && isGap(text[at]); ++at) {
      token.apart = true;
      token.lines += text[at] == '\n';
    }
    if (at == text.size()) break;
    const std::size_t start = at;
    const std::string_view two = text.substr(at, 2);
    if (two == "//") {
      token.kind = Token::Kind::lineComment;
      at = std::min(text.find('\n', at), text.size());
      std::size_t end = at;
      while (end > start && isGap(text[end - 1])) --end;
      token.text = text.substr(start, end - start);
    } else if (two == "/*") {
      token.kind = Token::Kind::blockComment;
      at = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
      token.text = text.substr(start, at - start);
    } else if (isMark(text, at)) {
      token.kind = Token::Kind::mark;
      token.text = text.substr(at++, 1);
    } else {
      const auto goesOn = [&] {
        return at < text.size() && !isGap(text[at]) && !isMark(text, at) && text.substr(at, 2) != "//" &&
               text.substr(at, 2) != "/*";
      };
      while (goesOn()) {
        if (text[at] == '"') at = std::min(text.find('"', at + 1), text.size() - 1);
        ++at;
      }
      token.text = text.substr(start, at - start);
    }
    tokens.push_back(token);
  }
  return tokens;
}

/// Blocks that the text has on several lines have their brackets at the ends of lines.
void breakBlocks(std::vector<Token>& tokens) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].opens()) open.push_back(i);
    if (!tokens[i].closes() || open.empty()) continue;
    const std::size_t from = std::exchange(open.back(), 0);
    open.pop_back();
    if (!tokens[i].isMark('}')) continue;
    bool several = false;
    for (std::size_t k = from + 1; k <= i; ++k) several |= tokens[k].lines > 0;
    if (!several) continue;
    const bool comment = tokens[from + 1].isComment() && tokens[from + 1].lines == 0;  // its own comment
    Token& first = tokens[from + (comment ? 2 : 1)];
    first.lines = std::max(first.lines, 1);
    tokens[i].lines = std::max(tokens[i].lines, 1);
  }
}

/// Whether a blank stands between two tokens of a line.
bool blankBetween(const Token& left, const Token& right) {
  if (right.isComment() || left.isComment()) return true;
  if (right.isMark(';') || right.isMark(',')) return false;
  if (left.isMark(';') || left.isMark(',')) return !right.closes() || right.isMark('}');
  if (left.isMark('=') || right.isMark('=')) return true;
  if (left.isMark('(') || left.isMark('[') || right.isMark(')') || right.isMark(']')) return false;
  if (left.isMark('{') || right.isMark('}') || right.isMark('{')) return true;
  return right.apart;
}

/// A line of the result; its comment, if any, stands behind the code.
struct Line {
  std::size_t indent = 0;
  std::string code;
  std::string_view comment{};
  bool emptyBefore = false;
};

class Layout {
 public:
  explicit Layout(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  std::string text() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) add(i);
    std::string text;
    for (std::size_t first = 0; first < lines_.size();) {
      std::size_t end = first + 1;  // end of the lines in a row that have comments behind them
      if (isCommented(lines_[first]))
        while (end < lines_.size() && isCommented(lines_[end]) && !lines_[end].emptyBefore) ++end;
      std::size_t least = kNone, most = 0;
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t width = lines_[i].indent + columns(lines_[i].code);
        least = std::min(least, width);
        most = std::max(most, width);
      }
      const bool aligned = most - least <= kFarthest;
      for (; first < end; ++first) print(lines_[first], aligned ? most : 0, text);
    }
    return text;
  }

 private:
  static constexpr std::size_t kStep = 2, kNone = static_cast<std::size_t>(-1);
  static constexpr std::size_t kFarthest = 40;  // comments do not move farther than that

  static bool isCommented(const Line& line) { return !line.code.empty() && !line.comment.empty(); }
  /// Characters of UTF-8.
  static std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  }

  void add(std::size_t i) {
    const Token& token = tokens_[i];
    if (i == 0 || token.lines > 0) {
      Line line;
      line.indent = indentAt(i);
      line.emptyBefore = i > 0 && token.lines > 1;
      if (i > 0 && (tokens_[i - 1].isMark('{') || token.isMark('}'))) line.emptyBefore = false;
      lines_.push_back(line);
    } else if (blankBetween(tokens_[i - 1], token) && token.kind != Token::Kind::lineComment) {
      lines_.back().code += ' ';
    }
    if (token.kind == Token::Kind::lineComment)
      lines_.back().comment = token.text;
    else
      lines_.back().code += token.text;
    if (token.opens()) open_.push_back(lines_.back().indent);
    if (token.closes() && !open_.empty()) open_.pop_back();
  }

  std::size_t indentAt(std::size_t i) const {
    if (tokens_[i].closes()) return open_.empty() ? 0 : open_.back();
    const std::size_t base = open_.empty() ? 0 : open_.back() + kStep;
    const bool continues = i > 0 && tokens_[i - 1].isMark('=');
    return base + (continues ? 2 * kStep : 0);
  }

  static void print(const Line& line, std::size_t commentColumn, std::string& text) {
    if (line.emptyBefore) text += '\n';
    const std::size_t start = text.size();
    text.append(line.indent, ' ');
    text += line.code;
    if (!line.comment.empty()) {
      if (!line.code.empty()) {
        const std::size_t width = columns(std::string_view(text).substr(start));
        text.append(std::max(commentColumn, width) - width + 2, ' ');
      }
      text += line.comment;
    }
    text += '\n';
  }

  std::vector<Token> tokens_;
  std::vector<Line> lines_;
  std::vector<std::size_t> open_;  // indents of the lines on which the brackets that are open stand
};

/// Do both have the same nodes, wherever these stand?
bool sameNodes(const Syntax& a, const Syntax& b) {
  return std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end(),
                    [&](const Node& x, const Node& y) {
                      const bool word = x.kind == Kind::word;
                      return x.kind == y.kind && x.number == y.number && x.end == y.end &&
                             x.quoted == y.quoted && x.follows == y.follows &&
                             (!word || a.textOf(x) == b.textOf(y));
                    });
}

}  // namespace
}  // namespace rayfile

std::string tidied(const std::string& file, std::string_view text) {
  const rayfile::Syntax before(file, text);
  std::vector<rayfile::Token> tokens = rayfile::tokensOf(text);
  rayfile::breakBlocks(tokens);
  std::string result = rayfile::Layout(std::move(tokens)).text();
  const rayfile::Syntax after(file, result);
  if (!rayfile::sameNodes(before, after))
    throw Error(Fault::scene, SourcePlace{.file = file},
                "the tidied text would mean something else: this is a mistake of Trace",
                "please report it; the file stays as it is");
  return result;
}

}  // namespace trace
