#include "render/paths/onward.h"

#include <algorithm>
#include <cmath>

#include "shading/fresnel.h"
#include "shading/optics.h"

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

Onward::Onward(const Interaction& at, Real spectrum, std::optional<Real> intoBody) : at_(at) {
  const bool glossy = isGlossy(at.bsdf());
  const auto shares = glossy ? at.shares().first(0) : at.shares();
  if (!shares.empty()) {
    const auto count = static_cast<Real>(shares.size());
    share_ = &shares[static_cast<std::size_t>(spectrum * count)];
    through_ = at.filter(*share_);
    response_ = share_->weight * count;
  }
  mirror_ = at.mirror(true);
  const Real mirrors = maxComponent(mirror_), passes = maxComponent(through_);
  constexpr Real kLeastLobe = 0.2;  // what is scattered is not known beforehand
  const Real likely = intoBody ? kLeastLobe : std::max(kLeastLobe, 1 - mirrors - passes);
  const Real lobe = scatters(at.bsdf()) ? likely : 0;
  const Real all = lobe + mirrors + passes + intoBody.value_or(0);
  if (!(all > 0)) return;
  toLobe_ = lobe / all;
  toMirror_ = mirrors / all;
  toBody_ = intoBody.value_or(0) / all;
  toBehind_ = passes / all;
}

bool Onward::totallyReflected(Real choice) const {
  return choice >= toLobe_ + toMirror_ + toBody_ && toBehind_ > 0 && !at_.through(*share_);
}

std::optional<Onward::Ray> Onward::choose(Real choice, Sampler lobe, bool fromLight, bool lit) const {
  if (choice < toLobe_) {
    const Vec3 from = -at_.ray.direction;
    const Real which = lobe.next();
    const auto drawn = sample(at_.bsdf(), at_.frame, from, which, lobe.next2(), Transport::importance);
    if (!drawn) return {};
    const Vec3& to = drawn->toLight;
    const Color light = fromLight ? scatteredOn(at_, to, from, lit) : scattered(at_, from, to);
    if (isBlack(light)) return {};
    const bool inward = dot(to, at_.normal) < 0;
    return Ray{RayKind::bounce, to, light / (drawn->density * toLobe_),
               drawn->density,  1,  inward && at_.transmits ? at_.behind() : at_.inside};
  }
  const bool mirrors = choice < toLobe_ + toMirror_;
  if (!mirrors && goesIntoBody(choice) > 0) return {};
  const RayKind kind = mirrors ? RayKind::reflection : RayKind::refraction;
  return only(kind, fromLight, chance(kind));
}

std::optional<Onward::Ray> Onward::only(RayKind kind, bool fromLight, Real likely) const {
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
    return Ray{kind, to, mirror_ * (narrowed(to) / likely), 0, 1, at_.inside};
  }
  const auto to = at_.through(*share_);
  if (!to) return {};
  // Along paths from the camera radiance over the square of the index is kept, which light is not.
  const Real ratio = at_.ratio(*share_), counts = fromLight ? ratio * ratio * narrowed(*to) : 1;
  Interfaces behind = at_.behind();
  behind.wavelength = share_->nanometres;
  return Ray{kind, *to, through_ * (counts / likely), 0, ratio, std::move(behind)};
}

}  // namespace trace
