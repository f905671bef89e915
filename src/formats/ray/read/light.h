// The lights of .ray files.
#pragma once

#include <string_view>
#include <vector>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "math/vec.h"

namespace trace::rayfile {

/// The field of a light that fades, in files that begin with `Trace 1`: its watts.
inline constexpr std::string_view kWatts = "power";
/// The watts of a light that shines to all sides with a colour of 1: a matt white surface at the distance 1
/// shows intensity / pi, and the intensity is power / (4 pi).
inline constexpr Real kPowerOfOne = 4 * kPi * kPi;

bool isLight(std::string_view keyword);
void addLightWords(std::vector<std::string_view>& words);

/// Adds the light of `point_light { ... }` and the like to the scene. Reports what is wrong. False, without a
/// report, if it is none.
bool readLight(Findings& findings, const Item& call);

}  // namespace trace::rayfile
