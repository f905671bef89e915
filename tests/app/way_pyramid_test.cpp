#include "app/way_pyramid.h"

#include <gtest/gtest.h>

#include "support/panes.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

using WayPyramidTest = Files;

std::shared_ptr<Session> bowl(const std::string& file, const std::string& integrator) {
  writeFile(file, "SBT-raytracer 1.0\nsettings { integrator = " + integrator +
                      "; depth = 1; width = 12; spp = 16; sampling = sobol; }\n"
                      "camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }\n"
                      "translate(0, 1.5, 1, scale(0.5, sphere { material = { emissive = (4, 3, 2) } }))\n"
                      "sphere { material = { diffuse = (0.7, 0.7, 0.7) } }\n");
  auto session = std::make_shared<Session>();
  session->open(file, {});
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

}  // namespace
}  // namespace trace::test
