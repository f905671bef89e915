// Statistics of the difference of two pictures: see compare.h. Beside the life of a picture: it serves
// tests and `ray diff`. Both kinds of picture go through one loop over channel values.
// Source: definitions of mean absolute error, root mean square error and PSNR.
#include "image/compare.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace trace {
namespace {

/// |a - b|, where equal infinities and two NaN are equal and NaN is infinitely far from any number.
double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

/// `differenceAt(i)` is the distance of the i-th of `count` channel values.
template <class DifferenceAt>
Comparison statistics(std::size_t count, double peak, double tolerance, DifferenceAt differenceAt) {
  double largest = 0, sum = 0, sumOfSquares = 0;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = differenceAt(i);
    largest = std::max(largest, d);
    sum += d;
    sumOfSquares += d * d;
    if (d > tolerance) ++beyond;
  }
  const double n = static_cast<double>(std::max<std::size_t>(count, 1));
  const double rmse = std::sqrt(sumOfSquares / n);
  return {.sameSize = true,
          .identical = largest == 0,
          .maxDifference = largest,
          .mean = sum / n,
          .rmse = rmse,
          .psnr = rmse > 0 ? 20 * std::log10(peak / rmse) : std::numeric_limits<double>::infinity(),
          .valuesBeyond = beyond,
          .fractionBeyond = static_cast<double>(beyond) / n};
}

double channel(const Picture& picture, std::size_t i) {
  const Color& c = picture.pixels[i / 3];
  return i % 3 == 0 ? c.r : i % 3 == 1 ? c.g : c.b;
}

std::string sizeOf(const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); }

}  // namespace

Comparison compare(const Bytes& a, const Bytes& b, int tolerance) {
  if (a.width != b.width || a.height != b.height) return {};
  return statistics(a.rgb.size(), 255, tolerance,
                    [&](std::size_t i) { return std::abs(double(a.rgb[i]) - double(b.rgb[i])); });
}

Comparison compare(const Picture& a, const Picture& b, double tolerance) {
  if (a.width != b.width || a.height != b.height) return {};
  return statistics(3 * a.pixels.size(), 1, tolerance,
                    [&](std::size_t i) { return distance(channel(a, i), channel(b, i)); });
}

Picture differencePicture(const Picture& a, const Picture& b, double magnify) {
  if (a.width != b.width || a.height != b.height)
    throw Error(Fault::usage, "pictures of one size expected, found " + sizeOf(a) + " and " + sizeOf(b));
  Picture result(a.width, a.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const Color &p = a.pixels[i], &q = b.pixels[i];
    result.pixels[i] = Color(distance(p.r, q.r), distance(p.g, q.g), distance(p.b, q.b)) * magnify;
  }
  return result;
}

}  // namespace trace
