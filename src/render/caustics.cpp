#include "render/caustics.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/budget.h"
#include "image/srgb.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/fog.h"
#include "render/interaction.h"
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
struct Start {
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
std::optional<Start> startFrom(const Vec3& place, const std::vector<Target>& targets, Real which,
                               const Vec2& u) {
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
  return Start{{place, direction}, 2 * kPi * all / static_cast<Real>(over)};
}

/// The same of parallel light: evenly over the disks that the targets cover.
std::optional<Start> startAlong(const Vec3& direction, const std::vector<Target>& targets, const Box3& scene,
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
  return Start{{place - direction * before, direction}, kPi * all / static_cast<Real>(over)};
}

/// The place of a light that two numbers choose, as its illuminate() does; nothing of parallel light.
std::optional<Vec3> placeOn(const Light& light, const Vec2& u) {
  return match(light, [&](const auto& l) -> std::optional<Vec3> {
    if constexpr (requires { l.twoSided; }) {
      const Vec2 disk = toDisk(u);
      const Vec2 at = l.round ? Vec2{disk.x / 2, disk.y / 2} : Vec2{u.x - 0.5, u.y - 0.5};
      return l.position + l.u * at.x + l.v * at.y;
    } else if constexpr (requires { l.position; }) {
      return l.position + sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y) * l.radius;
    } else {
      return {};
    }
  });
}

class Emitter {
 public:
  Emitter(const World& world, const Settings& settings, std::vector<Target> targets)
      : world_(world),
        settings_(settings),
        targets_(std::move(targets)),
        fog_(settings),
        tracer_(world, settings) {}

  /// Photon n of the light's `count`.
  void send(std::size_t light, std::uint32_t n, std::int64_t count, std::vector<Photon>& landed) {
    const auto seed = mixBits(static_cast<std::uint64_t>(settings_.seed) ^ mixBits(light + 1));
    const auto pair = [&](std::uint64_t dimension) { return sobolPoint(n, mixBits(seed ^ dimension)); };
    const Vec2 place = world_.lightHasSize(light) ? pair(1) : kCenter;
    const std::optional<Vec3> point = placeOn(world_.lights()[light], place);
    std::optional<Start> start;
    if (point) {
      start = startFrom(*point, targets_, pair(3).x, pair(2));
    } else if (const auto arriving = world_.illuminate(light, {}, place)) {
      start = startAlong(-arriving->toLight, targets_, world_.bounds(), pair(3).x, pair(2));
    }
    if (!start) return;
    std::uint64_t chances = mixBits(mixBits(seed ^ 4) ^ n);
    const auto next = [&] { return unitFromBits(chances = mixBits(chances)); };

    Ray ray = start->ray;
    Interfaces inside = tracer_.interfacesAt(ray.origin);
    std::optional<Hit> hit = tracer_.cast(ray, RayKind::bounce, inside);
    if (!hit) return;
    // What falls on a surface there that faces the light, over the solid angle or the area.
    const auto arriving = world_.illuminate(light, hit->surface.point, place);
    if (!arriving) return;
    const Real away2 = point ? hit->t * hit->t : 1;
    Color power = arriving->intensity() * (kPi * away2 * start->share / static_cast<Real>(count));
    for (int bounces = 0; hit && !isBlack(power); ++bounces) {
      const bool fromInfinity = bounces == 0 && !point;  // which loses nothing
      power *= inside.passed(hit->t);
      if (!fromInfinity && isInOpenAir(inside, world_)) power *= Color(fog_.passes(ray, hit->t));
      const Interaction at(tracer_, ray, *hit, nullptr, inside, next());
      const Vec3& normal = hit->surface.normal;
      if (bounces > 0 && scatters(at.bsdf()))
        landed.push_back({hit->surface.point, ray.direction, at.facing() > 0 ? normal : -normal, power});
      if (bounces >= settings_.depth) return;

      const auto shares = at.shares();
      const SpectralShare* share =
          shares.empty() ? nullptr
                         : &shares[static_cast<std::size_t>(next() * static_cast<Real>(shares.size()))];
      const Color mirror = at.mirror(false);
      const Color through =
          share ? at.filter(*share) * share->weight * static_cast<Real>(shares.size()) : Color(0);
      // One ray goes on, or none: what it brings stays about the same.
      const Real mirrors = maxComponent(mirror), passes = maxComponent(through);
      const Real all = std::max(1.0, mirrors + passes), choice = next() * all;
      Interfaces there = inside;
      if (choice < mirrors) {
        power *= mirror * (all / mirrors);
        ray = hit->leave(mirrored(ray.direction, at.normal));
      } else if (choice < mirrors + passes) {
        const auto direction = at.through(*share);
        if (!direction) return;
        power *= through * (all / passes);
        there = at.behind();
        there.wavelength = share->nanometres;
        ray = hit->leave(*direction);
      } else {
        return;
      }
      inside = there;
      hit = tracer_.cast(ray, RayKind::bounce, inside);
    }
  }

 private:
  const World& world_;
  const Settings& settings_;
  std::vector<Target> targets_;
  Fog fog_;
  Tracer tracer_;
};

/// How many photons each light sends: by what it brings to the targets, and some in any case, for a light may
/// shine past the middle of a target.
std::vector<std::int64_t> shares(const World& world, const std::vector<Target>& targets,
                                 std::int64_t photons) {
  std::vector<Real> powers;
  Real sum = 0, most = 0;
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    Real power = 0;
    for (const Target& t : targets)
      if (const auto arriving = world.illuminate(i, t.center))
        power += luminanceOf(arriving->intensity()) * t.radius * t.radius;
    powers.push_back(power);
    most = std::max(most, power);
  }
  constexpr Real kLeast = 0.02;  // of the strongest one
  for (Real& power : powers) sum += power = std::max(power, most > 0 ? kLeast * most : 1);
  std::vector<std::int64_t> counts;
  for (const Real power : powers)
    counts.push_back(
        std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<Real>(photons) * power / sum)));
  return counts;
}

}  // namespace

PhotonMap causticMap(const World& world, const Settings& settings, Job& job) {
  std::vector<Target> targets = targetsOf(world);
  if (settings.caustics == 0 || targets.empty() || world.lights().empty()) return {};
  constexpr std::int64_t kChunk = 4096;
  struct Chunk {
    std::size_t light;
    std::int64_t first, end, count;
    std::vector<Photon> landed{};
  };
  std::vector<Chunk> chunks;
  const std::vector<std::int64_t> counts = shares(world, targets, settings.caustics);
  for (std::size_t light = 0; light < counts.size(); ++light)
    for (std::int64_t n = 0; n < counts[light]; n += kChunk)
      chunks.push_back({light, n, std::min(n + kChunk, counts[light]), counts[light]});
  Work work("sending photons", std::ssize(chunks));
  std::atomic<std::int64_t> sent{0};
  parallelChunks(std::ssize(chunks), settings.threads, job, [&](std::int64_t i, int) {
    Chunk& chunk = chunks[static_cast<std::size_t>(i)];
    Emitter emitter(world, settings, targets);
    for (std::int64_t n = chunk.first; n < chunk.end; ++n)
      emitter.send(chunk.light, static_cast<std::uint32_t>(n), chunk.count, chunk.landed);
    work.reached(++sent);
  });
  job.done = 0;  // what comes next counts anew
  if (job.cancel) return {};
  std::vector<Photon> all;
  for (const Chunk& chunk : chunks) all.insert(all.end(), chunk.landed.begin(), chunk.landed.end());
  constexpr Real kReach = 0.02;  // of the scene's size
  const Real reach =
      settings.causticRadius > 0 ? settings.causticRadius : kReach * length(world.bounds().size());
  return {std::move(all), reach};
}

}  // namespace trace
