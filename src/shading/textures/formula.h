// Colours by formulas.
#pragma once

#include "shading/formula_text.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Formula : PatternColors {
  static constexpr std::string_view kKeyword = "formula";
  static constexpr std::string_view kHelp =
      "formulas in x, y, z, u and v: one for a number, or one for each colour";

  FormulaText value, red, green, blue;

  static constexpr auto fields() {
    return Fields{Field{"value", &Formula::value, "", -kNoLimit, kNoLimit,
                        "the number that a, b and ramp colour, in place of red, green and blue"},
                  Field{"red", &Formula::red, "", -kNoLimit, kNoLimit, "from 0 to 1"},
                  Field{"green", &Formula::green, "", -kNoLimit, kNoLimit, "from 0 to 1"},
                  Field{"blue", &Formula::blue, "", -kNoLimit, kNoLimit, "from 0 to 1"},
                  PatternColors::fields()};
  }
  bool operator==(const Formula&) const = default;

  bool wantsUv() const { return true; }
  /// Never below 0.
  Color at(const TexturePlace& place) const {
    if (!value.text().empty()) return shade(value.at(place));
    const auto part = [&](const FormulaText& f) { return max(f.at(place), 0); };
    return {part(red), part(green), part(blue)};
  }
};

}  // namespace trace
