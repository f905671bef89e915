#include "cli/text/metric_text.h"

#include <cmath>
#include <cstdio>

#include "base/text.h"

namespace trace::cli {

std::string numberText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string metricText(const Metric& metric, const PictureDifference& difference) {
  const std::string_view unit = metric.unit.empty() ? difference.unit() : metric.unit;
  return numberText(metric.value(difference)) + " " + std::string(unit);
}

std::string limitText(const Limit& limit) {
  return std::string(limit.metric->name) + (limit.metric->higherIsBetter ? " >= " : " <= ") +
         toText(limit.value);
}

void addMetrics(Json& json, const PictureDifference& difference) {
  for (const Metric& metric : metrics()) {
    const double value = metric.value(difference);
    json[metric.name] = nullptr;
    if (std::isfinite(value)) json[metric.name] = value;
  }
}

}  // namespace trace::cli
