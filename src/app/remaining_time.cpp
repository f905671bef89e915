#include "app/remaining_time.h"

#include <algorithm>
#include <cmath>

namespace trace {

std::optional<double> RemainingTime::update(double elapsed, double fraction) {
  if (fraction < kLeastFraction) return {};
  if (fraction >= 1) return 0;
  constexpr double kSmoothing = 8;  // the estimate settles over this part of the time elapsed
  const double steady = elapsed / fraction - elapsed;  // if the rest goes on as until now
  if (!left_) left_ = steady, last_ = elapsed;
  const double passed = elapsed - last_;
  *left_ -= passed;
  *left_ += (1 - std::exp(-kSmoothing * passed / std::max(elapsed, 1e-9))) * (steady - *left_);
  *left_ = std::max(*left_, steady / 2);
  last_ = elapsed;
  return left_;
}

}  // namespace trace
