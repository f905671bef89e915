#include "geometry/shapes/fractals/mandelbulb.h"

#include <algorithm>
#include <cmath>

#include "geometry/solve/escape_search.h"
#include "math/complex.h"

namespace trace {
namespace {

/// base^n by squaring.
template <class T>
T raised(T base, int n, T one) {
  T result = one;
  for (; n > 0; n /= 2) {
    if (n % 2 != 0) result = result * base;
    if (n > 1) base = base * base;
  }
  return result;
}

class MandelbulbStep {
 public:
  explicit MandelbulbStep(const Mandelbulb& shape);

  Real radius() const { return radius_; }
  Real half() const { return radius_; }
  int surely() const { return surely_; }
  int iterations() const { return shape_.iterations; }
  Trap trap() const { return shape_.trap; }
  bool colored() const { return !shape_.materials.empty(); }
  Vec3 start(const Vec3& p) const { return p; }
  Vec3 constant(const Vec3& p) const { return shape_.julia ? shape_.constant : p; }
  Real shareOfPlace() const { return shape_.julia ? 0 : 1; }
  Real unit() const { return 1; }
  Affine step(const Vec3& w) const;
  Vec3 value(const Vec3& w) const;
  Real stretch(const Vec3& w, Real r) const;

 private:
  Mandelbulb shape_;
  Real radius_;
  int surely_;
};

MandelbulbStep::MandelbulbStep(const Mandelbulb& shape) : shape_(shape) {
  shape_.power = std::clamp(shape.power, 2, 16);
  shape_.iterations = std::clamp(shape.iterations, 1, 30);
  // From here on |w^p + c| >= |w| (|w|^(p-1) - 1) > |w|.
  radius_ = max(math::pow(2.0, 1.0 / (shape_.power - 1)), shape.julia ? length(shape.constant) : 0);
  // Neighbours part by `power` at each step at least where the surface is smooth: a low power shows detail
  // late.
  surely_ = std::max(6, static_cast<int>(14 / math::log2(shape_.power)));
}

Vec3 MandelbulbStep::value(const Vec3& w) const {
  const Real rho = std::sqrt(w.x * w.x + w.y * w.y);
  const Complex up = raised(Complex{w.z, rho}, shape_.power, {1, 0});
  const Complex around =
      rho > 0 ? raised(Complex{w.x / rho, w.y / rho}, shape_.power, {1, 0}) : Complex{1, 0};
  return {up.im * around.re, up.im * around.im, up.re};
}

Affine MandelbulbStep::step(const Vec3& w) const {
  const int p = shape_.power;
  const Real rho = std::sqrt(w.x * w.x + w.y * w.y), r = length(w);
  Affine f;
  if (r == 0) {
    f.row[0] = f.row[1] = f.row[2] = {};
    return f;
  }
  const Complex a = rho > 0 ? Complex{w.x / rho, w.y / rho} : Complex{1, 0};
  const Complex unitUp{w.z / r, rho / r};
  const Complex around = raised(a, p, {1, 0}), up = raised(unitUp, p, {1, 0});
  const Real grown = raised(r, p - 1, 1.0);
  // The unit vectors outward, down and around before the step, and after it.
  const Vec3 before[] = {w / r, {unitUp.re * a.re, unitUp.re * a.im, -unitUp.im}, {-a.im, a.re, 0}};
  const Vec3 after[] = {{up.im * around.re, up.im * around.im, up.re},
                        {up.re * around.re, up.re * around.im, -up.im},
                        {-around.im, around.re, 0}};
  const Real turned = unitUp.im > 0 ? up.im / unitUp.im : p * up.re / unitUp.re;
  const Real scale[] = {p * grown, p * grown, p * grown * turned};
  for (int axis = 0; axis < 3; ++axis) {
    f.row[axis] = {};
    for (int k = 0; k < 3; ++k) f.row[axis] += before[k] * (after[k][axis] * scale[k]);
  }
  f.offset = after[0] * (grown * r);
  return f;
}

/// Outward and down p |w|^(p-1); around as many times that as |sin(p a) / sin(a)|, where a is the angle from
/// the axis: at most p.
Real MandelbulbStep::stretch(const Vec3& w, Real r) const {
  const int p = shape_.power;
  const Real l = length(w), far = l + r, rho = std::sqrt(w.x * w.x + w.y * w.y);
  Real turned = p;
  if (rho > r) {
    const Complex up = raised(Complex{w.z / l, rho / l}, p, {1, 0});
    const Real turn = 0.5 * kPi * r / l;  // no more than that is an angle of the ball off that of its middle
    turned = min(turned, max(1, min(1, std::abs(up.im) + p * turn) * far / (rho - r)));
  }
  return p * raised(far, p - 1, 1.0) * turned;
}

}  // namespace

std::shared_ptr<const TracedMandelbulb> Mandelbulb::prepared() const {
  return std::make_shared<const TracedMandelbulb>(*this);
}

Box3 TracedMandelbulb::bounds() const { return EscapeSearch(MandelbulbStep(shape_)).bounds(); }

void TracedMandelbulb::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  EscapeSearch(MandelbulbStep(shape_)).crossings(ray, range, visit);
}

SurfacePoint TracedMandelbulb::surface(const Ray& ray, const Crossing& crossing) const {
  return EscapeSearch(MandelbulbStep(shape_)).surface(ray, crossing);
}

}  // namespace trace
