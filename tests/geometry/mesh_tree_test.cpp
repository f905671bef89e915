// The hierarchy of a mesh, for each instruction set that this machine can run, against testing every
// triangle.
#include "geometry/mesh/mesh_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/presplit.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

struct Nearest {
  Real t = kInfinity;
  std::uint32_t triangle = Bvh::kNoItem;
  Real b1 = 0, b2 = 0;
  bool front = false;
  bool operator==(const Nearest&) const = default;
};

struct Counts {
  NodeCount nodes;
  std::uint64_t triangles = 0;
  MeshCounts<> both() { return {nodes, triangles}; }
};

/// The nearest of the triangles that `accept` likes.
template <class Accept = std::nullptr_t>
Nearest nearest(const MeshTree& tree, const Ray& ray, Accept accept = {}) {
  Counts counts;
  MeshHit best;
  best.hit.t = kInfinity;
  if (!tree.closest(ray, best, accept, counts.both())) return {};
  const TriangleHit& hit = best.hit;
  EXPECT_NEAR(hit.b[0] + hit.b[1] + hit.b[2], 1, 1e-12);
  return {hit.t, best.triangle, hit.b[1], hit.b[2], hit.front};
}

std::set<std::uint32_t> allHits(const MeshTree& tree, const Ray& ray, Real tMost) {
  std::set<std::uint32_t> hits;
  Counts counts;
  const auto insert = [&](const MeshHit& met) {
    hits.insert(met.triangle);  // parts meet twice
    return false;
  };
  tree.crossings(ray, tMost, insert, counts.both());
  return hits;
}

/// The ball, scaled and moved: far from the origin, floats are coarse.
std::shared_ptr<MeshData> movedBall(Random& random, double scale, const Vec3& offset) {
  auto mesh = ballMesh(16, random);
  for (Vec3f& p : mesh->points) p = Vec3f(Vec3(p) * scale + offset);
  return mesh;
}

TEST(MeshTree, FindsWhatTestingEveryTriangleFinds) {
  Random random(1);
  int i = 0;
  for (const auto& [scale, offset] : {std::pair{1.0, Vec3{}},
                                      {1e-4, Vec3{}},
                                      {1e6, Vec3{}},
                                      {1.0, Vec3{1000, -500, 300}},
                                      {1e-3, Vec3{5, 5, 5}}}) {
    const auto mesh = movedBall(random, scale, offset);
    if (i++ % 2) addNeedles(*mesh, random, scale, offset);
    const MeshTree every(mesh, true);
    std::vector<std::unique_ptr<MeshTree>> trees;
    for (const MeshKernel& kernel : meshKernels())
      trees.push_back(std::make_unique<MeshTree>(mesh, false, 1, kernel));
    for (int k = 0; k < (kSanitized ? 200 : 2000); ++k) {
      // From near and from very far, through the ball, along axes, and exactly at vertices.
      const Real away = scale * std::pow(10, random.uniform(-1, 6));
      const Vec3 target =
          k % 4 == 0
              ? Vec3(mesh->points[static_cast<size_t>(random.below(static_cast<int>(mesh->points.size())))])
              : offset + random.inCube(1.2 * scale);
      Vec3 d = random.direction();
      if (k % 5 == 0) d = {k % 2 ? 1.0 : 0.0, k % 2 ? 0.0 : -1.0, 0};
      // Directions of any length: instances scale them. The longest and shortest leave the range of the
      // filter.
      const Ray ray{target - d * away,
                    d * std::pow(10, k % 7 == 0 ? random.uniform(-40, 40) : random.uniform(-1, 1))};
      const Real tMost = random.coin() ? kInfinity : random.uniform(0, 2 * away) / length(ray.direction);
      const auto odd = [](const MeshHit& met) { return met.triangle % 2 == 1; };
      for (const auto& tree : trees) {
        EXPECT_EQ(nearest(*tree, ray), nearest(every, ray));
        EXPECT_EQ(nearest(*tree, ray, odd), nearest(every, ray, odd));
        EXPECT_EQ(allHits(*tree, ray, tMost), allHits(every, ray, tMost));
      }
    }
  }
}

/// Rays from one eye, or from anywhere: along axes, through vertices, from inside, of unusual lengths.
std::array<Ray, RayPacket::kRays> packetAt(const MeshData& mesh, Random& random, int kind) {
  std::array<Ray, RayPacket::kRays> rays;
  const auto vertex = [&] {
    return Vec3(mesh.points[static_cast<size_t>(random.below(static_cast<int>(mesh.points.size())))]);
  };
  const Vec3 eye = kind % 3 == 0 ? random.inCube(0.5) : random.direction() * 3;
  const Vec3 target = kind % 2 ? vertex() : random.inCube(1.2);
  for (Ray& ray : rays) {
    ray = {eye, target + random.inCube(0.05) - eye};
    if (kind % 5 == 1) ray = {random.inCube(2), random.direction()};              // from anywhere
    if (kind % 5 == 2) ray.direction = vertex() - eye;                            // at vertices
    if (kind % 5 == 3) ray.direction[kind / 5 % 3] = random.coin() ? 0.0 : -0.0;  // across an axis
    if (kind % 7 == 3) ray.direction = {0, 0, random.coin() ? 1.0 : -1.0};        // along one
    if (kind % 11 == 3) ray.direction = ray.direction * std::pow(10, random.uniform(-40, 40));
  }
  if (kind % 13 == 3) rays[2].origin = rays[2].origin - rays[2].direction * 1e6;
  return rays;
}

using Packet = std::array<Ray, RayPacket::kRays>;
std::array<const Ray*, RayPacket::kRays> pointers(const Packet& rays) {
  std::array<const Ray*, RayPacket::kRays> all;
  for (std::size_t i = 0; i < rays.size(); ++i) all[i] = &rays[i];
  return all;
}

TEST(MeshTree, RaysTogetherFindWhatEachFindsAlone) {
  Random random(5);
  const auto mesh = ballMesh(24, random);
  addNeedles(*mesh, random);
  const MeshTree every(mesh, true);
  for (const MeshKernel& kernel : meshKernels()) {
    const MeshTree tree(mesh, false, 1, kernel);
    for (int k = 0; k < (kSanitized ? 500 : 5000); ++k) {
      const auto rays = packetAt(*mesh, random, k);
      const Real tMost = random.coin() ? kInfinity : random.uniform(0, 5);
      const auto lanes = k % 4 == 0 ? static_cast<unsigned>(random.below(256)) : 255u;
      std::array<MeshHit, RayPacket::kRays> best;
      for (MeshHit& hit : best) hit.hit.t = tMost;
      Counts counts;
      (k % 10 == 0 ? every : tree).closest(pointers(rays).data(), best.data(), lanes, counts.both());
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!(lanes >> i & 1)) continue;
        MeshHit alone;
        alone.hit.t = tMost;
        const bool found = (k % 5 == 0 ? every : tree).closest(rays[i], alone, nullptr, counts.both());
        ASSERT_EQ(best[i].triangle, alone.triangle) << kernel.name << ' ' << k;
        if (!found) continue;
        EXPECT_EQ(best[i].hit.t, alone.hit.t);
        EXPECT_TRUE(std::equal(std::begin(alone.hit.b), std::end(alone.hit.b), best[i].hit.b));
        EXPECT_EQ(best[i].hit.front, alone.hit.front);
      }
    }
  }
}

TEST(MeshTree, RaysOfNeighbouringPixelsVisitFewNodesTogether) {
  Random random(6);
  const auto mesh = ballMesh(60, random);
  const MeshTree tree(mesh, false);
  Counts together, alone;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; x += 8) {
      std::array<Ray, RayPacket::kRays> rays;
      std::array<MeshHit, RayPacket::kRays> best;
      for (int i = 0; i < 8; ++i) {
        const auto at = static_cast<std::size_t>(i);
        rays[at] = {{0.1, 0.2, 3}, {(x + i - 31.5) / 90, (y - 31.5) / 90, -1}};
        best[at].hit.t = kInfinity;
        MeshHit hit;
        hit.hit.t = kInfinity;
        tree.closest(rays[at], hit, nullptr, alone.both());
      }
      tree.closest(pointers(rays).data(), best.data(), 255, together.both());
    }
  EXPECT_LT(together.nodes.count, alone.nodes.count / 3);
  EXPECT_LT(static_cast<double>(together.triangles), 1.5 * static_cast<double>(alone.triangles));
}

TEST(MeshTree, NoRayEscapesThroughEdgesOrVertices) {
  // From inside a closed mesh, aimed exactly at vertices and at points of edges: an odd number of crossings.
  Random random(4);
  const auto ball = ballMesh(24, random);
  const MeshTree tree(ball, false);
  int escapes = 0;
  for (int i = 0; i < (kSanitized ? 20000 : 10000000); ++i) {
    const Triangle& t =
        ball->triangles[static_cast<size_t>(random.below(static_cast<int>(ball->triangles.size())))];
    const Vec3 a(ball->points[t[0]]), b(ball->points[t[1]]), inside = random.inCube(0.3);
    const Ray ray{inside, a + (b - a) * (i % 3 == 0 ? 0 : random.uniform()) - inside};
    int crossings = 0;
    Counts counts;
    tree.crossings(
        ray, kInfinity, [&](const MeshHit&) { return ++crossings, false; }, counts.both());
    escapes += crossings % 2 == 0;
  }
  EXPECT_EQ(escapes, 0);
}

TEST(MeshTree, AnyOrderStopsWhenTold) {
  Random random(2);
  const auto ball = ballMesh(20, random);
  for (const MeshKernel& kernel : meshKernels()) {
    const MeshTree tree(ball, false, 1, kernel);
    int calls = 0;
    Counts counts;
    tree.crossings(
        {{0, 0, 5}, {0.001, 0.002, -1}}, kInfinity, [&](const MeshHit&) { return ++calls == 1; },
        counts.both());
    EXPECT_EQ(calls, 1);
  }
}

TEST(Presplit, PartsCoverTheirTrianglesAndEvenMeshesStayWhole) {
  Random random(3);
  const auto ball = ballMesh(16, random);
  EXPECT_EQ(triangleParts(*ball).size(), ball->triangles.size());

  addNeedles(*ball, random, 1, {});
  const std::vector<BoxedItem> parts = triangleParts(*ball);
  EXPECT_GT(parts.size(), ball->triangles.size() * 105 / 100);
  EXPECT_LE(parts.size(), ball->triangles.size() * 125 / 100);
  EXPECT_EQ(triangleParts(*ball, true).size(), ball->triangles.size());
  for (int i = 0; i < 20000; ++i) {
    const auto triangle = static_cast<std::uint32_t>(random.below(static_cast<int>(ball->triangles.size())));
    const Corners v = corners(*ball, triangle);
    const double r = std::sqrt(random.uniform()), u = random.uniform();
    const Vec3 p = v.a * (1 - r) + v.b * (r * (1 - u)) + v.c * (r * u), slack{1e-12, 1e-12, 1e-12};
    bool covered = false;
    for (const auto& [low, item, high, note] : parts)
      covered =
          covered ||
          (item == triangle &&
           Box3{Vec3{low[0], low[1], low[2]} - slack, Vec3{high[0], high[1], high[2]} + slack}.contains(p));
    EXPECT_TRUE(covered);
  }
}

TEST(MeshTree, EmptyAndDegenerateMeshes) {
  for (bool brute : {false, true}) {
    auto mesh = std::make_shared<MeshData>();
    EXPECT_EQ(nearest(MeshTree(mesh, brute), {{}, {0, 0, 1}}).t, kInfinity);
    mesh->points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    mesh->triangles = {{0, 1, 2}, {0, 0, 0}};
    EXPECT_EQ(nearest(MeshTree(mesh, brute), {{}, {1, 1, 1}}).t, kInfinity);
  }
}

}  // namespace
}  // namespace trace::test
