// Tables of evenly spaced numbers, read between their entries.
#pragma once

#include <algorithm>

#include "math/vec.h"

namespace trace {

/// The two entries around a number from 0 to 1, of a table of `steps` + 1, and how far it is on the way
/// between them.
struct Between {
  int low;
  Real share;

  Between(Real x, int steps) {
    const Real place = max(0, min(1, x)) * steps;
    low = std::min(steps - 1, static_cast<int>(place));
    share = place - low;
  }

  /// Mixes what `ask` gives of the two.
  template <class Ask>
  Real of(const Ask& ask) const {
    const Real first = ask(low);
    return share > 0 ? first + share * (ask(low + 1) - first) : first;
  }
};

/// Cell i of `count` of the numbers from 0 to 1, the narrower the nearer to 0 or 1: for midpoint rules where
/// most changes at the ends.
struct EndCell {
  Real middle, width;

  EndCell(Real at, Real wide) : middle(at), width(wide) {}
  EndCell(int i, int count) {
    const auto smooth = [](Real x) { return x * x * (3 - 2 * x); };
    const Real part = 1.0 / count;
    middle = smooth((i + 0.5) * part);
    width = smooth((i + 1) * part) - smooth(i * part);
  }
};

}  // namespace trace
