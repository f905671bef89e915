// Photons along edges and under things are as bright as elsewhere: photon is checked against path, whose
// mean and tiles it keeps, in rooms of separate squares and of one mesh, and around balls.
#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/sphere.h"
#include "render/picture/agreement.h"
#include "support/rooms.h"

namespace trace::test::photon_edges_test {
namespace {

Affine ceilingLamp() {
  return Affine::translation({0, 0.98, 0}) * turned({1, 0, 0}, 0.5) * Affine::scaling({0.7, 0.7, 1});
}

/// A room of which the camera sees the lower left edges and the corner where they meet.
Scene intoTheCorner(Scene scene) {
  addObject(scene, Square{}, ceilingLamp(), diffuse(0.5, 6));
  scene.camera.position = {0.4, 0.3, 2};
  scene.camera.viewdir = {-1.2, -1.1, -2.7};
  scene.camera.fov = 14;
  return scene;
}

/// The walls of openRoom() as one mesh.
Scene meshRoom() {
  MeshData data;
  for (int n = 0; n < 8; ++n)
    data.points.push_back({n & 1 ? 1.0f : -1.0f, n & 2 ? 1.0f : -1.0f, n & 4 ? 1.0f : -1.0f});
  const auto wall = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    data.triangles.push_back({a, b, c});
    data.triangles.push_back({a, c, d});
  };
  wall(0, 1, 3, 2), wall(0, 4, 5, 1), wall(2, 3, 7, 6), wall(0, 2, 6, 4), wall(1, 5, 7, 3);
  Scene scene;
  addObject(scene, Mesh{std::make_shared<MeshData>(data)}, {}, diffuse(0.7));
  return scene;
}

/// A ball so high above a floor; below a lamp, or a sky that is bright on one side.
Scene ballScene(Real above, bool sky) {
  Scene scene;
  addObject(scene, Square{}, turned({1, 0, 0}, -0.5) * Affine::scaling({6, 6, 1}), diffuse(0.7));
  addObject(scene, Sphere{}, Affine::translation({0, 0.5 + above, 0}) * scaled(0.5), diffuse(0.7));
  if (sky)
    scene.background.gradient = {{Color(0.2, 0.25, 0.3), Color(1, 0.9, 0.8)}};
  else
    addObject(scene, Square{}, Affine::translation({0.8, 3, 0.6}) * turned({1, 0, 0}, 0.5), diffuse(0, 8));
  scene.camera.position = {0.3, 0.7, 2.5};
  scene.camera.viewdir = {-0.3, -0.5, -2.5};
  scene.camera.fov = 18;
  return scene;
}

/// A small ball in the middle of a room that shines evenly.
Scene ballInARoom() {
  Scene scene;
  addRoom(scene, diffuse(0.7, 1));
  addObject(scene, Sphere{}, scaled(0.15), diffuse(0.9));
  scene.camera.position = {0, 0, 0.9};
  scene.camera.fov = 8;
  return scene;
}

/// The mean within 0.3 %, and no tile beyond 3 %, but for noise.
void expectNoEdges(const Scene& scene, int photons = 100'000, int seeds = 4) {
  constexpr int kTile = 16;
  constexpr double kMean = 0.003, kTiles = 0.03, kErrors = 3, kLeast = 0.01;
  Settings path;
  path.sampling = SampleKind::sobol;
  path.width = path.height = 32;
  path.depth = 12;
  Settings photon = path;
  path.integrator = IntegratorKind::path, path.spp = 64;
  photon.integrator = IntegratorKind::photon, photon.spp = 32, photon.photons = photons;
  const Agreement a = agreement(scene, path, photon, seeds, kTile, kTiles);
  EXPECT_NEAR(a.meanB / a.meanA, 1, kMean + kErrors * a.error / a.meanA) << "error " << a.error / a.meanA;
  EXPECT_GT(a.least, kLeast);
}

TEST(PhotonEdges, OfARoomOfSquares) { expectNoEdges(intoTheCorner(openRoom(Color(0.7)))); }
TEST(PhotonEdges, OfARoomThatIsOneMesh) { expectNoEdges(intoTheCorner(meshRoom())); }
TEST(PhotonEdges, UnderABallOnAFloor) { expectNoEdges(ballScene(0, false)); }
TEST(PhotonEdges, UnderABallCloseAboveAFloor) { expectNoEdges(ballScene(0.03, false)); }
TEST(PhotonEdges, OnABallUnderASky) { expectNoEdges(ballScene(0.5, true)); }
// So few that their disks are as large as the ball: what it throws on the floor comes by paths.
TEST(PhotonEdges, UnderABallWithFewPhotons) { expectNoEdges(ballScene(0.5, true), 5000, 8); }
TEST(PhotonEdges, OfARoomWithFewPhotons) { expectNoEdges(intoTheCorner(openRoom(Color(0.7))), 5000, 8); }
// Light that grazes a ball beside a place comes from below the horizon of the place.
TEST(PhotonEdges, OnASmallBallInARoomThatShines) { expectNoEdges(ballInARoom(), 30000, 8); }

}  // namespace
}  // namespace trace::test::photon_edges_test
