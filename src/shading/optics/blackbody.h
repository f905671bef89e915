// The colour of a body that glows because it is hot, by Planck's law (1901) seen by the CIE's observer of
// 1931.
#pragma once

#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// Linear Rec. 709, without what is below 0, as a fraction of the luminance of a body of 1,900 kelvin, which
/// is about a candle's: it is 1 there, and grows steeply with the temperature. Black below 500 kelvin.
Color blackbodyColor(Real kelvin);

}  // namespace trace
