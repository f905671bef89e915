#include "app/view/way_pyramid.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "image/srgb.h"
#include "support/panes.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

using WayPyramidTest = Files;

std::shared_ptr<Session> bowl(const std::string& file, const std::string& integrator,
                              const std::vector<Choice>& choices = {}) {
  writeFile(file, "SBT-raytracer 1.0\nsettings { integrator = " + integrator +
                      "; depth = 1; width = 12; spp = 16; sampling = sobol; }\n"
                      "camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }\n"
                      "translate(0, 1.5, 1, scale(0.5, sphere { material = { emissive = (4, 3, 2) } }))\n"
                      "sphere { material = { diffuse = (0.7, 0.7, 0.7) } }\n");
  auto session = std::make_shared<Session>();
  session->open(file, choices);
  session->build();
  return session;
}

double lightIn(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels) sum += luminanceOf(c);
  return sum;
}

double lightOf(const Pyramid& pyramid) {
  double sum = 0;
  for (const WayPicture& each : pyramid.pictures) sum += lightIn(each.picture);
  return sum;
}

TEST_F(WayPyramidTest, ItsPicturesAddUpToThePicture) {
  const auto session = bowl(path("bowl.ray"), "bdpt");
  session->renderPicture();
  const Pyramid pyramid = wayPyramid({session, false, 3});
  ASSERT_EQ(pyramid.problem, "");
  ASSERT_EQ(pyramid.pictures.size(), 5u);
  const Picture whole = session->film().picture();
  for (int y = 0; y < whole.height; ++y)
    for (int x = 0; x < whole.width; ++x) {
      Color sum;
      for (const WayPicture& each : pyramid.pictures) sum += each.picture.at(x, y);
      for (const auto part : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(sum.*part, whole.at(x, y).*part, 1e-6) << x << " " << y;
    }
  EXPECT_NEAR(pyramid.longer, 0, 1e-9) << "depth 1 has none";
}

TEST_F(WayPyramidTest, WhatLongerPathsBringIsTheRestOfThePicturesLight) {
  const auto session = bowl(path("bowl.ray"), "bdpt", {{"depth", "3", {}}});
  const double light = lightOf(wayPyramid({session, false, 5})),
               shorter = lightOf(wayPyramid({session, false, 2}));
  ASSERT_LT(shorter, 0.95 * light);
  EXPECT_NEAR(wayPyramid({session, false, 5}).longer, 0, 1e-9);
  EXPECT_NEAR(wayPyramid({session, false, 2}).longer, 1 - shorter / light, 1e-9);
  EXPECT_EQ(wayPyramid({session, true, 2}).longer, 0) << "they do not add up";
}

TEST_F(WayPyramidTest, OneAloneIsTheSameWayLarger) {
  const auto session = bowl(path("bowl.ray"), "bdpt", {{"width", "200", {}}, {"spp", "4", {}}});
  const Way asked{1, 2};
  const Pyramid alone = wayPyramid({session, false, 0, asked});
  ASSERT_EQ(alone.pictures.size(), 1u);
  EXPECT_EQ(alone.pictures[0].way, asked);
  EXPECT_EQ(alone.pictures[0].picture.width, 200);
  EXPECT_EQ(alone.longer, 0);
  const WayPicture small = wayPyramid({session, false, 3}).pictures[3];
  ASSERT_EQ(small.way, asked);
  const double pixels = static_cast<double>(alone.pictures[0].picture.pixels.size()) /
                        static_cast<double>(small.picture.pixels.size());
  EXPECT_NEAR(lightIn(alone.pictures[0].picture) / lightIn(small.picture) / pixels, 1, 0.1);
}

TEST_F(WayPyramidTest, OtherIntegratorsHaveNone) {
  EXPECT_TRUE(wayPyramid({bowl(path("bowl.ray"), "path"), false, 3}).pictures.empty());
}

void finish(PyramidMaker& maker) {
  while (maker.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  maker.update();
}

TEST_F(WayPyramidTest, IsMadeAnewOnlyIfItsPicturesWouldDiffer) {
  PyramidMaker maker;
  EXPECT_FALSE(maker.current());
  const std::string file = path("bowl.ray");
  maker.want({bowl(file, "bdpt"), false, 3});
  EXPECT_FALSE(maker.current());
  finish(maker);
  EXPECT_TRUE(maker.current());
  ASSERT_EQ(maker.pyramid().pictures.size(), 5u);
  const auto first = maker.pyramid().plan.session;
  maker.want({bowl(file, "bdpt", {{"light-vertices", "1", {}}, {"camera-vertices", "2", {}}}), false, 3});
  EXPECT_FALSE(maker.busy());
  maker.want({});  // nothing is being made
  EXPECT_FALSE(maker.busy());
  EXPECT_FALSE(maker.current());
  maker.want({bowl(file, "bdpt", {{"spp", "4", {}}}), false, 3});
  EXPECT_FALSE(maker.busy());
  EXPECT_TRUE(maker.current());
  for (const bool unweighted : {true, false}) {
    maker.want({bowl(file, "bdpt", {{"depth", "2", {}}}), unweighted, 3});
    EXPECT_FALSE(maker.current()) << "what is there is as it was";
    finish(maker);
    EXPECT_TRUE(maker.current());
    EXPECT_NE(maker.pyramid().plan.session, first);
    EXPECT_EQ(maker.pyramid().plan.unweighted, unweighted);
  }
}

/// Its smallest picture takes hours: light goes to and fro between mirrors that scatter.
std::shared_ptr<Session> slowRoom(const std::string& file) {
  writeFile(file,
            "SBT-raytracer 1.0\nsettings { integrator = bdpt; depth = 1000; width = 200; }\n"
            "camera { position = (0, 0, 0); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }\n"
            "translate(0, 1, 0, scale(0.1, sphere { material = { emissive = (4, 3, 2) } }))\n"
            "scale(6, sphere { material = { diffuse = (1, 1, 1) } })\n");
  auto session = std::make_shared<Session>();
  session->open(file, {});
  session->build();
  return session;
}

TEST_F(WayPyramidTest, APictureInWorkIsGivenUpAtOnce) {
  PyramidMaker maker;
  const PyramidPlan plan{bowl(path("bowl.ray"), "bdpt"), false, 3};
  maker.want(plan);
  finish(maker);
  const auto slow = slowRoom(path("slow.ray"));
  for (const PyramidPlan& other : {PyramidPlan{}, plan}) {
    maker.want({slow, false, 3});
    EXPECT_TRUE(maker.busy());
    EXPECT_FALSE(maker.current());
    maker.want(other);
    finish(maker);
    EXPECT_EQ(maker.current(), other == plan);
    EXPECT_EQ(maker.pyramid().plan, plan);
  }
  EXPECT_EQ(maker.pyramid().pictures.size(), 5u);
}

}  // namespace
}  // namespace trace::test
