#include "app/editing/short_number.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "formats/words.h"

namespace trace {
namespace {

constexpr std::string_view kUnlimited = "no limit";

std::string printed(const char* format, double value) {
  char text[400];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string printed(const char* format, int decimals, double value) {
  char text[400];
  std::snprintf(text, sizeof text, format, decimals, value);
  return text;
}

std::string withoutLastZeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// .025 for 0.025; "" for what has no such zero.
std::string withoutFirstZero(std::string text) {
  const std::size_t zero = text.find("0.");
  const bool first = zero == 0 || (zero == 1 && text[0] == '-');
  return first ? text.erase(zero, 1) : "";
}

/// 1.5e3, where printf says 1.500e+03.
std::string scientific(double value, int digits) {
  const std::string text = printed("%.*e", digits - 1, value);
  const std::size_t e = text.find('e');
  return withoutLastZeros(text.substr(0, e)) + "e" + std::to_string(std::atoi(text.c_str() + e + 1));
}

}  // namespace

std::string shortNumber(double value, const std::string& format,
                        const std::function<bool(const std::string&)>& fits) {
  constexpr int kMostDigits = 6;
  const std::string full = printed(format.c_str(), value);
  const std::size_t unit = format.find(' ', format.find('%'));
  if (fits(full) || !std::isfinite(value)) return full;
  if (unit != std::string::npos)
    if (const std::string bare = printed(format.substr(0, unit).c_str(), value); fits(bare)) return bare;
  for (int digits = kMostDigits; digits > 0; --digits) {
    const std::string tens = printed("%.*e", digits - 1, value);  // with the exponent that rounding leads to
    const int decimals = digits - 1 - std::atoi(tens.c_str() + tens.find('e') + 1);
    const std::string plain = decimals < 0 ? "" : withoutLastZeros(printed("%.*f", decimals, value));
    const std::string spellings[] = {plain, scientific(value, digits), withoutFirstZero(plain)};
    for (const std::string& text : spellings)
      if (!text.empty() && fits(text) && (digits > 1 || std::strtod(text.c_str(), nullptr) == value))
        return text;
  }
  return "...";
}

std::string_view NumberWords::of(double value, double from) const {
  if (value == from && !least.empty()) return least;
  return std::isinf(value) ? kUnlimited : std::string_view();
}

std::optional<double> NumberWords::meaning(std::string_view typed, double from) const {
  if (!least.empty() && sameWord(typed, least)) return from;
  return sameWord(typed, kUnlimited) ? unlimited : std::nullopt;
}

}  // namespace trace
