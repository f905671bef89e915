// Complex indices of refraction of metals, for the three channels of linear Rec. 709.
//
// Source: laboratory measurements as collected by the SOPRA and refractiveindex.info data bases. eta is the
// mean of the measured spectrum, weighed by what light of D65 adds to the channel (CIE 1931 2-degree
// observer); k is the number for which the channel's reflectance along the normal is that of the measured
// spectrum under D65. Gold's red, which no screen can show, is taken as 0.98.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "math/color.h"

namespace trace {

enum class Metal { none, silver, aluminium, gold, copper, brass };
constexpr std::array<std::string_view, 6> names(Metal) {
  return {"none", "silver", "aluminium", "gold", "copper", "brass"};
}

struct ComplexIndex {
  Color eta, k;
};

/// Precondition: not Metal::none.
constexpr ComplexIndex indexOf(Metal metal) {
  constexpr ComplexIndex kTable[] = {{{0.1274, 0.1264, 0.1481}, {4.0767, 3.3685, 2.3824}},
                                     {{1.2458, 0.9207, 0.6298}, {7.2352, 6.5746, 5.5396}},
                                     {{0.2167, 0.4795, 1.4343}, {6.4705, 2.5730, 1.6774}},
                                     {{0.3936, 0.9639, 1.1624}, {5.7560, 2.6047, 2.3219}},
                                     {{0.4558, 0.5653, 1.0590}, {4.2499, 2.7825, 1.7611}}};
  return kTable[static_cast<int>(metal) - 1];
}

/// The index of what does not absorb and mirrors so much of light along its normal.
inline ComplexIndex indexMirroring(const Color& alongNormal) {
  const auto index = [](Real mirrored) {
    constexpr Real kMost = 0.9999;
    const Real root = std::sqrt(std::clamp(mirrored, 0.0, kMost));
    return (1 + root) / (1 - root);
  };
  return {{index(alongNormal.r), index(alongNormal.g), index(alongNormal.b)}, Color(0)};
}

}  // namespace trace
