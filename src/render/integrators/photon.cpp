#include "render/integrators/photon.h"

#include <algorithm>
#include <cmath>

#include "render/photons/photons.h"

namespace trace {

void PhotonTracer::prepare(const World& world, const Settings& settings, Job& job) {
  PathTracer::prepare(world, settings, job);
  mostScattered_ = 1;
  terminator_ = this;
  gathers_ = gathersFinally(settings);
  const int passes = std::min(settings.photonPasses, samplesOf(settings));
  maps_.resize(static_cast<std::size_t>(passes));
  Work work("sending photons", passes);
  for (int pass = 0; pass < passes && !job.cancel; ++pass) {
    Maps& maps = maps_[static_cast<std::size_t>(pass)];
    maps.caustics = causticMap(world, settings, &lamps_, job, pass);
    if (job.cancel) return;
    GlobalMaps all = globalMaps(world, settings, lamps_, job, pass);
    maps.all = std::move(all.surfaces);
    maps.media = std::move(all.media);
    work.reached(pass + 1);
  }
  if (settings.irradianceCache > 0) fillCache(world, settings, job);
}

Terminator::Told PhotonTracer::begin(int sample) const {
  return {.maps = static_cast<std::size_t>(sample) % maps_.size()};
}

bool PhotonTracer::knowsEmitter(const Told& told, RayKind kind) const {
  return told.bounced && kind != RayKind::bounce && !maps_[told.maps].caustics.empty();
}

Terminator::Left PhotonTracer::addLight(Gather& sum, const Interaction& at, const Told& told, RayKind kind,
                                        const Sampler& numbers) const {
  const Maps& maps = maps_[told.maps];
  const bool scattered = scatters(at.bsdf()), glossy = isGlossy(at.bsdf());
  const auto isWhole = [&](Real radius) { return at.hasDisk(radius, numbers.branch(Branch::photonDisk)); };
  // A gathering ray may end nearer than the photons lie of which the estimate would be made: they might be
  // behind the wall that it comes from. Then the place looks around by itself (Jensen 2001); and where they
  // lie beyond an edge, too.
  bool gathers = told.gathers;
  if (gathers && scattered) {
    const PhotonMap::Near near = at.photonsOf(maps.all);
    gathers = (kind != RayKind::bounce || !(at.hit.t * at.hit.t < near.radius2)) &&
              isWhole(std::sqrt(near.radius2));
    if (gathers) at.addPhotons(sum, Term::Kind::photons, near, true);
  }
  const bool toldHere = told.all && !(at.hit.t < told.apart && at.sendsEvenly());
  const bool asks = !gathers && !toldHere;
  if (asks) {
    if (!at.tracer.world().lights().empty()) at.addLights(sum, numbers);
    at.addCaustics(sum, maps.caustics, numbers.branch(Branch::caustics));
  }
  // The photon map gives the scattered light. Not where a part of the disk on which they lie is beyond an
  // edge, or below what stands there: from there the path continues. So it does to surfaces that are near
  // compared with the disk, whose light changes within it, except for what their mirrors and lobes throw.
  constexpr Real kApart = 4;  // radii of the disk: then light of a small source is blurred by 4 % at most
  bool tells = asks && !gathers_ && !glossy && scattered;
  Real apart = 0;
  if (tells) {
    const PhotonMap::Near near = at.photonsOf(maps.all);
    const Real radius = std::sqrt(near.radius2);
    tells = isWhole(radius);
    apart = kApart * radius;
    if (tells) at.addPhotons(sum, Term::Kind::photons, near, true, 1, apart);
  }
  const bool cached = !told.gathers && addCached(sum, at), brought = !maps.caustics.empty();
  return {.lamps = asks,
          .lobe = asks && !cached,
          .body = !told.all,
          .bounced = !(toldHere && brought),
          .sent = !(told.all && brought),
          .here = {.maps = told.maps, .gathers = gathers},
          .next = {.maps = told.maps,
                   .gathers = told.gathers || (gathers_ && !glossy),
                   .all = toldHere || tells,
                   .apart = tells ? apart : 0,
                   .bounced = true}};
}

void PhotonTracer::addInMedium(Gather& sum, const ScatterPlace& at, const Told& told,
                               const Sampler& numbers) const {
  addPhotonsAt(sum, at, maps_[told.maps].media, numbers.branch(Branch::photonDisk));
}

}  // namespace trace
