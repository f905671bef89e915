// A number where there is little room for it, such as in a narrow field.
#pragma once

#include <functional>
#include <string>

namespace trace {

/// The value in the format (of printf, for a double, perhaps with a unit after a space) if that fits; else
/// without the unit; else with as many digits as fit, as 1.5e3 or .025 if need be. Where neither two digits
/// that count nor all of them fit it is "...", as the first digit alone may be wrong by half of the value.
std::string shortNumber(double value, const std::string& format,
                        const std::function<bool(const std::string&)>& fits);

}  // namespace trace
