// Queries of the World by rays: one of the two files that see the structs of all shapes, so that the way from
// the hierarchy to a crossing is inlined for each. Forms lie side by side, without a pointer to follow.
#include "base/budget.h"
#include "base/match.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shape_list.h"
#include "render/world/world.h"

namespace trace {

struct World::Forms {
  std::vector<TracedShape::Held> all;
};

void World::collectForms() {
  auto forms = std::make_shared<Forms>();
  forms->all.reserve(shapes_.size());
  for (const TracedShape& shape : shapes_) forms->all.push_back(shape.held());
  forms_ = std::move(forms);
}

namespace {

/// The nodes of a mesh are distinguished from those of the scene for observers.
void enter(NodeCount&, std::uint32_t) {}
void enter(NodeWatch& nodes, std::uint32_t object) {
  nodes.owner = object == NodeWatch::kTop ? nodes.placement : object + nodes.shift;
}

/// Those of a placement, too.
template <class Nodes>
struct Within {
  Within(Nodes&, std::uint32_t, std::uint32_t) {}
};
template <>
struct Within<NodeWatch> {
  Within(NodeWatch& nodes, std::uint32_t placement, std::uint32_t shift) : nodes_(nodes), before_(nodes) {
    nodes.owner = nodes.placement = placement;
    nodes.shift = shift;
  }
  ~Within() {
    nodes_.owner = before_.owner;
    nodes_.placement = before_.placement;
    nodes_.shift = before_.shift;
  }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  NodeWatch& nodes_;
  const NodeWatch before_;
};

/// The ray in the space of a group.
Ray into(const Affine& outFromGroup, const Ray& ray) {
  const Affine in = inverse(outFromGroup);
  return {in * ray.origin, linear(in, ray.direction)};
}

/// Takes the hit of a mesh. At the same distance the object that comes first in the scene counts.
template <class Nodes>
void take(const MeshHit& met, std::uint32_t object, std::uint32_t kind, QueryCounts<Nodes>& counts,
          Found& best) {
  if (met.hit.t == best.t && object >= best.object) return;
  ++counts.hits[kind];
  best = {met.hit.t, object, met.triangle, met.hit};
}

/// Those among which the placement of that number is.
template <class Uses>
const Uses& usesWith(const std::vector<Uses>& uses, std::uint32_t use) {
  std::size_t at = 0;
  while (at + 1 < uses.size() && uses[at + 1].firstUse <= use) ++at;
  return uses[at];
}

}  // namespace

// --- the nearest crossing -----------------------------------------------------------------------------

template <class Nodes>
std::optional<Found> World::closest(const Ray& ray, Faces faces, QueryCounts<Nodes>& counts,
                                    Real tMost) const {
  std::optional<Found> best(std::in_place);
  best->t = tMost;
  const auto ask = [&](std::uint32_t object) {
    checkBudget();
    if (object >= plain_) [[unlikely]]
      closestInUse(object, uses_, {ray, faces, 0}, counts, *best);
    else
      closestOf(object, ray, faces, counts, *best);
    return false;
  };
  checkBudget();
  for (std::uint32_t object : always_)
    if (object != ray.leaves) ask(object);
  if (!bvh_->nodes().empty())
    bvh_->query(ray.origin, ray.direction, best->t, true, counts.nodes, ask, ray.leaves);
  if (best->t == tMost) best.reset();
  return best;
}

void World::closest(std::span<const Ray* const> rays, Faces faces, Statistics& counts,
                    std::span<Found* const> found) const {
  RayPacket packet;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    *found[i] = {};
    packet.origin[i] = &rays[i]->origin;
    packet.direction[i] = &rays[i]->direction;
    packet.tMost[i] = &found[i]->t;
    packet.lanes |= 1u << i;
  }
  const auto ask = [&](std::uint32_t object, unsigned lanes) {
    checkBudget();
    closestTogether(object, rays, lanes, faces, counts, found);
    return lanes;
  };
  checkBudget();
  for (std::uint32_t object : always_) ask(object, packet.lanes);
  if (!bvh_->nodes().empty()) bvh_->query(packet, counts.nodes, ask);
}

void World::closestTogether(std::uint32_t object, std::span<const Ray* const> rays, unsigned lanes,
                            Faces faces, Statistics& counts, std::span<Found* const> best) const {
  const auto each = [&](const auto& use) {
    for (unsigned i = 0; i < rays.size(); ++i)
      if (lanes >> i & 1) use(i);
  };
  const Instance* mesh = object < plain_ && objects_[object].mesh ? &objects_[object] : nullptr;
  if (!mesh || faces != Faces::both || (lanes & (lanes - 1)) == 0) {
    each([&](unsigned i) {
      if (object >= plain_)
        closestInUse(object, uses_, {*rays[i], faces, 0}, counts, *best[i]);
      else
        closestOf(object, *rays[i], faces, counts, *best[i]);
    });
    return;
  }
  const auto inItsSpace = [&](const Ray* const* own) {
    MeshHit met[RayPacket::kRays];
    each([&](unsigned i) { met[i].hit.t = best[i]->t; });
    mesh->mesh->closest(own, met, lanes, MeshCounts{counts.nodes, counts.tests[mesh->kind]});
    each([&](unsigned i) {
      if (met[i].triangle != Bvh::kNoItem) take(met[i], object, mesh->kind, counts, *best[i]);
    });
  };
  if (!mesh->placement.moved()) return inItsSpace(rays.data());
  Ray moved[RayPacket::kRays];
  const Ray* own[RayPacket::kRays];
  each([&](unsigned i) {
    moved[i] = mesh->placement.into(*rays[i]);
    own[i] = &moved[i];
  });
  inItsSpace(own);
}

template <class Nodes>
inline void World::closestOf(std::uint32_t object, const Ray& worldRay, Faces faces,
                             QueryCounts<Nodes>& counts, Found& best) const {
  const Instance& instance = objects_[object];
  const auto inItsSpace = [&](const Ray& ray) {
    const MeshTree* mesh = instance.mesh.get();
    if (!mesh) return closestOfShape(instance, object, ray, counts, best);
    const std::uint32_t kind = instance.kind;
    MeshHit met;
    met.hit.t = best.t;
    enter(counts.nodes, object);
    const bool found = faces == Faces::both
                           ? mesh->closest(ray, met, nullptr, MeshCounts{counts.nodes, counts.tests[kind]})
                           : closestSeen(object, ray, faces, counts, met);
    enter(counts.nodes, NodeWatch::kTop);
    if (found) take(met, object, kind, counts, best);
  };
  const Placement& placement = instance.placement;
  placement.moved() ? inItsSpace(placement.into(worldRay)) : inItsSpace(worldRay);
}

template <class Nodes>
bool World::closestSeen(std::uint32_t object, const Ray& ray, Faces faces, QueryCounts<Nodes>& counts,
                        MeshHit& met) const {
  const Instance& instance = objects_[object];
  const auto seen = [&](const MeshHit& hit) { return included(faces, object, ray, hit); };
  return instance.mesh->closest(ray, met, seen, MeshCounts{counts.nodes, counts.tests[instance.kind]});
}

template <class Nodes, class Visit>
inline void World::crossingsOfShape(std::uint32_t object, const Ray& ray, const Real& tMost,
                                    QueryCounts<Nodes>& counts, const Visit& visit) const {
  const Instance& instance = objects_[object];
  ++counts.tests[instance.kind];
  const TracedShape::Held& held = forms_->all[instance.form];
  match(held.form, Overloaded{[](const Mesh&) {},
                              [&](const auto& form) {
                                visitCrossings(form, held.approach, ray, Range{0, tMost}, visit);
                              }});
}

template <class Nodes>
void World::closestOfShape(const Instance& instance, std::uint32_t object, const Ray& ray,
                           QueryCounts<Nodes>& counts, Found& best) const {
  crossingsOfShape(object, ray, best.t, counts, [&](const Crossing& crossing) {
    if (!(crossing.t > 0 && crossing.t <= best.t)) return;
    const auto part = static_cast<std::uint64_t>(crossing.part);
    if (!best.after(crossing.t, object, part)) return;
    ++counts.hits[instance.kind];
    best.t = crossing.t;
    best.object = object;
    best.part = part;
  });
}

template std::optional<Found> World::closest(const Ray&, Faces, QueryCounts<NodeCount>&, Real) const;
template std::optional<Found> World::closest(const Ray&, Faces, QueryCounts<NodeWatch>&, Real) const;

SurfacePoint World::surface(const Ray& ray, const Found& found) const {
  return found.object < plain_ ? surfaceOn(found.object, ray, found) : placedSurface(ray, found);
}

SurfacePoint World::surfaceOn(std::uint32_t object, const Ray& worldRay, const Found& found) const {
  const Instance& instance = objects_[object];
  const Placement& placement = instance.placement;
  const Ray ray = placement.moved() ? placement.into(worldRay) : worldRay;
  const TracedShape::Held& held = forms_->all[instance.form];
  const SurfacePoint s = match(
      held.form, Overloaded{[&](const Mesh&) {
                              return trace::surface(instance.mesh->data(),
                                                    static_cast<std::uint32_t>(found.part), found.triangle);
                            },
                            [&](const auto& shape) {
                              const Crossing crossing{found.t, static_cast<std::int64_t>(found.part)};
                              return surfaceOf(shape, held.approach, ray, crossing);
                            }});
  return placement.moved() ? placement.outOf(s) : s;
}

// --- every crossing -----------------------------------------------------------------------------------

template <class Nodes>
bool World::crossAll(const Across<Nodes>& query) const {
  bool ended = false;
  const auto ask = [&](std::uint32_t object) {
    checkBudget();
    return ended = object < plain_ ? crossObject(object, query) : crossUse(object, uses_, 0, query);
  };
  checkBudget();
  const Ray& ray = query.ray;
  for (std::uint32_t object : always_)
    if (object != ray.leaves && ask(object)) return true;
  if (!bvh_->nodes().empty())
    bvh_->query(ray.origin, ray.direction, query.tMost, false, query.counts.nodes, ask, ray.leaves);
  return ended;
}

template <class Nodes>
inline bool World::crossObject(std::uint32_t object, const Across<Nodes>& query) const {
  const Instance& instance = objects_[object];
  const auto inItsSpace = [&](const Ray& ray) {
    return instance.mesh ? crossMesh(object, ray, query) : crossShape(object, ray, query);
  };
  const Placement& placement = instance.placement;
  return placement.moved() ? inItsSpace(placement.into(query.ray)) : inItsSpace(query.ray);
}

template <class Nodes>
bool World::crossMesh(std::uint32_t object, const Ray& ray, const Across<Nodes>& query) const {
  const Instance& instance = objects_[object];
  const MeshTree& mesh = *instance.mesh;
  const bool ends = query.opaqueEnds && instance.blocks;
  bool ended = false;
  const auto met = [&](const MeshHit& hit) {
    if (!included(query.faces, object, ray, hit)) return false;
    ++query.counts.hits[instance.kind];
    return ended = ends || query.visit(Found{hit.hit.t, object, hit.triangle, hit.hit});
  };
  enter(query.counts.nodes, object);
  mesh.crossings(ray, query.tMost, met, MeshCounts{query.counts.nodes, query.counts.tests[instance.kind]});
  enter(query.counts.nodes, NodeWatch::kTop);
  return ended;
}

template <class Nodes>
bool World::crossShape(std::uint32_t object, const Ray& ray, const Across<Nodes>& query) const {
  const bool ends = query.opaqueEnds && objects_[object].blocks;
  bool ended = false;
  Real wanted = query.tMost;
  crossingsOfShape(object, ray, wanted, query.counts, [&](const Crossing& crossing) {
    if (ended || !(crossing.t > 0 && crossing.t < query.tMost)) return;
    ++query.counts.hits[objects_[object].kind];
    ended = ends || query.visit(Found{crossing.t, object, static_cast<std::uint64_t>(crossing.part), {}});
    if (ended) wanted = -kInfinity;
  });
  return ended;
}

void World::crossingsOf(std::uint32_t object, const Ray& ray, Real tMost, Statistics& statistics,
                        VisitFound visit) const {
  checkBudget();
  if (object < plain_) {
    crossObject(object, Across<NodeCount>{ray, tMost, Faces::both, false, statistics, visit});
    return;
  }
  const Located at = locate(object);
  Ray inside = ray;
  for (int level = 0; level < at.levels; ++level) inside = into(*at.steps[level], inside);
  crossObject(at.object, Across<NodeCount>{inside, tMost, Faces::both, false, statistics, [&](Found found) {
                                             found.object = object;
                                             return visit(found);
                                           }});
}

// --- placements ---------------------------------------------------------------------------------------

template <class Nodes>
void World::closestInUse(std::uint32_t use, const std::vector<Uses>& uses, const Around& around,
                         QueryCounts<Nodes>& counts, Found& best) const {
  const Uses& list = usesWith(uses, use);
  const Group& group = groups_[list.group];
  const std::uint32_t index = use - list.firstUse, first = list.firstObject + index * group.numbers,
                      base = around.base + first;
  Ray ray = into((*list.list)[index].outFromGroup, around.ray);
  const std::uint32_t left = around.ray.leaves - first;
  ray.leaves = left < group.numbers ? left : Ray::kNothing;
  const Within<Nodes> within(counts.nodes, around.base + use, base - group.first);
  const auto ask = [&](std::uint32_t item) {
    checkBudget();
    if (item >= group.count) {
      closestInUse(item, group.uses, {ray, around.faces, base}, counts, best);
      return false;
    }
    // At the same distance the lower number counts, which is not that in objects_.
    const std::uint32_t number = base + item, object = group.first + item,
                        rank = best.object == number  ? object
                               : best.object < number ? 0
                                                      : Ray::kNothing;
    Found found = best;
    found.object = rank;
    closestOf(object, ray, around.faces, counts, found);
    if (found.t == best.t && found.object == rank && found.part == best.part) return false;
    best = found;
    best.object = number;
    return false;
  };
  if (group.bvh->nodes().empty()) {
    for (const std::uint32_t item : group.bvh->items())
      if (item != ray.leaves) ask(item);
  } else {
    group.bvh->query(ray.origin, ray.direction, best.t, true, counts.nodes, ask, ray.leaves);
  }
}

template <class Nodes>
bool World::crossUse(std::uint32_t use, const std::vector<Uses>& uses, std::uint32_t outer,
                     const Across<Nodes>& query) const {
  const Uses& list = usesWith(uses, use);
  const Group& group = groups_[list.group];
  const std::uint32_t index = use - list.firstUse, first = list.firstObject + index * group.numbers,
                      base = outer + first;
  Ray ray = into((*list.list)[index].outFromGroup, query.ray);
  const std::uint32_t left = query.ray.leaves - first;
  ray.leaves = left < group.numbers ? left : Ray::kNothing;
  const Within<Nodes> within(query.counts.nodes, outer + use, base - group.first);
  bool ended = false;
  const auto ask = [&](std::uint32_t item) {
    checkBudget();
    const auto inside = [&](VisitFound visit) {
      return Across<Nodes>{ray, query.tMost, query.faces, query.opaqueEnds, query.counts, visit};
    };
    if (item >= group.count) return ended = crossUse(item, group.uses, base, inside(query.visit));
    const auto numbered = [&](Found found) {
      found.object = base + item;
      return query.visit(found);
    };
    return ended = crossObject(group.first + item, inside(numbered));
  };
  if (group.bvh->nodes().empty()) {
    for (const std::uint32_t item : group.bvh->items())
      if (item != ray.leaves && ask(item)) break;
  } else {
    group.bvh->query(ray.origin, ray.direction, query.tMost, false, query.counts.nodes, ask, ray.leaves);
  }
  return ended;
}

SurfacePoint World::placedSurface(const Ray& ray, const Found& found) const {
  const Located at = locate(found.object);
  Affine inward[kMostGroupLevels];
  Ray inside = ray;
  for (int level = 0; level < at.levels; ++level) {
    inward[level] = inverse(*at.steps[level]);
    inside = {inward[level] * inside.origin, linear(inward[level], inside.direction)};
  }
  SurfacePoint point = surfaceOn(at.object, inside, found);
  for (int level = at.levels; level-- > 0;)
    point = outOf(point, WayOut(*at.steps[level], inward[level]), inward[level]);
  return point;
}

template bool World::crossAll(const Across<NodeCount>&) const;
template bool World::crossAll(const Across<NodeWatch>&) const;

}  // namespace trace
