// The numbers of a comparison, for people and for programs.
#pragma once

#include <string>

#include "app/compare/difference.h"
#include "app/session/json.h"

namespace trace::cli {

/// Four digits.
std::string numberText(double value);

/// "0.21 levels", "62.3 dB".
std::string metricText(const Metric& metric, const PictureDifference& difference);

/// "rmse <= 6", "psnr >= 30".
std::string limitText(const Limit& limit);

/// Each metric as a key; null where it is infinite.
void addMetrics(Json& json, const PictureDifference& difference);

}  // namespace trace::cli
