// The colours of a Background: circles around the axis y, between which they are mixed.
#pragma once

#include <vector>

#include "shading/background.h"

namespace trace::inventor {

/// Colours from a pole to where the last angle is, in radians from the pole: one angle less than colours.
struct Dome {
  std::vector<Color> colors;
  std::vector<double> angles;
};

/// The gradient of both: the ground, which is seen from straight down, before the sky, which continues with
/// its last colour. A ground of one colour ends where it begins and is not seen. Elevations are whole
/// thousandths of a degree, and one of these lies between two colours that meet. Angles that do not ascend
/// count as equal.
Background gradientOf(const Dome& sky, const Dome& ground);

}  // namespace trace::inventor
