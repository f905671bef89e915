#include "formats/tokens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/budget.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::size_t kLongLine = 200, kLongText = 40;

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }
/// 0xRRGGBBAA, as packed colours and the images in a file are written.
std::optional<ParsedNumber> hexadecimal(std::string_view text) {
  if (text.size() < 3 || text.size() > 10 || text[0] != '0' || (text[1] != 'x' && text[1] != 'X')) return {};
  double value = 0;
  for (char c : text.substr(2)) {
    const std::size_t digit = std::string_view("0123456789abcdefABCDEF").find(c);
    if (digit == std::string_view::npos) return {};
    value = value * 16 + static_cast<double>(digit < 16 ? digit : digit - 6);
  }
  return ParsedNumber{value, text.size()};
}

bool startsNumber(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

}  // namespace

Tokens::Tokens(std::string file, std::string_view source, const TokenRules& rules, std::size_t start)
    : file_(std::move(file)), source_(source), rules_(rules), at_(start) {
  if (source.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(Fault::limit, SourcePlace{file_, 0, 0, {}}, "expected a scene of less than 4 GiB of text");
  lineStarts_.push_back(0);
  for (std::size_t i = source.find('\n'); i != std::string_view::npos; i = source.find('\n', i + 1))
    lineStarts_.push_back(static_cast<std::uint32_t>(i + 1));
  advance();
}

Token Tokens::next() {
  checkBudget();
  const Token token = next_;
  if (!atEnd()) advance();
  return token;
}

std::size_t Tokens::wordEnd(std::size_t at) const {
  while (at < source_.size()) {
    const char c = source_[at];
    if (isBlank(c) || c == '"' || (rules_.comment && c == rules_.comment) ||
        (rules_.commasAreBlank && c == ',') || rules_.marks.find(c) != std::string_view::npos)
      break;
    ++at;
  }
  return at;
}

std::size_t Tokens::skipBlanks(std::size_t at) const {
  while (at < source_.size()) {
    const char c = source_[at];
    if (rules_.comment && c == rules_.comment)
      at = std::min(source_.find_first_of("\r\n", at), source_.size());
    else if (isBlank(c) || (rules_.commasAreBlank && c == ','))
      ++at;
    else
      break;
  }
  return at;
}

bool Tokens::markFollows(char mark) const {
  const std::size_t at = skipBlanks(at_);
  return at < source_.size() && source_[at] == mark;
}

void Tokens::advance() {
  at_ = skipBlanks(at_);
  next_ = {};
  next_.offset = at_;
  if (at_ == source_.size()) return;

  const char c = source_[at_];
  if (c == '"') {
    std::size_t end = at_ + 1;
    while (end < source_.size() && source_[end] != '"')
      end += rules_.stringEscapes && source_[end] == '\\' ? 2 : 1;
    if (end >= source_.size()) fail(next_, "expected a closing quote, found the end of the file");
    next_.kind = Token::Kind::string;
    next_.text = source_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return;
  }
  if (rules_.marks.find(c) != std::string_view::npos) {
    next_.kind = Token::Kind::mark;
    next_.text = source_.substr(at_++, 1);
    return;
  }
  const std::size_t end = wordEnd(at_);
  next_.kind = Token::Kind::word;
  next_.text = source_.substr(at_, end - at_);
  at_ = end;
  if (!startsNumber(c)) return;
  auto number = hexadecimal(next_.text);
  if (!number) number = parseNumber(next_.text);
  if (!number || number->length != next_.text.size()) return;
  if (!std::isfinite(number->value)) fail(next_, "expected a finite number, found " + describe(next_));
  next_.kind = Token::Kind::number;
  next_.number = number->value;
}

bool Tokens::skipMark(char mark) {
  if (!next_.isMark(mark)) return false;
  advance();
  return true;
}

bool Tokens::skipWord(std::string_view word) {
  if (!next_.isWord(word)) return false;
  advance();
  return true;
}

double Tokens::number(std::string_view what) {
  if (!next_.is(Token::Kind::number)) expected(what, "a number");
  return next().number;
}

Token Tokens::word(std::string_view what) {
  if (!next_.is(Token::Kind::word)) expected(what, "a word");
  return next();
}

Token Tokens::string(std::string_view what) {
  if (!next_.is(Token::Kind::string)) expected(what, "text in quotes");
  return next();
}

void Tokens::mark(char mark, std::string_view what) {
  if (!skipMark(mark)) expected(what, "\"" + std::string(1, mark) + "\"");
}

void Tokens::fail(const Token& at, std::string what, std::string hint) const {
  throw Error(Fault::scene, place(at), std::move(what), std::move(hint));
}

void Tokens::expected(std::string_view what, std::string_view expected, std::string hint) const {
  fail(next_, std::string(what) + ": expected " + std::string(expected) + ", found " + describe(next_),
       std::move(hint));
}

SourcePlace Tokens::place(const Token& token) const {
  if (!rules_.hasPlaces) return {.file = file_};
  const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), token.offset);
  const std::size_t start = *(after - 1);
  std::size_t end = after == lineStarts_.end() ? source_.size() : *after - 1;
  if (end > start && source_[end - 1] == '\r') --end;
  const bool isLong = end - start > kLongLine;
  return {file_, static_cast<int>(after - lineStarts_.begin()), static_cast<int>(token.offset - start) + 1,
          std::string(isLong ? std::string_view() : source_.substr(start, end - start))};
}

std::string describe(const Token& token) {
  const std::string text(token.text.substr(0, kLongText));
  const char* more = token.text.size() > kLongText ? "..." : "";
  switch (token.kind) {
    case Token::Kind::end: return "the end of the file";
    case Token::Kind::number: return text + more;
    case Token::Kind::string: return "the text \"" + text + more + "\"";
    default: return "\"" + text + more + "\"";
  }
}

}  // namespace trace
