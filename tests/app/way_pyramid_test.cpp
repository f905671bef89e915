#include "app/way_pyramid.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

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

TEST_F(WayPyramidTest, ItsPicturesAddUpToThePicture) {
  const auto session = bowl(path("bowl.ray"), "bdpt");
  session->renderPicture();
  const Pyramid pyramid = wayPyramid(session, false, 3);
  ASSERT_EQ(pyramid.problem, "");
  ASSERT_EQ(pyramid.pictures.size(), 5u);
  const Picture whole = session->film().picture();
  for (int y = 0; y < whole.height; ++y)
    for (int x = 0; x < whole.width; ++x) {
      Color sum;
      for (const WayPicture& way : pyramid.pictures) sum += way.picture.at(x, y);
      for (const auto part : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(sum.*part, whole.at(x, y).*part, 1e-6) << x << " " << y;
    }
}

TEST_F(WayPyramidTest, OtherIntegratorsHaveNone) {
  EXPECT_TRUE(wayPyramid(bowl(path("bowl.ray"), "path"), false, 3).pictures.empty());
}

void finish(PyramidMaker& maker) {
  while (maker.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  maker.update();
}

TEST_F(WayPyramidTest, IsMadeAnewOnlyIfItsPicturesWouldDiffer) {
  PyramidMaker maker;
  const std::string file = path("bowl.ray");
  maker.want(bowl(file, "bdpt"), false, 3);
  finish(maker);
  ASSERT_EQ(maker.pyramid().pictures.size(), 5u);
  const auto first = maker.pyramid().session;
  maker.want(bowl(file, "bdpt", {{"light-vertices", "1", {}}, {"camera-vertices", "2", {}}}), false, 3);
  EXPECT_FALSE(maker.busy());
  maker.want(bowl(file, "bdpt", {{"spp", "4", {}}}), false, 3);
  EXPECT_FALSE(maker.busy());
  maker.giveUp();  // nothing is being made
  EXPECT_FALSE(maker.busy());
  for (const bool unweighted : {true, false}) {
    maker.want(bowl(file, "bdpt", {{"depth", "2", {}}}), unweighted, 3);
    finish(maker);
    EXPECT_NE(maker.pyramid().session, first);
    EXPECT_EQ(maker.pyramid().unweighted, unweighted);
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
  maker.want(bowl(path("bowl.ray"), "bdpt"), false, 3);
  finish(maker);
  const auto shown = maker.pyramid().session;
  maker.want(slowRoom(path("slow.ray")), false, 3);
  EXPECT_TRUE(maker.busy());
  maker.giveUp();
  finish(maker);
  EXPECT_EQ(maker.pyramid().session, shown);
  EXPECT_EQ(maker.pyramid().pictures.size(), 5u);
}

}  // namespace
}  // namespace trace::test
