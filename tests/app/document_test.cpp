// A document's edits, undo, options and reading again; what the studio remembers.
#include "app/editing/document.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/editing/edits.h"
#include "app/editing/folder.h"
#include "app/editing/preferences.h"
#include "base/files/read_scope.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "image/codecs/codec.h"
#include "support/paths.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

using DocumentTest = Files;

TEST_F(DocumentTest, UndoGoesBackThroughEditsOfSceneAndOptionsAndRedoForth) {
  Document document;
  document.open(path("scene.ray"));
  EXPECT_FALSE(document.canUndo());
  document.edit("name", renamed(document.scene(), "a"));
  document.choose("width", "77");
  EXPECT_EQ(document.settings().width, 77);
  EXPECT_EQ(document.undoName(), "width");
  document.undo();
  EXPECT_EQ(document.settings().width, Settings{}.width);
  EXPECT_EQ(document.redoName(), "width");
  document.undo();
  EXPECT_EQ(document.scene().objects[0].name, "ball");
  EXPECT_FALSE(document.edited());
  document.redo();
  EXPECT_EQ(document.scene().objects[0].name, "a");
  EXPECT_TRUE(document.edited());
  document.edit("name", renamed(document.scene(), "b"));  // what could be redone is gone
  EXPECT_FALSE(document.canRedo());
}

TEST_F(DocumentTest, ContinuedEditsAreOneStep) {
  Document document;
  document.open(path("scene.ray"));
  for (const char* name : {"a", "b", "c"})
    document.edit("name", renamed(document.scene(), name), *name != 'a');
  EXPECT_EQ(document.scene().objects[0].name, "c");
  document.undo();
  EXPECT_EQ(document.scene().objects[0].name, "ball");
  EXPECT_FALSE(document.canUndo());
  document.choose("width", "10", true);  // nothing to go on with: a step of its own
  EXPECT_TRUE(document.canUndo());
}

TEST_F(DocumentTest, ADragThatIsGivenUpLeavesNoStep) {
  Document document;
  document.open(path("scene.ray"));
  document.edit("name", renamed(document.scene(), "a"));
  const std::uint64_t before = document.step();
  document.edit("move", renamed(document.scene(), "b"));
  document.edit("move", renamed(document.scene(), "c"), true);
  document.choose("width", "77");
  document.dropSince(before);
  EXPECT_EQ(document.scene().objects[0].name, "a");
  EXPECT_EQ(document.settings().width, Settings{}.width);
  EXPECT_EQ(document.undoName(), "name");
  EXPECT_FALSE(document.canRedo());
  document.dropSince(before);  // nothing came after it
  EXPECT_EQ(document.undoName(), "name");
  document.undo();
  document.dropSince(before);  // it lies ahead
  EXPECT_EQ(document.scene().objects[0].name, "ball");
  EXPECT_EQ(document.redoName(), "name");
}

TEST_F(DocumentTest, AFolderThatCannotBeListedSaysWhy) {
  EXPECT_EQ(folderProblem(path(".")), "");
  const std::string none = path("none"), file = path("scene.ray");
  EXPECT_EQ(folderProblem(none), "there is no folder \"" + none + '"');
  EXPECT_EQ(folderProblem(file), '"' + file + "\" is no folder");
  EXPECT_THROW(listFolder(none, {}), Error);
}

TEST_F(DocumentTest, OneSideOfThePictureKeepsTheScenesShape) {
  writeFile(path("sized.ray"), std::string(kScene) + "settings { width = 80; height = 60; }\n");
  Document document;
  document.open(path("sized.ray"), {{"width", "40", {}}});
  EXPECT_EQ(document.settings().height, 30);
  document.choose("height", "15");
  EXPECT_EQ(document.settings().width, 20);
  document.choose("width", "15");
  EXPECT_EQ(document.settings().height, 15) << "both are given here";
  document.undo();
  document.undo();
  EXPECT_EQ(document.settings().width, 40);
}

TEST_F(DocumentTest, OptionsTellWhoChoseThemAndGoBackToIt) {
  Document document;
  document.open(path("scene.ray"), {{"width", "50", {}}});
  EXPECT_EQ(document.chooser(findOption("depth")), "scene.ray:4");
  EXPECT_EQ(document.chooser(findOption("width")), "command line");
  EXPECT_EQ(document.chooser(findOption("threads")), "default");
  document.choose("depth", "9");
  EXPECT_EQ(document.chooser(findOption("depth")), "studio");
  EXPECT_TRUE(document.chosenHere("depth"));
  document.reset("depth");
  EXPECT_EQ(document.settings().depth, 3);
  EXPECT_FALSE(document.chosenHere("depth"));
  EXPECT_THROW(document.choose("depth", "deep"), Error);
  EXPECT_EQ(document.undoName(), "reset depth");
}

TEST_F(DocumentTest, AConventionSetsAllOfItsOptionsAnew) {
  Document document;
  document.open(path("scene.ray"));
  document.choose("pixel-position", "center");
  document.choose("like", "ut");
  const Settings expected = resolve({document.scene().choices, std::vector<Choice>{{"like", "ut", {}}}});
  EXPECT_EQ(document.settings(), expected);
  EXPECT_EQ(document.chooser(findOption("pixel-position")), "studio, by like");
}

TEST_F(DocumentTest, ReadingAgainIsAStepThatKeepsChoicesAndCanBeUndone) {
  Document document;
  document.open(path("scene.ray"));
  document.choose("width", "60");
  EXPECT_FALSE(document.changedOnDisk());
  std::string other = kScene;
  other.replace(other.find("ball"), 4, "moon");
  rewrite("scene.ray", other);
  EXPECT_TRUE(document.changedOnDisk());
  document.reload();
  EXPECT_FALSE(document.changedOnDisk());
  EXPECT_EQ(document.scene().objects[0].name, "moon");
  EXPECT_EQ(document.settings().width, 60);
  EXPECT_NE(document.fileFingerprint(), "") << "the scene is that of the file";
  EXPECT_TRUE(document.edited()) << "the width is in no file";
  document.undo();
  EXPECT_EQ(document.scene().objects[0].name, "ball");
  EXPECT_TRUE(document.edited());

  rewrite("scene.ray", "SBT-raytracer 1.0\nsphere {");  // broken: the document stays
  fs::last_write_time(path("scene.ray"), fs::last_write_time(path("scene.ray")) + std::chrono::seconds(2));
  const auto revision = document.revision();
  EXPECT_THROW(document.reload(), Error);
  EXPECT_EQ(document.revision(), revision);
  EXPECT_FALSE(document.changedOnDisk());
  EXPECT_THROW(document.open(path("nothing.ray")), Error);
  EXPECT_EQ(document.file(), path("scene.ray"));
}

/// The ball of kAnimated in another place, so that the keys of its place are lost when it is saved.
Scene withoutKeys(Scene scene, Real x) {
  scene.objects.at(0).worldFromObject.offset.x = x;
  return scene;
}

TEST_F(DocumentTest, WhatASaveLosesIsKeptInAFileBeside) {
  const std::string text = std::string(kAnimated) + "// mine\n";
  write("animated.ray", text);
  write("animated.ray.bak", "somebody else's");
  Document document;
  document.open(path("animated.ray"));
  document.edit("name", renamed(document.scene(), "moon"));
  EXPECT_TRUE(document.save(path("animated.ray")).empty());
  EXPECT_FALSE(fs::exists(path("animated.ray.bak2"))) << "nothing was lost";

  document.undo();
  document.save(path("animated.ray"));
  ASSERT_EQ(readFile(path("animated.ray")), text);
  for (const Real x : {3.0, 4.0}) {  // the second time only what was saved the first time is replaced
    document.edit("move", withoutKeys(document.scene(), x));
    const std::vector<Message> told = document.save(path("animated.ray"));
    EXPECT_EQ(told.back().what.find("is kept as animated.ray.bak2") != std::string::npos, x == 3.0);
    EXPECT_NE(readFile(path("animated.ray")), text);
  }
  EXPECT_EQ(readFile(path("animated.ray.bak")), "somebody else's");
  EXPECT_EQ(readFile(path("animated.ray.bak2")), text);
  EXPECT_FALSE(fs::exists(path("animated.ray.bak3")));
}

TEST_F(DocumentTest, WhatWasSavedBeforeIsKeptTooIfASaveLosesSomethingOfIt) {
  write("animated.ray", kAnimated);
  Document document;
  document.open(path("animated.ray"));
  document.choose("depth", "9");
  EXPECT_TRUE(document.save(path("animated.ray")).empty());
  const std::string saved = readFile(path("animated.ray"));
  ASSERT_NE(saved, kAnimated);
  document.edit("move", withoutKeys(document.scene(), 3));
  EXPECT_NE(document.save(path("animated.ray")).back().what.find("kept as animated.ray.bak"),
            std::string::npos);
  EXPECT_EQ(readFile(path("animated.ray.bak")), saved) << "as it was, with the depth";
  document.edit("move", withoutKeys(document.scene(), 4));
  document.save(path("animated.ray"));
  EXPECT_FALSE(fs::exists(path("animated.ray.bak2"))) << "nothing more was lost";
}

TEST_F(DocumentTest, AGroupInASolidThatIsWrittenAnewIsKeptAsItWasSavedBefore) {
  write("solid.ray", R"(SBT-raytracer 1.0
camera { position=(0,0,8); viewdir=(0,0,-1); updir=(0,1,0); }
difference { box { } rotate(0, 0, 1, 0.3, union { sphere { } translate(1, 0, 0, sphere { }) /* mine */ }) }
)");
  Document document;
  document.open(path("solid.ray"));
  document.choose("depth", "9");
  EXPECT_TRUE(document.save(path("solid.ray")).empty());
  const std::string saved = readFile(path("solid.ray"));
  Scene scene = document.scene();
  auto& whole = *scene.objects.at(0).shape.edit<Difference>();
  std::vector<Operand> operands = whole.objects.list();
  operands.at(1).shape = Torus{};
  whole.objects = Operands(operands);
  document.edit("solid", scene);
  document.save(path("solid.ray"));
  ASSERT_EQ(readFile(path("solid.ray")).find("mine"), std::string::npos);
  EXPECT_EQ(readFile(path("solid.ray.bak")), saved);
}

TEST_F(DocumentTest, AnothersEditThatWasReadAndUndoneIsKeptInAFileBeside) {
  Document document;
  document.open(path("scene.ray"));
  document.edit("name", renamed(document.scene(), "moon"));
  const std::string others = std::string(kScene) + "// written elsewhere\n";
  rewrite("scene.ray", others);
  document.reload();
  document.undo();
  EXPECT_EQ(document.save(path("scene.ray")).size(), 1u);
  EXPECT_EQ(readFile(path("scene.ray")).find("elsewhere"), std::string::npos);
  EXPECT_EQ(readFile(path("scene.ray.bak")), others);
  document.undo();
  EXPECT_TRUE(document.save(path("scene.ray")).empty()) << "the text is the one before";
  EXPECT_FALSE(fs::exists(path("scene.ray.bak2")));
}

TEST_F(DocumentTest, OptionsOfTheCommandLineAreNotSaved) {
  Document document;
  document.open(path("scene.ray"), {{"spp", "4", {}}, {"depth", "2", {}}});
  EXPECT_TRUE(document.save(path("scene.ray")).empty());
  EXPECT_EQ(readFile(path("scene.ray")), kScene);
  document.choose("depth", "9");
  document.choose("spp", "4");  // as the command line says, but chosen
  EXPECT_TRUE(document.edited());
  document.undo();
  EXPECT_TRUE(document.save(path("scene.ray")).empty());
  std::string expected = kScene;
  EXPECT_EQ(readFile(path("scene.ray")), expected.replace(expected.find("depth = 3"), 9, "depth = 9"));
  EXPECT_EQ(document.settings().spp, 4);
  EXPECT_FALSE(document.edited());
}

TEST_F(DocumentTest, AFileThatASceneCannotNameIsNoReasonToWriteItAnew) {
  TRACE_NEEDS_ANY_NAMES();
  write("odd\".ppm", "P3\n1 1\n255\n0 255 0\n");
  Document document;
  document.open(path("scene.ray"));
  Scene scene = document.scene();
  setTexture(scene.materials.at(0).textures, "diffuse", pictureTexture("odd\".ppm"));
  document.edit("diffuse image file", std::move(scene));
  EXPECT_THROW(document.save(path("scene.ray")), Error);
  EXPECT_EQ(readFile(path("scene.ray")), kScene);
}

TEST_F(DocumentTest, SavedScenesAreReadAsTheyWereEdited) {
  Document document;
  document.open(path("scene.ray"), {{"threads", "3", {}}});
  document.edit("name", renamed(document.scene(), "moon"));
  document.choose("depth", "9");
  EXPECT_TRUE(document.edited());
  document.save(path("saved.ray"));
  EXPECT_FALSE(document.edited());
  EXPECT_FALSE(document.changedOnDisk());
  EXPECT_EQ(document.file(), path("saved.ray"));
  Document again;
  again.open(path("saved.ray"));
  EXPECT_EQ(again.scene().objects.at(0).name, "moon");
  EXPECT_EQ(again.settings().depth, 9);
  EXPECT_EQ(again.settings().threads, 0);
  EXPECT_THROW(document.save(path("no/such/folder/x.ray")), Error);
  EXPECT_EQ(document.file(), path("saved.ray"));
}

TEST_F(DocumentTest, AMovedCameraKeepsItsLookAtInTheFile) {
  const std::string text =
      "SBT-raytracer 1.0\ncamera { position = (0, 1, 8); look_at = (0, 1, 0); fov = 40; } // eye\nsphere { "
      "}\n";
  write("look.ray", text);
  Document document;
  document.open(path("look.ray"));
  ASSERT_TRUE(document.lookAt());
  EXPECT_EQ(*document.lookAt(), Vec3(0, 1, 0));
  Scene scene = document.scene();
  scene.camera.position = {3, 2, 8};
  followMove(scene.camera, "position", document.lookAt());
  document.edit("camera: position", scene);
  EXPECT_TRUE(document.lookAt());
  document.save(path("moved.ray"));
  EXPECT_EQ(readFile(path("moved.ray")), std::string(text).replace(text.find("0, 1, 8"), 7, "3, 2, 8"));

  scene.camera.viewdir = {0, 0, -1};  // looks elsewhere
  document.edit("camera: viewdir", scene);
  EXPECT_FALSE(document.lookAt());
  document.save(path("turned.ray"));
  EXPECT_EQ(readFile(path("turned.ray")).find("look_at"), std::string::npos);
  document.undo();
  EXPECT_TRUE(document.lookAt());
  document.open(path("scene.ray"));
  EXPECT_FALSE(document.lookAt());
}

TEST_F(DocumentTest, OnlyAFileOfItsOwnKindIsSavedOver) {
  write("ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Document document;
  EXPECT_FALSE(document.savesOverItsFile());
  document.open(path("ball.obj"));
  EXPECT_FALSE(document.savesOverItsFile());
  document.save(path("ball.ray"));
  EXPECT_TRUE(document.savesOverItsFile());
  document.open(path("scene.ray"));
  EXPECT_TRUE(document.savesOverItsFile());
}

TEST_F(DocumentTest, PointsOfASweepAndObjectsOfASolidAreEditedUndoneAndSaved) {
  write("solids.ray", R"(SBT-raytracer 1.0
camera { position=(0,0,8); viewdir=(0,0,-1); updir=(0,1,0); }
sphere_sweep { points = ((0,0,0,1), (1,0,0,0.5), (2,1,0,0.2)); }
difference { box { } sphere { name = "hole"; } }
)");
  Document document;
  document.open(path("solids.ray"));
  Scene scene = document.scene();
  auto& sweep = *scene.objects.at(0).shape.edit<SphereSweep>();
  sweep.points.push_back({3, 1, 0, 0.1});
  sweep.spline = Spline::catmull;
  auto& whole = *scene.objects.at(1).shape.edit<Difference>();
  std::vector<Operand> operands = whole.objects.list();
  operands.at(1).wholeFromOperand = Affine::translation({0.5, 0, 0});
  operands.push_back({"bite", Torus{}, {}, operands.at(0).material});
  whole.objects = Operands(operands);
  document.edit("solids", scene);
  document.undo();
  EXPECT_EQ(document.scene().objects.at(1).shape.as<Difference>()->objects.list().size(), 2u);
  document.redo();
  document.save(path("saved.ray"));
  Document again;
  again.open(path("saved.ray"));
  EXPECT_EQ(again.scene().objects.at(0).shape, scene.objects.at(0).shape);
  EXPECT_EQ(again.scene().objects.at(1).shape.as<Difference>()->objects.list().size(), 3u);
  EXPECT_EQ(again.scene().objects.at(1).shape, scene.objects.at(1).shape);
}

TEST_F(DocumentTest, TheOptionTimeReadsTheSceneOfThatMoment) {
  write("animated.ray", kAnimated);
  Document document;
  document.open(path("animated.ray"));
  const auto x = [&] { return document.scene().objects.at(0).worldFromObject.offset.x; };
  EXPECT_EQ(x(), 0);
  document.choose("time", "1");
  EXPECT_EQ(x(), 0.5);
  EXPECT_NE(document.fileFingerprint(), "") << "the scene is that of the file";
  document.choose("time", "2", true);
  EXPECT_EQ(x(), 1);
  document.undo();
  EXPECT_EQ(x(), 0);
  EXPECT_FALSE(document.edited());
  document.redo();
  document.reset("time");
  EXPECT_EQ(x(), 0);

  document.edit("name", renamed(document.scene(), "moon"));
  document.choose("time", "1");
  EXPECT_EQ(document.scene().objects.at(0).name, "ball");
  ASSERT_EQ(document.messages().all().size(), 1u);  // which says so
  document.undo();
  EXPECT_EQ(document.scene().objects.at(0).name, "moon");
}

TEST_F(DocumentTest, TheOptionTimeKeepsEditsOfASceneThatDoesNotChange) {
  Document document;
  document.open(path("scene.ray"));
  document.edit("name", renamed(document.scene(), "moon"));
  document.choose("time", "1");
  EXPECT_EQ(document.scene().objects.at(0).name, "moon");
  EXPECT_EQ(document.settings().time, 1);
  EXPECT_TRUE(document.messages().all().empty());
}

TEST_F(DocumentTest, SavingKeepsTheKeysOfAnAnimatedScene) {
  write("animated.ray", kAnimated);
  Document document;
  document.open(path("animated.ray"));
  document.choose("time", "1");
  document.edit("name", renamed(document.scene(), "moon"));
  EXPECT_TRUE(document.save(path("animated.ray")).empty());
  EXPECT_TRUE(document.changesWithTime());
  const std::string text = readFile(path("animated.ray"));
  EXPECT_NE(text.find("translate(key((0, 0), (2, 1)), 0, 0, sphere { name = \"moon\"; })"), text.npos)
      << text;
}

TEST_F(DocumentTest, SavingAValueThatHadKeysWarns) {
  write("animated.ray", kAnimated);
  Document document;
  document.open(path("animated.ray"));
  Scene scene = document.scene();
  scene.objects[0].worldFromObject.offset.x = 7;
  document.edit("move", scene);
  const std::vector<Message> warnings = document.save(path("animated.ray"));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].place.line, 4);
  EXPECT_EQ(warnings[1].what, "the old file is kept as animated.ray.bak");
  EXPECT_FALSE(document.changesWithTime());
  EXPECT_NE(readFile(path("animated.ray")).find("translate(7, 0, 0, sphere"), std::string::npos);
}

TEST_F(DocumentTest, SavingWithoutAnEditOrAfterUndoWritesTheBytesThatWereRead) {
  const std::string text = std::string("// a comment\r\n") + kScene + "// no line break";
  write("own.ray", text);
  Document document;
  document.open(path("own.ray"), {{"threads", "2", {}}});
  EXPECT_TRUE(document.save(path("own.ray")).empty());
  EXPECT_EQ(readFile(path("own.ray")), text);
  document.edit("name", renamed(document.scene(), "moon"));
  document.choose("depth", "9");
  EXPECT_TRUE(document.save(path("own.ray")).empty());
  std::string changed = text;
  changed.replace(changed.find("\"ball\""), 6, "\"moon\"");
  changed.replace(changed.find("depth = 3"), 9, "depth = 9");
  EXPECT_EQ(readFile(path("own.ray")), changed);
  document.undo();
  document.undo();
  EXPECT_TRUE(document.save(path("own.ray")).empty());
  EXPECT_EQ(readFile(path("own.ray")), text);
}

TEST_F(DocumentTest, SavingAfterTheFileWasReadAgainChangesTheNewText) {
  Document document;
  document.open(path("scene.ray"));
  rewrite("scene.ray", std::string(kScene) + "// written elsewhere\n");
  document.reload();
  document.edit("name", renamed(document.scene(), "moon"));
  EXPECT_TRUE(document.save(path("scene.ray")).empty());
  std::string expected = std::string(kScene) + "// written elsewhere\n";
  expected.replace(expected.find("\"ball\""), 6, "\"moon\"");
  EXPECT_EQ(readFile(path("scene.ray")), expected);
}

TEST_F(DocumentTest, SavingInAnotherFolderStillFindsTheFilesThatAreNamed) {
  const ReadScope allowed({path("meshes")});
  fs::create_directories(path("meshes"));
  fs::create_directories(path("other/deep"));
  write("meshes/tri.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write("mesh.ray", std::string(kScene) + "mesh { file = \"meshes/tri.off\"; name = m; } // a file\n");
  Document document;
  document.open(path("mesh.ray"));
  document.edit("name", renamed(document.scene(), "moon"));
  EXPECT_TRUE(document.save(path("other/deep/copy.ray")).empty());
  const std::string text = readFile(path("other/deep/copy.ray"));
  EXPECT_NE(text.find("mesh { file = \"../../meshes/tri.off\"; name = m; } // a file\n"), text.npos) << text;
  Document again;
  again.open(path("other/deep/copy.ray"));
  EXPECT_EQ(again.scene().objects.at(1).shape, document.scene().objects.at(1).shape);
}

/// Tries to save what cannot be read again. Returns what the refusal says.
std::string refusal(Document& document, const std::string& file) {
  const std::string before = readFile(file), saved = document.file();
  const auto time = fs::last_write_time(file);
  std::string said;
  try {
    document.save(file);
  } catch (const Error& error) {
    said = error.what();
  }
  EXPECT_EQ(readFile(file), before);
  EXPECT_EQ(fs::last_write_time(file), time);
  EXPECT_EQ(document.file(), saved);
  EXPECT_TRUE(document.edited());
  return said;
}

TEST_F(DocumentTest, WhatCouldNotBeReadAgainIsNotSaved) {
  const auto camera = [&](const std::string& what, auto&& change, const std::string& expected) {
    write("own.ray", std::string("// a comment\n") + kScene);
    Document document;
    document.open(path("own.ray"));
    Scene scene = document.scene();
    change(scene.camera);
    document.edit(what, scene);
    const std::string said = refusal(document, path("own.ray"));
    EXPECT_NE(said.find(expected), said.npos) << what << ": " << said;
    EXPECT_NE(said.find("undo, or correct"), said.npos) << what << ": " << said;
    document.undo();
    EXPECT_TRUE(document.save(path("own.ray")).empty());
  };
  camera(
      "fov", [](Camera& c) { c.fov = 180; }, "found 180");
  camera(
      "fov", [](Camera& c) { c.fov = 0; }, "found 0");
  camera(
      "updir", [](Camera& c) { c.updir = {}; }, "updir");
  camera(
      "viewdir", [](Camera& c) { c.viewdir = c.updir; }, "updir");
  camera(
      "aspectratio", [](Camera& c) { c.aspectratio = 0; }, "aspectratio");
}

TEST_F(DocumentTest, WhatWouldBeReadAsFewerObjectsIsNotSaved) {
  write("own.ray", std::string("// a comment\n") + kScene + "box { name = \"chest\"; }\n");
  Document document;
  document.open(path("own.ray"));
  Scene scene = document.scene();
  scene.objects[1].worldFromObject.row[0] = {};
  document.edit("transform chest", scene);
  const std::string said = refusal(document, path("own.ray"));
  EXPECT_NE(said.find("chest"), said.npos) << said;
  EXPECT_NE(said.find("undo, or correct"), said.npos) << said;
}

/// Whatever can be opened can be saved as .ray, edited or not.
TEST_F(DocumentTest, EverySoundSceneIsSaved) {
  const ReadScope allowed({test::sourceFolder()});
  for (const char* folder : {"/scenes", "/tests/corpus"})
    for (const auto& entry : fs::recursive_directory_iterator(test::sourceFolder() + folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "forest.ray") continue;  // a million lines
      Document document;
      try {
        document.open(entry.path().string());
      } catch (const Error&) {
        continue;  // no scene, or a broken one
      }
      SCOPED_TRACE(entry.path().string());
      EXPECT_NO_THROW(document.save(path("copy.ray")));
      Document again;
      again.open(path("copy.ray"));
      EXPECT_EQ(again.scene().objects.size(), document.scene().objects.size());
      if (again.scene().objects.empty()) continue;
      again.edit("name", renamed(again.scene(), "a \"name\" // with signs"));
      EXPECT_NO_THROW(again.save(path("copy.ray")));
    }
}

TEST_F(DocumentTest, OptionsThatSavingWouldWriteCountAsEdits) {
  Document document;
  document.open(path("scene.ray"), {{"width", "50", {}}});
  EXPECT_FALSE(document.edited()) << "the command line is no edit";
  document.choose("threads", "2");
  EXPECT_FALSE(document.edited()) << "saving leaves the machine's own out";
  document.choose("spp", "4");
  EXPECT_TRUE(document.edited());
  EXPECT_NE(document.fileFingerprint(), "");
  document.undo();
  EXPECT_FALSE(document.edited());
  document.choose("depth", "9");
  EXPECT_TRUE(document.edited());
  document.choose("depth", "3");
  EXPECT_FALSE(document.edited()) << "so says the file";
  document.choose("depth", "7");
  document.save(path("scene.ray"));
  EXPECT_FALSE(document.edited());
  document.undo();
  EXPECT_TRUE(document.edited());
}

TEST_F(DocumentTest, HeightsAndMapsDoNotKeepASceneFromAnotherFolder) {
  fs::create_directories(path("other"));
  writePicture(path("land.png"), Picture(4, 4));
  write("land.ray", std::string(kScene) +
                        "height_field { file = \"land.png\"; }\n"
                        "sphere { material = { diffuse = map(\"land.png\"); } }\n");
  Document document;
  document.open(path("land.ray"));
  EXPECT_NO_THROW(document.save(path("other/copy.ray")));
}

// --- small things -------------------------------------------------------------------------------------

TEST(Preferences, AreReadAsTheyWereWritten) {
  Preferences p;
  p.set("theme", "light");
  p.set("left", 0.25);
  p.setAll("recent", {"/a b/c.ray", "/d.ray"});
  p.set("theme", "dark");
  const Preferences q = Preferences::parse(p.text() + "nonsense\n\n");
  EXPECT_EQ(q.get("theme"), "dark");
  EXPECT_EQ(q.number("left", 0), 0.25);
  EXPECT_EQ(q.number("right", 7), 7);
  EXPECT_EQ(q.all("recent"), (std::vector<std::string>{"/a b/c.ray", "/d.ray"}));
  EXPECT_EQ(q.get("nonsense", "no"), "no");
}

using FolderTest = Files;

TEST_F(FolderTest, ListsFoldersFirstThenFilesThatFit) {
  fs::create_directories(path("zoo"));
  for (const char* name : {"b.RAY", "a.ray", ".hidden.ray", "note.txt"}) write(name, "x");
  const auto entries = listFolder(path(""), {".ray"});
  ASSERT_EQ(entries.size(), 4u);
  EXPECT_EQ(entries[0], (FolderEntry{"zoo", true, 0}));
  EXPECT_EQ(entries[1], (FolderEntry{"a.ray", false, 1}));
  EXPECT_EQ(entries[2].name, "b.RAY");
  EXPECT_EQ(entries[3].name, "scene.ray");
  EXPECT_THROW(listFolder(path("nowhere"), {}), Error);
  EXPECT_EQ(withSuffix("lesson", ".ray"), "lesson.ray");
  EXPECT_EQ(withSuffix("lesson.tr", ".ray"), "lesson.tr");
  EXPECT_EQ(endingProblem("rays.SVG", {".svg", ".png"}), "");
  EXPECT_EQ(endingProblem("rays.jpg", {".svg", ".png", ".apng"}),
            "the name must end in .svg, .png or .apng, found \"rays.jpg\"");
  EXPECT_EQ(nearestFolder(path("zoo/no/such")), path("zoo"));
  EXPECT_EQ(nearestFolder(path("a.ray")), fs::path(path("")).parent_path().string());
}

}  // namespace
}  // namespace trace::test
