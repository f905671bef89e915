#include "render/photons/photon_emitter.h"

#include "math/warp.h"
#include "render/lights/parallel_light.h"
#include "render/paths/interaction.h"
#include "shading/lights/panel.h"

namespace trace {
namespace {

/// The place of a light that two numbers choose, as its illuminate() does; nothing of parallel light.
std::optional<Vec3> startOnLight(const LightGeometry& light, const Vec2& u) {
  switch (light.starts) {
    case LightOrigin::panel: return placeOn(light, u);
    case LightOrigin::ball:
      return light.position + sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y) * light.radius;
    default: return {};
  }
}

}  // namespace

PhotonEmitter::PhotonEmitter(const World& world, const Settings& settings, const Lamps* lamps,
                             std::vector<PhotonTarget> targets, Kept kept, int texels, int pass)
    : seedOfPass_(mixBits(static_cast<std::uint64_t>(pass)) - mixBits(0)),
      world_(world),
      settings_(settings),
      lamps_(lamps),
      targets_(std::move(targets)),
      kept_(kept),
      onlyCaustics_(kept == Kept::caustics),
      fog_(settings),
      tracer_(world, settings),
      texels_(texels),
      rules_(settings, {1, 1}) {}

void PhotonEmitter::send(const PhotonSource& source, std::uint32_t n, LandedPhotons& landed) {
  const auto number = static_cast<std::uint64_t>(source.kind) << 32 | source.light;
  seed_ = mixBits((static_cast<std::uint64_t>(settings_.seed) + seedOfPass_) ^ mixBits(number + 1));
  n_ = n;
  chances_.bits = mixBits(mixBits(seed_ ^ 4) ^ n);
  holes_.bits = mixBits(mixBits(seed_ ^ 5) ^ n);
  numbers_ = HashedNumbers(mixBits(mixBits(seed_ ^ 6) ^ n));
  auto flight = source.kind == PhotonSource::Kind::light   ? fromLight(source)
                : source.kind == PhotonSource::Kind::lamps ? fromLamp(source)
                                                           : fromSky(source);
  if (flight) fly(*flight, landed);
}

std::optional<PhotonEmitter::Flight> PhotonEmitter::fromLight(const PhotonSource& source) {
  const std::size_t light = source.light;
  const Vec2 place = world_.lightHasSize(light) ? pair(1) : kCenter;
  const LightGeometry& geometry = world_.lightGeometry(light);
  const std::optional<Vec3> point = startOnLight(geometry, place);
  std::optional<PhotonAim> aim;
  if (point) {
    const bool isPoint = !onlyCaustics_ && !(geometry.radius > 0);
    const LightCone* cone = isPoint && geometry.cone ? &*geometry.cone : nullptr;
    aim = aimFrom(*point, targets_, pair(3).x, pair(2));
    if (aim && cone && 2 * kPi * (1 - cone->cosine) < aim->share)  // narrower than what there is to light
      aim = PhotonAim{{*point, toCone(pair(2), cone->axis, cone->cosine)}, 2 * kPi * (1 - cone->cosine)};
  } else if (const auto arriving = world_.illuminate(light, {}, place)) {
    aim = aimAlong(-arriving->toLight, targets_, world_.bounds(), pair(3).x, pair(2));
    if (aim) aim->ray.origin = startOfParallel(tracer_, aim->ray.origin, aim->ray.direction);
  }
  if (!aim) return {};
  Flight flight{aim->ray, tracer_.interfacesAt(aim->ray.origin), {}, Color(1), !point};
  flight.light = &source.light;
  flight.onLight = place;
  flight.start = point;
  flight.share = aim->share;
  flight.count = static_cast<Real>(source.count);
  cast(flight);
  return flight;
}

std::optional<PhotonEmitter::Flight> PhotonEmitter::fromLamp(const PhotonSource& source) {
  const Vec2 choice = pair(3);
  const Vec2 line = lamps_->hasBodies() ? pair(4) : Vec2{};
  const auto start = lamps_->start(world_, choice.x, pair(1), line);
  if (!start) return {};
  Vec3 normal = start->normal;
  const bool back = start->twoSided && chance() < 0.5;
  if (back) normal = -normal;
  Vec3 direction;
  Real share = kPi / start->density * (start->twoSided ? 2 : 1);
  if (!onlyCaustics_) {
    direction = Frame{normal}.basis().toWorld(cosineDirection(pair(2)));
  } else {
    const auto aim = aimFrom(start->point, targets_, choice.y, pair(2));
    if (!aim) return {};
    direction = aim->ray.direction;
    const Real cosine = dot(direction, start->normal);
    if (cosine < 0 && !start->twoSided) return {};
    normal = cosine < 0 ? -start->normal : start->normal;
    share = aim->share * std::abs(cosine) / start->density;
  }
  const std::optional<Hit> place = Lamps::placeOf(tracer_, *start, normal, RayKind::bounce);
  if (!place) return {};
  const PlaceBsdf bsdf = world_.shade(*place);
  const Color power = whitted(*bsdf).emissive * (place->opacity * share / static_cast<Real>(source.count));
  const Ray ray = place->leave(direction);
  Flight flight{ray, tracer_.interfacesAt(ray.origin), {}, power};
  cast(flight);
  return flight;
}

std::optional<PhotonEmitter::Flight> PhotonEmitter::fromSky(const PhotonSource& source) {
  const auto sky = lamps_->startOfSky(pair(1));
  const Color light = world_.outside().view({{}, sky.toLight}, RayKind::bounce).color;
  const auto aim = aimAlong(-sky.toLight, targets_, world_.bounds(), pair(3).x, pair(2));
  if (!aim) return {};
  const Vec3 start = startOfParallel(tracer_, aim->ray.origin, aim->ray.direction);
  const Color power = light * (aim->share / (sky.density * static_cast<Real>(source.count)));
  Flight flight{{start, aim->ray.direction}, tracer_.interfacesAt(start), {}, power, true, true};
  cast(flight);
  return flight;
}

}  // namespace trace
