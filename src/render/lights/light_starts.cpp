#include "render/lights/light_starts.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"
#include "math/elementary.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/lights/parallel_light.h"
#include "shading/lights/panel.h"
#include "shading/scattering.h"

namespace trace {
namespace {

/// Branches of the sampler.
constexpr std::uint32_t kChoice = 0, kPlace = 1, kDirection = 2, kHole = 3;

Real solidAngle(Real cosine) { return 2 * kPi * (1 - cosine); }

/// A point light with a size.
struct Ball {
  Vec3 middle;
  Real radius;
  Real area() const { return 4 * kPi * radius * radius; }
  /// The solid angle that it covers, and in which it is sampled; 0 from inside.
  Real angleFrom(const Vec3& place) const {
    const Vec3 way = middle - place;
    const Real sine2 = radius * radius / dot(way, way);
    return sine2 < 1 ? solidAngle(std::sqrt(1 - sine2)) : 0;
  }
};
std::optional<Ball> ballOf(const LightGeometry& light) {
  if (light.starts != LightOrigin::ball || !(light.radius > 0)) return {};
  return Ball{light.position, light.radius};
}

}  // namespace

LightStarts::LightStarts(const World& world, const Lamps& lamps) : lamps_(&lamps) {
  const Box3& box = world.bounds();
  if (box.empty()) return;
  middle_ = box.center();
  radius_ = length(box.size()) / 2;
  if (!(radius_ > 0)) return;
  lights_.resize(world.lights().size());
  Real sum = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    Source& source = lights_[i];
    if (const LightGeometry& light = world.lightGeometry(i); light.starts == LightOrigin::ball) {
      const Vec3 way = middle_ - light.position;
      const Real away2 = dot(way, way), sine2 = radius_ * radius_ / away2;
      source.axis = away2 > 0 ? normalize(way) : Vec3{0, 0, 1};
      if (sine2 < 1 && !(light.radius > 0)) source.cosine = std::sqrt(1 - sine2);
      // The cone in which it shines, if that is narrower.
      const LightReach reach = world.lights()[i].reach(world.rules());
      const Real cosine = math::cos(std::min(reach.around + reach.beyond, kPi));
      if (cosine > source.cosine && cosine < 1) source.cosine = cosine, source.axis = reach.axis;
    }
    sum += source.share = powerOf(world, i);
  }
  lampShare_ = lamps.power();
  if (world.outside().isSeenBy(RayKind::light)) {
    constexpr std::uint32_t kLooks = 1024;
    for (std::uint32_t n = 0; n < kLooks; ++n) {
      const auto sky = lamps.startOfSky(sobolPoint(n, 0));
      const Color light = world.outside().view({{}, sky.toLight}, RayKind::light).color;
      if (sky.density > 0) skyShare_ += luminanceOf(light) / (sky.density * diskDensity() * kLooks);
    }
  }
  sum += lampShare_ + skyShare_;
  // Some paths in any case: it may shine past all places that were looked at.
  constexpr Real kLeast = 0.02;  // least share of all, for all lights together
  const Real least = sum > 0 ? kLeast * sum / static_cast<Real>(lights_.size()) : 1;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const bool shines = world.lights()[i].reach(world.rules()).power > 0;
    if (!shines || lights_[i].share >= least) continue;
    sum += least - lights_[i].share;
    lights_[i].share = least;
  }
  if (!(sum > 0)) return;
  Real upTo = 0;
  for (Source& source : lights_) sums_.push_back(upTo += source.share /= sum);
  lampShare_ /= sum;
  skyShare_ /= sum;
}

/// About what the light sends to the scene.
Real LightStarts::powerOf(const World& world, std::size_t light) const {
  constexpr std::uint32_t kLooks = 64;
  const LightGeometry& l = world.lightGeometry(light);
  Real power = 0;
  if (l.starts == LightOrigin::ball || l.starts == LightOrigin::panel) {
    Vec3 axis{0, 0, 1};
    Real cosine = -1;
    if (l.starts == LightOrigin::ball) axis = lights_[light].axis, cosine = lights_[light].cosine;
    const Real away = std::clamp(length(middle_ - l.position), radius_ / 2, 4 * radius_);
    for (std::uint32_t n = 0; n < kLooks; ++n) {
      const auto arriving =
          world.illuminate(light, l.position + toCone(sobolPoint(n, 0), axis, cosine) * away);
      if (arriving)
        power += luminanceOf(arriving->intensity()) * kPi * away * away * solidAngle(cosine) / kLooks;
    }
  } else if (const auto arriving = world.illuminate(light, middle_)) {
    power = luminanceOf(arriving->intensity()) * kPi / diskDensity();
  }
  return power;
}

Ray LightStarts::before(Tracer& tracer, const Vec3& direction, const Vec2& u) const {
  const Vec3 x = perpendicularTo(direction), y = cross(direction, x);
  const Vec2 disk = toDisk(u);
  const Vec3 start = middle_ + (x * disk.x + y * disk.y - direction * 2) * radius_;
  return {startOfParallel(tracer, start, direction), direction};
}

Real LightStarts::diskDensity(const Vec3& at, const Vec3& toLight) const {
  const Vec3 off = cross(at - middle_, toLight);
  return dot(off, off) <= radius_ * radius_ ? diskDensity() : 0;
}

void LightStarts::follow(Tracer& tracer, Start& start, const Sampler& sampler) const {
  start.hit = tracer.cast(start.ray, RayKind::light, start.inside, tracer.chance(sampler.branch(kHole)));
}

std::optional<LightStarts::Start> LightStarts::start(Tracer& tracer, const Sampler& sampler) const {
  const bool chooses = !sums_.empty() || skyShare_ > 0 || !lamps_->isOne() || lamps_->hasBodies();
  Real which = chooses ? sampler.branch(kChoice).next() : 0;
  if (!sums_.empty()) {
    const auto found = std::upper_bound(sums_.begin(), sums_.end(), which);
    if (found != sums_.end())
      return fromLight(tracer, static_cast<std::size_t>(found - sums_.begin()), sampler);
    which -= sums_.back();
  }
  if (which < lampShare_) return fromLamp(tracer, which / lampShare_, sampler);
  return skyShare_ > 0 ? fromSky(tracer, sampler) : std::nullopt;
}

std::optional<LightStarts::Start> LightStarts::fromLight(Tracer& tracer, std::size_t light,
                                                         const Sampler& sampler) const {
  const World& world = tracer.world();
  const Source& source = lights_[light];
  const Vec2 u = world.lightHasSize(light) ? sampler.branch(kPlace).next2() : kCenter;
  const Vec2 v = sampler.branch(kDirection).next2();
  Start start;
  start.light = light;
  start.onLight = u;
  Real density = 0;  // density of the direction, or of the place across parallel light
  const LightGeometry& l = world.lightGeometry(light);
  switch (l.starts) {
    case LightOrigin::panel: {
      Vec3 normal = normalize(cross(l.u, l.v));
      const bool back = l.twoSided && sampler.branch(kChoice).branch(0).next() < 0.5;
      if (back) normal = -normal;
      const Vec3 local = cosineDirection(v);
      start.ray = {placeOn(l, u), Frame{normal}.basis().toWorld(local)};
      density = cosineDensity(local) * (l.twoSided ? 0.5 : 1);
      break;
    }
    case LightOrigin::ball:
      if (const auto ball = ballOf(l)) {
        const Vec3 normal = sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y), local = cosineDirection(v);
        start.ray = {l.position + normal * l.radius, Frame{normal}.basis().toWorld(local)};
        start.cosine = local.z;
        density = cosineDensity(local) / ball->area();
      } else {
        start.ray = {l.position, toCone(v, source.axis, source.cosine)};
        density = 1 / solidAngle(source.cosine);
      }
      break;
    case LightOrigin::parallel:
      if (const auto arriving = world.illuminate(light, {}, u)) {
        start.ray = before(tracer, -arriving->toLight, v);
        start.parallel = true;
        density = diskDensity();
      }
      break;
    case LightOrigin::none: break;
  }
  if (!(density > 0)) return {};
  start.density = density * source.share;
  start.inside = tracer.interfacesAt(start.ray.origin);
  follow(tracer, start, sampler);
  return start;
}

std::optional<LightStarts::Arrival> LightStarts::arrives(const World& world, const Start& start,
                                                         const Vec3& at, Real t) const {
  const Real away2 = start.parallel ? 1 : t * t;
  if (start.lamp)
    return Arrival{start.sends, lamps_->density(at, *start.lamp) * start.cosine / (away2 * start.density),
                   start.cosine / start.density};
  if (start.light == kNoLight)
    return Arrival{start.sends, lamps_->density(Ray{at, -start.ray.direction}) / start.density,
                   1 / start.density};
  const auto arriving = world.illuminate(start.light, at, start.onLight);
  if (!arriving) return {};
  const auto ball = ballOf(world.lightGeometry(start.light));
  if (!ball) return Arrival{arriving->intensity() * (kPi * away2 / start.density), 1 / start.density, 0};
  // Its radiance to there is what arrives over the solid angle.
  const Real angle = ball->angleFrom(at);
  if (!(angle > 0)) return {};
  return Arrival{arriving->intensity() * (kPi * start.cosine / (angle * start.density)),
                 start.cosine / (away2 * angle * start.density), 0};
}

std::optional<LightStarts::Start> LightStarts::fromLamp(Tracer& tracer, Real which,
                                                        const Sampler& sampler) const {
  const Sampler placing = sampler.branch(kPlace);
  const Vec2 line = lamps_->hasBodies() ? placing.second2() : Vec2{};
  const auto from = lamps_->start(tracer.world(), which, Sampler(placing).next2(), line);
  if (!from) return {};
  Sampler numbers = sampler.branch(kDirection);
  const Vec3 local = cosineDirection(numbers.next2());
  Vec3 normal = from->normal;
  if (from->twoSided && numbers.next() < 0.5) normal = -normal;
  const std::optional<Hit> place = Lamps::placeOf(tracer, *from, normal, RayKind::light);
  if (!place) return {};
  Start start;
  start.ray = place->leave(Frame{normal}.basis().toWorld(local));
  start.inside = tracer.interfacesAt(start.ray.origin);
  const Real density = lampShare_ * lamps_->startDensity(*place);
  if (!(density > 0)) return {};
  const PlaceBsdf bsdf = tracer.world().shade(*place);
  start.sends = whitted(*bsdf).emissive * (place->opacity * kPi / density);
  start.cosine = local.z;
  start.density = density * local.z / kPi;
  start.lamp = place;
  follow(tracer, start, sampler);
  return start;
}

std::optional<LightStarts::Start> LightStarts::fromSky(Tracer& tracer, const Sampler& sampler) const {
  const auto sky = lamps_->startOfSky(sampler.branch(kPlace).next2());
  if (!(sky.density > 0)) return {};
  Start start;
  start.parallel = true;
  start.ray = before(tracer, -sky.toLight, sampler.branch(kDirection).next2());
  start.inside = tracer.interfacesAt(start.ray.origin);
  start.density = skyShare_ * sky.density * diskDensity();
  start.sends = tracer.world().outside().view({{}, sky.toLight}, RayKind::light).color * (1 / start.density);
  follow(tracer, start, sampler);
  return start;
}

Real LightStarts::overAsked(const World& world, std::size_t light, const Illumination& arriving,
                            const Vec3& at) const {
  const Source& source = lights_.empty() ? Source{} : lights_[light];
  if (!(source.share > 0)) return 0;
  const LightGeometry& l = world.lightGeometry(light);
  const Real away2 = arriving.distance * arriving.distance;
  switch (l.starts) {
    case LightOrigin::panel: {
      const Real facing = std::abs(dot(arriving.toLight, normalize(cross(l.u, l.v))));
      return source.share * (facing / (kPi * away2) * (l.twoSided ? 0.5 : 1));
    }
    case LightOrigin::ball: {
      if (const auto ball = ballOf(l)) return source.share * (ball->angleFrom(at) / (ball->area() * kPi));
      const bool isInCone = dot(-arriving.toLight, source.axis) >= source.cosine;
      return source.share * (isInCone ? 1 / (solidAngle(source.cosine) * away2) : 0);
    }
    case LightOrigin::parallel: return source.share * diskDensity(at, arriving.toLight);
    case LightOrigin::none: break;
  }
  return 0;
}

Real LightStarts::overAsked(const Lamps::Place& place, const Vec3& at) const {
  if (place.distance == kInfinity) return ofSky(at, place.toLight) / place.density;
  return lampShare_ * lamps_->startDensity(place.object, place.part) / (kPi * place.density);
}

Real LightStarts::ofLamp(const Hit& hit) const { return lampShare_ * lamps_->startDensity(hit) / kPi; }

Real LightStarts::ofSky(const Vec3& at, const Vec3& toLight) const {
  return skyShare_ > 0 ? skyShare_ * lamps_->skyStartDensity(toLight) * diskDensity(at, toLight) : 0;
}

}  // namespace trace
