#include "geometry/shapes/fractals/mandelbox.h"

#include <algorithm>

#include "geometry/solve/escape_search.h"

namespace trace {
namespace {

class MandelboxStep {
 public:
  explicit MandelboxStep(const Mandelbox& shape);

  Real radius() const { return radius_; }
  Real half() const { return 1; }
  int surely() const { return 6; }
  int iterations() const { return shape_.iterations; }
  Trap trap() const { return shape_.trap; }
  bool colored() const { return !shape_.materials.empty(); }
  Vec3 start(const Vec3& p) const { return p * half_; }
  Vec3 constant(const Vec3& p) const { return p * half_; }
  Real shareOfPlace() const { return 1; }
  Real unit() const { return half_; }
  Affine step(const Vec3& w) const;
  Vec3 value(const Vec3& w) const;
  Real stretch(const Vec3& w, Real r) const;

 private:
  /// How the ball scales a point, by the square of its distance from the middle.
  Real ballScale(Real square) const;

  Mandelbox shape_;
  Real half_, radius_;
};

MandelboxStep::MandelboxStep(const Mandelbox& shape) : shape_(shape) {
  constexpr Real kLeast = 1.1;
  const Real s = std::clamp(std::abs(shape.scale), kLeast, 4.0);
  shape_.scale = std::copysign(s, shape.scale);
  shape_.minRadius = std::clamp(shape.minRadius, 0.05, 1.0);
  shape_.iterations = std::clamp(shape.iterations, 1, 30);
  half_ = shape_.scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
  // A coordinate beyond this is folded once and grows: s (x - 2) - |c| > x. A point that far out in all
  // three.
  radius_ = std::sqrt(3.0) * max(3, (2 * s + half_) / (s - 1));
}

Real MandelboxStep::ballScale(Real square) const {
  const Real least = shape_.minRadius * shape_.minRadius;
  return square < least ? 1 / least : square < 1 ? 1 / square : 1;
}

Vec3 MandelboxStep::value(const Vec3& w) const {
  Vec3 v = w;
  for (int axis = 0; axis < 3; ++axis) v[axis] = std::clamp(w[axis], -1.0, 1.0) * 2 - w[axis];
  return v * (ballScale(dot(v, v)) * shape_.scale);
}

Affine MandelboxStep::step(const Vec3& w) const {
  Vec3 v = w, sign{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(w[axis]) > 1) {
      v[axis] = std::copysign(2, w[axis]) - w[axis];
      sign[axis] = -1;
    }
  const Real square = dot(v, v), k = ballScale(square) * shape_.scale;
  const bool mirrored = square < 1 && square >= shape_.minRadius * shape_.minRadius;
  Affine f = Affine::scaling({k, k, k});
  if (mirrored)
    for (int axis = 0; axis < 3; ++axis) f.row[axis] += v * (-2 * v[axis] * k / square);
  for (Vec3& row : f.row) row = {row.x * sign.x, row.y * sign.y, row.z * sign.z};
  f.offset = v * k;
  return f;
}

/// Folding at the box moves no two points farther apart; the ball does most for points nearest its middle.
Real MandelboxStep::stretch(const Vec3& w, Real r) const {
  Vec3 v = w;
  for (int axis = 0; axis < 3; ++axis) v[axis] = std::clamp(w[axis], -1.0, 1.0) * 2 - w[axis];
  const Real near = max(0, length(v) - r);
  return ballScale(near * near) * std::abs(shape_.scale);
}

}  // namespace

std::shared_ptr<const TracedMandelbox> Mandelbox::prepared() const {
  return std::make_shared<const TracedMandelbox>(*this);
}

Box3 TracedMandelbox::bounds() const { return EscapeSearch(MandelboxStep(shape_)).bounds(); }

void TracedMandelbox::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  EscapeSearch(MandelboxStep(shape_)).crossings(ray, range, visit);
}

SurfacePoint TracedMandelbox::surface(const Ray& ray, const Crossing& crossing) const {
  return EscapeSearch(MandelboxStep(shape_)).surface(ray, crossing);
}

}  // namespace trace
