// Backdrops and environments from files: which are found, what is told of those that are not, and what is
// read once.
#include "scene/surroundings.h"

#include <gtest/gtest.h>

#include "base/files/file.h"
#include "scene/scene.h"
#include "support/exr.h"
#include "support/folder.h"

namespace trace::test {
namespace {

std::string pictureOf(const std::string& path, int width, int height, const Color& color) {
  Picture picture(width, height);
  for (Color& c : picture.pixels) c = color;
  writePicture(path, picture);
  return path;
}

/// What the choices of a scene and of a command line make of the surroundings.
struct Read {
  Scene scene;
  Messages messages;

  Read(std::vector<Choice> ofScene, std::vector<Choice> commandLine, const Surroundings* before = nullptr) {
    scene.choices = std::move(ofScene);
    readSurroundings(scene, resolve({scene.choices, commandLine}), {}, messages, before);
  }
  const Surroundings* operator->() const { return &scene.surroundings; }
};

TEST(Surroundings, NothingIsReadWhereNothingIsNamed) {
  const Read read({}, {});
  EXPECT_EQ(read->backdrop, nullptr);
  EXPECT_EQ(read->environment, nullptr);
  EXPECT_TRUE(read.scene.inputs.all().empty());
}

TEST(Surroundings, PicturesAreReadAndNoted) {
  const Folder folder;
  const std::string back = pictureOf(folder / "back.png", 3, 2, Color(1, 0, 0));
  const std::string sky = pictureOf(folder / "sky.png", 8, 4, Color(0, 0, 1));
  const Read read({}, {{"backdrop", back, {}}, {"environment", sky, {}}});
  ASSERT_TRUE(read->backdrop && read->environment);
  EXPECT_EQ(read->backdrop->width, 3);
  EXPECT_EQ(read->environment->kind(), EnvironmentKind::latLong);
  EXPECT_EQ(read->environment->at(Vec3{0, 1, 0}), Color(0, 0, 1));
  ASSERT_EQ(read.scene.inputs.all().size(), 2u);
  for (const InputFile& file : read.scene.inputs.all()) EXPECT_TRUE(file.read) << file.path;
}

TEST(Surroundings, ALayerIsChosenByName) {
  const Folder folder;
  const std::string file = folder / "sky.exr";
  writeFile(file, layeredExr(8, 4));
  const Read left({}, {{"environment", file + ":left", {}}, {"backdrop", file + ":shine", {}}});
  ASSERT_TRUE(left->backdrop && left->environment);
  EXPECT_EQ(left->environment->at(Vec3{0, 1, 0}), Color(2, 0, 0));
  EXPECT_EQ(left->backdrop->at(0, 0), Color(3, 0, 0));
  EXPECT_TRUE(left.messages.all().empty());
  for (const InputFile& input : left.scene.inputs.all()) EXPECT_EQ(input.path, file);
  const Read unnamed({}, {{"environment", file, {}}});
  ASSERT_EQ(unnamed.messages.all().size(), 1u);
  EXPECT_NE(unnamed.messages.all()[0].what.find("its layers are not shown: left"), std::string::npos);
}

TEST(Surroundings, AFolderOfFacesIsACubeAndSoIsOneOfThem) {
  const Folder folder;
  const char* names[6]{"posx", "negx", "posy", "negy", "negz", "posz"};  // in the order of kFaceNames
  for (int i = 0; i < 6; ++i) {
    pictureOf(folder / ("a_" + std::string(names[i]) + ".png"), 4, 4, Color(i / 5.0));
    pictureOf(folder / ("b_" + std::string(names[i]) + ".png"), 4, 4, Color(0));
  }
  writeFile(folder / "posx.txt", "no picture");
  const Vec3 axes[6]{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const std::string& name : {folder.path(), folder / "a_negy.png"}) {
    const Read read({}, {{"environment", name, {}}});
    ASSERT_EQ(read->environment->kind(), EnvironmentKind::cube) << name;
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(read->environment->at(axes[i]).r, i / 5.0, 1e-12) << name << i;
    EXPECT_EQ(read.scene.inputs.all().size(), 6u);
  }
  EXPECT_EQ(Read({}, {{"environment", folder / "b_posx.png", {}}})->environment->at(axes[5]), Color(0));
  // Told to be no cube it is none.
  const Read one({}, {{"environment", folder / "a_negy.png", {}}, {"environment-kind", "angular", {}}});
  EXPECT_EQ(one->environment->kind(), EnvironmentKind::angular);
}

TEST(Surroundings, WhatTheCommandLineNamesAndIsNoPictureIsAnErrorWithAHint) {
  const Folder folder;
  writeFile(folder / "broken.png", "\x89PNG\r\n\x1a\n and no more");
  const std::string square = pictureOf(folder / "square.png", 5, 5, Color(1));
  std::filesystem::create_directory(folder / "empty");
  const auto wrong = [&](std::vector<Choice> choices, const char* expected) {
    try {
      const Read read({}, choices);
      ADD_FAILURE() << expected;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::io);
      const Message& message = error.messages().front();
      EXPECT_NE(message.what.find(expected), std::string::npos) << message.what;
      EXPECT_FALSE(message.hint.empty()) << message.what;
    }
  };
  for (const char* option : {"backdrop", "environment"}) {
    const std::string flag = "--" + std::string(option) + ": ";
    wrong({{option, folder / "missing.png", {}}},
          (flag + "cannot read \"" + folder.path() + "/missing.png\"").c_str());
    wrong({{option, folder / "broken.png", {}}},
          (flag + "cannot read \"" + folder.path() + "/broken.png\"").c_str());
  }
  wrong({{"backdrop", folder.path(), {}}}, "--backdrop: ");
  wrong({{"environment", folder / "empty", {}}},
        "expected six pictures of the faces of a cube, found none for: right, left, up, down, back, front");
  wrong({{"environment", square, {}}, {"environment-kind", "cube", {}}}, "4 x 3 or 3 x 4 squares");
}

TEST(Surroundings, WhatTheSceneNamesAndIsMissingIsAWarningAndAChecker) {
  const SourcePlace place{.file = "nowhere/scene.ray", .line = 7};
  const Read read({{"backdrop", "a.png", place}, {"environment", "b.png", place}}, {});
  ASSERT_EQ(read.messages.all().size(), 2u);
  for (const Message& message : read.messages.all()) {
    EXPECT_EQ(message.severity, Message::Severity::warning);
    EXPECT_EQ(message.place.line, 7);
    EXPECT_NE(message.hint.find("checker"), std::string::npos);
  }
  EXPECT_NE(read.messages.all()[0].what.find("nowhere/a.png"), std::string::npos);
  ASSERT_TRUE(read->backdrop && read->environment);
  EXPECT_EQ(read->backdrop->at(0, 0), Color(1, 0, 1));
  EXPECT_EQ(read->backdrop->at(1, 0), Color(0));
  for (const InputFile& file : read.scene.inputs.all()) EXPECT_FALSE(file.read) << file.path;
  EXPECT_EQ(read.scene.inputs.all().size(), 2u);  // nothing may be written there
}

TEST(Surroundings, WhatDidNotChangeIsSharedWithTheRenderBefore) {
  const Folder folder;
  const std::string sky = pictureOf(folder / "sky.png", 8, 4, Color(0.2, 0.4, 1));
  const std::string back = pictureOf(folder / "back.png", 4, 4, Color(0.5));
  const std::vector<Choice> first{{"environment", sky, {}}, {"backdrop", back, {}}};
  const Read one({}, first);
  std::filesystem::remove(sky), std::filesystem::remove(back);  // it is not opened again
  std::vector<Choice> second = first;
  second.push_back({"environment-rotation", "30", {}});
  const Read two({}, second, &one.scene.surroundings);
  EXPECT_EQ(one->environment, two->environment);
  EXPECT_EQ(one->backdrop, two->backdrop);
  EXPECT_EQ(two.scene.inputs.all().size(), 2u);  // and still may not be overwritten
  second.push_back({"environment-blur", "10", {}});
  const Read blurred({}, second, &two.scene.surroundings);
  EXPECT_NE(blurred->environment, one->environment);
  EXPECT_EQ(blurred->sharpEnvironment, one->environment);
  second.push_back({"environment-blur", "0", {}});
  EXPECT_EQ(Read({}, second, &blurred.scene.surroundings)->environment, one->environment);
  second.push_back({"environment", "none", {}});
  EXPECT_EQ(Read({}, second, &blurred.scene.surroundings)->environment, nullptr);
}

TEST(Surroundings, PicturesThatAreTooLargeAreALimit) {
  const Folder folder;
  const std::string sky = pictureOf(folder / "sky.png", 64, 32, Color(1));
  Scene scene;
  Messages messages;
  const std::vector<Choice> choices{{"environment", sky, {}}};
  EXPECT_THROW(readSurroundings(scene, resolve({choices}), {.memory = 100}, messages), Error);
}

TEST(Surroundings, ABlackLensOpeningIsToldOnce) {
  const Folder folder;
  const std::string black = pictureOf(folder / "black.png", 2, 2, Color(0));
  const std::string white = pictureOf(folder / "white.png", 2, 2, Color(1));
  const Read read({}, {{"aperture-picture", black, {}}});
  ASSERT_EQ(read.messages.all().size(), 1u);
  EXPECT_NE(read.messages.all()[0].what.find("black everywhere"), std::string::npos);
  EXPECT_TRUE(Read({}, {{"aperture-picture", white, {}}}).messages.all().empty());
}

}  // namespace
}  // namespace trace::test
