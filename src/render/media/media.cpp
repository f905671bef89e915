#include "render/media/media.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/elementary.h"
#include "math/low_discrepancy.h"
#include "render/lights/light_choice.h"
#include "render/rays/fog.h"

namespace trace {
namespace {

/// A medium begins or ends there.
struct Border {
  Real t;
  const World::MediumBody* body;  ///< null where the fog scatters
  bool begins;
  Real arrives = 0;  ///< light that arrives in the fog, per scattering
};

/// The stretch of the ray's line that may lie in the box: from first to second, if that is not less.
std::pair<Real, Real> stretchIn(const Box3& box, const Ray& ray) {
  Real near = -kInfinity, far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const Real slope = 1 / ray.direction[axis];
    if (!std::isfinite(slope)) {  // it runs along the faces, or on one
      if (ray.origin[axis] < box.low[axis] || ray.origin[axis] > box.high[axis])
        return {kInfinity, -kInfinity};
      continue;
    }
    const Real a = (box.low[axis] - ray.origin[axis]) * slope,
               b = (box.high[axis] - ray.origin[axis]) * slope;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return {near, far};
}

/// The body's stretches of the ray up to t. `whole`: all of it lies in the body.
void addBorders(std::vector<Border>& borders, Tracer& tracer, const World::MediumBody& body, const Ray& ray,
                Real t, bool whole) {
  if (whole) {
    borders.push_back({0, &body, true});
    return;
  }
  // Crossings on the whole ray tell whether it starts inside. A box that it misses saves asking.
  if (ray.leaves == body.object) return;
  const auto [near, far] = stretchIn(body.bounds, ray);
  if (near > far || near > t || far < 0) return;
  struct At {
    Real t;
    std::uint64_t part;
  };
  std::vector<At> crossed;
  tracer.world().crossingsOf(body.object, ray, kInfinity, tracer.statistics(), [&](const Found& found) {
    crossed.push_back({found.t, found.part});
    return false;
  });
  std::sort(crossed.begin(), crossed.end(),
            [](const At& a, const At& b) { return a.t != b.t ? a.t < b.t : a.part < b.part; });
  crossed.erase(std::unique(crossed.begin(), crossed.end(),
                            [](const At& a, const At& b) { return a.t == b.t && a.part == b.part; }),
                crossed.end());
  bool inside = crossed.size() % 2 == 1;
  if (inside) borders.push_back({0, &body, true});
  for (const At& at : crossed) {
    if (at.t >= t) break;
    inside = !inside;
    borders.push_back({at.t, &body, inside});
  }
}

Real mean(const Color& c) { return (c.r + c.g + c.b) / 3; }
Color less(const Color& c) { return {math::exp(-c.r), math::exp(-c.g), math::exp(-c.b)}; }

/// Walks along a ray from stretch to stretch.
class Walk {
 public:
  Walk(Tracer& tracer, const Ray& ray, const Color& importance, int draws, Sampler& numbers)
      : tracer_(tracer),
        ray_(ray),
        fog_(tracer.settings()),
        importance_(importance),
        wantsPlaces_(draws > 0),
        draws_(std::max(1, draws)),
        leastSteps_(kLeastSteps + 3 * draws),
        numbers_(numbers) {}

  void begin(const World::MediumBody* body) { active_.push_back(body); }
  void end(const World::MediumBody* body) {
    const auto found = std::find(active_.begin(), active_.end(), body);
    if (found != active_.end()) active_.erase(found);
  }
  void go(Real from, Real to) {
    if (active_.empty() || !(to > from) || isBlack(passes)) return;
    const bool uniform = std::all_of(active_.begin(), active_.end(),
                                     [](const World::MediumBody* body) { return body->model.uniform(); });
    uniform ? byLaw(from, to) : byChance(from, to);
  }
  void add(Real t, const Color& weight, Real forward, std::uint32_t object, const Color& arrives) {
    if (wantsPlaces_ && !isBlack(weight)) places.push_back({t, weight, forward, object, arrives});
  }
  /// In fog before the bodies.
  bool foggy = false;

  Color passes{1}, glows;
  std::vector<MediumWay::Place> places;

 private:
  static constexpr int kLeastSteps = 6;
  Real fogPasses(Real t) const { return foggy ? fog_.passes(ray_, t) : 1; }

  Medium total(const Vec3* point) {
    Medium sum;
    Real all = 0;
    for (const World::MediumBody* body : active_) {
      const Medium m = point ? tracer_.world().mediumAt(*body, *point) : body->model.most();
      sum.scatters += m.scatters;
      sum.absorbs += m.absorbs;
      sum.glows += m.glows;
      // One of several that scatter is chosen, to say which way.
      const Real part = mean(m.scatters);
      all += part;
      if (part > 0 && (part == all || numbers_.next() * all < part)) {
        sum.forward = m.forward;
        object_ = body->object;
      }
    }
    return sum;
  }

  void byLaw(Real from, Real to) {
    const Medium medium = total(nullptr);
    const Color loses = medium.loses();
    const Real length = to - from;
    const auto sent = [&](Real s) { return s > 0 ? -math::expm1(-s * length) / s : length; };
    if (!foggy) glows += passes * medium.glows * Color(sent(loses.r), sent(loses.g), sent(loses.b));
    const bool asks = wantsPlaces_ && !isBlack(medium.scatters);
    if (asks || (foggy && !isBlack(medium.glows))) {
      const Color counts = importance_ * passes;
      const Real all = counts.r + counts.g + counts.b;
      for (int k = 0; k < draws_; ++k) {  // each in a part of its own of what is scattered
        const Real which = numbers_.next() * all, u = (k + numbers_.next()) / draws_;
        const Real of = which < counts.r ? loses.r : which < counts.r + counts.g ? loses.g : loses.b;
        const Real gone = -math::expm1(-of * length);
        const Real x = std::min(length, of * length > 1e-9 ? -math::log1p(-u * gone) / of : u * length);
        const auto density = [&](Real s) {
          return s * length > 1e-9 ? s * math::exp(-s * x) / -math::expm1(-s * length) : 1 / length;
        };
        const Real chosen =
            (counts.r * density(loses.r) + counts.g * density(loses.g) + counts.b * density(loses.b)) / all;
        const Color arrives = passes * less(loses * x) * (fogPasses(from + x) / (chosen * draws_));
        if (foggy) glows += arrives * medium.glows;
        if (asks) add(from + x, arrives * medium.scatters, medium.forward, object_, arrives);
      }
    }
    passes *= less(loses * length);
  }

  void byChance(Real from, Real to) {
    Color most;
    for (const World::MediumBody* body : active_) most += body->model.most().loses();
    const Real rate = std::max(maxComponent(most), leastSteps_ / (to - from));
    for (Real t = from;;) {
      checkBudget();
      t += -math::log1p(-numbers_.next()) / rate;
      if (!(t < to)) return;
      const Vec3 point = ray_.at(t);
      const Medium medium = total(&point);
      const Color loses = medium.loses();
      if (isBlack(loses) && isBlack(medium.glows)) continue;
      const Color arrives = passes * (fogPasses(t) / rate);
      glows += arrives * medium.glows;
      add(t, arrives * medium.scatters, medium.forward, object_, arrives);
      passes *= Color(1) + loses * (-1 / rate);
      // A path with hardly any throughput ends at random, or continues with more weight.
      constexpr Real kLittle = 0.05, kGoesOn = 0.5;
      if (maxComponent(passes) < kLittle) {
        if (!(numbers_.next() < kGoesOn)) passes = Color(0);
        passes = passes / kGoesOn;
      }
      if (isBlack(passes)) return;
    }
  }

  Tracer& tracer_;
  const Ray& ray_;
  Fog fog_;
  Color importance_;
  bool wantsPlaces_;
  int draws_;        ///< places of a stretch that Beer's law tells, from which some are chosen
  Real leastSteps_;  ///< least steps of a stretch that is divided at random: more of them are less noise
  Sampler& numbers_;
  std::vector<const World::MediumBody*> active_;
  std::uint32_t object_ = Filling::kAir;
};

/// The scattering of the fog at its border.
struct FogPlace {
  Color weight{};  ///< without what bodies let pass
  Real forward = 0;
};

void follow(Walk& walk, std::vector<Border>& borders, Real t, const FogPlace& fog) {
  std::stable_sort(borders.begin(), borders.end(),
                   [](const Border& a, const Border& b) { return a.t < b.t; });
  Real from = 0;
  for (const Border& border : borders) {
    walk.go(from, border.t);
    from = border.t;
    if (!border.body)
      walk.add(border.t, walk.passes * fog.weight, fog.forward, Filling::kAir, walk.passes * border.arrives);
    else
      border.begins ? walk.begin(border.body) : walk.end(border.body);
  }
  walk.go(from, t);
}

/// So many of the places, each as often as it weighs.
std::vector<MediumWay::Place> chosen(const std::vector<MediumWay::Place>& places, int count,
                                     const Color& importance, Sampler& numbers) {
  std::vector<MediumWay::Place> few;
  Real all = 0;
  for (const MediumWay::Place& place : places) all += mean(place.weight * importance);
  if (!(all > 0)) return few;
  const Real step = all / count;
  Real sum = 0;
  std::size_t next = 0;
  for (int k = 0; k < count; ++k) {
    const Real goal = (k + numbers.next()) * step;
    while (next + 1 < places.size() && sum + mean(places[next].weight * importance) <= goal)
      sum += mean(places[next++].weight * importance);
    const Real own = mean(places[next].weight * importance);
    if (!(own > 0)) continue;
    few.push_back(places[next]);
    few.back().weight = few.back().weight * (step / own);
    few.back().arrives = few.back().arrives * (step / own);
  }
  return few;
}

}  // namespace

MediumWay throughMedia(Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside, int places,
                       const Color& importance, Sampler numbers, bool withFog) {
  MediumWay way;
  const World& world = tracer.world();
  const Settings& settings = tracer.settings();
  const bool open = isInOpenAir(inside, world);
  const std::uint32_t around = inside.around().object;
  std::vector<Border> borders;
  for (const World::MediumBody& body : world.media()) {
    if (body.cloud ? !open : body.object != around) continue;
    addBorders(borders, tracer, body, ray, t, !body.cloud);
  }
  const Fog fog(settings);
  const bool foggy = withFog && open && !fog.none();
  if (borders.empty() && !foggy) return way;
  Walk walk(tracer, ray, importance, places, numbers);
  walk.foggy = foggy;
  FogPlace ofFog;
  if (foggy && places > 0) {
    const Real stays = -math::expm1(-fog.depth(ray, t));
    ofFog = {settings.fogColor * (stays / places), fog.forward()};
    for (int k = 0; k < places; ++k) {
      const Real u = (k + numbers.next()) / places;
      const Real at = stays > 0 ? fog.distance(ray, -math::log1p(-stays * u)) : kInfinity;
      if (isFinite(ray.at(at)) && at <= t)
        borders.push_back({at, nullptr, true, stays / (fog.densityAt(ray.at(at)) * places)});
    }
  }
  follow(walk, borders, t, ofFog);
  way.passes = foggy ? walk.passes * fog.passes(ray, t) : walk.passes;
  way.glows = walk.glows;
  if (places > 0) way.places = chosen(walk.places, places, importance, numbers);
  return way;
}

std::optional<MediumWay::Place> placeByChance(MediumWay& way, const Color& weight, Real chance) {
  if (way.places.empty()) return {};
  const auto counts = [&](const Color& factor) {
    const Color c = weight * factor;
    return c.r + c.g + c.b;
  };
  MediumWay::Place place = way.places.front();
  const Real scatters = counts(place.weight), all = scatters + counts(way.passes);
  if (!(all > 0)) return {};
  const Real share = scatters / all;
  if (chance < share) {
    place.weight = place.weight / share;
    return place;
  }
  way.passes = way.passes / (1 - share);
  return {};
}

PhaseSample samplePhase(const Vec3& along, Real forward, const Vec2& u) {
  const Real cosine = phaseCosine(forward, u.x);
  const Basis basis = Frame{along}.basis();
  return {basis.toWorld(sphericalDirection(cosine, 2 * kPi * u.y)), phase(forward, cosine)};
}

void coverWithMedia(Gather& sum, const MediumWay& way) {
  if (!(way.passes == Color(1))) sum.dim(way.passes, {MediumTerm::What::covers, Filling::kAir, 0, 0});
  if (!isBlack(way.glows))
    sum.add(Color(1), way.glows, MediumTerm{MediumTerm::What::glows, Filling::kAir, 0, 0});
}

Color passedByBodies(Tracer& tracer, const Ray& ray, Real distance, Sampler numbers, std::uint32_t* first) {
  std::vector<Border> borders;
  for (const World::MediumBody& body : tracer.world().media())
    addBorders(borders, tracer, body, ray, distance, false);
  if (borders.empty()) return Color(1);
  if (first) *first = borders.front().body->object;
  Walk walk(tracer, ray, Color(1), 0, numbers);
  follow(walk, borders, distance, {});
  return walk.passes;
}

Color throughBodies(Tracer& tracer, const Color& passed, const Ray& toLight, Real distance, Sampler numbers) {
  if (tracer.world().media().empty() || isBlack(passed)) return passed;
  std::uint32_t first = 0;
  const Color passes = passedByBodies(tracer, toLight, distance, numbers, &first);
  return passes == Color(1) ? passed : tracer.veiled(passed, passes, first, distance);
}

namespace {

/// The share of the kernel of PhotonMap::Near::perVolume that lies in the medium of the place, where photons
/// are: up to surfaces and to where the body ends.
Real shareOfBall(Tracer& tracer, const ScatterPlace& place, Real radius, Sampler numbers) {
  constexpr std::uint32_t kLooks = 16;
  constexpr Real kLeast = 0.05;  // a share that is found smaller says little
  const World& world = tracer.world();
  const bool ends = !(tracer.settings().fog > 0);  // beyond the body there is no other medium
  const Vec2 first = numbers.next2();
  Real sum = 0;
  for (std::uint32_t n = 0; n < kLooks; ++n) {
    const Vec2 u = rotated(sobolPoint(n), first);
    const Ray ray{place.point(), sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y)};
    Real free = radius;
    world.crossings(ray, radius, Faces::both, tracer.statistics(), [&](const Found& found) {
      const bool leaves = ends && found.object == place.medium->object;
      if (found.t < free && (leaves || world.opacityAt(ray, found) > 0)) free = found.t;
      return false;
    });
    const Real x = free / radius, cube = x * x * x;
    sum += cube * (2.5 - 1.5 * x * x);
  }
  return std::max(kLeast, sum / kLooks);
}

}  // namespace

void addPhotonsAt(Gather& sum, const ScatterPlace& place, const PhotonMap& photons, const Sampler& numbers) {
  if (photons.empty()) return;
  const PhotonMap::Near near = photons.around(place.point());
  Color light;
  for (std::size_t i = 0; i < near.count; ++i) {
    const Photon& photon = *near.photons[i];
    const Real toEye = phase(place.forward, -dot(place.ray.direction, photon.direction));
    light += photon.power * (toEye * near.perVolume(i));
  }
  PhotonTerm counted{near.count, std::sqrt(near.radius2)};
  if (sum.tracer().records())
    for (std::size_t i = 0; i < near.count; ++i) counted.photons.push_back(*near.photons[i]);
  if (near.count == 0) return;
  const Real share = shareOfBall(sum.tracer(), place, counted.radius, numbers);
  sum.add(place.share, light * (1 / share), *place.medium, counted);
}

}  // namespace trace
