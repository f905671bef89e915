#include "app/explain/ray_segments.h"

#include "base/match.h"
#include "math/box.h"

namespace trace {
namespace {

RayLooks looksOf(const RayNode& node) {
  const bool blocked = node.kind == RayKind::shadow && isBlack(node.radiance);
  return blocked ? RayLooks::shadowBlocked : static_cast<RayLooks>(node.kind);
}

/// The t at which the ray ends; infinite if it does not.
Real length(const RayNode& node) {
  if (const MediumTerm* scattered = scatteredIn(node)) return scattered->t;
  if (node.hit) return node.hit->t;
  if (!node.ends.empty()) {
    if (const auto* blocked = std::get_if<Blocked>(&node.ends.front())) return blocked->t;
    if (const auto* cut = std::get_if<CutOff>(&node.ends.front())) return cut->t;
    if (const auto* met = std::get_if<MetLight>(&node.ends.front())) return met->t;
  }
  return node.tMost;
}

}  // namespace

const MediumTerm* scatteredIn(const RayNode& node) {
  for (const Term& term : node.terms)
    if (term.medium && term.goesOn()) return &*term.medium;
  return nullptr;
}

std::vector<RaySegment> raySegments(const RayTree& tree) {
  Box3 box;
  for (const RayNode& node : tree.nodes) {
    box.extend(node.ray.origin);
    if (const Real t = length(node); std::isfinite(t)) box.extend(node.ray.at(t));
  }
  const Real size = trace::length(box.size()), beyond = size > 0 ? size / 3 : 1;
  std::vector<RaySegment> segments;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    const Real t = length(node);
    const bool leaves = !std::isfinite(t);
    const Vec3 to = node.ray.at(leaves ? beyond / trace::length(node.ray.direction) : t);
    segments.push_back({static_cast<int>(i), looksOf(node), node.ray.origin, to, leaves});
  }
  return segments;
}

Box3 boundsOf(const std::vector<RaySegment>& segments, Real reach) {
  Box3 box;
  const auto note = [&](const Vec3& point) {
    if (length(point - segments.front().to) <= reach) box.extend(point);
  };
  for (const RaySegment& segment : segments) {
    if (segment.looks != RayLooks::camera) note(segment.from);
    if (!segment.leaves) note(segment.to);
  }
  return box;
}

}  // namespace trace
