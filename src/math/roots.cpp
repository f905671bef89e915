#include "math/roots.h"

#include <algorithm>

namespace trace {
namespace {

constexpr std::size_t kLeastDegree = 4;  // below, formulas are faster

/// A polynomial over [a, b] as its ordinates in the Bernstein basis: it lies between them, and its sign
/// changes at most as often as theirs do, and as often except for an even number (Descartes' rule of signs).
template <std::size_t n>
struct Bernstein {
  Real a, b;
  Real at[n + 1];  // not set before it is used

  int signVariations() const {
    int count = 0;
    for (std::size_t i = 1; i <= n; ++i) count += (at[i] < 0) != (at[i - 1] < 0);
    return count;
  }
  bool exceeds(Real size) const {
    bool any = false;
    for (const Real ordinate : at) any |= std::abs(ordinate) > size;
    return any;
  }
  /// Cuts off and returns the first half (de Casteljau).
  Bernstein halve() {
    Bernstein first;
    const Real middle = a + 0.5 * (b - a);
    first.a = a;
    first.b = middle;
    a = middle;
    for (std::size_t i = 0; i <= n; ++i) {
      first.at[i] = at[0];
      for (std::size_t k = 0; k + i < n; ++k) at[k] = 0.5 * (at[k] + at[k + 1]);
    }
    return first;
  }
};

/// 1 / binomial(n, k) at k.
template <std::size_t n>
constexpr auto kInverseBinomials = [] {
  std::array<Real, n + 1> inverse{};
  Real binomial = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    inverse[k] = 1 / binomial;
    binomial = binomial * static_cast<Real>(n - k) / static_cast<Real>(k + 1);
  }
  return inverse;
}();

template <std::size_t n>
Bernstein<n> bernstein(std::span<const Real> coefficients, Real a, Real b) {
  Bernstein<n> p;
  p.a = a;
  p.b = b;
  std::copy_n(coefficients.begin(), n + 1, p.at);
  if (a != 0)  // around a
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = n; k-- > i;) p.at[k] += a * p.at[k + 1];
  // The ordinate i is the sum of binomial(i, k) / binomial(n, k) c_k.
  Real power = 1;
  for (std::size_t k = 0; k <= n; ++k, power *= b - a) p.at[k] *= power * kInverseBinomials<n>[k];
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t k = n; k >= i; --k) p.at[k] += p.at[k - 1];
  return p;
}

/// The sum of the sizes of a polynomial's terms over [a, b], at most.
Real sizeOf(std::span<const Real> coefficients, Real a, Real b) {
  const Real farthest = max(std::abs(a), std::abs(b));
  Real size = 0, power = 1;
  for (const Real c : coefficients) {
    size += std::abs(c) * power;
    power *= farthest;
  }
  return size;
}

/// Calls found(from, to, negativeAtFrom, guess) in order for intervals with one change of sign each.
template <std::size_t n, class Found>
void isolate(std::span<const Real> coefficients, Real a, Real b, Found&& found) {
  constexpr std::size_t kMostDepth = 48;
  constexpr int kMostHalvings = 400;
  const Real noise = gammaError(16) * sizeOf(coefficients, a, b);  // less than this is rounding
  std::array<Bernstein<n>, kMostDepth + 1> parts;                  // still to be looked at, the first last
  std::size_t count = 0;
  parts[count++] = bernstein<n>(coefficients, a, b);
  for (int halvings = 0; count > 0;) {
    Bernstein<n>& p = parts[count - 1];
    if (p.signVariations() > 1 && count < parts.size() && halvings < kMostHalvings && p.exceeds(noise)) {
      parts[count++] = p.halve();
      ++halvings;
      continue;
    }
    const Real first = p.at[0], last = p.at[n];
    if ((first < 0) != (last < 0)) found(p.a, p.b, first < 0, p.a + (p.b - p.a) * (first / (first - last)));
    --count;
  }
}

/// Calls f with the degree, at least kLeastDegree, as a constant.
template <std::size_t n = kLeastDegree, class F>
decltype(auto) withDegree(std::size_t degree, F&& f) {
  if constexpr (n < kMostDegree)
    if (degree > n) return withDegree<n + 1>(degree, f);
  return f.template operator()<n>();
}

/// Where it changes sign among the places between which it is monotone.
Nodes rootsAmong(const Nodes& turns, std::span<const Real> coefficients) {
  const auto p = [&](Real t) { return evaluate(coefficients, t); };
  Nodes roots;
  roots.add(turns.at[0]);
  const auto root = [&](Real a, Real b, bool negativeAtA) { return rootBetween(p, a, b, negativeAtA); };
  SignWalk walk{turns.at[0], p(turns.at[0]).value < 0};
  for (std::size_t i = 1; i < turns.count; ++i)
    walk.to(turns.at[i], p(turns.at[i]).value < 0, root, [&](Real t, bool) { roots.add(t); });
  roots.add(turns.at[turns.count - 1]);
  return roots;
}

}  // namespace

Nodes rootsWithEnds(std::span<const Real> coefficients, Real a, Real b) {
  while (coefficients.size() > 1 && coefficients.back() == 0)
    coefficients = coefficients.first(coefficients.size() - 1);
  const std::size_t n = coefficients.size() - 1;
  if (n == 3) return rootsAmong(extremaWithEnds(coefficients, a, b), coefficients);
  Nodes nodes;
  nodes.add(a);
  const auto addInside = [&](Real t) {
    if (a < t && t < b) nodes.add(t);
  };
  if (n == 1) {
    addInside(-coefficients[0] / coefficients[1]);
  } else if (n == 2) {
    const Real half = 0.5 * coefficients[1];
    const Roots2 roots = solveQuadratic(coefficients[2], half, coefficients[0],
                                        half * half - coefficients[2] * coefficients[0]);
    if (roots.count && roots.t0 < roots.t1) {
      addInside(roots.t0);
      addInside(roots.t1);
    }
  } else if (n >= kLeastDegree) {
    withDegree(n, [&]<std::size_t kDegree>() {
      isolate<kDegree>(coefficients, a, b, [&](Real from, Real to, bool negative, Real guess) {
        if (nodes.count > n) return;
        const auto p = [&](Real t) { return evaluate(coefficients, t); };
        addInside(rootBetween(p, from, to, negative, guess));
      });
    });
  }
  nodes.add(b);
  return nodes;
}

int signVariations(std::span<const Real> coefficients, Real a, Real b) {
  const Real noise = 64 * gammaError(64) * sizeOf(coefficients, a, b);
  return withDegree(coefficients.size() - 1, [&]<std::size_t n>() {
    const Bernstein<n> p = bernstein<n>(coefficients, a, b);
    for (const Real ordinate : p.at)
      if (!(std::abs(ordinate) > noise)) return 2;
    return p.signVariations();
  });
}

}  // namespace trace
