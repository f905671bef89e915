// How far two pictures are apart, in numbers.
//
// Used by tests, `ray diff` and `ray grade`. Levels (0 to 255) are what graders and idiff look at; colours
// are for pictures with values above 1. All statistics run over channel values, three per pixel. What an eye
// makes of the difference is flip.h; pictures of it are in difference.h. Source: the usual definitions; PSNR
// = 20 log10(peak / rmse) with peak 255 for levels, 1 for colours.
#pragma once

#include <cstddef>
#include <limits>

#include "image/development/tone.h"
#include "image/picture.h"

namespace trace {

/// Differences in levels or in linear units, as the pictures compared. The defaults are those of
/// pictures whose sizes differ: as far apart as can be.
struct Comparison {
  bool sameSize = false;
  bool identical = false;  ///< every value equal; two NaN at one place count as equal
  double maxDifference = std::numeric_limits<double>::infinity();
  int worstX = 0, worstY = 0;                             ///< the first pixel with the largest difference
  double mean = std::numeric_limits<double>::infinity();  ///< of |a - b|
  double rmse = std::numeric_limits<double>::infinity();
  double psnr = 0;               ///< decibel; infinite when identical
  std::size_t valuesBeyond = 0;  ///< channel values that differ by more than the tolerance
  double fractionBeyond = 1;     ///< valuesBeyond / all values
  std::size_t pixelsBeyond = 0;  ///< pixels with a value beyond the tolerance
  double pixelFractionBeyond = 1;
};

/// Compares levels; `tolerance` in levels.
Comparison compare(const Bytes& a, const Bytes& b, int tolerance = 0);

/// Compares colours; `tolerance` in linear units. A NaN against a number is infinitely far.
Comparison compare(const Picture& a, const Picture& b, double tolerance = 0);

/// |a - b|, where equal infinities and two NaN are equal and NaN is infinitely far from any number.
double distance(double a, double b);

/// The mean of all pixels; black if there are none.
Color meanColor(const Picture& picture);

/// Throws Error(Fault::usage) when the sizes differ.
void checkSameSize(const Picture& a, const Picture& b);

}  // namespace trace
