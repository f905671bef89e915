#include "app/compare/difference.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "image/codecs/picture_name.h"
#include "image/comparison/flip.h"

namespace trace {
namespace {

constexpr std::array kMetrics{
    Metric{"max", "largest difference of a channel", "", false,
           [](const PictureDifference& d) { return d.numbers.maxDifference; }},
    Metric{"mean", "mean of the differences of all channels", "", false,
           [](const PictureDifference& d) { return d.numbers.mean; }},
    Metric{"rmse", "root of the mean of their squares", "", false,
           [](const PictureDifference& d) { return d.numbers.rmse; }},
    Metric{"psnr", "peak signal to noise ratio", "dB", true,
           [](const PictureDifference& d) { return d.numbers.psnr; }},
    Metric{"flip", "mean FLIP error, the perceived difference: 0 none, 1 the most", "of 1", false,
           [](const PictureDifference& d) { return d.flip; }},
    Metric{"beyond", "values that differ by more than the tolerance", "%", false,
           [](const PictureDifference& d) { return 100 * d.numbers.fractionBeyond; }},
    Metric{"pixels", "pixels that differ", "%", false,
           [](const PictureDifference& d) { return 100 * d.numbers.pixelFractionBeyond; }},
};

}  // namespace

LoadedPicture loadPicture(const std::string& path) {
  const Work work("reading a picture");
  const std::string bytes = readInput(pictureName(path).file);
  return {decodePicture(bytes, path), !pictureFormatOf(bytes, path).keepsBright, pictureRemark(bytes, path)};
}

PictureDifference difference(LoadedPicture reference, LoadedPicture test, const DifferenceOptions& options) {
  PictureDifference d;
  d.reference = std::move(reference);
  d.test = std::move(test);
  d.levels = d.reference.levels && d.test.levels;
  d.tolerance = options.tolerance;
  const Picture &a = d.reference.picture, &b = d.test.picture;
  std::optional<BudgetScope> late;  // without FLIP the numbers cost less than reading the pictures
  if (options.flipMayLack) late.emplace(nullptr);
  if (d.levels)
    d.numbers = compare(toBytes(a, Rounding::nearest), toBytes(b, Rounding::nearest),
                        static_cast<int>(std::min(options.tolerance, 255.0)));
  else
    d.numbers = compare(a, b, options.tolerance);
  late.reset();
  if (!d.numbers.sameSize) return d;
  if (d.numbers.identical)
    d.flipErrors.assign(a.pixels.size(), 0);
  else
    try {
      lookAtBudget();
      d.flipErrors = flipErrors(a, b, options.pixelsPerDegree);
    } catch (const Error& error) {
      if (error.fault() != Fault::limit || !options.flipMayLack) throw;
      d.stopped = error.messages().front().what;
      d.flipErrors.clear();
    }
  d.flip = d.stopped.empty() ? mean(d.flipErrors) : std::numeric_limits<double>::quiet_NaN();
  return d;
}

std::span<const Metric> metrics() { return kMetrics; }

const Metric& findMetric(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Metric& metric : kMetrics) {
    if (metric.name == name) return metric;
    names.push_back(metric.name);
  }
  std::string all;
  for (std::string_view n : names) all += (all.empty() ? "" : ", ") + std::string(n);
  throw Error(Fault::usage, "expected one of " + all + ", found \"" + std::string(name) + "\"",
              didYouMean(name, names));
}

bool Limit::met(const PictureDifference& difference) const {
  const double found = metric->value(difference);
  return metric->higherIsBetter ? found >= value : found <= value;
}

Limit parseLimit(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const Metric& metric = findMetric(text.substr(0, equals));
  const std::string_view number = text.substr(std::min(equals + 1, text.size()));
  const auto parsed = parseNumber(number);
  if (!parsed || parsed->length != number.size() || !(parsed->value >= 0))
    throw Error(Fault::usage, "expected " + std::string(metric.name) + "= and a number from 0 on, found \"" +
                                  std::string(text) + "\"");
  return {&metric, parsed->value};
}

bool within(const PictureDifference& difference, std::span<const Limit> limits) {
  if (!difference.numbers.sameSize) return false;
  if (limits.empty()) return difference.numbers.valuesBeyond == 0;
  for (const Limit& limit : limits)
    if (!limit.met(difference)) return false;
  return true;
}

}  // namespace trace
