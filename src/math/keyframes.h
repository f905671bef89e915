// Values that change with time: given at moments, the keys, and interpolated between them.
//
// Before the first key and behind the last the value stands still. Source of the spline: Catmull and Rom
// 1974, as a cubic Hermite curve whose tangent at a key is the slope between its neighbours, for keys at any
// distance.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "math/vec.h"

namespace trace {

/// linear: at even speed. smooth: slowing down to every key. spline: through the keys without a corner.
enum class Interpolation { linear, smooth, spline };

/// The value at `time`, exactly that of a key at its own. Preconditions: as many values as times, at least
/// one; times grow.
inline Real interpolate(std::span<const Real> times, std::span<const Real> values, Real time,
                        Interpolation interpolation) {
  if (!(time > times.front())) return values.front();
  if (!(time < times.back())) return values.back();
  const auto after =
      static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  const std::size_t i = after - 1;
  const Real a = values[i], b = values[after], span = times[after] - times[i];
  const Real u = (time - times[i]) / span;
  if (u == 0) return a;
  switch (interpolation) {
    case Interpolation::linear: return a + (b - a) * u;
    case Interpolation::smooth: return a + (b - a) * (u * u * (3 - 2 * u));
    case Interpolation::spline: break;
  }
  const auto slope = [&](std::size_t from, std::size_t to) {
    return (values[to] - values[from]) / (times[to] - times[from]);
  };
  const Real start = slope(i > 0 ? i - 1 : i, after);
  const Real end = slope(i, after + 1 < times.size() ? after + 1 : after);
  const Real v = 1 - u;
  return v * v * (1 + 2 * u) * a + u * u * (3 - 2 * u) * b + span * (v * v * u * start - u * u * v * end);
}

}  // namespace trace
