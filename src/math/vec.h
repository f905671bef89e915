// Vectors, points and normals: three numbers. Arithmetic is in double (Real); Vec3f only stores.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace trace {

using Real = double;
inline constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
inline constexpr Real kPi = 3.14159265358979323846;

/// Bounds the relative rounding error of n operations in a row (Higham; pbrt 4th ed., section 6.8.1).
constexpr Real gammaError(int n) {
  constexpr Real kHalfUlp = std::numeric_limits<Real>::epsilon() / 2;
  return n * kHalfUlp / (1 - n * kHalfUlp);
}

/// The next number from a finite x in the direction of `move`, or x if that is 0; near 0 one as invisibly far
/// (Rump, Zimmermann, Boldo and Melquiond, Computing Predecessor and Successor in Rounding to Nearest, BIT
/// 49, 2009). Without branches, which would be guessed wrongly for every ray that leaves a surface.
inline Real onward(Real x, Real move) {
  const Real step = std::abs(x) * (0x1p-53 * (1 + 0x1p-52)) + std::numeric_limits<Real>::min();
  return x + (move != 0 ? std::copysign(step, move) : 0);
}

template <class T>
struct Vec3T {
  T x = 0, y = 0, z = 0;

  constexpr Vec3T() = default;
  constexpr Vec3T(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class U>
  constexpr explicit Vec3T(const Vec3T<U>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr bool operator==(const Vec3T&) const = default;
};
using Vec3 = Vec3T<Real>;
using Vec3f = Vec3T<float>;

struct Vec2 {
  Real x = 0, y = 0;
  constexpr bool operator==(const Vec2&) const = default;
};

constexpr Vec3 operator-(const Vec3& v) { return {-v.x, -v.y, -v.z}; }
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(const Vec3& v, Real s) { return {v.x * s, v.y * s, v.z * s}; }
constexpr Vec3 operator*(Real s, const Vec3& v) { return v * s; }
constexpr Vec3 operator/(const Vec3& v, Real s) { return {v.x / s, v.y / s, v.z / s}; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }

constexpr Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Exactly antisymmetric: cross(b, a) has the same digits as -cross(a, b).
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(const Vec3& v) { return std::sqrt(dot(v, v)); }
inline Vec3 normalize(const Vec3& v) { return v / length(v); }
inline Vec3 abs(const Vec3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
// Not std::fmin: it is a call. A NaN in b is ignored.
constexpr Real min(Real a, Real b) { return b < a ? b : a; }
constexpr Real max(Real a, Real b) { return a < b ? b : a; }
constexpr Vec3 min(const Vec3& a, const Vec3& b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
constexpr Vec3 max(const Vec3& a, const Vec3& b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
constexpr Real maxComponent(const Vec3& v) { return max(v.x, max(v.y, v.z)); }
inline bool isFinite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace trace
