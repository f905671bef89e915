// A place of a path, on a surface or in a medium: what it does with light from one direction to another, as
// paths from both ends ask it (Veach 1997, section 8.3; in media Lafortune and Willems, Rendering
// Participating Media with Bidirectional Path Tracing, 1996). In a medium the phase function takes the place
// of the lobe, and no direction is slanted: the cosine is 1.
#pragma once

#include "render/media/media.h"
#include "render/paths/interaction.h"
#include "render/paths/onward.h"

namespace trace {

class PathPlace {
 public:
  /// On a surface, where a ray of `at` has arrived.
  explicit PathPlace(const Interaction& at)
      : at_(&at), even_(evenOf(at)), inside_(&at.inside), along_(at.ray.direction) {}
  /// In a medium, where the ray is scattered.
  PathPlace(const Ray& ray, const MediumWay::Place& place, const Interfaces& inside)
      : inside_(&inside), point_(ray.at(place.t)), along_(ray.direction), forward_(place.forward) {}

  const Interaction* surface() const { return at_; }
  const Interfaces& inside() const { return *inside_; }
  /// Where rays to other places start.
  const Vec3& point() const { return at_ ? at_->lightPlace() : point_; }
  /// Where the path came from.
  Vec3 from() const { return -along_; }
  /// Mirrors and clear glass join with nothing.
  bool joins() const { return !at_ || scatters(at_->bsdf()); }

  Real cosine(const Vec3& direction) const {
    return at_ ? std::abs(dot(direction, at_->hit.surface.normal)) : 1;
  }
  /// Per solid angle, of continuing in a direction after one has come from the other.
  Real density(const Vec3& from, const Vec3& to) const {
    if (even_) return dot(at_->normal, from) > 0 ? max(0, dot(at_->normal, to)) / kPi : 0;
    return at_ ? trace::density(at_->bsdf(), frameToward(*at_, from), from, to)
               : phase(forward_, -dot(from, to));
  }
  /// The scattering of the light from one direction to the other, of a path from the camera and of one from
  /// a light; see render/paths/onward.h.
  Color scattered(const Vec3& toEye, const Vec3& toLight) const {
    if (even_) return scatteredEvenly(toEye, toLight);
    return at_ ? trace::scattered(*at_, toEye, toLight) : Color(phase(forward_, -dot(toEye, toLight)));
  }
  Color scatteredOn(const Vec3& toEye, const Vec3& toLight, bool lit) const {
    if (even_ && !lit) {
      const Vec3& flat = at_->hit.surface.normal;
      const Real arrives = std::abs(dot(toLight, flat));
      return arrives > 0 ? scatteredEvenly(toEye, toLight) * (std::abs(dot(toEye, flat)) / arrives)
                         : Color(0);
    }
    return at_ ? trace::scatteredOn(*at_, toEye, toLight, lit) : Color(phase(forward_, -dot(toEye, toLight)));
  }
  /// The scattering of a light of the scene, whose `arriving` is.
  Color scattered(const Illumination& arriving) const;

  Ray leave(const Vec3& direction) const {
    return at_ ? at_->leaveToLight(direction) : Ray{point_, direction};
  }
  /// The media of a ray that leaves toward another vertex.
  Interfaces side(const Vec3& direction) const {
    return at_ && dot(direction, at_->normal) < 0 && at_->transmits ? at_->behind() : *inside_;
  }
  /// The transmittance of fog and of the medium on its side along that ray; visible() has that of nested
  /// media.
  Color clear(Tracer& tracer, const Ray& ray, Real distance) const;
  /// The transmittance along the ray that leaves it, up to that distance, of what is in the way and of bodies
  /// that media fill; fog is left out.
  Color visible(Tracer& tracer, const Ray& ray, Real distance, const Sampler& numbers) const;

 private:
  /// The Bsdf of an opaque surface that scatters by the cosine and does nothing else, as most do; else null.
  /// Its answers here have the same bits as trace::scattered() and trace::density().
  static const PhongBsdf* evenOf(const Interaction& at) {
    const auto* phong = at.bsdf().as<PhongBsdf>();
    const bool even = phong && phong->isEven() && phong->scatters();
    return even && !at.transmits && at.coat == 0 && !at.raised() ? phong : nullptr;
  }
  Color scatteredEvenly(const Vec3& toEye, const Vec3& toLight) const {
    const Real cosine = dot(at_->normal, toLight);
    if (!(cosine > 0) || !(dot(at_->normal, toEye) > 0)) return Color(0);
    const Vec3& flat = at_->hit.surface.normal;
    const auto fromOtherSide = [&] {
      return at_->hit.twoSided && at_->hit.isBehind(-toEye) != at_->frame.inside;
    };
    if (dot(toLight, flat) * dot(toEye, flat) < 0 && !fromOtherSide()) return Color(0);
    return even_->diffuse * cosine / kPi;
  }

  const Interaction* at_ = nullptr;
  const PhongBsdf* even_ = nullptr;
  const Interfaces* inside_;
  Vec3 point_, along_;
  Real forward_ = 0;
};

}  // namespace trace
