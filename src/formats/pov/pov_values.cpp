#include "formats/pov/pov_values.h"

#include <algorithm>
#include <cmath>

namespace trace::pov {

std::optional<Numbers> combined(std::string_view op, const Numbers& a, const Numbers& b) {
  const int n = std::max(a.size, b.size);
  const Numbers p = a.promoted(n), q = b.promoted(n);
  Numbers r;
  r.size = n;
  const auto each = [&](auto&& f) {
    for (int i = 0; i < n; ++i) r[i] = f(p[i], q[i]);
    return r;
  };
  if (op == "+") return each([](Real x, Real y) { return x + y; });
  if (op == "-") return each([](Real x, Real y) { return x - y; });
  if (op == "*") return each([](Real x, Real y) { return x * y; });
  if (op == "/") {
    for (int i = 0; i < n; ++i)
      if (q[i] == 0 && (b.size == 1 || p[i] != 0)) return {};
    return each([](Real x, Real y) { return y == 0 ? 0 : x / y; });
  }
  const Real x = p[0], y = q[0];
  const auto equal = [&] {
    for (int i = 0; i < n; ++i)
      if (std::abs(p[i] - q[i]) > 1e-10) return false;
    return true;
  };
  if (op == "=") return Numbers(equal());
  if (op == "!=") return Numbers(!equal());
  if (op == "<") return Numbers(x < y);  // exact in POV-Ray, too
  if (op == ">") return Numbers(x > y);
  if (op == "<=") return Numbers(x < y || std::abs(x - y) <= 1e-10);
  if (op == ">=") return Numbers(x > y || std::abs(x - y) <= 1e-10);
  if (op == "&") return Numbers(x != 0 && y != 0);
  if (op == "|") return Numbers(x != 0 || y != 0);
  return {};
}

std::string_view kindOf(const Value& value) {
  constexpr std::string_view kKinds[]{"nothing",    "a number", "a string",  "a transform", "an array",
                                      "a function", "a spline", "a macro",   "an object",   "a pigment",
                                      "a normal",   "a finish", "a texture", "an interior", "a medium",
                                      "a material", "a camera", "a fog",     "a sky",       "a map"};
  static_assert(std::size(kKinds) == std::variant_size_v<decltype(Value::held)>);
  if (const Numbers* n = value.as<Numbers>(); n && n->size > 1) return n->size == 5 ? "a colour" : "a vector";
  return kKinds[value.held.index()];
}

namespace {

Numbers scaled(const Numbers& a, Real s) {
  Numbers r = a;
  for (Real& c : r.v) c *= s;
  return r;
}
Numbers sum(const Numbers& a, const Numbers& b) { return *combined("+", a, b); }

/// Second derivatives of the natural cubic through the points, for one component.
std::vector<Real> bends(const std::vector<Real>& t, const std::vector<Real>& y) {
  const std::size_t n = t.size();
  std::vector<Real> m(n, 0), c(n, 0), d(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Real h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
    const Real rhs = 6 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
    const Real w = 2 * (h0 + h1) - h0 * c[i - 1];
    c[i] = h1 / w;
    d[i] = (rhs - h0 * d[i - 1]) / w;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] = d[i] - c[i] * m[i + 1];
  return m;
}

}  // namespace

Numbers SplineCurve::at(Real t) const {
  if (points.empty()) return {};
  const auto above = points.upper_bound(t);
  if (points.size() == 1 || above == points.begin())
    return above == points.begin() ? above->second : points.begin()->second;
  if (above == points.end()) return std::prev(above)->second;
  const auto below = std::prev(above);
  const Real t1 = below->first, t2 = above->first, u = (t - t1) / (t2 - t1);
  const auto line = [&] { return sum(scaled(below->second, 1 - u), scaled(above->second, u)); };
  switch (kind) {
    case Kind::linear: return line();
    case Kind::quadratic: {
      // The parabola through the three nearest points: the one before where there is one.
      auto first = below;
      if (first != points.begin()) --first;
      auto second = std::next(first), third = std::next(second);
      if (third == points.end()) return line();
      const Real a = first->first, b = second->first, c = third->first;
      return sum(sum(scaled(first->second, (t - b) * (t - c) / ((a - b) * (a - c))),
                     scaled(second->second, (t - a) * (t - c) / ((b - a) * (b - c)))),
                 scaled(third->second, (t - a) * (t - b) / ((c - a) * (c - b))));
    }
    case Kind::cubic: {  // Catmull and Rom's
      if (below == points.begin() || std::next(above) == points.end()) return line();
      const Numbers &p0 = std::prev(below)->second, &p1 = below->second, &p2 = above->second,
                    &p3 = std::next(above)->second;
      const Real t0 = std::prev(below)->first, t3 = std::next(above)->first;
      const Numbers m1 = scaled(sum(p2, scaled(p0, -1)), (t2 - t1) / (t2 - t0));
      const Numbers m2 = scaled(sum(p3, scaled(p1, -1)), (t2 - t1) / (t3 - t1));
      const Real u2 = u * u, u3 = u2 * u;
      return sum(sum(scaled(p1, 2 * u3 - 3 * u2 + 1), scaled(m1, u3 - 2 * u2 + u)),
                 sum(scaled(p2, 3 * u2 - 2 * u3), scaled(m2, u3 - u2)));
    }
    case Kind::natural: {
      std::vector<Real> times;
      for (const auto& [time, p] : points) times.push_back(time);
      const auto i = static_cast<std::size_t>(std::distance(points.begin(), below));
      Numbers r = below->second;
      const Real h = t2 - t1;
      for (int axis = 0; axis < r.size; ++axis) {
        std::vector<Real> y;
        for (const auto& [time, p] : points) y.push_back(p[axis]);
        const std::vector<Real> m = bends(times, y);
        const Real a = 1 - u;
        r[axis] = a * y[i] + u * y[i + 1] + h * h / 6 * ((a * a * a - a) * m[i] + (u * u * u - u) * m[i + 1]);
      }
      return r;
    }
  }
  return {};
}

}  // namespace trace::pov
