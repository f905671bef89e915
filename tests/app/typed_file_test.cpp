// Files that are typed for an option.
#include "app/editing/typed_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::test {
namespace {

TEST(TypedFile, CountsFromTheFolderOfTheScene) {
  const Folder folder;
  std::filesystem::create_directories(folder / "pictures");
  std::ofstream(folder / "pictures/dusk.png") << "no picture";
  const std::string scene = folder / "scene.ray";
  const std::string file = typedFile("pictures/dusk.png", "backdrop", scene);
  EXPECT_EQ(file, folder / "pictures/dusk.png");
  EXPECT_EQ(shownFile(file, scene), "pictures/dusk.png");
  EXPECT_EQ(typedFile(file, "backdrop", "elsewhere.ray"), file);
  EXPECT_EQ(shownFile(file, folder / "pictures/other/scene.ray"), file);
  EXPECT_EQ(typedFile("", "backdrop", scene), "none");
  EXPECT_EQ(shownFile("none", scene), "");
  try {
    typedFile("dusk.png", "backdrop", scene);
    FAIL() << "there is no such file";
  } catch (const Error& error) {
    EXPECT_EQ(error.messages().front().what,
              "backdrop: expected a file, found \"dusk.png\", which does not exist; not accepted");
  }
  std::ofstream(folder / "odd\".png") << "no picture";
  EXPECT_THROW(typedFile("odd\".png", "backdrop", scene), Error) << "no scene could name it";
}

}  // namespace
}  // namespace trace::test
