#include "geometry/shapes/solids/blend.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/small_list.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/solve/interval_search.h"
#include "math/elementary.h"
#include "math/perpendicular.h"

namespace trace {

std::shared_ptr<const TracedBlend> Blend::prepared() const {
  return std::make_shared<const TracedBlend>(*this);
}

// --- what a blend is made of ----------------------------------------------------------------------------

namespace {

using Kind = DistanceForm::Kind;

struct PlacedForm {
  DistanceForm form;
  Affine shapeFromForm;
};

PlacedForm frustum(Real bottom, Real top, Real low, Real height) {
  return {{Kind::cone, {0, 0, height}, std::abs(bottom), std::abs(top), {}, 1},
          Affine::translation({0, 0, low})};
}

/// Around the line between two points.
PlacedForm capsule(const Vec3& a, const Vec3& b, Real radius) {
  const Real l = length(b - a);
  const Vec3 z = l > 0 ? (b - a) / l : Vec3{0, 0, 1};
  const Vec3 x = perpendicularTo(z), y = cross(z, x);
  Affine place;
  for (int i = 0; i < 3; ++i) place.row[i] = {x[i], y[i], z[i]};
  place.offset = a;
  return {{Kind::capsule, {0, 0, l}, radius, 0, {}, 1}, place};
}

using Forms = std::vector<PlacedForm>;

/// The forms whose union a shape is; none if the distance is not known of one like this.
struct FormsOf {
  Forms operator()(const Sphere&) const { return {{{Kind::ball, {}, 1, 0, {}, 1}, {}}}; }
  Forms operator()(const Cube&) const { return {{{Kind::box, {0.5, 0.5, 0.5}, 0, 0, {}, 1}, {}}}; }
  Forms operator()(const RoundedBox& s) const {
    const Vec3 half = abs(s.size) * 0.5;
    const Real r = std::min({std::abs(s.radius), half.x, half.y, half.z});
    return {{{Kind::box, half - Vec3{r, r, r}, r, 0, {}, 1}, {}}};
  }
  Forms operator()(const Cylinder& s) const { return s.capped ? Forms{frustum(1, 1, 0, 1)} : Forms{}; }
  Forms operator()(const Cone& s) const {
    return s.capped ? Forms{frustum(s.bottomRadius, s.topRadius, 0, s.height)} : Forms{};
  }
  Forms operator()(const Conic& s) const {
    const bool up = s.zMin < s.zMax;
    const Real bottom = up ? s.bottomRadius : s.topRadius, top = up ? s.topRadius : s.bottomRadius;
    return s.capped ? Forms{frustum(bottom, top, min(s.zMin, s.zMax), std::abs(s.zMax - s.zMin))} : Forms{};
  }
  Forms operator()(const Torus& s) const {
    return {{{Kind::ring, {}, std::abs(s.majorRadius), std::abs(s.minorRadius), {}, 1}, {}}};
  }
  Forms operator()(const Ellipsoid& s) const { return {{{Kind::ellipsoid, abs(s.radii), 0, 0, {}, 1}, {}}}; }
  Forms operator()(const Plane&) const { return {{{Kind::below, {}, 0, 0, {}, 1}, {}}}; }
  Forms operator()(const SphereSweep& s) const {
    Forms forms;
    for (std::size_t i = 0; i + 1 < s.points.size(); ++i) {
      const auto &a = s.points[i], &b = s.points[i + 1];
      if (s.spline != Spline::linear || a[3] != b[3]) return {};
      forms.push_back(capsule({a[0], a[1], a[2]}, {b[0], b[1], b[2]}, std::abs(a[3])));
    }
    return forms;
  }
};

Forms formsOf(const Shape& shape) {
  Forms forms;
  visitAs<Sphere, Cube, RoundedBox, Cylinder, Cone, Conic, Torus, Ellipsoid, Plane, SphereSweep>(
      shape, [&](const auto& s) { forms = FormsOf()(s); });
  return forms;
}

/// By how much lengths of the part grow in the whole, on the average of all directions.
Real scaleOf(const Affine& wholeFromPart) { return math::cbrt(std::abs(determinant(wholeFromPart))); }

/// How near one of two values must be where what they become is as near as `near`; see smoothLesser().
Real nearestOf(CsgOperation operation, Real radius, Real near) {
  if (operation != CsgOperation::unite) return near;
  return max(near, radius - (radius - near) * std::sqrt(0.5));
}

}  // namespace

TracedBlend::TracedBlend(const Blend& shape) {
  bounds_ = add(shape.operation, std::abs(shape.radius), shape.objects.list(), {}, 0);
  if (bounds_.unbounded())
    throw Error(Fault::scene, "a blend is infinite",
                "a plane can be cut out of it, or cut it off by an intersection");
  constexpr std::size_t kMostForms = 1 << 16;
  if (forms_.size() > kMostForms) throw Error(Fault::scene, "a blend of more than 65536 solids is too large");
}

Box3 TracedBlend::add(DistanceForm form, std::uint32_t material, const Affine& wholeFromForm, Real near) {
  if (!invertible(wholeFromForm))
    throw Error(Fault::scene, "an object of a blend is squeezed flat by its transform");
  form.formFromWhole = inverse(wholeFromForm);
  form.scale = scaleOf(wholeFromForm);
  steps_.push_back({true, forms_.size(), {}, 0});
  forms_.push_back(form);
  materials_.push_back(material);
  const Box3 box = form.within(near);
  return box.unbounded() ? box : wholeFromForm * box;
}

Box3 TracedBlend::add(CsgOperation operation, Real radius, const std::vector<Operand>& operands,
                      const Affine& wholeFromPart, Real near) {
  const Real fillet = radius * scaleOf(wholeFromPart);
  std::vector<Real> nears(operands.size(), near);  // distance for each operand; they are taken in one by one
  for (std::size_t i = operands.size(); i-- > 1;) nears[i] = near = nearestOf(operation, fillet, near);
  if (!nears.empty()) nears.front() = near;
  Box3 box;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const Box3 own = add(operands[i], wholeFromPart, nears[i]);
    if (i > 0) steps_.push_back({false, 0, operation, fillet});
    if (i == 0)
      box = own;
    else if (operation == CsgOperation::unite)
      box.extend(own);
    else if (operation == CsgOperation::intersect) {
      box.low = max(box.low, own.low);
      box.high = min(box.high, own.high);
    }
  }
  return box;
}

Box3 TracedBlend::add(const Operand& operand, const Affine& wholeFromOutside, Real near) {
  const Affine wholeFromShape = wholeFromOutside * operand.wholeFromOperand;
  const Shape& shape = operand.shape;
  const auto nested = [&](CsgOperation operation, Real radius) {
    return add(operation, radius, shape.operands().list(), wholeFromShape, near);
  };
  if (const auto* blend = shape.as<Blend>()) return nested(blend->operation, std::abs(blend->radius));
  if (shape.is<Union>()) return nested(CsgOperation::unite, 0);
  if (shape.is<Intersection>()) return nested(CsgOperation::intersect, 0);
  if (shape.is<Difference>()) return nested(CsgOperation::subtract, 0);

  const Forms forms = formsOf(shape);
  if (forms.empty())
    throw Error(
        Fault::scene,
        "no distance is known from a " + std::string(shape.keyword()) + " like this, as a blend needs it",
        "known are sphere, box, rounded_box, closed cylinder, cone and conic, torus, ellipsoid, plane, a "
        "sphere_sweep of lines and one radius, and unions, intersections, differences and blends of them");
  Box3 box;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    box.extend(add(forms[i].form, operand.material, wholeFromShape * forms[i].shapeFromForm, near));
    if (i > 0) steps_.push_back({false, 0, CsgOperation::unite, 0});
  }
  return box;
}

// --- its distance ---------------------------------------------------------------------------------------

namespace {

Real smoothLesser(Real a, Real b, Real r) {
  const Real u = max(r - a, 0), v = max(r - b, 0);
  return max(r, min(a, b)) - std::sqrt(u * u + v * v);
}

Along<Real> united(const Along<Real>& a, const Along<Real>& b, Real r) {
  const Real u = max(r - a.value, 0), v = max(r - b.value, 0), l = std::sqrt(u * u + v * v);
  if (!(u > 0 && v > 0)) return min(a, b);
  return {r - l, (a.slope * u + b.slope * v) / l};
}

/// It grows with both distances; how much of each slope counts lies between what their ends say.
Along<Interval> united(const Along<Interval>& a, const Along<Interval>& b, Real r) {
  const Interval u{max(r - a.value.high, 0), max(r - a.value.low, 0)};
  const Interval v{max(r - b.value.high, 0), max(r - b.value.low, 0)};
  if (u.high == 0 || v.high == 0) return min(a, b);
  const Interval value = outward(smoothLesser(a.value.low, b.value.low, r) - r * gammaError(8),
                                 smoothLesser(a.value.high, b.value.high, r) + r * gammaError(8));
  const auto share = [](Real own, Real other) {
    return own > 0 ? own / std::sqrt(own * own + other * other) : 0;
  };
  const bool surely = u.low > 0 || v.low > 0;  // is one of them nearer than the radius?
  const Interval ofA = surely ? outward(share(u.low, v.high), share(u.high, v.low)) : Interval{0, 1};
  const Interval ofB = surely ? outward(share(v.low, u.high), share(v.high, u.low)) : Interval{0, 1};
  return {value, ofA * a.slope + ofB * b.slope};
}

template <class T>
T combined(CsgOperation operation, const T& a, const T& b, Real r) {
  switch (operation) {
    case CsgOperation::unite: return united(a, b, r);
    case CsgOperation::intersect: return -united(-a, -b, r);
    case CsgOperation::subtract: return -united(-a, b, r);
  }
  return a;
}

/// A distance, and which solids it is from.
struct Named {
  Real value = 0;
  std::size_t first = 0, second = 0;
  Real share = 0;
  std::size_t most() const { return share < 0.5 ? first : second; }
  Named operator-() const { return {-value, first, second, share}; }
};
Named united(const Named& a, const Named& b, Real r) {
  const Real u = max(r - a.value, 0), v = max(r - b.value, 0);
  if (!(u > 0 && v > 0)) return a.value <= b.value ? a : b;
  return {smoothLesser(a.value, b.value, r), a.most(), b.most(), v * v / (u * u + v * v)};
}

}  // namespace

/// A line, in the space of each form.
class TracedBlend::Line {
 public:
  Line(const TracedBlend& blend, const Vec3& o, const Vec3& d) : blend_(blend) {
    for (const DistanceForm& form : blend.forms_)
      lines_.add({form.formFromWhole * o, linear(form.formFromWhole, d)});
  }

  template <class T>
  Along<T> at(const T& t) {
    return evaluate<Along<T>>([&](std::size_t i) {
      const Ray& line = lines_.all()[i];
      return blend_.forms_[i].template along<T>(line.origin, line.direction, t);
    });
  }
  /// The distance of the line's origin, and the solids it is from.
  Named named() {
    return evaluate<Named>([&](std::size_t i) {
      return Named{blend_.forms_[i].template along<Real>(lines_.all()[i].origin, {}, 0.0).value, i, i, 0};
    });
  }

 private:
  template <class T, class Leaf>
  T evaluate(Leaf&& leaf) {
    SmallList<T, 16> waiting;
    for (const Step& step : blend_.steps_) {
      if (step.leaf) {
        waiting.add(leaf(step.index));
        continue;
      }
      const T b = waiting.take(), a = waiting.take();
      waiting.add(combined(step.operation, a, b, step.radius));
    }
    return waiting.take();
  }

  const TracedBlend& blend_;
  SmallList<Ray, 16> lines_;
};

void TracedBlend::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (bounds_.empty()) return;
  const Span span = spanIn(roomy(bounds_), ray);
  if (span.empty()) return;
  Line line(*this, ray.origin, ray.direction);
  const auto at = [&](Real t) {
    const Along<Real> a = line.at(t);
    return Jet{a.value, a.slope};
  };
  const auto over = [&](const Interval& t) { return line.at(t); };
  intervalCrossings(span, range, over, at, [&](Real t, bool) { visit(Crossing{t, partAt(ray.at(t))}); });
}

std::int64_t TracedBlend::partAt(const Vec3& p) const {
  const Named named = Line(*this, p, {}).named();
  const auto share = static_cast<std::int64_t>(named.share * static_cast<Real>(kShares - 1));
  return (static_cast<std::int64_t>(named.first) * count() + static_cast<std::int64_t>(named.second)) *
             kShares +
         share;
}

MaterialMix TracedBlend::material(std::int64_t part, std::uint32_t) const {
  const std::int64_t pair = part / kShares;
  return MaterialMix::between(materials_[static_cast<std::size_t>(pair / count())],
                              materials_[static_cast<std::size_t>(pair % count())],
                              static_cast<Real>(part % kShares) / static_cast<Real>(kShares - 1));
}

void TracedBlend::addMaterials(std::vector<std::uint32_t>& all) const {
  all.insert(all.end(), materials_.begin(), materials_.end());
}

SurfacePoint TracedBlend::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t);
  const auto gradientAt = [&](const Vec3& at) {
    Vec3 g;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 d;
      d[axis] = 1;
      g[axis] = Line(*this, at, d).at(0.0).slope;
    }
    return g;
  };
  const Real size = maxComponent(max(abs(bounds_.low), abs(bounds_.high)));
  Vec3 g = gradientAt(p);
  for (int step = 0; step < 2; ++step) {  // back to the surface
    const Vec3 next = p - g * (Line(*this, p, {}).at(0.0).value / dot(g, g));
    if (!(length(next - p) < 1e-6 * size)) break;
    p = next;
    g = gradientAt(p);
  }
  const Real l = length(g);
  const Vec3 n = l > 0 && std::isfinite(l) ? g / l : normalize(-ray.direction);
  // The interval of a single point bounds the rounding.
  const Interval value = Line(*this, p, {}).at(Interval(0.0)).value;
  const Real off = min(l > 0 ? (value.high - value.low) / l : kInfinity, size * 1e-7);
  const Real error = 2 * off + size * gammaError(16);
  return {p, {error, error, error}, n, n, SurfaceUv::toward(normalize(p - bounds_.center()))};
}

}  // namespace trace
