// How long a job will still take, from the share of it that is done; durations in words.
#pragma once

#include <optional>
#include <string>

namespace trace {

/// Seconds left, from the share done so far and the time on the clock. Two rates of work are known: the mean
/// one since the beginning, and that of late, by which a machine that others keep busy shows. The slower of
/// them counts, so that no more is promised than was seen. Tiles differ in cost, so the estimate jumps: it is
/// smoothed.
class RemainingTime {
 public:
  /// Nothing is said before this share is done.
  static constexpr double kLeastFraction = 0.03;

  /// `before` is the share that was done when the time began.
  std::optional<double> update(double elapsed, double fraction, double before = 0);

 private:
  std::optional<double> left_;
  double last_ = 0;                     // seconds, of the last update
  double clock_ = 0, done_ = 0;         // clock and done of the update before: seconds and share
  double recentTime_ = 0, recent_ = 0;  // seconds and share, of which older ones count less and less
};

/// "0.04 s", "3.2 s", "2 min 05 s", "1 h 03 min".
std::string durationText(double seconds);

}  // namespace trace
