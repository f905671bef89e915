// The test of four triangles at once, and a ray's way through the blocks of a mesh. Compiled once for each
// instruction set (mesh_kernel_*.cpp), like accel/traverse.h.
#pragma once

#include "accel/traverse.h"
#include "geometry/mesh_tree.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

struct Vec3x4 {
  Float4 x, y, z;
};
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float4 dot(const Vec3x4& a, const Vec3x4& b) {
  return timesPlus(a.x, b.x, timesPlus(a.y, b.y, a.z * b.z));
}
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
  return {timesMinus(a.y, b.z, a.z * b.y), timesMinus(a.z, b.x, a.x * b.z), timesMinus(a.x, b.y, a.y * b.x)};
}
inline Float4 sizeOf(const Vec3x4& a) { return abs(a.x) + abs(a.y) + abs(a.z); }  // |a|_1

/// Rules out, in float, triangles that a ray surely does not meet at 0 <= t <= limit: the test of Moeller and
/// Trumbore (JGT 2(1), 1997) without its division, loosened by what rounding can do.
///
/// With u = 2^-24, D = |d|_1, L the largest coordinate of the mesh, A = |o|_1 + 3 L >= |a|_1, S the size of
/// the edges: a coordinate of a = v0 - o is off by at most 10 L u, for o is rounded and |o| <= 4 L; one of
/// a x d by (10 L + 4 A) D u; a weight by (10 L + 8 A + 10 S) D S u, its own rounding included; n a by
/// (15 L + 4 A) S^2 u; n d by 4 S^2 D u. S <= 12 L.
class FloatFilter {
 public:
  FloatFilter(const SlabRay& ray, float largest)
      : origin_{spread<0>(ray.origin), spread<1>(ray.origin), spread<2>(ray.origin)},
        direction_{spread<0>(ray.direction), spread<1>(ray.direction), spread<2>(ray.direction)} {
    constexpr float kHalfUlp = 0x1p-24f * 1.01f;
    const Vec3x4 &o = origin_, &d = direction_;
    const Float4 reach = sizeOf(o) + Float4::all(3 * largest), size = sizeOf(d);
    const Float4 inverse = abs(ray.inverse);
    far_ = min(spread<0>(inverse), min(spread<1>(inverse), spread<2>(inverse))) * Float4::all(16 * largest);
    weightSlack_ = (reach * Float4::all(8 * kHalfUlp) + Float4::all(130 * kHalfUlp * largest)) * size;
    alongSlack_ = reach * Float4::all(4 * kHalfUlp) + Float4::all(15 * kHalfUlp * largest);
    limitSlack_ = size * Float4::all(5 * kHalfUlp);
    // Where products could overflow, or lose their digits to underflow, nothing is ruled out.
    usable_ = largest > 1e-6f && largest < 1e6f;
  }

  struct Lanes {
    unsigned left;  ///< those that the ray may meet
    unsigned sure;  ///< those that its line surely meets
  };
  /// `limit` bounds t, counted from the slab ray's origin.
  Lanes operator()(const TriangleBlock& block, float limit) const {
    if (__builtin_expect(!usable_, 0)) return {0xf, 0};
    const auto corner = [&](int i) {
      return Vec3x4{Float4::load(block.corner[i][0]), Float4::load(block.corner[i][1]),
                    Float4::load(block.corner[i][2])};
    };
    const Vec3x4 v0 = corner(0), e1 = corner(1) - v0, e2 = corner(2) - v0, a = v0 - origin_;
    const Vec3x4 n = cross(e1, e2), r = cross(a, direction_);
    // Weights of the corners and t, times n d.
    const Float4 whole = dot(n, direction_), b1 = dot(r, e2), minusB2 = dot(r, e1), b0 = whole - b1 + minusB2,
                 b2 = Float4::all(0) - minusB2, t = dot(n, a);
    const Float4 most = min(Float4::all(limit), far_), rest = timesMinus(most, whole, t);
    const Float4 s = sizeOf(e1) + sizeOf(e2), tiny = Float4::all(1e-37f);
    const Float4 slack = s * weightSlack_ + tiny, slackT = s * s * (alongSlack_ + most * limitSlack_) + tiny;
    const Float4 zero = Float4::all(0);
    const Float4 least = min(b0, min(b1, b2)), greatest = max(b0, max(b1, b2));
    const unsigned front = lessEqual(zero, least + slack) & lessEqual(zero, min(t, rest) + slackT);
    const unsigned back = lessEqual(greatest - slack, zero) & lessEqual(max(t, rest) - slackT, zero);
    return {front | back, lessEqual(slack, least) | lessEqual(greatest + slack, zero)};
  }

 private:
  Vec3x4 origin_, direction_;
  Float4 far_;  ///< t of all hits is less
  Float4 weightSlack_, alongSlack_, limitSlack_;
  bool usable_;
};

/// Calls meet(block, left, sure), which returns true to end, for the blocks and lanes that the ray may meet.
template <bool kNearestFirst, class Meet>
void blocksMet(MeshQuery& q, const Meet& meet) {
  const double origin[3] = {q.ray.origin.x, q.ray.origin.y, q.ray.origin.z},
               direction[3] = {q.ray.direction.x, q.ray.direction.y, q.ray.direction.z};
  SlabRay ray;
  if (!prepare(q.mesh.extent, origin, direction, q.best.hit.t, ray)) return;
  const FloatFilter filter(ray, q.mesh.largest);
  auto visitBlock = [&](std::uint32_t block, float limit) {
    ++q.blocks;
    const auto [left, sure] = filter(q.mesh.blocks[block], limit);
    return left != 0 && meet(block, left, sure);
  };
  traverseCounting<kNearestFirst>(q.mesh.nodes, ray, q.best.hit.t, q.nodes, visitBlock);
}

inline void closestInMesh(MeshQuery& q) {
  blocksMet<true>(q, [&](std::uint32_t block, unsigned left, unsigned sure) {
    return q.keepClosest(block, left, sure), false;
  });
}

inline void crossingsOfMesh(MeshQuery& q) {
  blocksMet<false>(q, [&](std::uint32_t block, unsigned left, unsigned sure) {
    return q.visitCrossings(block, left, sure);
  });
}

}  // namespace
}  // namespace trace::simd
