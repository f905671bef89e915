#include "render/paths/onward.h"

#include <algorithm>
#include <cmath>

#include "shading/optics/fresnel.h"
#include "shading/optics/optics.h"

namespace trace {
namespace {

/// The share that a varnish mirrors of what goes to the eye.
Real coatTo(const Interaction& at, const Vec3& toEye) {
  if (at.coat == 0) return 0;
  return fresnelDielectric(std::abs(dot(toEye, at.normal)), at.indices.before, at.indices.behind);
}

}  // namespace

Frame frameToward(const Interaction& at, const Vec3& toEye) {
  Frame frame = at.frame;
  if (at.transmits && at.straight && dot(toEye, frame.normal) < 0)
    frame.normal = -frame.normal, frame.coat = -frame.coat;
  return frame;
}

Color scattered(const Interaction& at, const Vec3& toEye, const Vec3& toLight, bool lit) {
  const Vec3& flat = at.hit.surface.normal;
  // Which side of the normal is the eye's depends, where the normal is turned, on where the eye is.
  const Real side = at.transmits                                                    ? dot(toEye, at.normal)
                    : at.hit.twoSided && at.hit.isBehind(-toEye) != at.frame.inside ? -1
                                                                                    : 1;
  const bool inward = dot(toLight, at.normal) * side < 0;
  if (!inward && !at.raised() && dot(toLight, flat) * dot(toEye, flat) < 0) return Color(0);
  const Real below = 1 - coatTo(at, toEye);
  if (!lit) return evaluate(at.bsdf(), frameToward(at, toEye), toEye, toLight, Transport::importance) * below;
  // As the eye sees it: light from behind is not spread to this side.
  Frame frame = at.frame;
  if (side < 0) frame.normal = -frame.normal, frame.inside = !frame.inside;
  const Scatter parts = scatter(at.bsdf(), frame, toLight, toEye);
  return (parts.diffuse * below + parts.specular) * (at.material.shadow / kPi);
}

Color scatteredOn(const Interaction& at, const Vec3& toEye, const Vec3& toLight, bool lit) {
  const Vec3& flat = at.hit.surface.normal;
  const Real arrives = std::abs(dot(toLight, flat));
  return arrives > 0 ? scattered(at, toEye, toLight, lit) * (std::abs(dot(toEye, flat)) / arrives) : Color(0);
}

bool Onward::totallyReflected(Real choice) const {
  return choice >= toLobe_ + toMirror_ + toBody_ && toBehind_ > 0 && !at_.through(*share_);
}

std::optional<Onward::Ray> Onward::lightIntoLobe(const LobeNumbers& numbers, bool lit) const {
  const Vec3 from = -at_.ray.direction;
  const auto drawn = sample(at_.bsdf(), at_.frame, from, numbers.which, numbers.where, Transport::importance);
  if (!drawn) return {};
  const Color light = scatteredOn(at_, drawn->toLight, from, lit);
  if (isBlack(light)) return {};
  return intoLobe(*drawn, light / (drawn->density * toLobe_));
}

std::optional<Onward::Ray> Onward::ofOne(Real choice, bool fromLight) const {
  const bool mirrors = choice < toLobe_ + toMirror_;
  if (!mirrors && goesIntoBody(choice) > 0) return {};
  auto ray = only(mirrors ? RayKind::reflection : RayKind::refraction, fromLight);
  if (ray) ray->weight = mirrors ? ray->weight / toMirror_ : ray->weight * (all_ / maxComponent(through_));
  return ray;
}

std::optional<Onward::Ray> Onward::only(RayKind kind, bool fromLight) const {
  if (!(chance(kind) > 0)) return {};
  const Vec3 from = -at_.ray.direction;
  const Vec3& flat = at_.hit.surface.normal;
  // Light loses or gains by the angle between the two normals what paths from the camera do not.
  const auto narrowed = [&](const Vec3& to) {
    if (!fromLight) return Real{1};
    const Real seen = dot(from, flat) * dot(to, at_.normal);
    return seen != 0 ? std::abs(dot(from, at_.normal) * dot(to, flat) / seen) : 1;
  };
  if (kind == RayKind::reflection) {
    const Vec3 to = mirrored(at_.ray.direction, at_.normal);
    return Ray{kind, to, mirror_ * narrowed(to)};
  }
  const auto to = at_.through(*share_);
  if (!to) return {};
  // Along paths from the camera radiance over the square of the index is kept, which light is not.
  const Real ratio = at_.ratio(*share_), counts = fromLight ? ratio * ratio * narrowed(*to) : 1;
  Ray ray{kind, *to, through_ * counts, 0, ratio, at_.behind()};
  ray.behind->wavelength = share_->nanometres;
  return ray;
}

std::optional<Onward::Ray> strongestOf(const Interaction& at) {
  const auto shares = at.shares();
  const Color mirror = at.mirror(false), filter = shares.empty() ? Color(0) : at.filter(shares[0]);
  const bool mirrors = shares.empty() || maxComponent(mirror) >= maxComponent(filter);
  if (mirrors && isBlack(mirror)) return {};
  const auto through = mirrors ? std::nullopt : at.through(shares[0]);
  if (through) return Onward::Ray{RayKind::refraction, *through, filter, 0, at.ratio(shares[0]), at.behind()};
  return Onward::Ray{RayKind::reflection, mirrored(at.ray.direction, at.normal), mirror};
}

}  // namespace trace
