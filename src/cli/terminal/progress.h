// How far a render is: a bar on a terminal, plain lines in a log, or JSON for programs. Only formats and
// decides when to print; whoever owns it calls update() about ten times a second.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "app/session/remaining_time.h"

namespace trace::cli {

inline constexpr double kQuietSeconds = 1;       ///< shorter work needs no words
inline constexpr double kPlainLineSeconds = 10;  ///< between two lines of a log

enum class ProgressStyle { automatic, bar, plain, json, none };

class Progress {
 public:
  using Print = std::function<void(const std::string&)>;

  /// automatic counts as plain. Bars are as wide as `columns` lets them.
  Progress(ProgressStyle style, int columns, Print print);

  /// So much of the work had been done, perhaps by another process, when the time began.
  void beginsAfter(double fraction) { before_ = fraction; }
  /// `done` of `total` chunks after `elapsed` seconds; total 0 means not known yet. `share` is what that is
  /// of the work that there is likely to be, where not all of the chunks take as long.
  void update(std::int64_t done, std::int64_t total, double elapsed, std::optional<double> share = {});
  /// Takes the bar away, so that something else can be printed.
  void clear();
  /// The last word, if the style has one.
  void finish(std::int64_t done, std::int64_t total, double elapsed, std::optional<double> share = {});

 private:
  void json(std::int64_t done, std::int64_t total, double elapsed);

  ProgressStyle style_;
  int columns_;
  Print print_;
  RemainingTime estimate_;
  std::optional<double> remaining_;
  double before_ = 0;
  double shown_ = 0;       // the largest share
  double lastPrint_ = -1;  // seconds
  int lastTenth_ = 0;
  bool drawn_ = false;
};

}  // namespace trace::cli
