// A number in a field of a window: shortened where there is little room, and words where it is no quantity.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/field.h"

namespace trace {

/// The value in the format (of printf, for a double, perhaps with a unit after a space) if that fits; else
/// without the unit; else with as many digits as fit, as 1.5e3 or .025 if need be. Where neither two digits
/// that count nor all of them fit it is "...", as the first digit alone may be wrong by half of the value.
std::string shortNumber(double value, const std::string& format,
                        const std::function<bool(const std::string&)>& fits);

/// The words that a field shows, and accepts, in place of numbers that are no quantity.
struct NumberWords {
  std::string_view least{};           ///< for the least number of its range; "" if that is a quantity
  std::optional<double> unlimited{};  ///< the infinity that "no limit" means; nothing if the field takes none

  /// The word for a number of the range that begins at `from`; "" for a quantity.
  std::string_view of(double value, double from) const;
  /// The number that a word stands for, in small letters or not; nothing for other text.
  std::optional<double> meaning(std::string_view typed, double from) const;
};

}  // namespace trace
