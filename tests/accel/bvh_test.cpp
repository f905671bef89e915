#include "accel/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "support/random.h"

namespace trace::test {
namespace {

/// What the ray visits among others that go nearly the same way.
std::set<std::uint32_t> visitedTogether(const Bvh& bvh, const Vec3& o, const Vec3& d, Real tMost) {
  std::array<Vec3, RayPacket::kRays> origins, directions;
  RayPacket rays;
  for (std::size_t i = 0; i < RayPacket::kRays; ++i) {
    const Real off = 0.01 * (static_cast<Real>(i) - 3);  // none for ray 3
    origins[i] = o * (1 + off);
    directions[i] = d + Vec3{off, -off, off};
    rays.origin[i] = &origins[i];
    rays.direction[i] = &directions[i];
    rays.tMost[i] = &tMost;
    if (i != 5) rays.lanes |= 1u << i;
  }
  std::set<std::uint32_t> items;
  NodeCount nodes;
  bvh.query(rays, nodes, [&](std::uint32_t item, unsigned lanes) {
    EXPECT_EQ(lanes & ~rays.lanes, 0u);
    if (lanes >> 3 & 1) items.insert(item);
    return 0u;
  });
  return items;
}

/// What a query visits; the same for every kernel and both orders, alone and with others.
std::set<std::uint32_t> visited(Bvh bvh, const Vec3& o, const Vec3& d, Real tMost = kInfinity) {
  std::set<std::uint32_t> first;
  bool any = false;
  for (const BvhKernel& kernel : bvhKernels())
    for (bool nearestFirst : {true, false}) {
      std::set<std::uint32_t> items;
      NodeCount nodes;
      const auto insert = [&](std::uint32_t item) { return items.insert(item), false; };
      bvh.setKernel(kernel);
      bvh.query(o, d, tMost, nearestFirst, nodes, insert);
      EXPECT_TRUE(!any || items == first) << kernel.name;
      EXPECT_EQ(visitedTogether(bvh, o, d, tMost), items) << kernel.name;
      first = items, any = true;
    }
  return first;
}

/// Slabs in extended precision: does the ray surely meet the box?
bool meets(const Box3& box, const Vec3& o, const Vec3& d) {
  long double near = 0, far = kInfinity;
  for (int i = 0; i < 3; ++i) {
    long double t0 = (static_cast<long double>(box.low[i]) - o[i]) / d[i];
    long double t1 = (static_cast<long double>(box.high[i]) - o[i]) / d[i];
    if (t0 > t1) std::swap(t0, t1);
    near = std::max(near, t0), far = std::min(far, t1);
  }
  return near <= far;
}

TEST(Bvh, NeverMissesABox) {
  Random random(1);
  std::vector<Box3> boxes(500);
  for (Box3& box : boxes) {
    const Vec3 c = random.inCube(10);
    box.extend(c), box.extend(c + random.inCube(1));
  }
  const Bvh bvh(boxes);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 o = random.inCube(15), d = random.direction();
    const auto items = visited(bvh, o, d);
    for (std::uint32_t k = 0; k < boxes.size(); ++k) EXPECT_TRUE(!meets(boxes[k], o, d) || items.count(k));
  }
}

TEST(Bvh, BoxesBeyondFloat) {
  Random random(2);
  for (int count : {8, 100}) {
    std::vector<Box3> boxes(static_cast<std::size_t>(count));
    for (Box3& box : boxes) {
      const Vec3 size = random.inCube(random.uniform() < 0.3 ? 1e300 : 1);
      box.extend(random.inCube(3)), box.extend(size);
      if (random.uniform() < 0.3) box.extend(-1.0 * size);
    }
    const auto items = visited(Bvh(boxes), {}, {1, 2, 3});
    for (std::uint32_t k = 0; k < boxes.size(); ++k)
      EXPECT_TRUE(!meets(boxes[k], {}, {1, 2, 3}) || items.count(k)) << k << " of " << count;
  }
}

TEST(Bvh, RaysInThePlanesOfFacesAndAlongAxes) {
  std::vector<Box3> boxes;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) boxes.push_back({{x + 0.0, y + 0.0, z + 0.0}, {x + 1.0, y + 1.0, z + 1.0}});
  const Bvh bvh(boxes);
  for (Real a = 0; a <= 4; a += 0.5)
    for (Real b = 0; b <= 4; b += 0.5)
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 o, d;
        o[axis] = -1, o[(axis + 1) % 3] = a, o[(axis + 2) % 3] = b, d[axis] = 1;
        const auto items = visited(bvh, o, d);
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
          const Box3& box = boxes[k];
          const int i = (axis + 1) % 3, j = (axis + 2) % 3;
          const bool met = a >= box.low[i] && a <= box.high[i] && b >= box.low[j] && b <= box.high[j];
          EXPECT_TRUE(!met || items.count(k));
        }
      }
}

TEST(Bvh, DegenerateInputs) {
  EXPECT_TRUE(visited(Bvh(std::vector<Box3>{}), {}, {1, 0, 0}).empty());
  EXPECT_TRUE(visited(Bvh(std::vector<Box3>(3)), {}, {1, 0, 0}).empty());  // empty boxes
  const std::vector<Box3> same(5000, Box3{{-1, -1, -1}, {1, 1, 1}});
  EXPECT_EQ(visited(Bvh(same), {-5, 0, 0}, {1, 0, 0}).size(), same.size());
  std::vector<Box3> line;  // sizes from 1e-30 to 1e30: no plane splits them evenly
  for (int i = -300; i < 300; ++i) {
    const Real s = std::pow(10.0, i / 10.0);
    line.push_back({{0, 0, 0}, {s, s, s}});
  }
  EXPECT_EQ(visited(Bvh(line), {-1, -1, -1}, {1, 1, 1}).size(), line.size());
}

TEST(Bvh, StopsBeyondTheLimitAndWhenTold) {
  std::vector<Box3> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back({{i + 0.1, 0, 0}, {i + 0.9, 1, 1}});
  const Bvh bvh(boxes);
  const size_t near =
      visited(bvh, {-1, 0.5, 0.5}, {1, 0, 0}, 5.5).size();  // five boxes, and what shares a leaf
  EXPECT_GE(near, 5u);
  EXPECT_LE(near, 5u + 3u);
  NodeCount nodes;
  int calls = 0;
  bvh.query({-1, 0.5, 0.5}, {1, 0, 0}, kInfinity, true, nodes, [&](std::uint32_t) { return ++calls == 3; });
  EXPECT_EQ(calls, 3);
}

TEST(Bvh, BruteForceVisitsEverything) {
  EXPECT_EQ(visited(Bvh::bruteForce(std::vector<Box3>(7, Box3{{8, 8, 8}, {9, 9, 9}})), {}, {1, 0, 0}).size(),
            7u);
}

TEST(Bvh, TheSameTreeForAnyNumberOfThreads) {
  Random random(7);
  std::vector<Box3> boxes(60000);  // more than one thread takes at a time
  for (Box3& box : boxes) {
    const Vec3 c = random.inCube(10);
    box.extend(c), box.extend(c + random.inCube(0.1));
  }
  for (const Bvh::Leaves leaves : {Bvh::Leaves::single, Bvh::Leaves::together}) {
    const Bvh one(boxes, leaves, 1);
    for (int threads : {2, 7}) {
      const Bvh many(boxes, leaves, threads);
      ASSERT_EQ(many.nodes().size(), one.nodes().size());
      static_assert(sizeof(BvhNode) == 8 * (6 * sizeof(float) + sizeof(std::uint32_t)));  // no padding
      EXPECT_EQ(std::memcmp(many.nodes().data(), one.nodes().data(), one.nodes().size() * sizeof(BvhNode)),
                0);
      EXPECT_TRUE(std::ranges::equal(many.items(), one.items())) << threads;
    }
  }
}

}  // namespace
}  // namespace trace::test
