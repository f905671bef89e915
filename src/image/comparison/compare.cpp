// Statistics of the difference of two pictures: see compare.h. Beside the life of a picture: it serves
// tests and `ray diff`. Both kinds of picture go through one loop over channel values.
// Source: definitions of mean absolute error, root mean square error and PSNR.
#include "image/comparison/compare.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/budget.h"
#include "base/error.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// `differenceAt(i)` is the distance of the i-th of 3 * width * height channel values.
template <class DifferenceAt>
Comparison statistics(int width, int height, double peak, double tolerance, DifferenceAt differenceAt) {
  Comparison c{.sameSize = true, .maxDifference = 0};
  double sum = 0, sumOfSquares = 0;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    checkBudget();
    for (int x = 0; x < width; ++x) {
      bool beyond = false;
      for (int channel = 0; channel < 3; ++channel, ++i) {
        const double d = differenceAt(i);
        if (d > c.maxDifference) {
          c.maxDifference = d;
          c.worstX = x;
          c.worstY = y;
        }
        sum += d;
        sumOfSquares += d * d;
        if (d > tolerance) {
          ++c.valuesBeyond;
          beyond = true;
        }
      }
      c.pixelsBeyond += beyond;
    }
  }
  const double n = static_cast<double>(std::max<std::size_t>(i, 1));
  c.identical = c.maxDifference == 0;
  c.mean = sum / n;
  c.rmse = std::sqrt(sumOfSquares / n);
  c.psnr = c.rmse > 0 ? 20 * math::log10(peak / c.rmse) : std::numeric_limits<double>::infinity();
  c.fractionBeyond = static_cast<double>(c.valuesBeyond) / n;
  c.pixelFractionBeyond = 3 * static_cast<double>(c.pixelsBeyond) / n;
  return c;
}

double channel(const Picture& picture, std::size_t i) {
  const Color& c = picture.pixels[i / 3];
  return i % 3 == 0 ? c.r : i % 3 == 1 ? c.g : c.b;
}

std::string sizeOf(const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); }

}  // namespace

double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

Color meanColor(const Picture& picture) {
  Color sum;
  for (const Color& color : picture.pixels) sum += color;
  return picture.pixels.empty() ? sum : sum / static_cast<double>(picture.pixels.size());
}

void checkSameSize(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error(Fault::usage, "pictures of one size expected, found " + sizeOf(a) + " and " + sizeOf(b));
}

Comparison compare(const Bytes& a, const Bytes& b, int tolerance) {
  if (a.width != b.width || a.height != b.height) return {};
  return statistics(a.width, a.height, 255, tolerance,
                    [&](std::size_t i) { return std::abs(double(a.rgb[i]) - double(b.rgb[i])); });
}

Comparison compare(const Picture& a, const Picture& b, double tolerance) {
  if (a.width != b.width || a.height != b.height) return {};
  return statistics(a.width, a.height, 1, tolerance,
                    [&](std::size_t i) { return distance(channel(a, i), channel(b, i)); });
}

}  // namespace trace
