// Values that are known from formulas, and what this build makes of them: `ray selftest`.
#pragma once

#include <span>
#include <string_view>

namespace trace {

struct SelfCheck {
  std::string_view name;   ///< what is looked at
  std::string_view known;  ///< where the value comes from
  double expected;
  double tolerance;  ///< by which what is found may differ
  /// Runs the check and returns its result. Throws what a render throws.
  double (*find)();

  bool holds(double found) const { return found >= expected - tolerance && found <= expected + tolerance; }
};

/// How long the checks of both tables take, from how fast this machine is and from those that are done.
class SelftestTime {
 public:
  /// Renders a small picture to see how fast the machine is; takes less than a second. Throws what a render
  /// throws.
  SelftestTime();

  /// A check has taken so many seconds: one of longSelfChecks(), or one of selfChecks().
  void note(bool isLong, double seconds);
  /// Seconds for those that are still to come.
  double left() const;

 private:
  struct Table {
    double known;  ///< seconds of one on the average, as the measurement says, weighed as kKnown checks
    std::size_t checks, done = 0;
    double seconds = 0;  ///< seconds of those that are done
  };
  static constexpr double kKnown = 4;
  Table shorts_, longs_;
};

/// THE table of them. All together take some seconds.
std::span<const SelfCheck> selfChecks();
/// More of them, which take minutes: less than five, together, on two processors.
std::span<const SelfCheck> longSelfChecks();

}  // namespace trace
