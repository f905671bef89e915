// The options that .ray files set: `settings { depth = 3; }`.
#pragma once

#include <string>
#include <string_view>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

inline constexpr std::string_view kSettings = "settings";

/// Adds the options of the block to the scene's choices. Reports what is wrong.
void readSettings(Findings& findings, const Item& call);

/// The value of an option as a person writes it: numbers and words bare. Throws as exactly().
std::string writtenChoice(const std::string& value);

}  // namespace trace::rayfile
