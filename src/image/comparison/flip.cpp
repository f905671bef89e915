// LDR-FLIP: see flip.h. Beside the life of a picture. Section numbers are those of the paper; its filters are
// products of one-dimensional ones, and are applied as those, which gives the same sums.
#include "image/comparison/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/budget.h"
#include "image/comparison/compare.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "math/transform.h"

namespace trace {
namespace {

// --- colour spaces ------------------------------------------------------------------------------------

/// CIE XYZ of linear sRGB, in the fractions of the paper's supplement.
const Affine kXyzFromRgb{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                          {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                          {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}},
                         {}};
const Affine kRgbFromXyz = inverse(kXyzFromRgb);
const Vec3 kWhite = kXyzFromRgb * Vec3{1, 1, 1};

double linearFromSrgb(double c) { return c > 0 ? linearOfSrgb(std::min(c, 1.0)) : 0; }

/// The opponent space YyCxCz: black-white, red-green, blue-yellow; linear in XYZ.
Vec3 opponentFromRgb(const Vec3& rgb) {
  const Vec3 xyz = kXyzFromRgb * rgb;
  const double x = xyz.x / kWhite.x, y = xyz.y / kWhite.y, z = xyz.z / kWhite.z;
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Vec3 rgbFromOpponent(const Vec3& opponent) {
  const double y = (opponent.x + 16) / 116, x = y + opponent.y / 500, z = y - opponent.z / 200;
  return kRgbFromXyz * Vec3{x * kWhite.x, y * kWhite.y, z * kWhite.z};
}

/// L*a*b* whose colours fade in the dark, after Hunt (4.1.2).
Vec3 huntLabFromRgb(const Vec3& rgb) {
  const auto curve = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? math::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const Vec3 xyz = kXyzFromRgb * rgb;
  const double x = curve(xyz.x / kWhite.x), y = curve(xyz.y / kWhite.y), z = curve(xyz.z / kWhite.z);
  const double lightness = 116 * y - 16, hunt = 0.01 * lightness;
  return {lightness, hunt * 500 * (x - y), hunt * 200 * (y - z)};
}

// --- filters ------------------------------------------------------------------------------------------

struct Layer {
  int width = 0, height = 0;
  std::vector<double> values;

  Layer(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// Weights from -radius to radius.
using Kernel = std::vector<double>;

template <class Weight>
Kernel kernel(int radius, Weight weight) {
  Kernel k;
  for (int x = -radius; x <= radius; ++x) {
    checkBudget();
    k.push_back(weight(static_cast<double>(x)));
  }
  return k;
}

/// Positive weights add up to 1, negative ones to -1.
Kernel normalized(Kernel k) {
  double positive = 0, negative = 0;
  for (double w : k) (w > 0 ? positive : negative) += w;
  for (double& w : k) w /= w > 0 ? positive : -negative;
  return k;
}

/// Beyond its border the picture continues as it ends.
Layer filteredRows(Layer plane, const Kernel& k) {
  const int radius = static_cast<int>(k.size() / 2), length = plane.width + 2 * radius;
  std::vector<double> row(static_cast<std::size_t>(length));
  for (int y = 0; y < plane.height; ++y) {
    for (int x = -radius; x < plane.width + radius; ++x)
      row[static_cast<std::size_t>(x + radius)] = plane.at(std::clamp(x, 0, plane.width - 1), y);
    for (int x = 0; x < plane.width; ++x) {
      checkBudget();
      plane.at(x, y) = std::inner_product(k.begin(), k.end(), row.begin() + x, 0.0);
    }
  }
  return plane;
}

Layer transposed(Layer plane) {
  Layer result(plane.height, plane.width);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) result.at(y, x) = plane.at(x, y);
  return result;
}

Layer filtered(const Layer& plane, const Kernel& alongX, const Kernel& alongY) {
  return transposed(filteredRows(transposed(filteredRows(plane, alongX)), alongY));
}

// --- colour (4.1) -------------------------------------------------------------------------------------

/// The contrast sensitivity of the eye in one channel: a sum of Gaussians, of angles in degrees.
struct Sensitivity {
  double a, b;
};

int colorRadius(double pixelsPerDegree) {
  constexpr double kWidest = 0.04;  // largest b of all channels
  return static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
}

Layer spatiallyFiltered(const Layer& plane, std::initializer_list<Sensitivity> sum, double pixelsPerDegree) {
  const int radius = colorRadius(pixelsPerDegree);
  Layer result(plane.width, plane.height);
  double all = 0;
  for (const Sensitivity& s : sum) {
    const Kernel k = kernel(radius, [&](double x) {
      const double degrees = x / pixelsPerDegree;
      return math::exp(-kPi * kPi * degrees * degrees / s.b);
    });
    const double weight = s.a * std::sqrt(kPi / s.b);
    const double size = std::accumulate(k.begin(), k.end(), 0.0);
    all += weight * size * size;
    const Layer part = filtered(plane, k, k);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += weight * part.values[i];
  }
  for (double& value : result.values) value /= all;
  return result;
}

/// The colours that an eye sees at this distance, to be subtracted.
std::vector<Vec3> seenColors(const std::array<Layer, 3>& opponent, double pixelsPerDegree) {
  const Layer y = spatiallyFiltered(opponent[0], {{1, 0.0047}}, pixelsPerDegree);
  const Layer cx = spatiallyFiltered(opponent[1], {{1, 0.0053}}, pixelsPerDegree);
  const Layer cz = spatiallyFiltered(opponent[2], {{34.1, 0.04}, {13.5, 0.025}}, pixelsPerDegree);
  std::vector<Vec3> colors;
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const Vec3 rgb = rgbFromOpponent({y.values[i], cx.values[i], cz.values[i]});
    colors.push_back(huntLabFromRgb(min(max(rgb, Vec3{}), Vec3{1, 1, 1})));
  }
  return colors;
}

/// The HyAB distance, raised to the power that makes large ones count less (4.1.3).
double colorDistance(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return math::pow(std::abs(d.x) + math::hypot(d.y, d.z), 0.7);
}

/// From 0 to 1; distances below 0.4 of the largest there is take 0 to 0.95 (4.1.4).
double colorError(double distance) {
  static const double largest = colorDistance(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1}));
  constexpr double kShare = 0.4, kError = 0.95;
  const double bend = kShare * largest;
  if (distance < bend) return kError / bend * distance;
  return kError + (distance - bend) / (largest - bend) * (1 - kError);
}

// --- features (4.2) -----------------------------------------------------------------------------------

/// How strongly edges and points stand out at each pixel.
struct Features {
  std::vector<double> edges, points;
};

/// The width of the detector of edges: 0.082 degrees lie between its peak and trough.
double featureDeviation(double pixelsPerDegree) { return 0.5 * 0.082 * pixelsPerDegree; }
int featureRadius(double pixelsPerDegree) {
  return static_cast<int>(std::ceil(3 * featureDeviation(pixelsPerDegree)));
}

Features features(const Layer& opponentY, double pixelsPerDegree) {
  Layer luminance = opponentY;
  for (double& value : luminance.values) value = (value + 16) / 116;
  const double deviation = featureDeviation(pixelsPerDegree);
  const int radius = featureRadius(pixelsPerDegree);
  const auto gauss = [&](double x) { return math::exp(-x * x / (2 * deviation * deviation)); };
  const Kernel smooth = normalized(kernel(radius, gauss));
  const Kernel first = normalized(kernel(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel second =
      normalized(kernel(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
  const auto magnitude = [&](const Kernel& across) {
    const Layer x = filtered(luminance, across, smooth), y = filtered(luminance, smooth, across);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < x.values.size(); ++i)
      lengths.push_back(math::hypot(x.values[i], y.values[i]));
    return lengths;
  };
  return {magnitude(first), magnitude(second)};
}

std::array<Layer, 3> opponentPlanes(const Picture& picture) {
  const Layer empty(picture.width, picture.height);
  std::array<Layer, 3> planes{empty, empty, empty};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Color& c = picture.pixels[i];
    const Vec3 opponent = opponentFromRgb({linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b)});
    for (int channel = 0; channel < 3; ++channel)
      planes[static_cast<std::size_t>(channel)].values[i] = opponent[channel];
  }
  return planes;
}

/// The errors of pictures that fit into memory many times over.
std::vector<double> errorsOf(const Picture& reference, const Picture& test, double pixelsPerDegree) {
  const auto a = opponentPlanes(reference), b = opponentPlanes(test);
  const std::vector<Vec3> colorsA = seenColors(a, pixelsPerDegree), colorsB = seenColors(b, pixelsPerDegree);
  const Features featuresA = features(a[0], pixelsPerDegree), featuresB = features(b[0], pixelsPerDegree);
  std::vector<double> errors;
  for (std::size_t i = 0; i < colorsA.size(); ++i) {
    const double color = colorError(colorDistance(colorsA[i], colorsB[i]));
    const double feature = std::max(std::abs(featuresA.edges[i] - featuresB.edges[i]),
                                    std::abs(featuresA.points[i] - featuresB.points[i]));
    const double exponent = 1 - std::min(1.0, std::sqrt(feature / std::sqrt(2.0)));
    errors.push_back(color > 0 ? std::min(1.0, math::pow(color, exponent)) : 0);
  }
  return errors;
}

/// Rows y0 <= y < y1.
Picture rowsOf(const Picture& picture, int y0, int y1) {
  Picture rows(picture.width, y1 - y0);
  std::copy_n(&picture.at(0, y0), rows.pixels.size(), rows.pixels.begin());
  return rows;
}

}  // namespace

double usualPixelsPerDegree() { return 0.7 * (3840 / 0.7) * (kPi / 180); }

std::vector<double> flipErrors(const Picture& reference, const Picture& test, double pixelsPerDegree) {
  checkSameSize(reference, test);
  std::vector<double> errors;
  errors.reserve(reference.pixels.size());
  // In bands, since a pixel takes 200 bytes while it is worked on. Each has the rows around it that its
  // filters reach, so that the numbers are those of the whole picture, to the last bit.
  constexpr int kRows = 256;
  const int reach = std::max(colorRadius(pixelsPerDegree), featureRadius(pixelsPerDegree));
  const int height = reference.height;
  for (int y = 0; y < height && reference.width > 0; y += kRows) {
    const int end = std::min(y + kRows, height);
    const int y0 = y - std::min(y, reach), y1 = end + std::min(height - end, reach);
    const std::vector<double> band =
        errorsOf(rowsOf(reference, y0, y1), rowsOf(test, y0, y1), pixelsPerDegree);
    const auto width = static_cast<std::ptrdiff_t>(reference.width);
    errors.insert(errors.end(), band.begin() + (y - y0) * width, band.begin() + (end - y0) * width);
  }
  return errors;
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace trace
