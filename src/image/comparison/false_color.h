// Colours that stand for numbers, for the eye.
#pragma once

#include <cstdint>

#include "math/color.h"

namespace trace {

/// A colour of its own for each whole number: black for 0, bright ones for the others; neighbouring numbers
/// get colours that are easy to tell apart. They never change.
Color numberColor(std::uint64_t number);

/// From black at 0 over violet, red and yellow to white at 1; ever brighter. Clamps; NaN is white.
Color heatColor(double value);

}  // namespace trace
