// The scenes of the studio's start page.
#include "app/view/examples.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/session/session.h"
#include "base/files/file.h"
#include "scene/integrators.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::test {
namespace {

TEST(StartPage, HasLessonsAndScenesThatCanBeRendered) {
  const std::string folder = sourceFolder() + "/scenes";
  const std::vector<ExampleScene> lessons = lessonsIn(folder), scenes = examplesIn(folder);
  EXPECT_EQ(lessons.size(), 4u);
  EXPECT_EQ(scenes.size(), 7u);
  const std::vector<ExampleScene> integrators = integratorScenesIn(folder);
  for (const ExampleScene& scene : integrators) {
    Session session;
    session.open(scene.file, {});
    EXPECT_EQ(scene.title, rowOf(session.settings()).name) << scene.file;
  }
  for (const auto& list : {lessons, integrators, scenes})
    for (const ExampleScene& scene : list) {
      const Bytes picture = thumbnail(scene.file, 32);
      EXPECT_EQ(picture.width, 32) << scene.file;
      EXPECT_FALSE(scene.title.empty() || scene.about.empty());
    }
}

TEST(StartPage, WithoutAFolderItHasNone) {
  EXPECT_TRUE(lessonsIn("").empty());
  EXPECT_TRUE(examplesIn("/nothing").empty());
  EXPECT_EQ(examplesFolder("/nothing/bin/ray-studio"), "");
  EXPECT_EQ(thumbnail("/nothing.ray", 32).width, 0);
}

TEST(StartPage, FindsTheScenesOfAnInstallation) {
  const Folder folder;
  std::filesystem::create_directories(folder / "share/doc/trace-ray/scenes");
  std::filesystem::create_directories(folder / "libexec/trace-ray");
  writeFile(folder / "share/doc/trace-ray/scenes/shapes.ray", "Trace 1\n");
  EXPECT_EQ(examplesFolder(folder / "libexec/trace-ray/ray-studio"), folder / "share/doc/trace-ray/scenes");
}

TEST(StartPage, FindsTheScenesOfACheckout) {
  EXPECT_EQ(examplesFolder(sourceFolder() + "/build/release/bin/ray-studio"), sourceFolder() + "/scenes");
}

}  // namespace
}  // namespace trace::test
