// Motion blur: the moments while the shutter is open.
#include <gtest/gtest.h>

#include "app/document.h"
#include "app/session.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

/// A white square of 0.5 units that moves from x = -1 to x = 1 in a second, before black, 4 units wide.
constexpr const char* kMoving = R"(SBT-raytracer 1.0
settings { projection = orthographic; view-height = 1; height = 40; width = 160; transfer = linear; }
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); aspectratio = 4; }
translate(key((0, -1), (1, 1)), 0, 0, scale(0.5, 0.5, 1, square { material = { emissive = (1, 1, 1); }; }))
)";

Picture moved(const std::string& file, std::vector<Choice> choices) {
  Session session;
  session.open(file, choices);
  session.build();
  session.renderPicture();
  return session.picture();
}

std::string written(const Folder& folder, const char* text) {
  const std::string file = folder / "scene.ray";
  writeFile(file, text);
  return file;
}

Real sum(const Picture& picture) {
  Real total = 0;
  for (const Color& c : picture.pixels) total += c.g;
  return total;
}

TEST(Motion, LeavesAnEvenStreakOfItsLengthAndKeepsItsLight) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const Picture moving = moved(
      file, {{"shutter", "1", {}}, {"moments", "500", {}}, {"spp", "1024", {}}, {"sampling", "sobol", {}}});
  EXPECT_NEAR(sum(moving), 20 * 20, 4) << "the light of the square, which is 20 pixels wide";
  // 40 pixels a unit: the square covers every place from -0.75 to 0.75 for a quarter of the time.
  for (int x = 52; x < 108; ++x) EXPECT_NEAR(moving.at(x, 20).g, 0.25, 0.02) << x;
  EXPECT_EQ(moving.at(25, 20).g, 0);
  EXPECT_EQ(moving.at(135, 20).g, 0);
}

TEST(Motion, IsToldWhereAllKeysAreOver) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const auto told = [&](const char* time) {
    Session session;
    session.open(file, std::vector<Choice>{{"time", time, {}}, {"shutter", "0.5", {}}, {"moments", "3", {}}});
    session.build();
    std::string all;
    for (const Message& message : session.messages().all()) all += message.what;
    return all.find("nothing moves while the shutter is open") != std::string::npos;
  };
  EXPECT_FALSE(told("0.9"));
  EXPECT_TRUE(told("1"));
}

TEST(Motion, HasTheSameBitsForAnyNumberOfThreadsAndIsExplained) {
  const Folder folder;
  const std::string file = written(folder, kMoving);
  const std::vector<Choice> choices{{"shutter", "1", {}}, {"moments", "9", {}}, {"spp", "4", {}}};
  std::vector<Choice> one = choices, seven = choices;
  one.push_back({"threads", "1", {}});
  seven.push_back({"threads", "7", {}});
  const Picture picture = moved(file, one);
  EXPECT_EQ(picture, moved(file, seven));

  Session session;
  session.open(file, choices);
  session.build();
  int moved = 0;
  for (int x = 40; x < 120; x += 3)
    for (int k = 0; k < 4; ++k) {
      const Explanation e = session.explain(x, 20, k);
      EXPECT_TRUE(sumsUp(e.tree));
      EXPECT_EQ(e.pixel, picture.at(x, 20));
      ASSERT_GE(e.tree.moment, 0);
      ASSERT_LT(e.tree.moment, 9);
      moved += e.tree.moment != 0;
    }
  EXPECT_GT(moved, 60);
}

TEST(Motion, OfNothingIsToldAndChangesNothing) {
  const Folder folder;
  const std::string file = written(folder, "SBT-raytracer 1.0\nambient_light { color = 1; }\nsphere { }\n");
  Session session;
  session.open(file, std::vector<Choice>{{"shutter", "1", {}}});
  session.build();
  EXPECT_NE(session.messages().all().back().what.find("nothing in the scene changes with time"),
            std::string::npos);
  EXPECT_EQ(moved(file, {{"shutter", "1", {}}}), moved(file, {}));
}

TEST(Motion, OfChangingNumbersOfObjectsIsRefused) {
  const Folder folder;
  const std::string file = written(folder, R"(SBT-raytracer 1.0
translate(key((0, 0), (1, 1)), 0, 0, sphere { })
particles { count = key((0, 5), (1, 50)); }
)");
  Session session;
  try {
    session.open(file, std::vector<Choice>{{"shutter", "1", {}}});
    session.build();
    const std::size_t first = session.scene().objects.size();
    for (const Moment& moment : session.moments()) EXPECT_EQ(moment.world->objectCount(), first);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("while the shutter is open"), std::string::npos) << error.what();
  }
}

TEST(Motion, OfAnEditedSceneHasTheEdits) {
  const Folder folder;
  Document document;
  document.open(written(folder, kMoving));
  ASSERT_TRUE(document.sceneAt());
  EXPECT_EQ(document.sceneAt()(0.5).objects[0].worldFromObject.offset.x, 0);
  Scene scene = document.scene();
  scene.objects[0].name = "edited";
  document.edit("name", scene);
  const SceneAt sceneAt = document.sceneAt();
  EXPECT_EQ(sceneAt(0.5).objects[0].name, "edited");
  EXPECT_EQ(sceneAt(0.5).objects[0].worldFromObject.offset.x, 0);
  EXPECT_EQ(sceneAt(1).objects[0].worldFromObject.offset.x, 1);
}

}  // namespace
}  // namespace trace::test
