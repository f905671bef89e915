// Two eyes' pictures in one place, for glasses whose left glass is red and whose right one is cyan.
#pragma once

#include <array>

#include "image/picture.h"

namespace trace {

/// The weights of each eye's colour in the shown one: rows are the channels shown.
struct Anaglyph {
  std::array<Color, 3> left, right;
};

/// The red channel of the left eye's picture, green and blue of the right's.
extern const Anaglyph kRedCyan;
/// The same, with the left eye's luminance as red: colours that one glass shuts out flicker less.
extern const Anaglyph kHalfColor;
/// Both eyes' luminances.
extern const Anaglyph kGrey;
/// The least difference from what the eyes should see, over the spectra of glasses and screens (Dubois, A
/// Projection Method to Generate Anaglyph Stereo Images, ICASSP 2001).
extern const Anaglyph kDubois;

/// `both` has the left eye's picture in its left half, the right eye's in its right half.
Picture anaglyph(const Picture& both, const Anaglyph& rules);

}  // namespace trace
