// The values of a scene of British Columbia: numbers, vectors, and keys of materials and lights.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "formats/tokens.h"
#include "formats/warnings.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::ubc {

/// A key of a material or light: `"name" 1`, `"name" [1 2 3]` or `"name" "text"`.
struct Parameter {
  Token key;
  std::vector<double> numbers;
  std::optional<std::string_view> text;
};

class Values {
 public:
  Values(const std::string& file, std::string_view bytes, Messages& to)
      : tokens(file, bytes, kRules), messages(to) {}

  /// A number, or a list of one.
  double number(std::string_view what) {
    if (!tokens.skipMark('[')) return tokens.number(what);
    const double value = tokens.number(what);
    tokens.mark(']', what);
    return value;
  }
  Vec3 vector(std::string_view what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
  }
  std::vector<double> list(std::string_view what) {
    std::vector<double> numbers;
    if (!tokens.skipMark('[')) return {tokens.number(what)};
    while (!tokens.skipMark(']')) numbers.push_back(tokens.number(what));
    return numbers;
  }
  std::vector<Parameter> parameters() {
    std::vector<Parameter> all;
    while (tokens.peek().is(Token::Kind::string)) {
      Parameter& parameter = all.emplace_back();
      parameter.key = tokens.next();
      for (std::size_t i = 0; i + 1 < all.size(); ++i)
        if (all[i].key.text == parameter.key.text) repeated(parameter.key);
      if (tokens.peek().is(Token::Kind::string))
        parameter.text = tokens.next().text;
      else
        parameter.numbers = list(parameter.key.text);
    }
    return all;
  }
  void repeated(const Token& key) {
    warnings.warn(tokens.place(key),
                  "\"" + std::string(key.text.substr(0, 40)) + "\" is given again; the last counts");
  }
  double single(const Parameter& p) const {
    counted(p, 1);
    return p.numbers[0];
  }
  Color color(const Parameter& p) const {
    counted(p, 3);
    return Color{p.numbers[0], p.numbers[1], p.numbers[2]};
  }
  void counted(const Parameter& p, std::size_t count) const {
    if (p.numbers.size() == count) return;
    tokens.fail(p.key, std::string(p.key.text) + ": expected " + std::to_string(count) +
                           (count == 1 ? " number" : " numbers") + ", found " +
                           (p.text ? "text" : std::to_string(p.numbers.size())));
  }

  /// The 2016 template looked for "ambientColor", its scenes say "ambient".
  static std::string_view canonical(std::string_view key) {
    if (key.size() > 5 && key.ends_with("Color")) key.remove_suffix(5);
    if (key == "transparent") return "transparency";
    if (key == "rfrIndex") return "eta";
    return key;
  }
  /// Warns of a key that has no effect, once.
  void ignored(const Parameter& p, std::string_view owner) {
    static constexpr std::array<std::string_view, 11> kKeys{
        "ambient", "diffuse", "specular",     "emission", "shininess",  "shadow",
        "reflect", "refract", "transparency", "rfrIndex", "attenuation"};
    if (std::find(told_.begin(), told_.end(), p.key.text) != told_.end()) return;
    told_.emplace_back(p.key.text);
    messages.warn(tokens.place(p.key),
                  "\"" + std::string(p.key.text) + "\" of a " + std::string(owner) + " is ignored",
                  didYouMean(p.key.text, kKeys));
  }

  Tokens tokens;
  Messages& messages;
  WarningsByKind warnings;

 private:
  static constexpr TokenRules kRules{.marks = "[]", .comment = '#'};

  std::vector<std::string> told_;
};

}  // namespace trace::ubc
