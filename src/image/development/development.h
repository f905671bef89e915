// From the light that was gathered to the values that a screen shows: what a photographer does between the
// film and the print.
//
//   bloom, exposure, white balance, tone, working gamma, transfer, dither
//
// By default none of it happens: the courses' programs write linear values as they are. Files that hold
// linear light (EXR, Radiance) are never developed.
#pragma once

#include "image/development/tone.h"
#include "image/picture.h"

namespace trace {

enum class Transfer {
  linear,  ///< values as they are, as in the courses' pictures
  srgb,    ///< what screens expect (IEC 61966-2-1)
};

struct Development {
  double bloom = 0;         ///< share of the light that lenses and eyes scatter around each place, 0 to 1
  double exposure = 0;      ///< stops: a power of 2
  double whiteBalance = 0;  ///< temperature in kelvin of the light that is to look white; 0: as it is
  Tone tone = Tone::clamp;
  double workingGamma = 1;  ///< exponent that makes linear light of the values
  Transfer transfer = Transfer::linear;
  bool dither = false;  ///< hides the steps of 8-bit levels in noise of one level
  bool operator==(const Development&) const = default;
};

/// The picture whose levels are to be taken.
Picture developed(Picture picture, const Development& development);

/// The levels of the developed picture, without a copy of it where each colour is developed by itself.
Bytes developedBytes(const Picture& picture, const Development& development, Rounding rounding);

/// One colour through all but bloom, dither and Tone::stretch, which need the picture.
Color developed(Color color, const Development& development);

/// Takes linear Rec. 709 to where the light of a black body (Kang et al. 2002) is white, in Bradford's cone
/// space (Lam 1985).
struct WhiteBalance {
  Color red, green, blue;  ///< rows
  Color operator()(const Color& c) const;
};
WhiteBalance whiteBalance(double kelvin);

}  // namespace trace
