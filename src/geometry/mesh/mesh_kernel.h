// The test of four triangles at once, and a ray's way through the blocks of a mesh. Compiled once for each
// instruction set (mesh_kernel_*.cpp), like accel/traverse.h.
#pragma once

#include "accel/packet.h"
#include "geometry/mesh/mesh_tree.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

struct Vec3x4 {
  Double4 x, y, z;
};
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Where a ray hits the triangles of a block, lane by lane: t, and weights of the corners times `along`,
/// which is negative for a triangle that faces the ray. Only lanes whose bit is set in `met` mean something.
struct alignas(32) BlockHits {
  double t[4], along[4], w1[4], minusW2[4];
  unsigned met = 0;  ///< at 0 < t <= tMost, those that are not `sure` if TriangleRay::passes() agrees
  unsigned sure = 0;
};

/// The results of locate() and TriangleRay::passes() (triangle.h) for four triangles at once. The arithmetic
/// is that of locate(), operation by operation, so t and the weights are the same to the last bit.
///
/// The signs of the weights tell whether the line of the ray passes through a triangle. With u = 2^-53,
/// D = |d|_1 and R the sum of |v0 - o|_1 and two edges' sizes, rounding moves a weight by at most 10 R^2 D u,
/// and the edge signs that passes() finds, times d's largest coordinate, by 20 R^2 D u, as each sheared
/// coordinate is off by 5 R u. If no weight is that small, passes() says what the signs say. R is at most
/// |o|_1 + 15 L, where L is the largest coordinate of the mesh.
class BlockTest {
 public:
  BlockTest(const Ray& ray, const BvhExtent& extent) : ray_(ray) {
    const auto size = [](const Vec3& v) {
      return __builtin_fabs(v.x) + __builtin_fabs(v.y) + __builtin_fabs(v.z);
    };
    const double along = size(ray.direction),
                 across = size(ray.origin) + 4 * static_cast<double>(extent.reach);
    slack_ = across * across * along * 0x1p-48;
    // Where products could overflow or lose their digits to underflow, no sign is sure.
    if (!(along > 1e-100 && along < 1e100 && slack_ > 1e-250)) slack_ = __builtin_inf();
  }

  BlockHits operator()(const TriangleBlock& block, double tMost) const {
    const auto corner = [&](int i) {
      return Vec3x4{Double4::widen(block.corner[i][0]), Double4::widen(block.corner[i][1]),
                    Double4::widen(block.corner[i][2])};
    };
    const auto all = [](const Vec3& v) {
      return Vec3x4{Double4::all(v.x), Double4::all(v.y), Double4::all(v.z)};
    };
    const Vec3x4 origin = all(ray_.origin), direction = all(ray_.direction);
    const Vec3x4 v0 = corner(0), ab = corner(1) - v0, ac = corner(2) - v0, a = v0 - origin;
    const Double4 zero = Double4::all(0);
    const Vec3x4 normal = cross(ab, ac), moment = cross(a, direction);
    const Double4 along = dot(normal, direction), w1 = dot(moment, ac), minusW2 = dot(moment, ab),
                  tAlong = dot(normal, a);
    // With the sign that makes n d positive.
    const Double4 w0 = timesSign(along - w1 + minusW2, along),
                  least = min(w0, min(timesSign(w1, along), timesSign(zero - minusW2, along)));
    BlockHits hits;
    hits.met = lessEqual(Double4::all(-slack_), least) & less(zero, timesSign(tAlong, along));
    if (hits.met == 0) return hits;
    const Double4 t = tAlong / along;
    hits.met &= lessEqual(t, Double4::all(tMost)) & less(zero, t) & less(zero, timesSign(along, along));
    hits.sure = less(Double4::all(slack_), least);
    t.store(hits.t);
    along.store(hits.along);
    w1.store(hits.w1);
    minusW2.store(hits.minusW2);
    return hits;
  }

 private:
  const Ray& ray_;
  double slack_;
};

/// Calls meet(block, hits), which returns true to end and may lower q.best.hit.t, for blocks that the ray
/// hits.
template <bool kNearestFirst, class Nodes, class Meet>
[[gnu::always_inline]] inline void blocksMet(MeshQuery& q, Nodes& nodes, const Meet& meet) {
  const double origin[3] = {q.ray.origin.x, q.ray.origin.y, q.ray.origin.z},
               direction[3] = {q.ray.direction.x, q.ray.direction.y, q.ray.direction.z};
  SlabRay ray;
  if (!prepare(q.mesh.extent, origin, direction, q.best.hit.t, ray)) return;
  const BlockTest test(q.ray, q.mesh.extent);
  const auto visitBlock = [&](std::uint32_t place, float& limit) {
    ++q.blocks;
    const TriangleBlock& block = atPlace(q.mesh.blocks, place);
    const BlockHits hits = test(block, q.best.hit.t);
    if (hits.met == 0) return false;
    const bool ended = meet(block, hits);
    limit = ray.fromT(q.best.hit.t);
    return ended;
  };
  Nodes visited = nodes;  // a copy of its own, which may stay in a register
  traverse<kNearestFirst>({q.mesh.nodes, q.mesh.blocks}, ray, ray.fromT(q.best.hit.t), visited, visitBlock);
  nodes = visited;
}

inline void fill(MeshHit& met, const TriangleBlock& block, unsigned lane, const BlockHits& hits) {
  const double along = hits.along[lane], b1 = hits.w1[lane] / along, b2 = -hits.minusW2[lane] / along;
  met.triangle = block.triangle[lane];
  TriangleHit& hit = met.hit;
  hit.t = hits.t[lane];
  hit.b[0] = 1 - b1 - b2;
  hit.b[1] = b1;
  hit.b[2] = b2;
  hit.front = along < 0;
}

/// Whether the lane's hit counts.
inline bool accepted(MeshQuery& q, const TriangleBlock& block, unsigned lane, const BlockHits& hits) {
  if (!(hits.sure >> lane & 1) && !q.passes(block, lane)) return false;
  if (q.accept == nullptr) return true;
  MeshHit candidate;
  fill(candidate, block, lane, hits);
  return q.accept(q.context, candidate);
}

/// Keeps the nearest of the hits, if that is nearer than the best so far.
[[gnu::always_inline]] inline void keepNearest(MeshQuery& q, const TriangleBlock& block,
                                               const BlockHits& hits) {
  for (unsigned met = hits.met; met != 0; met &= met - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(met));
    const double t = hits.t[lane], best = q.best.hit.t;
    if (t > best || (t == best && block.triangle[lane] >= q.best.triangle)) continue;
    if (accepted(q, block, lane, hits)) fill(q.best, block, lane, hits);
  }
}

template <class Nodes>
void closestInMesh(MeshQuery& q, Nodes& nodes) {
  blocksMet<true>(q, nodes, [&](const TriangleBlock& block, const BlockHits& hits) {
    keepNearest(q, block, hits);
    return false;
  });
}

void closestTogetherInMesh(MeshPacket& p, NodeCount& nodes) {
  RayPacket rays;
  rays.lanes = p.lanes;
  for (unsigned lanes = p.lanes; lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<unsigned>(__builtin_ctz(lanes));
    rays.origin[i] = &p.rays[i]->origin;
    rays.direction[i] = &p.rays[i]->direction;
    rays.tMost[i] = &p.best[i].hit.t;
  }
  const auto visit = [&](std::uint32_t place, unsigned lanes) {
    const TriangleBlock& block = atPlace(p.mesh.blocks, place);
    unsigned lowered = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(lanes));
      ++p.blocks;
      MeshQuery q{*p.rays[lane], p.mesh, p.best[lane]};
      const BlockHits hits = BlockTest(q.ray, p.mesh.extent)(block, q.best.hit.t);
      if (hits.met == 0) continue;
      keepNearest(q, block, hits);
      lowered |= 1u << lane;
    }
    return lowered;
  };
  queryTogether({p.mesh.nodes, p.mesh.blocks}, p.mesh.extent, rays, nodes, visit);
}

template <class Nodes>
void crossingsOfMesh(MeshQuery& q, Nodes& nodes) {
  blocksMet<false>(q, nodes, [&](const TriangleBlock& block, const BlockHits& hits) {
    for (unsigned met = hits.met; met != 0; met &= met - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(met));
      if (hits.t[lane] < q.best.hit.t && accepted(q, block, lane, hits)) return true;
    }
    return false;
  });
}

template <class Nodes>
constexpr MeshWays<Nodes> inMesh{closestInMesh<Nodes>, crossingsOfMesh<Nodes>};

}  // namespace
}  // namespace trace::simd
