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
  /// What is found. Throws what a render throws.
  double (*find)();

  bool holds(double found) const { return found >= expected - tolerance && found <= expected + tolerance; }
};

/// THE table of them. All together take some seconds.
std::span<const SelfCheck> selfChecks();
/// More of them, which take minutes: less than five, together, on two processors.
std::span<const SelfCheck> longSelfChecks();

}  // namespace trace
