#include "render/rays/fog.h"

#include <algorithm>

#include "math/elementary.h"

namespace trace {
namespace {

/// So many heights down the density where the ray starts counts for nothing, and may be 0 by rounding.
constexpr Real kFarDown = 30;

}  // namespace

Real Fog::densityAt(const Vec3& point) const {
  constexpr Real kMost = 50;  // largest exponent, far below
  return height_ > 0 ? density_ * math::exp(std::min(-point.y / height_, kMost)) : density_;
}

Real Fog::depth(const Ray& ray, Real t) const {
  if (none()) return 0;
  const Real here = densityAt(ray.origin);
  const Real thinner = height_ > 0 ? ray.direction.y / height_ : 0;  // the rate along the ray
  if (thinner == 0) return here == 0 ? 0 : here * t;
  if (-thinner * t > kFarDown) return t < kInfinity ? (here - densityAt(ray.at(t))) / thinner : kInfinity;
  return here * (-math::expm1(-thinner * t) / thinner);  // the integral of exp(-thinner s)
}

Real Fog::distance(const Ray& ray, Real depth) const {
  const Real here = densityAt(ray.origin);
  const Real thinner = height_ > 0 ? ray.direction.y / height_ : 0;
  if (thinner == 0) return depth / here;
  const Real change = thinner * depth;
  if (!(here > change)) return kInfinity;
  if (-change > here * math::exp(kFarDown))  // by the height at which it is so dense
    return (-height_ * math::log((here - change) / density_) - ray.origin.y) / ray.direction.y;
  return -math::log1p(-change / here) / thinner;
}

void coverWithFog(Gather& sum, const Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside) {
  const Fog fog(tracer.settings());
  if (!fog.none() && isInOpenAir(inside, tracer.world()))
    sum.cover(Term::Kind::fog, -math::expm1(-fog.depth(ray, t)));
}

}  // namespace trace
