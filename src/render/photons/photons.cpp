#include "render/photons/photons.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "image/srgb.h"
#include "math/elementary.h"
#include "render/photons/photon_emitter.h"

namespace trace {
namespace {

/// As many of that many photons as are emitted.
int emitted(int photons, const Settings& settings) {
  return static_cast<int>(std::ceil(photons * settings.photonShare));
}

/// All that sends photons to the targets, each with its part of them: by what it sends, and some in any case,
/// for a light may shine past the middle of a target.
std::vector<PhotonSource> sourcesOf(const World& world, const Lamps* lamps,
                                    const std::vector<PhotonTarget>& targets, std::int64_t photons) {
  std::vector<PhotonSource> sources;
  Real most = 0, sum = 0;
  const auto add = [&](PhotonSource::Kind kind, std::size_t light, Real power) {
    constexpr Real kMost = 1e200;  // so that sums stay numbers, however strong the lights are
    power = std::clamp(power, 0.0, kMost);
    sources.push_back({kind, light, power > 0 ? power : 0});
    most = std::max(most, sources.back().power);
  };
  // In parts of pi squared.
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    Real power = 0;
    for (const PhotonTarget& t : targets)
      if (const auto arriving = world.illuminate(i, t.center))
        power += luminanceOf(arriving->intensity()) * t.radius * t.radius;
    add(PhotonSource::Kind::light, i, power);
  }
  if (lamps && lamps->power() > 0) add(PhotonSource::Kind::lamps, 0, lamps->power() / (kPi * kPi));
  if (lamps && world.outside().isSeenBy(RayKind::bounce)) {
    constexpr std::uint32_t kLooks = 1024;
    Real power = 0;
    for (std::uint32_t n = 0; n < kLooks; ++n) {
      const auto sky = lamps->startOfSky(sobolPoint(n, 0));
      const Color light = world.outside().view({{}, sky.toLight}, RayKind::bounce).color;
      if (sky.density > 0) power += luminanceOf(light) / (sky.density * kLooks * kPi);
    }
    Real disks = 0;
    for (const PhotonTarget& t : targets) disks += t.radius * t.radius;
    add(PhotonSource::Kind::sky, 0, power * disks);
  }
  constexpr Real kLeast = 0.02;  // relative to the strongest one
  for (PhotonSource& s : sources) sum += s.power = std::max(s.power, most > 0 ? kLeast * most : 1);
  for (PhotonSource& s : sources)
    s.count =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<Real>(photons) * s.power / sum));
  return sources;
}

/// Sends photons; what landed, in their order. Empty of a job that was cancelled.
LandedPhotons landedPhotons(const World& world, const Settings& settings, const Lamps* lamps,
                            const std::vector<PhotonTarget>& targets, Kept kept, int texels, int photons,
                            Job& job, int pass) {
  constexpr std::int64_t kChunk = 4096;
  struct Chunk {
    const PhotonSource& source;
    std::int64_t first, end;
    LandedPhotons landed{};
  };
  std::vector<Chunk> chunks;
  const std::vector<PhotonSource> sources = sourcesOf(world, lamps, targets, photons);
  for (const PhotonSource& source : sources)
    for (std::int64_t n = 0; n < source.count; n += kChunk)
      chunks.push_back({source, n, std::min(n + kChunk, source.count)});
  Work work("sending photons", std::ssize(chunks));
  std::atomic<std::int64_t> sent{0};
  parallelChunks(std::ssize(chunks), settings.threads, job, [&](std::int64_t i, int) {
    Chunk& chunk = chunks[static_cast<std::size_t>(i)];
    PhotonEmitter emitter(world, settings, lamps, targets, kept, texels, pass);
    for (std::int64_t n = chunk.first; n < chunk.end; ++n)
      emitter.send(chunk.source, static_cast<std::uint32_t>(n), chunk.landed);
    work.reached(++sent);
  });
  job.done = 0;  // what comes next counts anew
  LandedPhotons all;
  if (job.cancel) return all;
  for (const auto& [source, first, end, landed] : chunks) {
    all.photons.insert(all.photons.end(), landed.photons.begin(), landed.photons.end());
    all.inMedia.insert(all.inMedia.end(), landed.inMedia.begin(), landed.inMedia.end());
    all.onMaps.insert(all.onMaps.end(), landed.onMaps.begin(), landed.onMaps.end());
  }
  return all;
}

/// How flat the region of an estimate is where whole pictures are made of photons (Jensen 2001, section 7.3:
/// the sphere compressed to a disk).
constexpr Real kFlatness = 10;

/// How many photons the estimates of a pass take; the fewest that an unbiased estimate takes are 2.
std::size_t nearestOfPass(int pass) {
  constexpr std::size_t kFewest = 2;
  const Real count = areaOfPass(pass) * static_cast<Real>(PhotonMap::kNearest);
  return std::max(kFewest, static_cast<std::size_t>(count + 0.5));
}

/// From how far away photons count by default: by the scene's size, but of a glass on a wide floor by
/// that of the glass.
Real causticReach(const World& world, const std::vector<PhotonTarget>& targets) {
  constexpr Real kOfScene = 0.02, kOfTargets = 0.1;
  Box3 around;
  for (const PhotonTarget& t : targets) {
    around.extend(t.center - Vec3(t.radius, t.radius, t.radius));
    around.extend(t.center + Vec3(t.radius, t.radius, t.radius));
  }
  return std::min(kOfScene * length(world.bounds().size()), kOfTargets * length(around.size()));
}

GatheredCaustics gathered(const World& world, const Settings& settings, const Lamps* lamps, int side,
                          Job& job, int pass) {
  const std::vector<PhotonTarget> targets = photonTargetsOf(world, settings, lamps);
  const int photons =
      emitted(settings.caustics > 0 || !lamps ? settings.caustics : settings.photons, settings);
  if (photons == 0 || targets.empty()) return {};
  const Real widest = settings.causticRadius > 0 ? settings.causticRadius : causticReach(world, targets);
  const Real reach = widest * std::sqrt(areaOfPass(pass));
  LandedPhotons landed =
      landedPhotons(world, settings, lamps, targets, Kept::caustics, side, photons, job, pass);
  IlluminationMap texels(side);
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
  return gathered(world, settings, lamps, settings.causticTexels, job, 0);
}

PhotonMap causticMap(const World& world, const Settings& settings, const Lamps* lamps, Job& job, int pass) {
  return gathered(world, settings, lamps, 0, job, pass).photons;
}

GlobalMaps globalMaps(const World& world, const Settings& settings, const Lamps& lamps, Job& job, int pass) {
  const Box3& box = world.bounds();
  if (settings.photons == 0 || box.empty()) return {};
  const std::vector<PhotonTarget> everything{{box.center(), length(box.size()) / 2}};
  constexpr Real kReach = 0.1;  // relative to the scene's size
  const Real reach = kReach * length(box.size()), area = areaOfPass(pass);
  LandedPhotons landed = landedPhotons(world, settings, &lamps, everything,
                                       gathersFinally(settings) ? Kept::all : Kept::scattered, 0,
                                       emitted(settings.photons, settings), job, pass);
  return {{std::move(landed.photons), reach * std::sqrt(area), kFlatness, nearestOfPass(pass)},
          {std::move(landed.inMedia), reach * math::cbrt(area), 1, nearestOfPass(pass)}};
}

}  // namespace trace
