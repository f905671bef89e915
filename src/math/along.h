// Values along a line together with their derivatives (forward differentiation), of numbers or of intervals.
#pragma once

#include <initializer_list>

#include "math/interval.h"

namespace trace {

/// A value along a line and its derivative there; of intervals, bounds of both.
template <class T>
struct Along {
  T value, slope;
};

template <class T>
Along<T> operator+(const Along<T>& a, const Along<T>& b) {
  return {a.value + b.value, a.slope + b.slope};
}
template <class T>
Along<T> operator-(const Along<T>& a, const Along<T>& b) {
  return {a.value - b.value, a.slope - b.slope};
}
template <class T>
Along<T> operator-(const Along<T>& a) {
  return {-a.value, -a.slope};
}
template <class T>
Along<T> operator-(const Along<T>& a, Real b) {
  return {a.value - T(b), a.slope};
}
template <class T>
Along<T> operator*(const Along<T>& a, Real s) {
  return {a.value * T(s), a.slope * T(s)};
}
template <class T>
Along<T> operator*(const Along<T>& a, const Along<T>& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
template <class T>
Along<T> operator/(const Along<T>& a, const Along<T>& b) {
  const T ratio = a.value / b.value;
  return {ratio, (a.slope - ratio * b.slope) / b.value};
}

inline Along<Real> max(const Along<Real>& a, const Along<Real>& b) { return a.value < b.value ? b : a; }
inline Along<Interval> max(const Along<Interval>& a, const Along<Interval>& b) {
  const Interval slope = a.value.low > b.value.high   ? a.slope
                         : b.value.low > a.value.high ? b.slope
                                                      : hull(a.slope, b.slope);
  return {max(a.value, b.value), slope};
}
template <class T>
Along<T> min(const Along<T>& a, const Along<T>& b) {
  return -max(-a, -b);
}
template <class T>
Along<T> max(const Along<T>& a, Real b) {
  return max(a, Along<T>{T(b), T(0)});
}
template <class T>
Along<T> abs(const Along<T>& a) {
  return max(a, -a);
}

inline bool mayBePositive(const Along<Real>& a) { return a.value > 0; }
inline bool mayBePositive(const Along<Interval>& a) { return a.value.high > 0; }

/// The length of the vector (a, b, ...).
inline Along<Real> lengthOf(std::initializer_list<Along<Real>> parts) {
  Real square = 0, product = 0;
  for (const Along<Real>& p : parts) {
    square += p.value * p.value;
    product += p.value * p.slope;
  }
  const Real l = std::sqrt(square);
  return {l, l > 0 ? product / l : 0};
}
inline Along<Interval> lengthOf(std::initializer_list<Along<Interval>> parts) {
  Interval sum = 0, slope = 0;
  for (const Along<Interval>& p : parts) sum = sum + square(p.value);
  const Interval l = sqrt(sum);
  for (const Along<Interval>& p : parts) {
    Interval share{-1, 1};
    if (l.low > 0) {
      const Interval ratio = p.value / l;
      share = {max(ratio.low, -1), min(ratio.high, 1)};
    } else if (p.value.low >= 0) {
      share.low = 0;
    } else if (p.value.high <= 0) {
      share.high = 0;
    }
    slope = slope + share * p.slope;
  }
  return {l, slope};
}

}  // namespace trace
