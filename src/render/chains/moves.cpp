// Bidirectional mutations.
#include "render/chains/moves.h"

#include <algorithm>
#include <cmath>

#include "math/noise.h"
#include "render/lights/parallel_light.h"
#include "shading/scattering.h"

namespace trace::veach {

Real Numbers::next() { return even_ > 0 ? evenPair().x : unitFromBits(state_ = mixBits(state_)); }
Vec2 Numbers::next2() {
  if (even_ > 0) return evenPair();
  const Real x = next();
  return {x, next()};
}

// --- which places are taken out, and how many are put in --------------------------------------------------

namespace {

/// 1/2 to that power.
Real halved(std::size_t times) {
  return times < 60 ? 1 / static_cast<Real>(std::uint64_t{1} << times) : 0x1p-60;
}

/// How likely so many places in a row are taken out, of all `places` except for one: a single one more often
/// than others, none to put some in (Veach's p_d).
Real takenOut(std::size_t n, std::size_t places) {
  const Real all = 1.25 - halved(places - 1);  // 1/4 + 1/2 + 1/4 + 1/8 ...
  return (n == 0 ? 0.25 : halved(n)) / all;
}

/// Where they may begin. The lens and the emitter stay unless others are put in.
std::size_t positions(std::size_t n, std::size_t places) { return n == 0 ? places - 1 : places - n + 1; }

}  // namespace

Kept Moves::choose(std::size_t places) {
  Real rest = numbers_.next();
  std::size_t n = 0;
  while (n + 1 < places && rest >= takenOut(n, places)) rest -= takenOut(n++, places);
  const std::size_t count = positions(n, places);
  const auto first =
      std::min(static_cast<std::size_t>(numbers_.next() * static_cast<Real>(count)), count - 1);
  const std::size_t atLens = first + (n == 0 ? 1 : 0);
  return {atLens, places - n - atLens};
}

Real Moves::chance(const Kept& kept, std::size_t places) const {
  const std::size_t n = places - kept.atLens - kept.atLight;
  return takenOut(n, places) / static_cast<Real>(positions(n, places));
}

/// How many places the new path may have, and how likely: about as many as before (Veach's p_a), few if
/// nothing is kept.
struct Moves::Lengths {
  std::size_t least, most, before;
  bool fromNothing;
  std::size_t kept;

  Real weight(std::size_t places) const {
    if (places < least || places > most) return 0;
    if (fromNothing) return 1 / static_cast<Real>(places);
    if (places == before) return kept == before ? 0 : 0.5;  // all is kept: something has to be put in
    const std::size_t away = places > before ? places - before : before - places;
    return away == 1 ? 0.15 : 0.2 * halved(away);
  }
  Real all() const {
    Real sum = 0;
    for (std::size_t n = least; n <= most; ++n) sum += weight(n);
    return sum;
  }
  Real chance(std::size_t places) const {
    const Real one = weight(places);
    return one > 0 ? one / all() : 0;
  }
  std::size_t choose(Real u) const {
    Real rest = u * all();
    std::size_t places = least;
    while (places < most && rest >= weight(places)) rest -= weight(places++);
    return places;
  }
};

Moves::Lengths Moves::lengths(const Kept& kept, std::size_t before) const {
  const std::size_t all = kept.atLens + kept.atLight;
  const std::size_t least = all + (kept.atLens == 0) + (kept.atLight == 0);
  return {std::max<std::size_t>(2, least), static_cast<std::size_t>(stage_.mostPlaces), before, all == 0,
          all};
}

// --- the density of what is put in ------------------------------------------------------------------------

/// The sum over all numbers of places that may have been put in from the camera's side; the others came from
/// the light's.
Real Moves::density(Path& path, const Kept& kept, std::size_t placesBefore) const {
  const std::size_t places = path.nodes.size(), end = path.last();
  const Real length = lengths(kept, placesBefore).chance(places);
  if (!(length > 0)) return 0;
  const std::size_t added = places - kept.atLens - kept.atLight;
  const std::size_t first = kept.atLens == 0 ? 1 : 0;  // the lens is always the camera's
  const bool openEnd = kept.atLight == 0;
  Real eye = 1, sum = 0;
  for (std::size_t i = 0; i <= added; ++i) {
    const std::size_t last = kept.atLens + i - 1;  // last of the camera's side
    if (i > 0 && last > 0) eye *= path.nodes[last - 1].eye;
    if (i < first) continue;
    const std::size_t fromLight = added - i;
    if (openEnd && fromLight == 0) {
      if (path.end != Path::End::light) sum += eye;
      continue;
    }
    if (openEnd && fromLight == 1) {
      sum += eye * paths_.askDensity(path);
      continue;
    }
    const Real joins = path.joins(last);
    if (!(joins > 0 && eye > 0)) continue;
    Real light = openEnd ? paths_.startDensity(path) : 1;
    for (std::size_t m = openEnd ? end : places - kept.atLight; m > last + 1 && light > 0; --m)
      light *= paths_.lightDensity(path, m);
    sum += eye * light / joins;
  }
  return length * sum / static_cast<Real>(added + 1 - first);
}

Real Moves::anywhereDensity(Path& path) const { return density(path, {}, 0); }

// --- putting places in ------------------------------------------------------------------------------------

/// Places that a walk from the light has found, the last nearest to the camera.
struct Moves::Walk {
  struct Step {
    Target target;
    RayKind leaves = RayKind::bounce;  ///< how the path continues from there toward the light
  };
  std::vector<Step> steps{};
  std::unique_ptr<Vertex> at{};        ///< as the walk hit the last one
  RayKind fromKept = RayKind::bounce;  ///< how the path continues from the first place that is kept
};

/// One more place from the camera on, or an end.
bool Moves::step(Path& path) {
  const Vertex* at = path.nodes.back().vertex.get();
  if (!at) return paths_.follow(path, RayKind::camera);
  const auto next = at->onward.choose(numbers_.next(), lobeNumbers(lobes_));
  return next && paths_.follow(path, next->kind, next->direction);
}

/// So many more places from the camera on. At the end, if the path has to have one.
bool Moves::walkFromEye(Path& path, std::size_t places, bool toEnd) {
  for (std::size_t i = 0; i < places; ++i) {
    if (!step(path)) return false;
    if (path.end != Path::End::open) return toEnd && i + 1 == places;
  }
  return !toEnd || paths_.endAtLamp(path);
}

/// The end is asked for: an emissive object, the sky or a light of the scene.
bool Moves::askEnd(Path& path) {
  const Vertex* at = path.nodes.back().vertex.get();
  if (!at || !at->place.joins()) return false;
  if (const Real lamps = stage_.lampShare(); !(numbers_.next() < lamps)) {
    if (stage_.lights == 0) return false;
    const auto light = std::min(static_cast<std::size_t>(numbers_.next() * static_cast<Real>(stage_.lights)),
                                stage_.lights - 1);
    const Vec2 onLight = paths_.tracer.world().lightHasSize(light) ? numbers_.next2() : kCenter;
    return paths_.endAtLight(path, light, onLight);
  }
  const Real which = numbers_.next();
  const auto place = stage_.lamps.choose(at->place.point(), which, numbers_.next2());
  if (!place || !paths_.follow(path, RayKind::bounce, place->toLight)) return false;
  if (path.end == Path::End::sky) return place->distance == kInfinity;
  if (path.end != Path::End::open) return false;
  return stage_.lamps.met(*place, path.nodes.back().vertex->hit) && paths_.endAtLamp(path);
}

/// The walk continues from the place where it is, toward the camera.
bool Moves::goOn(Walk& walk, const Vertex& from, RayKind& leaves) {
  const auto next = from.onward.choose(numbers_.next(), lobeNumbers(lobes_), true);
  if (!next) return false;
  leaves = next->kind;
  const Ray ray =
      next->kind == RayKind::bounce ? from.at.leaveToLight(next->direction) : from.hit.leave(next->direction);
  Interfaces inside = next->in(from.at.inside);
  const auto hit = paths_.tracer.cast(ray, RayKind::light, inside);
  if (!hit) return false;
  walk.at = std::make_unique<Vertex>(paths_.tracer, ray, std::move(inside), *hit);
  walk.steps.push_back({targetOf(*hit)});
  return true;
}

/// So many places from the light on.
bool Moves::walkFromLight(Walk& walk, Path& from, const Kept& kept, std::size_t places) {
  if (places == 0) return true;
  std::size_t rest = places;
  const std::size_t first = from.nodes.size() - kept.atLight;  // that is kept
  if (kept.atLight > 1) {
    const Vertex* at = paths_.turned(from, first);
    if (!at || !goOn(walk, *at, walk.fromKept)) return false;
    --rest;
  } else {  // from the end
    Vec3 normal;
    std::optional<Hit> start;
    Interfaces inside;
    if (kept.atLight == 1) {
      if (from.end != Path::End::lamp) return false;
      const Vertex& end = from.vertex(first);
      start = end.hit;
      inside = end.inside;
      normal = dot(end.ray.direction, end.hit.surface.normal) < 0 ? end.hit.surface.normal
                                                                  : -end.hit.surface.normal;
    } else {
      const Real which = numbers_.next();
      const Vec2 place = numbers_.next2(), line = stage_.lamps.hasBodies() ? numbers_.next2() : Vec2{};
      const auto lamp = stage_.lamps.start(paths_.tracer.world(), which, place, line);
      if (!lamp) return false;
      normal = lamp->twoSided && numbers_.next() < 0.5 ? -lamp->normal : lamp->normal;
      start = Lamps::placeOf(paths_.tracer, *lamp, normal, RayKind::light);
      if (!start) return false;
      walk.steps.push_back({targetOf(*start)});
      --rest;
    }
    if (rest == 0) return true;
    const Ray ray = start->leave(Frame{normal}.basis().toWorld(cosineDirection(numbers_.next2())));
    if (kept.atLight == 0) inside = paths_.tracer.interfacesAt(ray.origin);
    const auto hit = paths_.tracer.cast(ray, RayKind::light, inside);
    if (!hit) return false;
    walk.at = std::make_unique<Vertex>(paths_.tracer, ray, std::move(inside), *hit);
    walk.steps.push_back({targetOf(*hit)});
    --rest;
  }
  for (; rest > 0; --rest) {
    const std::unique_ptr<Vertex> at = std::move(walk.at);
    if (!goOn(walk, *at, walk.steps[walk.steps.size() - 1].leaves)) return false;
  }
  return true;
}

/// The path continues over the places of the walk to those that are kept.
bool Moves::join(Path& path, const Walk& walk, const Path& from, const Kept& kept) {
  RayKind kind = path.nodes.back().vertex ? RayKind::bounce : RayKind::camera;
  for (std::size_t i = walk.steps.size(); i-- > 0; kind = walk.steps[i].leaves)
    if (!paths_.follow(path, kind, walk.steps[i].target)) return false;
  if (kept.atLight == 0) return paths_.endAtLamp(path);
  const std::size_t first = from.nodes.size() - kept.atLight;
  if (kind == RayKind::camera && !from.nodes[first].vertex) return false;
  return paths_.attach(path, kind, from, first, walk.fromKept);
}

Vec2 Moves::onFilm(const Vec2& u) const {
  return {stage_.low.x + u.x * (stage_.high.x - stage_.low.x),
          stage_.low.y + u.y * (stage_.high.y - stage_.low.y)};
}

/// A path of so many places, of which some are kept.
bool Moves::build(Path& path, Path& from, const Kept& kept, std::size_t places) {
  const std::size_t added = places - kept.atLens - kept.atLight, first = kept.atLens == 0 ? 1 : 0;
  const std::size_t ways = added + 1 - first;
  const std::size_t fromEye =
      first + std::min(static_cast<std::size_t>(numbers_.next() * static_cast<Real>(ways)), ways - 1);
  const std::size_t fromLight = added - fromEye;
  path.moment = from.moment;
  if (kept.atLens <= 1) {
    const Vec2 u = numbers_.next2(), lens = numbers_.next2();
    if (!paths_.begin(path, onFilm(u), kept.atLens == 0 ? lens : from.lens)) return false;
  } else {
    path.film = from.film;
    path.lens = from.lens;
    path.ray = from.ray;
    path.nodes.assign(from.nodes.begin(), from.nodes.begin() + static_cast<std::ptrdiff_t>(kept.atLens));
  }
  const bool openEnd = kept.atLight == 0;
  if (!walkFromEye(path, fromEye - first, openEnd && fromLight == 0)) return false;
  if (openEnd && fromLight == 0) return true;
  if (openEnd && fromLight == 1) return askEnd(path);
  Walk walk;
  return walkFromLight(walk, from, kept, fromLight) && join(path, walk, from, kept);
}

Path Moves::anywhere() {
  const std::size_t places = lengths({}, 0).choose(numbers_.next());
  Path none, path;
  if (!build(path, none, {}, places) || !paths_.weigh(path, 0, path.last())) path.brightness = 0;
  return path;
}

/// With which fromCamera() finds the path: its walk hits the emitter, or asks for it.
Real Moves::cameraDensity(const Path& path) const {
  const std::size_t end = path.last();
  Real eye = 1;
  for (std::size_t i = 0; i + 1 < end; ++i) eye *= path.nodes[i].eye;
  const Real met = path.end != Path::End::light ? eye * path.nodes[end - 1].eye : 0;
  return met + eye * paths_.askDensity(path);
}

Real Moves::anywhereShare(Path& path) const {
  const Real density = cameraDensity(path) + anywhereDensity(path);
  return path.brightness > 0 && density > 0 ? path.brightness / density : 0;
}

Real Moves::fromCamera() {
  Real sum = 0;
  // Adds what the path shows, of which all places before that one were weighed before.
  const auto show = [&](Path& whole, std::size_t first) {
    if (paths_.weigh(whole, first, whole.last())) sum += anywhereShare(whole);
  };
  Path path;
  const Vec2 u = numbers_.next2(), lens = numbers_.next2();
  if (!paths_.begin(path, onFilm(u), lens)) return 0;
  while (step(path)) {
    const std::size_t last = path.last();
    if (!paths_.weighPlace(path, last - 1)) break;
    if (path.end != Path::End::open) {
      show(path, last);
      break;
    }
    if (last > 1) paths_.lightDensity(path, last - 1);  // once for all paths that go by
    Path met = path, asks = path;
    if (paths_.endAtLamp(met)) show(met, last);
    if (askEnd(asks)) show(asks, last);
  }
  return sum;
}

Offer Moves::bidirectional(Path& from) {
  const std::size_t before = from.nodes.size();
  const Kept kept = choose(before);
  const Lengths lengths = this->lengths(kept, before);
  const std::size_t places = lengths.choose(numbers_.next());
  Offer offer;
  Path& path = offer.path;
  if (!(lengths.chance(places) > 0) || !build(path, from, kept, places)) return offer;
  const std::size_t last = std::min(path.last(), path.nodes.size() - kept.atLight);
  if (!paths_.weigh(path, kept.atLens == 0 ? 0 : kept.atLens - 1, last)) {
    path.brightness = 0;
    return offer;
  }
  const Real there = chance(kept, before) * density(path, kept, before);
  const Real back = chance(kept, path.nodes.size()) * density(from, kept, path.nodes.size());
  if (there > 0) offer.ratio = path.brightness * back / (from.brightness * there);
  return offer;
}

}  // namespace trace::veach
