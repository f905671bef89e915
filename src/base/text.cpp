#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace trace {
namespace {

/// How many slips of the pen lead from one word to the other: a letter too many, one missing, a wrong one, or
/// two neighbours exchanged (Damerau's and Levenshtein's distance, the restricted one).
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// The letters of the shorter word stand in the other one in the same order.
bool isPartOf(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  for (const char letter : b)
    if (!a.empty() && letter == a.front()) a.remove_prefix(1);
  return a.empty();
}

/// The usual numbers of files: up to 15 digits, perhaps with a point among them. They are a whole number and
/// a power of ten that doubles hold exactly, so that their quotient is rounded once, as it should be.
std::optional<ParsedNumber> parseShort(std::string_view text) {
  static constexpr double kPowers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = !text.empty() && text[0] == '-';
  const size_t start = negative ? 1 : 0, most = std::min(text.size(), start + 16);
  std::uint64_t digits = 0;
  size_t point = text.npos, at = start;
  for (; at < most; ++at) {
    const auto digit = static_cast<unsigned>(text[at] - '0');
    if (digit < 10)
      digits = digits * 10 + digit;
    else if (text[at] == '.' && point == text.npos)
      point = at;
    else
      break;
  }
  const size_t count = at - start - (point == text.npos ? 0 : 1);
  if (count == 0 || count > 15) return {};
  if (at < text.size() &&
      (text[at] == 'e' || text[at] == 'E' || text[at] == '.' || static_cast<unsigned>(text[at] - '0') < 10))
    return {};
  const double size = static_cast<double>(digits) / kPowers[point == text.npos ? 0 : at - point - 1];
  return ParsedNumber{negative ? -size : size, at};
}

}  // namespace

std::optional<ParsedNumber> parseNumber(std::string_view text) {
  if (const auto number = parseShort(text)) return number;
  const size_t plus = !text.empty() && text[0] == '+' ? 1 : 0;
  const std::string_view digits = text.substr(plus);
  if (plus && !digits.empty() && digits[0] == '-') return {};
#if defined(__cpp_lib_to_chars)
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::invalid_argument) return {};
  const size_t length = static_cast<size_t>(end - digits.data());
  if (status == std::errc::result_out_of_range)
    value = std::strtod(std::string(digits, 0, length).c_str(), nullptr);
  return ParsedNumber{value, length + plus};
#else  // libraries without floating from_chars (the web build); the "C" locale is never changed
  const std::size_t hexadecimal = digits.find_first_of("xX");  // only the 0 before it is a number here
  const std::string copy(digits.substr(0, std::min<std::size_t>(400, hexadecimal)));
  if (copy.empty() || std::isspace(static_cast<unsigned char>(copy[0]))) return {};
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end == copy.c_str()) return {};
  return ParsedNumber{value, static_cast<size_t>(end - copy.c_str()) + plus};
#endif
}

namespace {

/// The least number of digits that the number may need.
int fewestDigits(double number) {
#if defined(__cpp_lib_to_chars)
  char buffer[40];
  const char* end = std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::scientific).ptr;
  const auto digits =
      std::count_if(static_cast<const char*>(buffer), std::find(static_cast<const char*>(buffer), end, 'e'),
                    [](char c) { return c >= '0' && c <= '9'; });
  return std::max(1, static_cast<int>(digits));
#else
  static_cast<void>(number);
  return 1;
#endif
}

}  // namespace

std::string toText(double number) {
  constexpr double kWhole = 1e15;
  if (std::abs(number) < kWhole && number == std::floor(number) && number != 0)
    return std::to_string(static_cast<long long>(number));
  char buffer[40];
  for (int digits = fewestDigits(number); digits <= 17; ++digits) {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, number);
    if (std::strtod(buffer, nullptr) == number) break;
  }
  // "1000" rather than "1e+03"
  if (std::abs(number) >= 1 && std::abs(number) < 1e15 && std::strchr(buffer, 'e'))
    std::snprintf(buffer, sizeof buffer, "%.0f", number);
  return buffer;
}

void appendNumber(std::string& text, double number, int digits) {
  char buffer[40];
  if (digits > 0) {
    text.append(buffer, static_cast<size_t>(std::snprintf(buffer, sizeof buffer, "%.*g", digits, number)));
    return;
  }
#if defined(__cpp_lib_to_chars)
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
#else
  text += toText(number);
#endif
}

void appendNumber(std::string& text, float number, int digits) {
  if (digits > 0) return appendNumber(text, static_cast<double>(number), digits);
  char buffer[40];
  size_t length = 0;
#if defined(__cpp_lib_to_chars)
  length = static_cast<size_t>(std::to_chars(buffer, buffer + sizeof buffer, number).ptr - buffer);
#else
  for (int n = 1; n <= 9; ++n) {
    length =
        static_cast<size_t>(std::snprintf(buffer, sizeof buffer, "%.*g", n, static_cast<double>(number)));
    if (std::strtof(buffer, nullptr) == number) break;
  }
#endif
  // Rounding twice, to a double and then to a float, can differ from rounding once.
  const auto back = parseNumber({buffer, length});
  if (back && static_cast<float>(back->value) == number)
    text.append(buffer, length);
  else
    appendNumber(text, static_cast<double>(number));
}

std::string nearest(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.size() > 60) return {};
  std::string_view best;
  // Among words that are equally near, one with letters left out or too many is chosen: no letter was chosen
  // wrong.
  size_t least = 2 * (std::max<size_t>(1, word.size() / 3) + 1);
  for (std::string_view candidate : candidates) {
    const size_t distance = 2 * editDistance(word, candidate) + (isPartOf(word, candidate) ? 0 : 1);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return std::string(best);
}

std::string didYouMean(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? std::string() : "did you mean \"" + best + "\"?";
}

SourcePlace placeAt(std::string_view file, std::string_view source, size_t offset) {
  offset = std::min(offset, source.size());
  const std::string_view before = source.substr(0, offset);
  const size_t newline = before.rfind('\n');
  const size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  const size_t end = std::min(source.find('\n', offset), source.size());
  std::string_view text = source.substr(start, end - start);
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return {std::string(file), static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(offset - start) + 1, std::string(text)};
}

std::string counted(std::size_t n, std::string_view noun) {
  const bool sibilant = noun.ends_with("s") || noun.ends_with("x") || noun.ends_with("sh");
  return std::to_string(n) + " " + std::string(noun) + (n == 1 ? "" : sibilant ? "es" : "s");
}

}  // namespace trace
