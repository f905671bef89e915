// The lights of .ray files.
#pragma once

#include <string_view>
#include <vector>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

bool isLight(std::string_view keyword);
void addLightWords(std::vector<std::string_view>& words);

/// Adds the light of `point_light { ... }` and the like to the scene. Reports what is wrong. False, without a
/// report, if it is none.
bool readLight(Findings& findings, const Item& call);

}  // namespace trace::rayfile
