#include "app/session/cost_map.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "geometry/shapes/solids/sphere.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

/// Two mirrors that face each other on the left of the picture.
std::shared_ptr<const Session> mirrors(int threads = 2) {
  Scene scene;
  for (const Real x : {-1.6, -0.4}) {
    Phong mirror;
    mirror.reflective = Color(0.9);
    addObject(scene, Sphere{}, Affine::translation({x, 0, 0}) * Affine::scaling({0.5, 0.5, 0.5}), mirror);
  }
  scene.camera.position = {0, 0, 6};
  Settings settings{.width = 40, .height = 30};
  settings.threads = threads;
  auto session = std::make_shared<Session>();
  session->open(scene, settings);
  session->build();
  return session;
}

TEST(CostMap, SaysHowManyTestsASampleTakes) {
  const auto session = mirrors();
  const CostMap map = costMap(session, 1);
  ASSERT_EQ(map.tests.width, 40);
  ASSERT_EQ(map.tests.height, 30);
  EXPECT_GT(map.tests.at(0, 0).r, 0) << "the background is looked for";
  double onMirrors = 0;
  for (int x = 0; x < 20; ++x) onMirrors = std::max(onMirrors, map.tests.at(x, 15).r);
  EXPECT_GT(onMirrors, map.tests.at(39, 0).r) << "reflections are more rays";
}

TEST(CostMap, HasTheSameNumbersForAnyNumberOfThreads) {
  EXPECT_EQ(costMap(mirrors(1), 1).tests.pixels, costMap(mirrors(3), 1).tests.pixels);
}

TEST(CostMap, IsCoarseInBlocksAndEmptyWhenGivenUp) {
  const CostMap coarse = costMap(mirrors(), 8);
  ASSERT_EQ(coarse.tests.width, 40);
  EXPECT_EQ(coarse.tests.at(0, 0), coarse.tests.at(7, 7));
  EXPECT_EQ(costMap(mirrors(), 1, [] { return true; }).tests.width, 0);
}

TEST(CostMap, BecomesExactInTheBackground) {
  const auto session = mirrors();
  CostMaker maker;
  maker.want(session);
  while (maker.map().session == nullptr || maker.map().block > 1) {
    maker.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(maker.map().tests.pixels, costMap(session, 1).tests.pixels);
  maker.want(nullptr);
  EXPECT_EQ(maker.map().session, nullptr);
}

}  // namespace
}  // namespace trace::test
