#include "library/images.h"

#include <algorithm>

#include "app/compare/difference.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "image/comparison/difference.h"
#include "image/comparison/flip.h"
#include "library/guard.h"

namespace traceray {
namespace {

/// As `ray diff` by default.
constexpr double kMagnify = 8;

Difference differenceOf(trace::LoadedPicture reference, trace::LoadedPicture test, double tolerance) {
  const trace::PictureDifference found =
      trace::difference(std::move(reference), std::move(test), {tolerance, trace::usualPixelsPerDegree()});
  Difference difference;
  difference.sameSize = found.numbers.sameSize;
  difference.identical = found.numbers.identical;
  difference.unit = found.unit();
  for (const trace::Metric& metric : trace::metrics())
    difference.metrics.emplace_back(metric.name, metric.value(found));
  difference.worstX = found.numbers.worstX;
  difference.worstY = found.numbers.worstY;
  if (found.numbers.sameSize)
    difference.heat = imageOf(trace::shows().front().picture(found.pictures(), kMagnify));
  return difference;
}

}  // namespace

Image imageOf(const trace::Picture& picture) {
  Image image{.width = picture.width, .height = picture.height};
  image.values.reserve(3 * picture.pixels.size());
  for (const trace::Color& c : picture.pixels)
    for (const double value : {c.r, c.g, c.b}) image.values.push_back(static_cast<float>(value));
  return image;
}

trace::Picture pictureOf(const Image& image) {
  const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                      static_cast<std::size_t>(std::max(image.height, 0));
  if (pixels == 0 || image.values.size() != 3 * pixels)
    throw Error(Error::Kind::usage, "image: expected width x height x 3 values, found " +
                                        std::to_string(image.width) + " x " + std::to_string(image.height) +
                                        " pixels and " + std::to_string(image.values.size()) + " values");
  trace::Picture picture(image.width, image.height);
  for (std::size_t i = 0; i < pixels; ++i)
    picture.pixels[i] = {image.values[3 * i], image.values[3 * i + 1], image.values[3 * i + 2]};
  return picture;
}

Image Image::read(const std::string& file) {
  return guarded([&] {
    const trace::LoadedPicture loaded = trace::loadPicture(file);
    Image image = imageOf(loaded.picture);
    image.levels = loaded.levels;
    return image;
  });
}

void Image::write(const std::string& file) const {
  guarded([&] { writePicture(file, pictureOf(*this), trace::Rounding::nearest); });
}

double Difference::metric(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const auto& [known, value] : metrics) {
    if (known == name) return value;
    names.push_back(known);
  }
  throw Error(Error::Kind::usage, "expected the name of a metric, found \"" + std::string(name) + "\"",
              trace::didYouMean(name, names));
}

Difference diff(const Image& reference, const Image& test, double tolerance) {
  return guarded([&] {
    return differenceOf({pictureOf(reference), reference.levels}, {pictureOf(test), test.levels}, tolerance);
  });
}

Difference diff(const std::string& reference, const std::string& test, double tolerance) {
  return guarded(
      [&] { return differenceOf(trace::loadPicture(reference), trace::loadPicture(test), tolerance); });
}

}  // namespace traceray
