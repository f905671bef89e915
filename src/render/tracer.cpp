#include "render/tracer.h"

#include <algorithm>
#include <utility>

namespace trace {

Faces Tracer::facesSeenBy(RayKind kind) const {
  const bool seen = kind == RayKind::camera || kind == RayKind::reflection;
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
      twoSided(world.twoSided(object)),
      convex(world.convex(object)) {
  world.bump(ray, *this);
}

std::optional<Hit> Tracer::cast(const Ray& ray, RayKind kind) {
  count(kind);
  if (records()) begin(ray, kind, kInfinity);
  const auto found = world_.closest(ray, facesSeenBy(kind), statistics_);
  if (!found || (kind == RayKind::camera && !world_.camera().sees(found->t))) {
    if (records()) {
      const CameraFrame& camera = world_.camera();
      const Real limit = found && found->t < camera.near ? camera.near : camera.far;
      RayNode& node = finish();
      node.ends.push_back(
          found ? RayEnd(CutOff{found->object, found->t, limit, sharesOf(world_.materialMix(*found))})
                : hiddenFrom(ray, kind));
      if (world_.outside().isSeenBy(kind)) node.outside = world_.outside().view(ray.direction, kind);
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

RayEnd Tracer::hiddenFrom(const Ray& ray, RayKind kind) const {
  Statistics uncounted;
  if (facesSeenBy(kind) == Faces::both) return LeftScene{};
  const auto hidden = world_.closest(ray, Faces::both, uncounted);
  if (!hidden) return LeftScene{};
  return Culled{hidden->object, hidden->t, sharesOf(world_.materialMix(*hidden))};
}

bool Tracer::tooNear(const Ray& ray) const {
  const Real near = world_.camera().near;
  if (near <= 0) return false;
  Statistics uncounted;
  const auto found = world_.closest(ray, facesSeenBy(RayKind::camera), uncounted);
  return found && found->t < near;
}

Color Tracer::visible(const Hit& from, const Vec3& toLight, Real distance) {
  count(RayKind::shadow);
  const Ray ray = from.leave(toLight);
  if (records()) begin(ray, RayKind::shadow, distance);
  const Color color = passed(ray, distance);
  if (records()) {
    RayNode& node = finish();
    node.radiance = color;
    const auto blocked = isBlack(color) ? nearestBlocker(ray, distance) : std::nullopt;
    if (blocked) node.filters.clear();
    node.ends.push_back(blocked ? RayEnd(*blocked) : ReachedLight{});
  }
  return color;
}

Color Tracer::passed(const Ray& ray, Real distance) {
  bool blocked = false;
  crossed_.clear();
  world_.crossings(ray, distance, facesSeenBy(RayKind::shadow), statistics_, [&](const Found& found) {
    blocked = world_.opaque(found.object) || settings_.glassShadows == GlassShadows::black;
    if (!blocked) crossed_.push_back(found);
    return blocked;
  });
  if (blocked) return Color(0);
  if (crossed_.empty()) return Color(1);

  // In order along the ray, so that the product's last bit does not depend on the hierarchy; each once.
  std::sort(crossed_.begin(), crossed_.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end(), same), crossed_.end());
  Color color(1);
  Real last = 0;
  for (const Found& found : crossed_) {
    const Color filter = world_.filter(ray, found);
    if (isBlack(filter)) return Color(0);
    Color factor(1);
    if (settings_.glass == Glass::perCrossing)
      factor = filter;
    else if (dot(ray.direction, world_.surface(ray, found).normal) > 0)
      factor = pow(filter, found.t - last);
    color *= factor;
    last = found.t;
    if (records())
      tree_->nodes.back().filters.push_back(
          {found.object, found.part, found.t, factor, sharesOf(world_.materialMix(found))});
  }
  return color;
}

// --- recording ----------------------------------------------------------------------------------------

void Tracer::retrace(const RayNode& node) {
  if (node.kind == RayKind::shadow)
    passed(node.ray, node.tMost);
  else
    world_.closest(node.ray, facesSeenBy(node.kind), statistics_);
}

/// passed() stops at the first opaque thing it comes across; a person wants to know the nearest.
std::optional<Blocked> Tracer::nearestBlocker(const Ray& ray, Real distance) const {
  Statistics uncounted;
  std::optional<Found> nearest;
  world_.crossings(ray, distance, facesSeenBy(RayKind::shadow), uncounted, [&](const Found& found) {
    const bool opaque = world_.opaque(found.object) || settings_.glassShadows == GlassShadows::black ||
                        isBlack(world_.filter(ray, found));
    if (opaque && (!nearest || found.before(*nearest))) nearest = found;
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

void Tracer::begin(const Ray& ray, RayKind kind, Real tMost) {
  if (tree_->nodes.size() >= kMostRecordedRays)
    throw Error(Fault::limit, "the sample takes more than " + std::to_string(kMostRecordedRays) + " rays",
                "a smaller --depth or a --threshold makes them fewer");
  RayNode node;
  node.kind = kind, node.parent = current_, node.ray = ray, node.tMost = tMost;
  if (current_ != kNoNode) node.depth = tree_->nodes[static_cast<std::size_t>(current_)].depth + 1;
  node.nodes = statistics_.nodes.count, node.tests = testsSoFar();  // finish() makes them differences
  last_ = static_cast<int>(tree_->nodes.size());
  tree_->nodes.push_back(std::move(node));
}

RayNode& Tracer::finish() {
  RayNode& node = tree_->nodes.back();
  node.nodes = statistics_.nodes.count - node.nodes, node.tests = testsSoFar() - node.tests;
  return node;
}

void Tracer::record(int node, Term term) {
  term.ray = std::exchange(last_, kNoNode);
  tree_->nodes[static_cast<std::size_t>(node)].terms.push_back(term);
}

void Tracer::record(int node, const RayEnd& why) {
  tree_->nodes[static_cast<std::size_t>(node)].ends.push_back(why);
}

void Tracer::record(int node, const Bsdf& bsdf) { tree_->nodes[static_cast<std::size_t>(node)].bsdf = bsdf; }

void Tracer::record(int node, const Indices& indices) {
  tree_->nodes[static_cast<std::size_t>(node)].indices = indices;
}

void Tracer::record(int index, const Color& through, const Color& radiance) {
  RayNode& node = tree_->nodes[static_cast<std::size_t>(index)];
  node.through = through, node.radiance = radiance;
  const bool sentOn = std::any_of(node.terms.begin(), node.terms.end(), [&](const Term& term) {
    return term.ray != kNoNode && tree_->nodes[static_cast<std::size_t>(term.ray)].kind != RayKind::shadow;
  });
  if (node.ends.empty() && !sentOn) node.ends.push_back(Opaque{});
}

}  // namespace trace
