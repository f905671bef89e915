// The rays of a clicked pixel come in the background; the last pixel wanted is the one that stays.
#include "app/explain/pixel_inspector.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>

#include "geometry/shapes/solids/sphere.h"
#include "shading/lights/directional_light.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

std::shared_ptr<const Session> sessionOf(const Settings& settings) {
  Scene scene;
  Phong mirror;
  mirror.reflective = Color(0.5), mirror.diffuse = Color(0.3);
  addObject(scene, Sphere{}, {}, mirror);
  Phong sky;
  sky.emissive = Color(0.2);
  addObject(scene, Sphere{}, Affine::scaling({50, 50, 50}), sky);
  scene.lights.push_back({DirectionalLight{.direction = {0, -1, -1}, .color = Color(1)}, {}});
  scene.camera.position = {0, 0, 6};
  auto session = std::make_shared<Session>();
  session->open(scene, settings);
  session->build();
  return session;
}

void waitFor(PixelInspector& inspector) {
  while (inspector.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  inspector.update();
}

TEST(PixelInspector, AnswersWhatTheSessionWouldAndTracesNothingTwice) {
  const auto session = sessionOf({.width = 40, .spp = 4});
  PixelInspector inspector;
  EXPECT_EQ(inspector.traced(), nullptr);
  inspector.want(session, 20, 20, 1);
  waitFor(inspector);
  const TracedPixel* pixel = inspector.traced();
  ASSERT_NE(pixel, nullptr);
  EXPECT_EQ(pixel->problem, "");
  const Explanation expected = session->explain(20, 20, 1);
  EXPECT_EQ(pixel->explanation.pixel, expected.pixel);
  EXPECT_EQ(pixel->explanation.samples, expected.samples);
  ASSERT_EQ(pixel->tree().nodes.size(), expected.tree.nodes.size());
  EXPECT_EQ(pixel->segments.size(), expected.tree.nodes.size());
  EXPECT_EQ(pixel->level.front(), 0);
  EXPECT_EQ(pixel->hasChildren.front(), 1);

  inspector.want(session, 20, 20, 1);  // as it is
  EXPECT_FALSE(inspector.busy());
  inspector.want(session, 20, 20, 99);  // the last one that there is
  waitFor(inspector);
  EXPECT_EQ(inspector.traced()->sample, 3);
}

TEST(PixelInspector, TheLastPixelWantedStaysHoweverSlowTheFirst) {
  const auto slow = sessionOf({.width = 40, .spp = 1000000, .depth = 8});
  const auto session = sessionOf({.width = 40});
  PixelInspector inspector;
  inspector.want(slow, 20, 20, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));  // it is under way
  EXPECT_TRUE(inspector.busy());
  for (int x = 0; x < 40; ++x) inspector.want(session, x, 20, 0);
  waitFor(inspector);
  EXPECT_EQ(inspector.traced()->session, session);
  EXPECT_EQ(inspector.traced()->x, 39);
  inspector.want(slow, 20, 20, 0);  // given up when the inspector goes
}

TEST(PixelInspector, AProblemIsKeptInWords) {
  const auto session = sessionOf({.width = 40});
  PixelInspector inspector;
  inspector.want(session, 400, 20, 0);
  waitFor(inspector);
  EXPECT_NE(inspector.traced()->problem.find("400"), std::string::npos);
  inspector.pin(true);
  waitFor(inspector);
  EXPECT_EQ(inspector.pinned(), nullptr);
}

TEST(PixelInspector, ComparesWithThePinnedRaysUntilTheyAreLetGo) {
  const auto deep = sessionOf({.width = 40, .depth = 5}), flat = sessionOf({.width = 40, .depth = 0});
  PixelInspector inspector;
  inspector.want(deep, 21, 20, 0);
  waitFor(inspector);
  inspector.pin(true);
  waitFor(inspector);
  EXPECT_EQ(inspector.pinned(), inspector.traced());
  ASSERT_FALSE(inspector.pairs().empty());
  EXPECT_FALSE(inspector.pairs().front().differs);

  inspector.want(flat, 21, 20, 0);
  waitFor(inspector);
  EXPECT_EQ(inspector.pinned()->session, deep);
  EXPECT_EQ(inspector.traced()->session, flat);
  EXPECT_TRUE(inspector.pairs().front().differs);
  EXPECT_EQ(inspector.pairs().size(), inspector.pinned()->tree().nodes.size());

  inspector.pin(false);
  waitFor(inspector);
  EXPECT_EQ(inspector.pinned(), nullptr);
  EXPECT_TRUE(inspector.pairs().empty());
}

TEST(PixelInspector, ShowsNothingWhenNoPixelIsWantedAnyMore) {
  const auto session = sessionOf({.width = 40});
  PixelInspector inspector;
  inspector.want(nullptr, 0, 0, 0);
  EXPECT_FALSE(inspector.busy());
  inspector.want(session, 20, 20, 0);
  waitFor(inspector);
  inspector.pin(true);
  inspector.want(nullptr, 0, 0, 0);
  waitFor(inspector);
  EXPECT_EQ(inspector.traced(), nullptr);
  EXPECT_NE(inspector.pinned(), nullptr);
  inspector.want(session, 20, 20, 0);
  waitFor(inspector);
  EXPECT_NE(inspector.traced(), nullptr);
}

TEST(PixelInspector, AnExplanationThatNobodyWantsIsGivenUp) {
  const auto session = sessionOf({.width = 40, .spp = 100});
  int asked = 0;
  const Explanation cut = session->explain(20, 20, 0, [&] { return ++asked > 3; });
  EXPECT_EQ(cut.samples.size(), 3u);
}

TEST(PixelInspector, ForgetsPinnedRaysWithTheScene) {
  const auto session = sessionOf({.width = 40});
  PixelInspector inspector;
  inspector.want(session, 20, 20, 0);
  waitFor(inspector);
  inspector.pin(true);
  waitFor(inspector);
  ASSERT_NE(inspector.pinned(), nullptr);
  inspector.want(session, 21, 20, 0);  // an answer with the pinned rays is on its way
  inspector.forget();
  EXPECT_EQ(inspector.pinned(), nullptr);
  EXPECT_EQ(inspector.traced(), nullptr);
  waitFor(inspector);
  EXPECT_EQ(inspector.pinned(), nullptr);
  EXPECT_TRUE(inspector.pairs().empty());
  inspector.want(session, 22, 20, 0);
  waitFor(inspector);
  EXPECT_NE(inspector.traced(), nullptr);
  EXPECT_EQ(inspector.pinned(), nullptr);
}

}  // namespace
}  // namespace trace::test
