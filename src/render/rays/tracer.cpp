#include "render/rays/tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trace {

Faces Tracer::facesSeenBy(RayKind kind) const {
  const bool seen = kind != RayKind::refraction && kind != RayKind::light && kind != RayKind::shadow;
  if (settings_.backFaces == BackFaces::cullAll) return Faces::front;
  return settings_.backFaces == BackFaces::cullSeen && seen ? Faces::shadedFront : Faces::both;
}

Hit::Hit(const World& world, const Ray& ray, const Found& found)
    : t(found.t),
      object(found.object),
      part(found.part),
      surface(world.surface(ray, found)),
      materials(world.materialMix(found)),
      leaving(dot(ray.direction, surface.normal) > 0),
      twoSided(world.twoSided(object, materials)),
      convex(world.convex(object)),
      strands(world.strands(object)),
      solid(world.solid(object)) {
  world.pierce(*this);
  world.bump(ray, *this);
}

std::optional<Hit> Tracer::cast(const Ray& ray, RayKind kind, Interfaces& inside, Real chance,
                                const std::optional<std::uint32_t>& aim, const Found* first) {
  count(kind);
  if (records()) begin(ray, kind, kInfinity, inside.wavelength);
  std::optional<Found> found = !first                 ? world_.closest(ray, facesSeenBy(kind), statistics_)
                               : first->t < kInfinity ? std::optional(*first)
                                                      : std::nullopt;
  passedShadowless_ = false;
  if (aim) passedPanes_ = Color(1);
  const bool passes = aim && (world_.hasShadowless() || world_.hasPanes());
  if (found && (passes || inside.nested() || world_.hasHoles()))
    found = walk(ray, kind, *found, inside, chance, aim);
  if (!found || (kind == RayKind::camera && !world_.camera().sees(found->t))) {
    if (records()) {
      const CameraFrame& camera = world_.camera();
      const Real limit = found && found->t < camera.near ? camera.near : camera.far;
      RayNode& node = finish();
      node.ends.push_back(
          found ? RayEnd(CutOff{found->object, found->t, limit, sharesOf(world_.materialMix(*found))})
                : hiddenFrom(ray, kind));
      if (world_.outside().isSeenBy(kind)) node.outside = world_.outside().view(ray, kind);
    }
    return std::nullopt;
  }
  if (records()) {
    RayNode& node = finish();
    const Hit& hit = node.hit.emplace(world_, ray, *found);
    node.materials = sharesOf(hit.materials);
    node.bsdf = *world_.shade(hit);
    return hit;
  }
  return std::optional<Hit>(std::in_place, world_, ray, *found);
}

Hit Tracer::meet(const Ray& ray, RayKind kind, const Found& found) {
  const Hit hit(world_, ray, found);
  if (!records()) return hit;
  begin(ray, kind, kInfinity, 0);
  RayNode& node = finish();
  node.hit = hit;
  node.materials = sharesOf(hit.materials);
  node.bsdf = *world_.shade(hit);
  return hit;
}

void Tracer::drawFrom(const Vec3& from, const Vec3& to) {
  RayNode& node = tree_->nodes.back();
  const Real distance = length(to - from);
  node.ray = {from, distance > 0 ? (to - from) / distance : node.ray.direction};
  if (node.hit) node.hit->t = distance;
}

Color Tracer::veiled(const Color& passed, const Color& passes, std::uint32_t medium, Real distance) {
  const Color color = passed * passes;
  if (!records()) return color;
  RayNode& node = tree_->nodes[static_cast<std::size_t>(last_)];
  node.filters.push_back({medium, 0, distance, passes, {}});
  node.radiance = color;
  return color;
}

RayEnd Tracer::hiddenFrom(const Ray& ray, RayKind kind) const {
  Statistics uncounted;
  if (facesSeenBy(kind) == Faces::both) return LeftScene{};
  const auto hidden = world_.closest(ray, Faces::both, uncounted);
  if (!hidden) return LeftScene{};
  return Culled{hidden->object, hidden->t, sharesOf(world_.materialMix(*hidden))};
}

std::optional<Found> Tracer::lookAt(const Ray& ray, RayKind kind, std::uint32_t object, Real t) {
  count(kind);
  std::optional<Found> nearest;
  const auto off = [&](const Found& found) { return std::abs(found.t - t); };
  world_.crossings(ray, 2 * t, facesSeenBy(kind), statistics_, [&](const Found& found) {
    if (found.object == object &&
        (!nearest || off(found) < off(*nearest) || (off(found) == off(*nearest) && found.before(*nearest))))
      nearest = found;
    return false;
  });
  return nearest;
}

/// From the nearest surface on to the first that counts. The line of the ray is asked once for all crossings,
/// so that what lies behind is hit where it is hit without the surfaces before it.
std::optional<Found> Tracer::walk(const Ray& ray, RayKind kind, Found found, Interfaces& inside, Real chance,
                                  const std::optional<std::uint32_t>& aim) {
  const auto goesOn = [&](const Found& at) {
    return (aim && passesShadowless(at, *aim)) || ignored(ray, at, inside, chance) ||
           (aim && passesPane(ray, at));
  };
  if (!goesOn(found)) return found;
  collect(ray, kInfinity, facesSeenBy(kind), statistics_);
  for (const Found& next : crossed_)
    if (found.before(next) && !goesOn(next)) return next;
  return std::nullopt;
}

/// A ray that samples light passes what casts no shadow.
bool Tracer::passesShadowless(const Found& found, std::uint32_t aim) {
  if (found.object == aim || world_.castsShadow(found)) return false;
  passedShadowless_ = true;
  if (records()) {
    Ignored& ignored = tree_->nodes.back().ignored.emplace_back();
    ignored.object = found.object;
    ignored.part = found.part;
    ignored.t = found.t;
    ignored.shadowless = true;
  }
  return true;
}

/// A ray that samples light passes panes, and is filtered.
bool Tracer::passesPane(const Ray& ray, const Found& found) {
  if (!world_.hasPanes() || world_.opaque(found.object)) return false;
  const Hit hit(world_, ray, found);
  const PlaceBsdf bsdf = world_.shade(hit);
  if (!isPane(*bsdf)) return false;
  const Color factor = passWeight(*bsdf, std::abs(dot(ray.direction, hit.surface.shading)));
  passedPanes_ *= factor;
  if (records())
    tree_->nodes.back().filters.push_back({hit.object, hit.part, hit.t, factor, sharesOf(hit.materials)});
  return true;
}

/// If nothing changes there for light: the ray is behind it now. `chance` becomes one for what comes next.
bool Tracer::ignored(const Ray& ray, const Found& found, Interfaces& inside, Real& chance) {
  if (world_.opaque(found.object)) return false;
  const Hit hit(world_, ray, found);
  if (chance >= hit.opacity) {
    if (hit.opacity > 0) chance = (chance - hit.opacity) / (1 - hit.opacity);
    if (records())
      tree_->nodes.back().ignored.push_back({hit.object, hit.part, hit.t, hit.leaving, hit.opacity});
    return true;
  }
  if (!inside.nested() || !hit.solid) return false;
  const PlaceBsdf bsdf = world_.shade(hit);
  if (!whitted(*bsdf).transmits() || !whitted(*bsdf).encloses(hit.solid)) return false;
  const Filling body = filling(hit, whitted(*bsdf));
  const Sides sides = inside.at(hit.leaving, body, hit.solid);
  if (!sides.alike()) return false;
  if (records())
    tree_->nodes.back().ignored.push_back({hit.object, hit.part, hit.t, hit.leaving, 1, body, sides.before});
  inside.pass(hit.leaving, body, hit.solid);
  return true;
}

const Interfaces& Tracer::interfacesAt(const Vec3& point) {
  if (!start_ || !(start_->first == point)) start_.emplace(point, world_.interfacesAt(point, settings_));
  return start_->second;
}

bool Tracer::tooNear(const Ray& ray) const {
  const Real near = world_.camera().near;
  if (near <= 0) return false;
  Statistics uncounted;
  const auto found = behindHoles(ray, RayKind::camera, uncounted);
  return found && found->t < near;
}

std::optional<Found> Tracer::behindHoles(const Ray& ray, RayKind kind, Statistics& statistics) const {
  const Faces faces = facesSeenBy(kind);
  auto found = world_.closest(ray, faces, statistics);
  if (!found || world_.opacityAt(ray, *found) > 0) return found;
  found.reset();
  world_.crossings(ray, kInfinity, faces, statistics, [&](const Found& next) {
    if ((!found || next.before(*found)) && world_.opacityAt(ray, next) > 0) found = next;
    return false;
  });
  return found;
}

/// The share of light that passes along the ray, which starts inside of `inside`; null without nested glass.
[[gnu::always_inline]] inline Color Tracer::passed(const Ray& ray, Real distance, Interfaces* inside) {
  if (occluded(ray, distance, statistics_)) return Color(0);
  return crossed_.empty() && !inside ? Color(1) : filtered(ray, distance, inside);
}

[[gnu::always_inline]] inline Color Tracer::visibleAlong(const Ray& ray, Real distance, Interfaces* inside,
                                                         Real wavelength) {
  count(RayKind::shadow);
  passedShadowless_ = false;
  if (records()) begin(ray, RayKind::shadow, distance, wavelength);
  const Color color = passed(ray, distance, inside);
  if (records()) {
    RayNode& node = finish();
    node.radiance = color;
    const auto blocked = isBlack(color) ? nearestBlocker(ray, distance) : std::nullopt;
    if (blocked) node.filters.clear();
    node.ends.push_back(blocked ? RayEnd(*blocked) : ReachedLight{});
  }
  return color;
}

Color Tracer::visible(const Hit& from, const Ray& ray, Real distance, const Interfaces& inside) {
  // Apart, so that the usual way stays short.
  const auto throughNested = [&]() __attribute__((noinline)) {
    Interfaces start = startOn(from, ray, inside);
    return visibleAlong(ray, distance, &start, inside.wavelength);
  };
  if (inside.nested()) return throughNested();
  return visibleAlong(ray, distance, nullptr, inside.wavelength);
}

Color Tracer::visible(const Vec3& from, const Vec3& toLight, Real distance, const Interfaces& inside) {
  Interfaces start = inside;
  midair_ = true;
  const Color seen =
      visibleAlong({from, toLight}, distance, inside.nested() ? &start : nullptr, inside.wavelength);
  midair_ = false;
  return seen;
}

/// The medium at the start of a ray from a surface, on whose side that a ray came from it is `inside`.
Interfaces Tracer::startOn(const Hit& from, const Ray& ray, const Interfaces& inside) {
  Interfaces start = inside;
  if (from.leaving == (dot(ray.direction, from.surface.normal) > 0)) {  // on through the surface
    const PlaceBsdf bsdf = world_.shade(from);
    if (whitted(*bsdf).transmits())
      start.pass(from.leaving, filling(from, whitted(*bsdf)), whitted(*bsdf).encloses(from.solid));
  }
  return start;
}

/// The crossings in order along the ray, each once, into crossed_.
template <class Nodes>
void Tracer::collect(const Ray& ray, Real tMost, Faces faces, QueryCounts<Nodes>& counts) {
  crossed_.clear();
  world_.crossings(ray, tMost, faces, counts, [&](const Found& found) {
    crossed_.push_back(found);
    return false;
  });
  sortCrossed();
}

/// Crossings on the way of light; true if something blocks it.
template <class Nodes>
bool Tracer::occluded(const Ray& ray, Real tMost, QueryCounts<Nodes>& counts) {
  crossed_.clear();
  const bool blackGlass = settings_.glassShadows == GlassShadows::black;
  if (world_.occluded(ray, tMost, facesSeenBy(RayKind::shadow), counts, [&](const Found& found) {
        const bool ends = blackGlass && !isShadowless(found) && !(world_.opacityAt(ray, found) < 1) &&
                          !lightPasses(*world_.bsdfAt(ray, found));
        if (!ends) crossed_.push_back(found);
        return ends;
      }))
    return true;
  if (crossed_.size() > 1) sortCrossed();
  return false;
}

/// In order along the ray, so that the product's last bit does not depend on the hierarchy.
void Tracer::sortCrossed() {
  std::sort(crossed_.begin(), crossed_.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end(), same), crossed_.end());
}

/// The transmittance of the crossings.
Color Tracer::filtered(const Ray& ray, Real distance, Interfaces* inside) {
  Color color(1);
  Real last = 0;
  const auto record = [&](std::uint32_t object, std::uint64_t part, Real t, const Color& factor,
                          std::vector<MaterialShare> materials) {
    tree_->nodes.back().filters.push_back({object, part, t, factor, std::move(materials)});
  };
  for (const Found& found : crossed_) {
    if (isShadowless(found)) {
      passedShadowless_ = true;
      if (records())
        tree_->nodes.back().filters.push_back(
            {found.object, found.part, found.t, Color(1), sharesOf(world_.materialMix(found)), true});
      continue;
    }
    const Real opacity = world_.opacityAt(ray, found);
    if (!(opacity > 0)) continue;
    const auto pass = [&](const Color& throughIt) {
      const Color factor = opacity < 1 ? lerp(opacity, Color(1), throughIt) : throughIt;
      color *= factor;
      if (records()) record(found.object, found.part, found.t, factor, sharesOf(world_.materialMix(found)));
    };
    const PlaceBsdf bsdf = world_.bsdfAt(ray, found);
    const WhittedTerms& terms = whitted(*bsdf);
    if (!lightPasses(*bsdf)) {
      if (!(opacity < 1)) return Color(0);
      pass(Color(0));
      continue;
    }
    const bool perCrossing = settings_.glass == Glass::perCrossing;
    Color factor = perCrossing || terms.passage != Passage::asSaid ? terms.transmissive : Color(1);
    if (terms.passage == Passage::straight) {
      pass(passWeight(*bsdf, std::abs(dot(ray.direction, world_.surface(ray, found).shading))));
      continue;
    }
    if (inside) {
      Real whole = 0;
      if (ignored(ray, found, *inside, whole)) continue;
      const Hit hit(world_, ray, found);
      const Color& passes = inside->around().passes;
      if (!(passes == Color(1))) factor *= pow(passes, found.t - last);
      inside->pass(hit.leaving, filling(hit, terms), hit.solid);
    } else if (!perCrossing || !(terms.attenuation == Color(1))) {
      // Light ran in the body that it leaves, from the last surface on.
      const Hit hit(world_, ray, found);
      if (hit.leaving) factor *= pow(filling(hit, terms).passes, found.t - last);
    }
    pass(factor);
    last = found.t;
  }
  if (!inside) return color;
  const Filling& around = inside->around();
  if (!(around.passes == Color(1)) && distance < kInfinity) {  // a light inside glass
    const Color factor = pow(around.passes, distance - last);
    color *= factor;
    if (records()) record(around.object, 0, distance, factor, {});
  }
  return color;
}

// --- recording ----------------------------------------------------------------------------------------

void Tracer::retrace(const RayNode& node, const NodeWatch& watch) {
  QueryCounts<NodeWatch> watched{.nodes = watch};
  if (node.kind == RayKind::shadow)
    occluded(node.ray, node.tMost, watched);
  else
    world_.closest(node.ray, facesSeenBy(node.kind), watched);
  if (!node.ignored.empty() && node.kind != RayKind::shadow)
    collect(node.ray, kInfinity, facesSeenBy(node.kind), watched);
}

/// passed() stops at the first opaque thing it comes across; a person wants to know the nearest.
std::optional<Blocked> Tracer::nearestBlocker(const Ray& ray, Real distance) const {
  Statistics uncounted;
  std::optional<Found> nearest;
  world_.crossings(ray, distance, facesSeenBy(RayKind::shadow), uncounted, [&](const Found& found) {
    const bool opaque = world_.opaque(found.object) ||
                        (!(world_.opacityAt(ray, found) < 1) &&
                         (isBlack(world_.filter(ray, found)) || !lightPasses(*world_.bsdfAt(ray, found))));
    if (opaque && !isShadowless(found) && (!nearest || found.before(*nearest))) nearest = found;
    return false;
  });
  if (!nearest) return {};
  return Blocked{nearest->object, nearest->part, nearest->t, sharesOf(world_.materialMix(*nearest))};
}

std::uint64_t Tracer::testsSoFar() const {
  std::uint64_t sum = 0;
  for (std::uint64_t n : statistics_.tests) sum += n;
  return sum;
}

void Tracer::begin(const Ray& ray, RayKind kind, Real tMost, Real wavelength) {
  if (tree_->nodes.size() >= kMostRecordedRays)
    throw Error(Fault::limit, "the sample takes more than " + std::to_string(kMostRecordedRays) + " rays",
                "a smaller --depth or a --threshold makes them fewer");
  RayNode node;
  node.kind = kind;
  node.parent = current_;
  node.ray = ray;
  node.tMost = tMost;
  node.wavelength = wavelength;
  if (current_ != kNoNode) node.depth = tree_->nodes[static_cast<std::size_t>(current_)].depth + 1;
  node.nodes = statistics_.nodes.count;
  node.tests = testsSoFar();  // finish() makes them differences
  last_ = static_cast<int>(tree_->nodes.size());
  tree_->nodes.push_back(std::move(node));
}

RayNode& Tracer::finish() {
  RayNode& node = tree_->nodes.back();
  node.nodes = statistics_.nodes.count - node.nodes;
  node.tests = testsSoFar() - node.tests;
  return node;
}

void Tracer::record(int node, Term term) {
  term.ray = std::exchange(last_, kNoNode);
  tree_->nodes[static_cast<std::size_t>(node)].terms.push_back(term);
}

void Tracer::record(int index, const RayEnd& why) {
  RayNode& node = tree_->nodes[static_cast<std::size_t>(index)];
  if (std::holds_alternative<MetLight>(why)) {  // it got no farther
    node.hit.reset();
    node.outside.reset();
    node.materials.clear();
    node.ends.clear();
  }
  node.ends.push_back(why);
}

void Tracer::record(int node, const Bsdf& bsdf) { tree_->nodes[static_cast<std::size_t>(node)].bsdf = bsdf; }

void Tracer::record(int node, const std::optional<Vec3>& raised) {
  tree_->nodes[static_cast<std::size_t>(node)].raised = raised;
}

void Tracer::record(int node, const Indices& indices) {
  tree_->nodes[static_cast<std::size_t>(node)].indices = indices;
}

void Tracer::record(int index, const Color& through, const Color& radiance) {
  RayNode& node = tree_->nodes[static_cast<std::size_t>(index)];
  node.through = through;
  node.radiance = radiance;
  const bool sentOn =
      std::any_of(node.terms.begin(), node.terms.end(), [](const Term& term) { return term.goesOn(); });
  if (node.ends.empty() && !sentOn) node.ends.push_back(Opaque{});
}

}  // namespace trace
