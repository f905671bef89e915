// Linear pictures made visible: with an exposure, or as their difference in false colours.
#pragma once

#include <string>

#include "image/picture.h"
#include "image/tone.h"

namespace trace {

/// Brightened by `stops` powers of two and rounded to levels. 0 stops gives the levels of a file.
Bytes exposed(const Picture& picture, double stops, Rounding rounding);

/// What a pixel is, in words: its linear colour, and the levels of what the tone makes of it.
std::string pixelText(const Color& linear, const Color& toned, Rounding rounding);

/// |a - b| * magnify for each channel. Precondition: the same size.
Picture differences(const Picture& a, const Picture& b, double magnify);

/// The largest difference of the channels of each pixel, times `magnify`: black where there is none, then
/// blue, green, yellow, red, and white from 1 on. Precondition: the same size.
Picture falseColours(const Picture& a, const Picture& b, double magnify);

/// The colour that falseColours() gives a value.
Color falseColour(double value);

/// The levels as a file keeps them that has none beyond 0 and 1: what a picture from such a file is compared
/// with.
Picture clamped(Picture levels);

}  // namespace trace
