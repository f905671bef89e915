// Fog: air that scatters light, around all bodies. It covers what is behind it and shows the light of lamps
// in it, which it scatters once (single scattering; Pharr, Jakob and Humphreys 2016, chapter 11).
#pragma once

#include <algorithm>

#include "math/elementary.h"
#include "render/rays/gather.h"
#include "shading/medium.h"

namespace trace {

class Fog {
 public:
  explicit Fog(const Settings& settings)
      : density_(settings.fog),
        height_(settings.fogHeight),
        forward_(std::clamp(settings.fogForward, -kMostForward, kMostForward)) {}

  bool none() const { return !(density_ > 0); }
  /// How much of it lies along so much of the ray: the transmittance is exp(-depth). With a height, it thins
  /// out upward, along y.
  Real depth(const Ray& ray, Real t) const;
  Real passes(const Ray& ray, Real t) const { return math::exp(-depth(ray, t)); }
  /// The transmittance to a light that far away along the ray. Light from infinity is what arrives, and loses
  /// none.
  Real left(const Ray& toLight, Real distance) const {
    return distance < kInfinity ? passes(toLight, distance) : 1;
  }
  /// The distance along the ray at which that depth is reached; may be infinite.
  Real distance(const Ray& ray, Real depth) const;
  Real forward() const { return forward_; }  ///< the mean cosine of what is scattered
  /// The extinction per unit of length there.
  Real densityAt(const Vec3& point) const;

 private:
  Real density_;  ///< scattered along a unit of length, at y = 0
  Real height_;   ///< above which it is thinner by e; 0: it is the same everywhere
  Real forward_;
};

/// A ray in there runs through air: it is in no body. An open sheet encloses nothing.
inline bool isInOpenAir(const Interfaces& inside, const World& world) {
  const std::uint32_t object = inside.around().object;
  return object == Filling::kAir || !world.solid(object);
}

/// Covers what has been summed with the fog before it: the transmittance along the ray up to t, which may be
/// infinite.
void coverWithFog(Gather& sum, const Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside);
}  // namespace trace
