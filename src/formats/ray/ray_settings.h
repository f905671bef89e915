// The options that .ray files set: `settings { depth = 3; }`.
#pragma once

#include <string_view>

#include "formats/ray/ray_findings.h"
#include "formats/ray/ray_syntax.h"

namespace trace::rayfile {

inline constexpr std::string_view kSettings = "settings";

/// Adds the options of the block to the scene's choices. Reports what is wrong.
void readSettings(Findings& findings, const Item& call);

}  // namespace trace::rayfile
