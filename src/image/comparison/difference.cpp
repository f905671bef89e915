// The table of difference pictures: see difference.h. Beside the life of a picture; what `ray diff -o` writes
// and the pages of `ray grade` show.
#include "image/comparison/difference.h"

#include <algorithm>
#include <cmath>

#include "image/comparison/compare.h"
#include "image/comparison/false_color.h"

namespace trace {
namespace {

/// The picture of show(reference pixel, test pixel).
template <class ShowPixel>
Picture mapped(const Pictures& pictures, ShowPixel show) {
  checkSameSize(pictures.reference, pictures.test);
  Picture result = pictures.reference;
  std::transform(result.pixels.begin(), result.pixels.end(), pictures.test.pixels.begin(),
                 result.pixels.begin(), show);
  return result;
}

Picture absolute(const Pictures& pictures, double magnify) {
  return mapped(pictures, [&](const Color& a, const Color& b) {
    return clamp01(Color(distance(a.r, b.r), distance(a.g, b.g), distance(a.b, b.b)) * magnify);
  });
}

Picture signedDifference(const Pictures& pictures, double magnify) {
  const auto shifted = [&](double a, double b) {
    const double half = std::clamp(distance(a, b) * magnify, 0.0, 1.0) / 2;
    return b < a ? 0.5 - half : 0.5 + half;
  };
  return mapped(pictures, [&](const Color& a, const Color& b) {
    return Color(shifted(a.r, b.r), shifted(a.g, b.g), shifted(a.b, b.b));
  });
}

Picture heat(const Pictures& pictures, double magnify) {
  return mapped(pictures, [&](const Color& a, const Color& b) {
    return heatColor(magnify * std::max({distance(a.r, b.r), distance(a.g, b.g), distance(a.b, b.b)}));
  });
}

Picture flip(const Pictures& pictures, double) {
  Picture result = pictures.reference;
  std::transform(pictures.flip.begin(), pictures.flip.end(), result.pixels.begin(), heatColor);
  return result;
}

constexpr Show kShows[] = {
    {"heat", "the largest difference of a pixel's channels, in false colour from black to white", heat},
    {"absolute", "|B - A| of each channel", absolute},
    {"signed", "grey where equal, brighter where B is brighter, darker where it is darker", signedDifference},
    {"flip", "the error that an eye sees, in false colour; not magnified", flip},
};

}  // namespace

std::span<const Show> shows() { return kShows; }

}  // namespace trace
