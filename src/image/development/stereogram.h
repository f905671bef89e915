// Single-image random-dot stereograms: a picture that repeats itself at distances that tell two eyes, which
// look past it, how far away things are.
//
// Thimbleby, Inglis and Witten, Displaying 3D Images: Algorithms for Single-Image Random-Dot Stereograms,
// IEEE Computer 27(10), 1994.
#pragma once

#include <cstdint>
#include <vector>

#include "image/picture.h"

namespace trace {

struct StereogramRules {
  double eyes = 180;       ///< pixels between the eyes: 2.5 inches at 72 dots an inch
  double depth = 1.0 / 3;  ///< mu: how near the nearest is, of the way from the farthest to the eyes
  std::uint64_t seed = 0;  ///< other dots
  const Picture* pattern = nullptr;  ///< repeated instead of dots, if any; not empty
  double nearest = 0, farthest = 0;  ///< the range of distances; 0, 0: that of the picture
  bool guides = false;  ///< two dots near the lower edge, which fall together when one looks right
};

/// Pixels between the two places of the picture that show one point of depth z, 0 the farthest and 1 the
/// nearest: round((1 - mu z) E / (2 - mu z)).
int separation(double z, const StereogramRules& rules);

/// The depths of a row, 0 to 1: what lies the same in both eyes gets the same colour; what one eye cannot see
/// is left free. For each place the next to the right with which it is linked, or itself.
std::vector<int> linkedPlaces(const std::vector<double>& row, const StereogramRules& rules);

/// The stereogram of distances, in the red channel; infinite ones are the farthest.
Picture stereogram(const Picture& distances, const StereogramRules& rules);

}  // namespace trace
