#include "render/photons.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/budget.h"
#include "image/srgb.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/fog.h"
#include "render/interaction.h"
#include "shading/lights/panel.h"
#include "shading/optics.h"

namespace trace {
namespace {

/// A ball around an object that mirrors or refracts.
struct Target {
  Vec3 center;
  Real radius;
};

std::vector<Target> targetsOf(const World& world) {
  constexpr std::size_t kMost = 64;
  std::vector<Target> targets;
  Box3 all;
  const auto add = [&](const Box3& box) { targets.push_back({box.center(), length(box.size()) / 2}); };
  for (std::uint32_t object = 0; object < world.objectCount(); ++object) {
    const Box3& box = world.boundsOf(object);
    const WhittedTerms& terms = world.termsOf(object);
    if (box.empty() || box.unbounded() || !(terms.mirrors() || terms.transmits())) continue;
    add(box);
    all.extend(box);
  }
  if (targets.size() > kMost) {
    targets.clear();
    add(all);
  }
  return targets;
}

/// A photon on its way to a target.
struct Aim {
  Ray ray;
  /// The solid angle, or of parallel light the area, for which it stands when all of the light's photons are
  /// one.
  Real share;
};

/// One of the targets, by how much each covers, and what all cover.
struct Choice {
  const Target& target;
  Real all;
};
template <class Covers>
Choice choose(const std::vector<Target>& targets, Real which, const Covers& covers) {
  Real all = 0;
  for (const Target& t : targets) all += covers(t);
  Real rest = which * all;
  for (const Target& t : targets)
    if ((rest -= covers(t)) < 0) return {t, all};
  return {targets.back(), all};
}

/// Where photons of a light start that is at a place: toward one of the targets, evenly over the solid angle
/// that they cover.
std::optional<Aim> aimFrom(const Vec3& place, const std::vector<Target>& targets, Real which, const Vec2& u) {
  const auto cosineOf = [&](const Target& t) {
    const Vec3 way = t.center - place;
    const Real sine2 = t.radius * t.radius / dot(way, way);
    return sine2 < 1 ? std::sqrt(1 - sine2) : -1;  // from inside it is all around
  };
  const auto [chosen, all] = choose(targets, which, [&](const Target& t) { return 1 - cosineOf(t); });
  const Vec3 way = chosen.center - place;
  const Vec3 direction = toCone(u, length(way) > 0 ? normalize(way) : Vec3{0, 0, 1}, cosineOf(chosen));
  const auto covers = [&](const Target& t) {
    const Vec3 to = t.center - place;
    return dot(to, direction) >= cosineOf(t) * length(to);
  };
  const auto over = std::count_if(targets.begin(), targets.end(), covers);
  if (over == 0) return {};  // rounding at its rim
  return Aim{{place, direction}, 2 * kPi * all / static_cast<Real>(over)};
}

/// The same of parallel light: evenly over the disks that the targets cover.
std::optional<Aim> aimAlong(const Vec3& direction, const std::vector<Target>& targets, const Box3& scene,
                            Real which, const Vec2& u) {
  const auto [chosen, all] = choose(targets, which, [](const Target& t) { return t.radius * t.radius; });
  const Vec3 x = perpendicularTo(direction), y = cross(direction, x);
  const Vec2 disk = toDisk(u);
  const Vec3 place = chosen.center + (x * disk.x + y * disk.y) * chosen.radius;
  const auto covers = [&](const Target& t) {
    const Vec3 off = cross(place - t.center, direction);
    return dot(off, off) <= t.radius * t.radius;
  };
  const auto over = std::count_if(targets.begin(), targets.end(), covers);
  if (over == 0) return {};
  const Real before = 2 * length(scene.size());
  return Aim{{place - direction * before, direction}, kPi * all / static_cast<Real>(over)};
}

/// The place of a light that two numbers choose, as its illuminate() does; nothing of parallel light.
std::optional<Vec3> placeOn(const Light& light, const Vec2& u) {
  return match(light, [&](const auto& l) -> std::optional<Vec3> {
    if constexpr (requires { l.twoSided; }) {
      return trace::placeOn(l, u);
    } else if constexpr (requires { l.radius; }) {
      return l.position + sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y) * l.radius;
    } else {
      return {};
    }
  });
}

/// What sends photons: a light of the scene, the objects that shine, or what is around.
struct Source {
  enum class Kind { light, lamps, sky } kind;
  std::size_t light = 0;
  Real power = 0;          ///< about what it sends; only how many photons it gets depends on that
  std::int64_t count = 0;  ///< of them
};

/// What came to rest.
struct Landed {
  std::vector<Photon> photons{};
  std::vector<std::pair<IlluminationMap::Place, Color>> onMaps{};
};

class Emitter {
 public:
  /// With `onlyCaustics` photons are kept where they land after mirrors and glass, and those alone; they are
  /// sent to the targets. Else every surface that scatters keeps them.
  Emitter(const World& world, const Settings& settings, const Lamps* lamps, std::vector<Target> targets,
          bool onlyCaustics, int pass)
      : seedOfPass_(mixBits(static_cast<std::uint64_t>(pass)) - mixBits(0)),
        world_(world),
        settings_(settings),
        lamps_(lamps),
        targets_(std::move(targets)),
        onlyCaustics_(onlyCaustics),
        fog_(settings),
        tracer_(world, settings),
        texels_(onlyCaustics ? settings.causticTexels : 0) {}

  /// Photon n of the source.
  void send(const Source& source, std::uint32_t n, Landed& landed) {
    const auto number = static_cast<std::uint64_t>(source.kind) << 32 | source.light;
    seed_ = mixBits((static_cast<std::uint64_t>(settings_.seed) + seedOfPass_) ^ mixBits(number + 1));
    n_ = n;
    chances_.bits = mixBits(mixBits(seed_ ^ 4) ^ n);
    holes_.bits = mixBits(mixBits(seed_ ^ 5) ^ n);
    auto flight = source.kind == Source::Kind::light   ? fromLight(source)
                  : source.kind == Source::Kind::lamps ? fromLamp(source)
                                                       : fromSky(source);
    if (flight) fly(*flight, landed);
  }

 private:
  /// A photon at its first surface.
  struct Flight {
    Ray ray;
    Interfaces inside;
    std::optional<Hit> hit;
    Color power;
    bool fromInfinity;  ///< whose light is what arrives, and loses nothing before
    /// Of the scene, whose number that is; shadow rays ask for it, which cross panes that bend nothing.
    const std::size_t* light = nullptr;
    Vec2 onLight{};               ///< the place on it
    std::optional<Vec3> start{};  ///< which is that point
  };

  struct Chances {
    std::uint64_t bits = 0;
    Real next() { return unitFromBits(bits = mixBits(bits)); }
  };

  Vec2 pair(std::uint64_t dimension) const { return sobolPoint(n_, mixBits(seed_ ^ dimension)); }
  Real chance() { return chances_.next(); }
  Real hole() { return tracer_.chance(holes_); }

  std::optional<Flight> fromLight(const Source& source) {
    const std::size_t light = source.light;
    const Vec2 place = world_.lightHasSize(light) ? pair(1) : kCenter;
    const std::optional<Vec3> point = placeOn(world_.lights()[light], place);
    std::optional<Aim> aim;
    if (point) {
      aim = aimFrom(*point, targets_, pair(3).x, pair(2));
    } else if (const auto arriving = world_.illuminate(light, {}, place)) {
      aim = aimAlong(-arriving->toLight, targets_, world_.bounds(), pair(3).x, pair(2));
    }
    if (!aim) return {};
    Interfaces inside = tracer_.interfacesAt(aim->ray.origin);
    auto hit = tracer_.cast(aim->ray, RayKind::bounce, inside, hole());
    if (!hit) return {};
    // What falls on a surface there that faces the light, over the solid angle or the area.
    const auto arriving = world_.illuminate(light, hit->surface.point, place);
    if (!arriving) return {};
    const Real away2 = point ? hit->t * hit->t : 1;
    const Color power = arriving->intensity() * (kPi * away2 * aim->share / static_cast<Real>(source.count));
    return Flight{aim->ray, std::move(inside), std::move(hit), power, !point, &source.light, place, point};
  }

  /// What of the light over a solid angle falls on a surface at the flight's hit, by the light's own law.
  Real fallsOn(const Flight& flight) const {
    const Vec3& point = flight.hit->surface.point;
    const auto arriving = world_.illuminate(*flight.light, point, flight.onLight);
    if (!arriving) return 0;
    const Vec3 way = flight.start ? point - *flight.start : Vec3{};
    return arriving->attenuation * (flight.start ? dot(way, way) : 1);
  }

  std::optional<Flight> fromLamp(const Source& source) {
    const Vec2 choice = pair(3);
    const auto start = lamps_->start(choice.x, pair(1));
    if (!start) return {};
    // The surface is looked for from a little before it, so that its own rounding error is known.
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
    const Vec3 before = start->point + normal * (1e-4 * start->size);
    Interfaces inside = tracer_.interfacesAt(before), below = inside;
    const std::optional<Hit> place = tracer_.cast({before, -normal}, RayKind::bounce, below);
    if (!place || place->object != start->object) return {};
    const PlaceBsdf bsdf = world_.shade(*place);
    const Ray ray = place->leave(direction);
    auto hit = tracer_.cast(ray, RayKind::bounce, inside, hole());
    const Color power = whitted(*bsdf).emissive * (place->opacity * share / static_cast<Real>(source.count));
    return Flight{ray, std::move(inside), std::move(hit), power, false};
  }

  std::optional<Flight> fromSky(const Source& source) {
    const auto sky = lamps_->startOfSky(pair(1));
    const Color light = world_.outside().view({{}, sky.toLight}, RayKind::bounce).color;
    const auto aim = aimAlong(-sky.toLight, targets_, world_.bounds(), pair(3).x, pair(2));
    if (!aim) return {};
    Interfaces inside = tracer_.interfacesAt(aim->ray.origin);
    auto hit = tracer_.cast(aim->ray, RayKind::bounce, inside, hole());
    const Color power = light * (aim->share / (sky.density * static_cast<Real>(source.count)));
    return Flight{aim->ray, std::move(inside), std::move(hit), power, true};
  }

  void fly(Flight& flight, Landed& landed) {
    auto& [ray, inside, hit, power, fromInfinity, light, onLight, start] = flight;
    bool gathered = !light;  // shadow rays do not bring it
    bool straight = true;    // it has met nothing but panes that bend nothing
    for (int bounces = 0; hit && !isBlack(power); ++bounces) {
      power *= inside.passed(hit->t);
      if (!(bounces == 0 && fromInfinity) && isInOpenAir(inside, world_))
        power *= Color(fog_.passes(ray, hit->t));
      if (straight && light && !world_.lights(*light, hit->object)) return;
      const Interaction at(tracer_, ray, *hit, nullptr, inside, chance());
      const Vec3& normal = hit->surface.normal;
      const bool rests = scatters(at.bsdf());
      if (rests && ((bounces > 0 && gathered) || !onlyCaustics_)) {
        if (const auto place = texels_.place(world_, ray, *hit))
          landed.onMaps.emplace_back(*place, power);
        else
          landed.photons.push_back(
              {hit->surface.point, ray.direction, at.facing() > 0 ? normal : -normal, power});
      }
      if (bounces >= settings_.depth) return;

      const auto shares = at.shares();
      const SpectralShare* share =
          shares.empty() ? nullptr
                         : &shares[static_cast<std::size_t>(chance() * static_cast<Real>(shares.size()))];
      const bool glossy = !onlyCaustics_ && isGlossy(at.bsdf());
      const Color mirror = at.mirror(glossy);
      const Color through =
          share && !glossy ? at.filter(*share) * share->weight * static_cast<Real>(shares.size()) : Color(0);
      // One ray goes on, or none: what it brings stays about the same.
      const Real mirrors = maxComponent(mirror), passes = maxComponent(through);
      const Real lobe = rests && !onlyCaustics_ ? std::max(0.2, 1 - mirrors - passes) : 0;
      const Real all = std::max(1.0, mirrors + passes + lobe), choice = chance() * all;
      Interfaces there = inside;
      Vec3 direction;
      if (choice < mirrors) {
        gathered = true;
        straight = false;
        power *= mirror * (all / mirrors);
        direction = mirrored(ray.direction, at.normal);
      } else if (choice < mirrors + passes) {
        const auto refracted = at.through(*share);
        if (!refracted) return;
        gathered = gathered || !at.straight;
        straight = straight && at.straight;
        // Rays from the eye keep radiance over the square of the index (Veach 1997, section 5.2): so do
        // photons.
        const Real ratio = at.ratio(*share);
        power *= through * (ratio * ratio * all / passes);
        there = at.behind();
        there.wavelength = share->nanometres;
        direction = *refracted;
      } else if (choice < mirrors + passes + lobe) {
        straight = false;
        const Real choose = chance();
        const Vec2 u{chance(), chance()};
        const auto drawn = sample(at.bsdf(), at.frame, -ray.direction, choose, u, Transport::radiance);
        if (!drawn) return;
        direction = drawn->toLight;
        const bool inward = dot(direction, at.normal) < 0;
        if (!inward && dot(direction, normal) * at.facing() < 0) return;
        const Color weight = drawn->weight * ((1 - at.coat) * (all / lobe) * narrowed(at, direction));
        const Real goes = std::min(1.0, maxComponent(power * weight) / maxComponent(power));
        if (!(chance() < goes)) return;
        power *= weight / goes;
        if (inward && at.transmits) there = at.behind();
      } else {
        return;
      }
      // Behind a pane the light is as strong as a shadow ray through it finds it: by the light's own law,
      // which need not be the square of the distance.
      const Real before = straight && light ? fallsOn(flight) : 0;
      ray = hit->leave(direction);
      inside = there;
      hit = tracer_.cast(ray, RayKind::bounce, inside, hole());
      if (before > 0 && hit) power *= Color(fallsOn(flight) / before);
    }
  }

  /// What the scattered light counts because the shading normal is not the true one: paths from lamps see the
  /// surface's true area (Veach 1997, section 5.3.2).
  static Real narrowed(const Interaction& at, const Vec3& direction) {
    const Vec3& normal = at.hit.surface.normal;
    const Real seen = dot(at.ray.direction, normal) * dot(direction, at.normal);
    const Real factor = seen != 0 ? dot(at.ray.direction, at.normal) * dot(direction, normal) / seen : 1;
    return std::min(std::abs(factor), 4.0);
  }

  std::uint64_t seedOfPass_;  ///< 0 of the first
  const World& world_;
  const Settings& settings_;
  const Lamps* lamps_;
  std::vector<Target> targets_;
  bool onlyCaustics_;
  Fog fog_;
  Tracer tracer_;
  IlluminationMap texels_;  // tells where on it a place is
  // Of the photon that is sent.
  std::uint64_t seed_ = 0;
  std::uint32_t n_ = 0;
  Chances chances_, holes_;
};

/// All that sends photons to the targets, each with its part of them: by what it sends, and some in any case,
/// for a light may shine past the middle of a target.
std::vector<Source> sourcesOf(const World& world, const Lamps* lamps, const std::vector<Target>& targets,
                              std::int64_t photons) {
  std::vector<Source> sources;
  Real most = 0, sum = 0;
  const auto add = [&](Source::Kind kind, std::size_t light, Real power) {
    sources.push_back({kind, light, power});
    most = std::max(most, power);
  };
  // In parts of pi squared.
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    Real power = 0;
    for (const Target& t : targets)
      if (const auto arriving = world.illuminate(i, t.center))
        power += luminanceOf(arriving->intensity()) * t.radius * t.radius;
    add(Source::Kind::light, i, power);
  }
  if (lamps && lamps->power() > 0) add(Source::Kind::lamps, 0, lamps->power() / (kPi * kPi));
  if (lamps && world.outside().isSeenBy(RayKind::bounce)) {
    constexpr std::uint32_t kLooks = 1024;
    Real power = 0;
    for (std::uint32_t n = 0; n < kLooks; ++n) {
      const auto sky = lamps->startOfSky(sobolPoint(n, 0));
      const Color light = world.outside().view({{}, sky.toLight}, RayKind::bounce).color;
      if (sky.density > 0) power += luminanceOf(light) / (sky.density * kLooks * kPi);
    }
    Real disks = 0;
    for (const Target& t : targets) disks += t.radius * t.radius;
    add(Source::Kind::sky, 0, power * disks);
  }
  constexpr Real kLeast = 0.02;  // of the strongest one
  for (Source& s : sources) sum += s.power = std::max(s.power, most > 0 ? kLeast * most : 1);
  for (Source& s : sources)
    s.count =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<Real>(photons) * s.power / sum));
  return sources;
}

/// Sends photons; what landed, in their order. Empty of a job that was cancelled.
Landed landedPhotons(const World& world, const Settings& settings, const Lamps* lamps,
                     const std::vector<Target>& targets, bool onlyCaustics, int photons, Job& job, int pass) {
  constexpr std::int64_t kChunk = 4096;
  struct Chunk {
    const Source& source;
    std::int64_t first, end;
    Landed landed{};
  };
  std::vector<Chunk> chunks;
  const std::vector<Source> sources = sourcesOf(world, lamps, targets, photons);
  for (const Source& source : sources)
    for (std::int64_t n = 0; n < source.count; n += kChunk)
      chunks.push_back({source, n, std::min(n + kChunk, source.count)});
  Work work("sending photons", std::ssize(chunks));
  std::atomic<std::int64_t> sent{0};
  parallelChunks(std::ssize(chunks), settings.threads, job, [&](std::int64_t i, int) {
    Chunk& chunk = chunks[static_cast<std::size_t>(i)];
    Emitter emitter(world, settings, lamps, targets, onlyCaustics, pass);
    for (std::int64_t n = chunk.first; n < chunk.end; ++n)
      emitter.send(chunk.source, static_cast<std::uint32_t>(n), chunk.landed);
    work.reached(++sent);
  });
  job.done = 0;  // what comes next counts anew
  Landed all;
  if (job.cancel) return all;
  for (const auto& [source, first, end, landed] : chunks) {
    all.photons.insert(all.photons.end(), landed.photons.begin(), landed.photons.end());
    all.onMaps.insert(all.onMaps.end(), landed.onMaps.begin(), landed.onMaps.end());
  }
  return all;
}

/// Of photons by which whole pictures are made (Jensen 2001, section 7.3: the sphere compressed to a disk).
constexpr Real kFlatness = 10;

/// Of the estimates of a pass; the fewest that an unbiased estimate takes are 2.
std::size_t nearestOfPass(int pass) {
  constexpr std::size_t kFewest = 2;
  const Real count = areaOfPass(pass) * static_cast<Real>(PhotonMap::kNearest);
  return std::max(kFewest, static_cast<std::size_t>(count + 0.5));
}

GatheredCaustics gathered(const World& world, const Settings& settings, const Lamps* lamps, Job& job,
                          int pass) {
  const std::vector<Target> targets = targetsOf(world);
  const int photons = settings.caustics > 0 || !lamps ? settings.caustics : settings.photons;
  if (photons == 0 || targets.empty()) return {};
  constexpr Real kReach = 0.02;  // of the scene's size
  const Real widest =
      settings.causticRadius > 0 ? settings.causticRadius : kReach * length(world.bounds().size());
  const Real reach = widest * std::sqrt(areaOfPass(pass));
  Landed landed = landedPhotons(world, settings, lamps, targets, true, photons, job, pass);
  IlluminationMap texels(settings.causticTexels);
  for (const auto& [place, power] : landed.onMaps) texels.add(place, power);
  return {{std::move(landed.photons), reach, lamps ? kFlatness : 1, nearestOfPass(pass)}, std::move(texels)};
}

}  // namespace

Real areaOfPass(int pass) {
  constexpr Real kAlpha = 2.0 / 3;
  Real area = 1;
  for (int n = 1; n <= pass; ++n) area *= (n + kAlpha) / (n + 1);
  return area;
}

GatheredCaustics gatheredCaustics(const World& world, const Settings& settings, const Lamps* lamps,
                                  Job& job) {
  return gathered(world, settings, lamps, job, 0);
}

PhotonMap causticMap(const World& world, const Settings& settings, const Lamps* lamps, Job& job, int pass) {
  return gathered(world, settings, lamps, job, pass).photons;
}

PhotonMap globalMap(const World& world, const Settings& settings, const Lamps& lamps, Job& job, int pass) {
  const Box3& box = world.bounds();
  if (settings.photons == 0 || box.empty()) return {};
  const std::vector<Target> everything{{box.center(), length(box.size()) / 2}};
  constexpr Real kReach = 0.1;  // of the scene's size
  return {landedPhotons(world, settings, &lamps, everything, false, settings.photons, job, pass).photons,
          kReach * length(box.size()) * std::sqrt(areaOfPass(pass)), kFlatness, nearestOfPass(pass)};
}

}  // namespace trace
