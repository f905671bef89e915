// Affine transforms, column-vector convention: the innermost transform of a scene file is applied first.
// Named right to left: worldFromObject * p takes a point of the object to the world.
#pragma once

#include "math/box.h"
#include "math/elementary.h"
#include "math/vec.h"

namespace trace {

struct Affine {
  /// Rows of the 3x3 part and the translation.
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 offset;

  static Affine translation(const Vec3& v) {
    Affine m;
    m.offset = v;
    return m;
  }
  static Affine scaling(const Vec3& s) {
    Affine m;
    m.row[0].x = s.x;
    m.row[1].y = s.y;
    m.row[2].z = s.z;
    return m;
  }
  /// Right-handed, about a unit `axis`, by `angle` radians (Rodrigues).
  static Affine rotation(const Vec3& axis, Real angle) {
    const Real s = math::sin(angle), c = math::cos(angle), k = 1 - c;
    const Vec3& a = axis;
    Affine m;
    m.row[0] = {a.x * a.x * k + c, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s};
    m.row[1] = {a.y * a.x * k + a.z * s, a.y * a.y * k + c, a.y * a.z * k - a.x * s};
    m.row[2] = {a.z * a.x * k - a.y * s, a.z * a.y * k + a.x * s, a.z * a.z * k + c};
    return m;
  }
  bool operator==(const Affine&) const = default;
};

/// A direction or a difference of points.
inline Vec3 linear(const Affine& m, const Vec3& v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
inline Vec3 operator*(const Affine& m, const Vec3& p) { return linear(m, p) + m.offset; }
/// With every entry made positive: for error bounds.
inline Affine absolute(const Affine& m) {
  Affine r;
  for (int i = 0; i < 3; ++i) r.row[i] = abs(m.row[i]);
  r.offset = abs(m.offset);
  return r;
}
/// m's linear part transposed: transposed(objectFromWorld, n) takes a normal to the world.
inline Vec3 transposed(const Affine& m, const Vec3& n) {
  return m.row[0] * n.x + m.row[1] * n.y + m.row[2] * n.z;
}

inline Affine operator*(const Affine& a, const Affine& b) {
  Affine m;
  for (int i = 0; i < 3; ++i) m.row[i] = transposed(b, a.row[i]);
  m.offset = a * b.offset;
  return m;
}

inline Real determinant(const Affine& m) { return dot(m.row[0], cross(m.row[1], m.row[2])); }

/// True if the transform can be undone without leaving the range of numbers.
inline bool invertible(const Affine& m);
/// Precondition: invertible(m).
inline Affine inverse(const Affine& m) {
  const Real d = determinant(m);
  const Vec3 c0 = cross(m.row[1], m.row[2]) / d;
  const Vec3 c1 = cross(m.row[2], m.row[0]) / d;
  const Vec3 c2 = cross(m.row[0], m.row[1]) / d;
  Affine r;
  r.row[0] = {c0.x, c1.x, c2.x};
  r.row[1] = {c0.y, c1.y, c2.y};
  r.row[2] = {c0.z, c1.z, c2.z};
  r.offset = -linear(r, m.offset);
  return r;
}
inline bool invertible(const Affine& m) {
  const Real d = determinant(m);
  if (!std::isfinite(d) || d == 0) return false;
  const Affine r = inverse(m);
  return isFinite(r.row[0]) && isFinite(r.row[1]) && isFinite(r.row[2]) && isFinite(r.offset) &&
         isFinite(m.offset);
}

inline Box3 operator*(const Affine& m, const Box3& b) {
  Box3 result;
  if (b.empty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.extend(m * Vec3{corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                           corner & 4 ? b.high.z : b.low.z});
  return result;
}

}  // namespace trace
