// A formula as a scene keeps it.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/error.h"
#include "math/expression.h"
#include "shading/texture_place.h"

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

}  // namespace trace
