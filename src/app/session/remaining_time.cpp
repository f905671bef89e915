#include "app/session/remaining_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "math/elementary.h"

namespace trace {

std::optional<double> RemainingTime::update(double elapsed, double fraction, double before) {
  if (fraction >= 1) return 0;
  fraction = (fraction - before) / (1 - before);
  constexpr double kForgets = 4;  // what was done after x of the time until now counts x to this power
  if (fraction > done_) {         // what comes in large pieces is judged when one comes
    const double kept = elapsed > 0 ? math::pow(clock_ / elapsed, kForgets) : 0;
    recentTime_ = recentTime_ * kept + std::max(0.0, elapsed - clock_);
    recent_ = recent_ * kept + fraction - done_;
    clock_ = std::max(clock_, elapsed);
    done_ = fraction;
  }
  const double waiting = std::max(0.0, elapsed - clock_);
  if (fraction < kLeastFraction) return {};
  constexpr double kSmoothing = 8;  // the estimate settles over this part of the time elapsed
  const double onAverage = elapsed / fraction - elapsed;  // if the rest continues as until now
  constexpr double kSlower = 6;                           // a pause is no measure of the rest
  const double ofLate =
      recent_ > 0 ? std::min((1 - fraction) * (recentTime_ + waiting) / recent_, kSlower * onAverage)
                  : onAverage;
  const double steady = std::max(onAverage, ofLate);
  if (!left_) {
    left_ = steady;
    last_ = elapsed;
  }
  const double passed = elapsed - last_;
  *left_ -= passed;
  *left_ += (1 - math::exp(-kSmoothing * passed / std::max(elapsed, 1e-9))) * (steady - *left_);
  *left_ = std::max(*left_, steady / 2);
  last_ = elapsed;
  return left_;
}

std::string durationText(double seconds) {
  char text[64];
  const auto whole = static_cast<long long>(std::llround(std::min(seconds, 1e15)));
  if (seconds < 0.995)
    std::snprintf(text, sizeof text, "%.2f s", seconds);
  else if (seconds < 9.95)
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  else if (whole < 60)
    std::snprintf(text, sizeof text, "%lld s", whole);
  else if (whole < 3600)
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
  return text;
}

}  // namespace trace
