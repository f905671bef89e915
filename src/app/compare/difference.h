// Two pictures compared: all numbers, and whether they stay within limits. What `ray diff` prints of one pair
// and `ray grade` of many.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/comparison/compare.h"
#include "image/comparison/difference.h"

namespace trace {

/// A picture as it came from a file, or from a render that was given levels.
struct LoadedPicture {
  Picture picture;
  bool levels = true;    ///< 8 bits a channel
  std::string remark{};  ///< a warning, of what is not shown; may be empty
};
/// `path` may choose a layer (image/codecs/picture_name.h). Throws Error(Fault::io), Error(Fault::limit).
LoadedPicture loadPicture(const std::string& path);

/// Numbers are in levels, 0 to 255, when both pictures have 8 bits a channel, else in linear values.
struct PictureDifference {
  LoadedPicture reference, test;
  bool levels = true;
  double tolerance = 0;  ///< what does not count as "beyond", in the same unit
  Comparison numbers;
  std::vector<double> flipErrors;  ///< flip errors of each pixel; empty when the sizes differ
  double flip = 1;                 ///< their mean
  std::string stopped{};           ///< why there is no FLIP; "" if there is

  std::string_view unit() const { return levels ? "levels" : "values"; }
  Pictures pictures() const { return {reference.picture, test.picture, flipErrors}; }
};

struct DifferenceOptions {
  double tolerance = 0;
  double pixelsPerDegree;    ///< pixels per degree of the eye that FLIP stands for
  bool flipMayLack = false;  ///< if the time is over, FLIP is left out and the other numbers are returned
};
PictureDifference difference(LoadedPicture reference, LoadedPicture test, const DifferenceOptions& options);

/// A row of THE table of numbers that tell how far pictures are apart.
struct Metric {
  std::string_view name;
  std::string_view help;  ///< one sentence, no full stop
  std::string_view unit;  ///< "" takes that of the pictures
  bool higherIsBetter;
  double (*value)(const PictureDifference&);
};
std::span<const Metric> metrics();
/// Throws Error(Fault::usage).
const Metric& findMetric(std::string_view name);

/// The metric may be at most, or where higher is better at least, this.
struct Limit {
  const Metric* metric;
  double value;
  bool met(const PictureDifference& difference) const;
};
/// "rmse=6". Throws Error(Fault::usage).
Limit parseLimit(std::string_view text);

/// The sizes agree and every limit is met; without limits, no value is beyond the tolerance.
bool within(const PictureDifference& difference, std::span<const Limit> limits);

}  // namespace trace
