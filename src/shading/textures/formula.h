// Colours by formulas.
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "math/expression.h"
#include "shading/textures/pattern.h"

namespace trace {

/// A formula in x, y, z, u and v, and what follows from it. Empty: 0.
class FormulaText {
 public:
  FormulaText() = default;
  /// Throws Error(Fault::scene) that says what was expected at which character.
  explicit FormulaText(std::string text)
      : text_(std::move(text)),
        parsed_(text_.empty() ? nullptr
                              : std::make_shared<const Expression>(text_, Expression::Variables::xyzuv)) {}

  const std::string& text() const { return text_; }
  bool operator==(const FormulaText& other) const { return text_ == other.text_; }

  /// 0 where the formula has no value.
  Real at(const TexturePlace& place) const {
    const Real value = parsed_ ? parsed_->at(place.point, place.uv) : 0;
    return std::isfinite(value) ? value : 0;
  }

 private:
  std::string text_;
  std::shared_ptr<const Expression> parsed_;
};

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
