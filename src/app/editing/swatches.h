// Colours that a person picks often, next to the picker of all.
#pragma once

#include <array>
#include <string_view>

#include "math/color.h"

namespace trace {

struct Swatch {
  std::string_view name;
  Color color;
};

/// Two rows of eight. As a surface reflects light: none reflects all of it.
inline constexpr std::array<Swatch, 16> kSwatches{{{"white", {0.85, 0.85, 0.85}},
                                                   {"light grey", {0.6, 0.6, 0.6}},
                                                   {"grey", {0.35, 0.35, 0.35}},
                                                   {"dark grey", {0.12, 0.12, 0.12}},
                                                   {"black", {0.02, 0.02, 0.02}},
                                                   {"cream", {0.85, 0.75, 0.55}},
                                                   {"sand", {0.6, 0.45, 0.28}},
                                                   {"brown", {0.25, 0.12, 0.05}},
                                                   {"red", {0.8, 0.08, 0.06}},
                                                   {"orange", {0.85, 0.35, 0.05}},
                                                   {"yellow", {0.85, 0.7, 0.08}},
                                                   {"green", {0.1, 0.5, 0.12}},
                                                   {"teal", {0.05, 0.5, 0.5}},
                                                   {"blue", {0.08, 0.2, 0.75}},
                                                   {"violet", {0.35, 0.12, 0.6}},
                                                   {"pink", {0.85, 0.35, 0.5}}}};

}  // namespace trace
