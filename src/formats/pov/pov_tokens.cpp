#include "formats/pov/pov_tokens.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/budget.h"
#include "base/text.h"

namespace trace::pov {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

}  // namespace

Source::Source(std::string name, std::string bytes) : file(std::move(name)), text(std::move(bytes)) {
  lineStarts_.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lineStarts_.push_back(static_cast<std::uint32_t>(i + 1));
  split();
}

SourcePlace Source::place(std::size_t offset) const {
  constexpr std::size_t kLongestLine = 500;
  const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  const auto line = static_cast<std::size_t>(next - lineStarts_.begin());
  const std::size_t start = lineStarts_[line - 1];
  std::size_t end = text.find_first_of("\r\n", start);
  if (end == std::string::npos) end = text.size();
  return {file, static_cast<int>(line), static_cast<int>(offset - start + 1),
          end - start <= kLongestLine ? text.substr(start, end - start) : std::string()};
}

void Source::split() {
  const std::string_view s = text;
  std::size_t at = 0;
  const auto add = [&](Token::Kind kind, std::size_t from, std::size_t to, double number = 0) {
    tokens.push_back({kind, s.substr(from, to - from), number, static_cast<std::uint32_t>(from), this});
  };
  const auto fail = [&](std::size_t where, const char* what, const char* hint) {
    throw Error(Fault::scene, place(where), what, hint);
  };
  while (at < s.size()) {
    checkBudget();
    const char c = s[at];
    if (isBlank(c)) {
      ++at;
    } else if (s.substr(at, 2) == "//") {
      at = std::min(s.find('\n', at), s.size());
    } else if (s.substr(at, 2) == "/*") {  // comments nest
      const std::size_t start = at;
      int depth = 0;
      do {
        if (at + 1 >= s.size()) fail(start, "a comment that never ends", "close it with */");
        const std::string_view two = s.substr(at, 2);
        depth += two == "/*" ? 1 : two == "*/" ? -1 : 0;
        at += two == "/*" || two == "*/" ? 2 : 1;
      } while (depth > 0);
    } else if (c == '"') {
      std::size_t end = at + 1;
      while (end < s.size() && s[end] != '"') end += s[end] == '\\' ? 2 : 1;
      if (end >= s.size()) fail(at, "a string that never ends", "close it with \"");
      tokens.push_back(
          {Token::Kind::string, s.substr(at + 1, end - at - 1), 0, static_cast<std::uint32_t>(at), this});
      at = end + 1;
    } else if (isDigit(c) || (c == '.' && at + 1 < s.size() && isDigit(s[at + 1]))) {
      const std::optional<ParsedNumber> parsed = parseNumber(std::string_view(s).substr(at));
      const double number = parsed ? parsed->value : HUGE_VAL;
      const std::size_t to = at + (parsed ? parsed->length : 0);
      if (!std::isfinite(number)) fail(at, "a number that is too large", "numbers go up to 1e308");
      add(Token::Kind::number, at, to, number);
      at = to;
    } else if (isLetter(c)) {
      std::size_t end = at;
      while (end < s.size() && (isLetter(s[end]) || isDigit(s[end]))) ++end;
      add(Token::Kind::name, at, end);
      at = end;
    } else if (c == '#') {
      std::size_t from = at + 1;
      while (from < s.size() && isBlank(s[from])) ++from;
      std::size_t end = from;
      while (end < s.size() && (isLetter(s[end]) || isDigit(s[end]))) ++end;
      tokens.push_back(
          {Token::Kind::directive, s.substr(from, end - from), 0, static_cast<std::uint32_t>(at), this});
      at = std::max(end, at + 1);
    } else {
      const bool two = at + 1 < s.size() && s[at + 1] == '=' && (c == '<' || c == '>' || c == '!');
      add(Token::Kind::mark, at, at + (two ? 2 : 1));
      at += two ? 2 : 1;
    }
  }
  tokens.push_back({Token::Kind::end, {}, 0, static_cast<std::uint32_t>(s.size()), this});
}

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::end: return "the end of the file";
    case Token::Kind::number: return std::string(token.text);
    case Token::Kind::directive: return "#" + std::string(token.text.substr(0, 40));
    default: break;
  }
  return "\"" + std::string(token.text.substr(0, 40)) + "\"";
}

std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      result += text[i];
      continue;
    }
    const char c = text[++i];
    switch (c) {
      case 'n': result += '\n'; break;
      case 't': result += '\t'; break;
      case 'r': result += '\r'; break;
      case 'a':
      case 'b':
      case 'f':
      case 'v': break;
      case '"':
      case '\'':
      case '\\': result += c; break;
      default: (result += '\\') += c;  // a folder of another system
    }
  }
  return result;
}

}  // namespace trace::pov
