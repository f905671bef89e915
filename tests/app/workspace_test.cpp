// What the studio does in the background: the picture that follows, files that are read and written while the
// window goes on.
#include "app/editing/workspace.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>
#include <utility>

#include "app/editing/texture_edits.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/sphere.h"
#include "image/codecs/codec.h"
#include "support/panes.h"
#include "support/scene_files.h"

namespace trace::test {
namespace {

using WorkspaceTest = Files;

void waitFor(BackgroundRender& render) {
  while (render.state().working()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

void waitFor(const PixelInspector& inspector) {
  while (inspector.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Until all files are read and written. False if one could not be.
bool settled(Workspace& workspace) {
  const std::uint64_t before = workspace.failures();
  for (; workspace.reading() || workspace.saving(); workspace.update())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return workspace.failures() == before;
}

/// The log has it, among what else happened meanwhile.
bool tells(const Workspace& workspace, const char* words) {
  return std::any_of(workspace.log().begin(), workspace.log().end(), [&](const Workspace::LogEntry& entry) {
    return entry.text.find(words) != std::string::npos;
  });
}

bool opened(Workspace& workspace, const std::string& file, std::vector<Choice> commandLine = {}) {
  workspace.commandLine = std::move(commandLine);
  workspace.open(file);
  return settled(workspace);
}

TEST_F(WorkspaceTest, RendersTheSamePictureAsASession) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "100", {}}}));
  waitFor(workspace.render);
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::finished);
  Session session;
  session.open(path("scene.ray"), std::vector<Choice>{{"width", "100", {}}});
  session.build();
  session.renderPicture();
  EXPECT_EQ(workspace.render.picture(), session.picture());
  workspace.savePicture(path("out.png"));
  ASSERT_TRUE(settled(workspace));
  session.save(path("expected.png"));
  EXPECT_EQ(readFile(path("out.png")), readFile(path("expected.png")));
}

TEST_F(WorkspaceTest, AnExposureThatWasMeasuredIsThatOfTheFile) {
  writeFile(path("kind.ray"),
            "Trace 1\nsettings { width = 24; spp = 4; denoise = off }\nplane { }\nsphere { }\n");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("kind.ray"), {}));
  waitFor(workspace.render);
  workspace.savePicture(path("out.png"));
  ASSERT_TRUE(settled(workspace));
  Session session;
  session.open(path("kind.ray"), {});
  session.build();
  session.renderPicture();
  EXPECT_NE(session.measuredExposure(), 0);
  session.save(path("expected.png"));
  EXPECT_EQ(readPicture(path("out.png")), readPicture(path("expected.png")));
}

TEST_F(WorkspaceTest, OptionsThatAQualityHidesAreSaved) {
  writeFile(path("kind.ray"), "Trace 1\n// mine\nsettings { width = 24 }\nplane { }\nsphere { }\n");
  Document document;
  document.open(path("kind.ray"), {});
  document.choose("integrator", "whitted");
  document.choose("spp", "1");
  document.save(path("kind.ray"));
  const std::string text = readFile(path("kind.ray"));
  EXPECT_NE(text.find("settings { width = 24; spp = 1; integrator = whitted; }"), std::string::npos) << text;
  EXPECT_NE(text.find("// mine"), std::string::npos) << text;
  Document again;
  again.open(path("kind.ray"), {});
  EXPECT_EQ(again.settings().integrator, IntegratorKind::whitted);
  EXPECT_EQ(again.settings().spp, 1);
}

TEST_F(WorkspaceTest, WhatIsChosenBeforeASceneIsOpenHoldsForAllThatAreOpened) {
  Workspace workspace;
  workspace.commandLine = {{"threads", "1", {}}};
  EXPECT_THROW(workspace.choose("width", "wide"), Error);
  workspace.choose("width", "20");
  std::filesystem::copy_file(path("scene.ray"), path("other.ray"));
  for (const char* name : {"scene.ray", "other.ray"}) {
    workspace.open(path(name));
    ASSERT_TRUE(settled(workspace));
    EXPECT_EQ(workspace.document.settings().threads, 1) << name;
    EXPECT_EQ(workspace.document.settings().width, 20) << name;
    EXPECT_EQ(workspace.document.chooser(findOption("width")), "command line") << name;
    EXPECT_FALSE(workspace.document.edited()) << name;
    workspace.choose("depth", "1");  // that of one scene alone
  }
  EXPECT_EQ(workspace.commandLine.size(), 2u);
}

TEST_F(WorkspaceTest, ANewSceneIsWrittenAndOpenedButOverNoFile) {
  Workspace workspace;
  workspace.commandLine = {{"width", "20", {}}};
  workspace.startScene(path("scene.ray"));  // which there is
  EXPECT_FALSE(settled(workspace));
  EXPECT_FALSE(workspace.document.isOpen());
  workspace.startScene(path("first.ray"));
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.document.file(), path("first.ray"));
  EXPECT_GT(workspace.document.scene().objects.size(), 3u);
  const std::string written = readFile(path("first.ray"));
  EXPECT_NE(written.find("`ray first.ray` renders it"), std::string::npos) << written;
  EXPECT_EQ(written.find("scene.ray"), std::string::npos) << "it is called otherwise";
  EXPECT_EQ(workspace.newSceneFile(), path("scene-2.ray"));
  workspace.startScene(path("small.ray"), kSmallScene);
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.document.scene().objects.size(), 2u);
  EXPECT_EQ(workspace.document.settings().integrator, IntegratorKind::whitted);
  workspace.choose("spp", "16");
  EXPECT_EQ(workspace.document.settings().spp, 16);
  EXPECT_FALSE(workspace.document.settings().denoise) << "the mean of 16 samples, no more";
  EXPECT_EQ(workspace.document.settings().noiseTarget, 0);
}

TEST_F(WorkspaceTest, WithoutASceneNothingIsWritten) {
  Workspace workspace;
  workspace.saveScene(path("kept.ray"));
  workspace.savePicture(path("kept.png"));
  EXPECT_EQ(workspace.failures(), 2u);
  ASSERT_EQ(workspace.log().size(), 2u);
  EXPECT_EQ(workspace.log()[0].text, "not written: no scene is open");
  EXPECT_EQ(workspace.log()[1].text, "not written: there is no picture yet");
  EXPECT_FALSE(std::filesystem::exists(path("kept.ray")));
}

TEST_F(WorkspaceTest, ASceneThatWasBrokenAtTheStartIsReadWhenItIsMended) {
  const std::string whole = readFile(path("scene.ray"));
  writeFile(path("broken.ray"), "SBT-raytracer 1.0\nsphere { radius = ");
  Workspace workspace;
  EXPECT_FALSE(opened(workspace, path("broken.ray"), {{"width", "20", {}}}));
  EXPECT_FALSE(workspace.document.isOpen());
  writeFile(path("broken.ray"), whole);
  std::filesystem::last_write_time(path("broken.ray"),
                                   std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  for (int i = 0; i < 3000 && !workspace.document.isOpen(); ++i, workspace.update())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(workspace.document.isOpen());
  EXPECT_EQ(workspace.document.settings().width, 20);
  waitFor(workspace.render);
}

TEST_F(WorkspaceTest, AFileThatIsGoneIsToldOnce) {
  writeFile(path("gone.ray"), readFile(path("scene.ray")));
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("gone.ray"), {{"width", "20", {}}}));
  std::filesystem::remove(path("gone.ray"));
  const auto told = [&] {
    return std::count_if(workspace.log().begin(), workspace.log().end(), [](const Workspace::LogEntry& e) {
      return e.text.find("no longer on the disk") != std::string::npos;
    });
  };
  for (int i = 0; i < 1200; ++i, workspace.update()) {
    if (told() && i < 550) i = 550;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(told(), 1);
  EXPECT_TRUE(workspace.document.isOpen());

  // It is in no file, so nobody leaves unasked; saved over its file, it is written anew.
  EXPECT_FALSE(workspace.document.edited());
  EXPECT_TRUE(workspace.unsaved());
  workspace.saveSceneOver();
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.log().back().text,
            workspace.log()[0].text.substr(std::string("opened ").size()).insert(0, "wrote ") +
                " anew: it was no longer on the disk");
  for (int i = 0; i < 1200 && workspace.unsaved(); ++i, workspace.update())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(workspace.unsaved());
  workspace.saveSceneOver();
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.log().back().text.find("anew"), std::string::npos);
  Document again;
  again.open(path("gone.ray"));
  EXPECT_EQ(again.scene().objects.size(), workspace.document.scene().objects.size());
}

TEST_F(WorkspaceTest, OnceAnotherSceneIsOpenNothingOfTheOneBeforeIsShown) {
  writeFile(path("bright.ray"), readFile(path("scene.ray")) + "\nsettings { exposure = 3; }\n");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "20", {}}}));
  waitFor(workspace.render);
  ASSERT_TRUE(opened(workspace, path("bright.ray"), {{"width", "20", {}}}));
  const auto session = workspace.render.session();
  if (session) {
    EXPECT_EQ(session->scene().file, workspace.document.scene().file);
  } else if (const Picture picture = workspace.render.picture(); !workspace.render.session()) {
    EXPECT_EQ(picture.width, 0);
  }
  EXPECT_EQ(workspace.shownSettings().exposure, 3);
  waitFor(workspace.render);
  EXPECT_EQ(workspace.shownSettings().exposure, 3);
}

TEST_F(WorkspaceTest, DirectLightIsShownWhilePhotonsAreSentAndAnEditEndsThem) {
  writeFile(path("photons.ray"),
            "SBT-raytracer 1.0\nsettings { integrator = photon; photons = 20000000; width = 64; spp = 1; }\n"
            "camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }\n"
            "point_light { position = (30, 0, 90); color = (1, 1, 1); constant_attenuation_coeff = 1; }\n"
            "sphere { material = { diffuse = (0.8, 0.5, 0.2) } }\n");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("photons.ray")));
  while (workspace.render.picture().width == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::building);
  const Picture early = workspace.render.picture();
  EXPECT_EQ(early.width, 64);
  EXPECT_GT(early.at(32, early.height / 2).r, 0);
  workspace.document.choose("photons", "1000");
  workspace.update();
  waitFor(workspace.render);
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::finished);
  EXPECT_EQ(workspace.render.session()->settings().photons, 1000);
}

TEST_F(WorkspaceTest, AFileThatAnEditNamesIsReadOrTheEditIsNotTaken) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "20", {}}}));
  Scene scene = workspace.document.scene();
  setTexture(scene.materials.at(0).textures, "diffuse", pictureTexture("no_such.ppm"));
  workspace.edit("file", scene);
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.refusals(), 1u);
  EXPECT_EQ(workspace.undoName(), "");
  writeFile(path("leaf.ppm"), "P3 1 1 255 0 255 0\n");
  setTexture(scene.materials.at(0).textures, "diffuse", pictureTexture("leaf.ppm"));
  workspace.edit("file", scene);
  ASSERT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.undoName(), "file");
}

TEST_F(WorkspaceTest, ThePictureFollowsEditsAndUndoButNotThreads) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);
  const Picture red = workspace.render.picture();
  Scene scene = workspace.document.scene();
  scene.materials.at(0).model.edit<Phong>()->diffuse = {0, 1, 0};
  workspace.document.edit("diffuse", scene);
  EXPECT_TRUE(workspace.stale());
  workspace.update();
  waitFor(workspace.render);
  EXPECT_FALSE(workspace.stale());
  EXPECT_NE(workspace.render.picture(), red);
  workspace.document.undo();
  workspace.update();
  waitFor(workspace.render);
  EXPECT_EQ(workspace.render.picture(), red);
  const auto number = workspace.render.state().number;
  workspace.document.choose("threads", "1");
  workspace.document.choose("rounding", "nearest");
  workspace.update();
  EXPECT_EQ(workspace.render.state().number, number);
  workspace.automatic = false;
  workspace.document.choose("depth", "1");
  workspace.update();
  EXPECT_EQ(workspace.render.state().number, number);
  EXPECT_TRUE(workspace.stale());
}

TEST_F(WorkspaceTest, AnEditOfAMaterialKeepsTheTreesOfMeshes) {
  write("mesh.ray", R"(SBT-raytracer 1.0
camera { position=(0,0,4); viewdir=(0,0,-1); updir=(0,1,0); }
directional_light { direction=(0,0,-1); color=(1,1,1); }
polymesh { material = { diffuse = (1,0,0); } points = ((-1,-1,0), (1,-1,0), (0,1,0)); faces = ((0,1,2)); }
)");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("mesh.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);
  const auto before = workspace.render.session();
  Scene scene = workspace.document.scene();
  scene.materials.at(0).model.edit<Phong>()->diffuse = {0, 1, 0};
  workspace.document.edit("diffuse", scene);
  workspace.document.choose("depth", "2");
  workspace.update();
  waitFor(workspace.render);
  const auto now = workspace.render.session();
  ASSERT_NE(now, before);
  EXPECT_EQ(now->world().meshTree(0), before->world().meshTree(0));
  EXPECT_EQ(&now->world().hierarchy(), &before->world().hierarchy());
}

TEST_F(WorkspaceTest, StopsAtOnceKeepsWhatIsThereAndStartsAnew) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"),
                     {{"width", "3000", {}}, {"spp", "100", {}}, {"threads", "1", {}}}));
  while (workspace.render.picture().width == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  workspace.render.stop();
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::stopped);
  EXPECT_EQ(workspace.render.picture().width, 3000);
  for (int i = 0; i < 20; ++i) {  // each replaces the one before
    workspace.document.choose("width", std::to_string(200 + i));
    workspace.update();
  }
  workspace.document.choose("spp", "1");
  workspace.update();
  waitFor(workspace.render);
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::finished);
  EXPECT_EQ(workspace.render.picture().width, 219);
}

TEST_F(WorkspaceTest, AnEditDoesNotWaitForATileThatTakesTooLong) {
  write("panes.ray", kPanes);
  // The narrow picture has no coarse one before it.
  for (const auto& [width, phase] :
       {std::pair{"8", BackgroundRender::Phase::tracing}, std::pair{"64", BackgroundRender::Phase::coarse}}) {
    Workspace workspace;
    ASSERT_TRUE(opened(workspace, path("panes.ray"), {{"width", width, {}}, {"depth", "60", {}}}));
    while (workspace.render.state().phase != phase) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    workspace.document.choose("depth", "1");
    workspace.update();
    waitFor(workspace.render);
    EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::finished);
  }
}

TEST_F(WorkspaceTest, WhatCannotBeRenderedIsInTheLog) {
  Workspace workspace;
  EXPECT_FALSE(opened(workspace, path("nothing.ray")));
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  Scene scene = workspace.document.scene();
  scene.camera.fov = 0;
  workspace.document.edit("fov", scene);
  workspace.update();
  waitFor(workspace.render);
  workspace.update();
  EXPECT_EQ(workspace.render.state().phase, BackgroundRender::Phase::failed);
  EXPECT_NE(workspace.log().back().text.find("camera"), std::string::npos);
  EXPECT_EQ(workspace.log().back().level, Workspace::LogEntry::Level::error);
  workspace.openReference(path("scene.ray"));
  EXPECT_FALSE(settled(workspace));
  EXPECT_FALSE(workspace.reference());
}

TEST_F(WorkspaceTest, HowExactTheBrightnessOfChainsIsIsInTheLog) {
  writeFile(path("speck.ray"),
            "SBT-raytracer 1.0\nsettings { integrator = mlt; chain-starts = 1000; width = 12; spp = 2; }\n"
            "camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }\n"
            "scale(0.8, sphere { material = { emissive = (4, 3, 2) } })\n");
  const auto warnings = [&](const char* starts) {
    Workspace workspace;
    EXPECT_TRUE(opened(workspace, path("speck.ray"), {{"chain-starts", starts, {}}}));
    waitFor(workspace.render);
    workspace.update();
    std::string text;
    for (const Workspace::LogEntry& entry : workspace.log())
      if (entry.level == Workspace::LogEntry::Level::warning) text += entry.text + "\n";
    return text;
  };
  EXPECT_NE(warnings("500").find("how bright the whole picture is, is known to "), std::string::npos);
  EXPECT_EQ(warnings("300000"), "");
}

TEST_F(WorkspaceTest, TheLogNamesFilesAsSeenFromTheCurrentFolder) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(std::filesystem::path(path("scene.ray")).parent_path());
  Workspace workspace;
  writeFile("bad.ray", "SBT-raytracer 1.1\nsphere {");
  EXPECT_FALSE(opened(workspace, path("bad.ray")));
  EXPECT_EQ(workspace.log().back().place.file, "bad.ray");
  EXPECT_EQ(workspace.log().back().place.line, 2);
  std::filesystem::current_path(before);
}

TEST_F(WorkspaceTest, FilesOpenedLatelyComeNewestFirstAndOnce) {
  Workspace workspace;
  write("b.ray", kScene);
  workspace.setRecent({"/old"});
  for (const char* name : {"scene.ray", "b.ray", "scene.ray"}) ASSERT_TRUE(opened(workspace, path(name)));
  EXPECT_EQ(workspace.recent(), (std::vector<std::string>{path("scene.ray"), path("b.ray"), "/old"}));
}

TEST_F(WorkspaceTest, FilesSavedLatelyAreAmongThem) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  workspace.saveScene(path("saved.ray"));
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.recent(), (std::vector<std::string>{path("saved.ray"), path("scene.ray")}));
}

TEST_F(WorkspaceTest, ASceneIsSavedOverItsFileUnlessThatWasChangedByOthers) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  ASSERT_TRUE(workspace.document.savesOverItsFile());
  workspace.document.edit("name", renamed(workspace.document.scene(), "moon"));
  workspace.saveSceneOver();
  EXPECT_TRUE(settled(workspace));
  EXPECT_NE(readFile(path("scene.ray")).find("moon"), std::string::npos);
  EXPECT_FALSE(workspace.document.edited());

  workspace.document.edit("name", renamed(workspace.document.scene(), "star"));
  const std::string theirs = readFile(path("scene.ray")) + "// theirs\n";
  write("scene.ray", theirs);
  std::filesystem::last_write_time(path("scene.ray"),
                                   std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  const auto failures = workspace.failures();
  workspace.saveSceneOver();
  EXPECT_EQ(workspace.failures(), failures + 1);
  EXPECT_EQ(readFile(path("scene.ray")), theirs);
}

TEST_F(WorkspaceTest, ASceneOfAnotherFormatIsSavedUnderANameThatNoFileHas) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  EXPECT_EQ(workspace.defaultSceneFile(), path("scene.ray"));
  write("ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_TRUE(opened(workspace, path("ball.obj")));
  EXPECT_EQ(workspace.defaultSceneFile(), path("ball.ray"));
  write("ball.ray", kScene);
  EXPECT_EQ(workspace.defaultSceneFile(), path("ball-trace.ray"));
  write("ball-trace.ray", kScene);
  EXPECT_EQ(workspace.defaultSceneFile(), path("ball-trace2.ray"));
  waitFor(workspace.render);
}

TEST_F(WorkspaceTest, ABrokenFileOfOthersIsNotSavedOverAndOneSavedOnPurposeIs) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  workspace.document.edit("name", renamed(workspace.document.scene(), "moon"));
  const std::string theirs = readFile(path("scene.ray")) + "translate(0, 1, 0, sphere { name = mine; }\n";
  write("scene.ray", theirs);
  std::filesystem::last_write_time(path("scene.ray"),
                                   std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  for (; workspace.failures() == 0; workspace.update())  // it is looked at, and cannot be read
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(workspace.document.changedOnDisk());
  for (int again = 0; again < 2; ++again) {
    workspace.saveSceneOver();
    EXPECT_FALSE(workspace.saving());
    EXPECT_EQ(readFile(path("scene.ray")), theirs);
    EXPECT_NE(workspace.log().back().text.find("not saved: the file was changed"), std::string::npos);
    EXPECT_NE(workspace.log().back().hint.find("Save scene as"), std::string::npos);
  }
  workspace.saveScene(path("scene.ray"));  // as Save scene as... does
  ASSERT_TRUE(settled(workspace));
  EXPECT_NE(readFile(path("scene.ray")).find("moon"), std::string::npos);
  workspace.document.edit("name", renamed(workspace.document.scene(), "star"));
  workspace.saveSceneOver();
  EXPECT_TRUE(settled(workspace));
  EXPECT_NE(readFile(path("scene.ray")).find("star"), std::string::npos);
}

TEST_F(WorkspaceTest, NamesThatASceneFileCannotHoldAreNotTaken) {
  write("odd\".ppm", "P3\n1 1\n255\n0 255 0\n");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  const auto refused = [&](const std::string& what, const std::function<void(Scene&)>& edit) {
    const auto before = workspace.document.sharedScene();
    const std::uint64_t refusals = workspace.refusals();
    Scene scene = *before;
    edit(scene);
    workspace.edit(what, std::move(scene));
    EXPECT_TRUE(settled(workspace));
    EXPECT_EQ(workspace.refusals(), refusals + 1) << what;
    EXPECT_EQ(workspace.document.sharedScene(), before) << what;
    EXPECT_TRUE(workspace.log().back().text.starts_with(what + " was not taken: expected "))
        << workspace.log().back().text;
  };
  refused("name", [](Scene& s) { s.objects[0].name = "my \"odd\" ball"; });
  refused("part", [](Scene& s) {
    s.objects[0].shape = Shape(Union{});
    s.objects[0].shape.setOperands(Operands({{"a\"", Shape(Sphere{}), {}, 0}}));
  });
  refused("lit_by", [](Scene& s) { s.objects[0].links.litBy = {"a\""}; });
  refused("light", [](Scene& s) { s.lights[0].links.name = "\""; });
  refused("excludes", [](Scene& s) { s.lights[0].links.excludes = {"\""}; });
  refused("material", [](Scene& s) { s.materials[0].name = "a\"b"; });
  refused("long", [](Scene& s) { s.objects[0].name = std::string(5000, 'a'); });
  refused("picture",
          [](Scene& s) { setTexture(s.materials[0].textures, "diffuse", pictureTexture("odd\".ppm")); });
  refused("face", [](Scene& s) { s.background.front.file = "odd\".ppm"; });
  waitFor(workspace.render);
}

TEST_F(WorkspaceTest, LinksFollowWhatIsRenamedAlsoInTheFile) {
  std::string text = R"(SBT-raytracer 1.0
camera { position=(0,0,4); viewdir=(0,0,-1); updir=(0,1,0); }
directional_light { name = sun; direction=(0,0,-1); color=(1,1,1); lights = ("ball"); } // of the ball
sphere { name = "ball"; lit_by = ("sun") }
)";
  write("linked.ray", text);
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("linked.ray")));
  Scene scene = renamed(workspace.document.scene(), "moon");
  workspace.edit("name", scene);
  scene = workspace.document.scene();
  scene.lights[0].links.name = "lamp";
  workspace.edit("name", scene);
  EXPECT_EQ(workspace.document.scene().objects[0].links.litBy, std::vector<std::string>{"lamp"});
  workspace.saveSceneOver();
  ASSERT_TRUE(settled(workspace));
  for (const auto& [old, now] : {std::pair{"(\"ball\")", "(\"moon\")"},
                                 {"\"ball\"", "\"moon\""},
                                 {"(\"sun\")", "(\"lamp\")"},
                                 {"name = sun", "name = \"lamp\""}})
    text.replace(text.find(old), std::string_view(old).size(), now);
  EXPECT_EQ(readFile(path("linked.ray")), text);
  waitFor(workspace.render);
}

TEST(BackgroundRender, CoarsePicturesAreEnlargedToTheEdges) {
  Picture small(2, 1);
  small.at(0, 0) = Color(1), small.at(1, 0) = Color(2);
  const Picture large = enlarged(small, {5, 3});
  EXPECT_EQ(large.at(0, 0), Color(1));
  EXPECT_EQ(large.at(2, 2), Color(1));
  EXPECT_EQ(large.at(3, 0), Color(2));
  EXPECT_EQ(large.at(4, 2), Color(2));
}

// --- files, in the background -------------------------------------------------------------------------

/// A file that keeps who reads it waiting until it is released; then it is an ordinary one.
class SlowFile {
 public:
  explicit SlowFile(const std::string& path) : path_(path) {
    std::error_code none;
    const auto before = std::filesystem::last_write_time(path, none);
    EXPECT_EQ(mkfifo(next().c_str(), 0600), 0);
    made_ = none ? std::filesystem::last_write_time(next()) : before + std::chrono::seconds(2);
    replace();
  }
  ~SlowFile() {
    if (pipe_ >= 0) ::close(pipe_);
  }
  SlowFile(const SlowFile&) = delete;
  SlowFile& operator=(const SlowFile&) = delete;

  void awaitReader() {
    while (pipe_ < 0) {
      pipe_ = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK);  // refused as long as nobody reads
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void release(const std::string& text) {
    awaitReader();
    writeFile(next(), text);
    answer(text);
  }
  /// Only who reads it now: the next one has to wait again.
  void releaseOne(const std::string& text) {
    awaitReader();
    EXPECT_EQ(mkfifo(next().c_str(), 0600), 0);
    answer(text);
  }

 private:
  std::string next() const { return path_ + ".next"; }
  /// The next file takes the place of this one, at once, and looks as old: it has not changed since it was
  /// read.
  void replace() const {
    std::filesystem::last_write_time(next(), made_);
    std::filesystem::rename(next(), path_);
  }
  /// What the reader has been waiting for. A later reader must not find the pipe, which has no writer
  /// then.
  void answer(const std::string& text) {
    EXPECT_EQ(::write(pipe_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    replace();
    ::close(std::exchange(pipe_, -1));
  }

  std::string path_;
  std::filesystem::file_time_type made_;
  int pipe_ = -1;
};

/// What the ball of kScene or kAnimated is called, or where it is.
std::string nameOf(const Workspace& workspace) { return workspace.document.scene().objects.at(0).name; }
Real xOf(const Workspace& workspace) {
  return workspace.document.scene().objects.at(0).worldFromObject.offset.x;
}
std::string sceneWith(const std::string& name) {
  std::string text = kScene;
  return text.replace(text.find("ball"), 4, name);
}

TEST_F(WorkspaceTest, ASceneIsOpenedInTheBackgroundAndTheOneBeforeStaysIfThatFails) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  SlowFile slow(path("slow.ray"));
  workspace.commandLine = {{"width", "30", {}}};
  workspace.open(path("slow.ray"));
  workspace.update();
  EXPECT_TRUE(workspace.reading());
  EXPECT_EQ(workspace.document.file(), path("scene.ray"));
  workspace.document.choose("depth", "1");  // the window goes on
  slow.release(sceneWith("moon"));
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.document.file(), path("slow.ray"));
  EXPECT_EQ(workspace.recent().front(), path("slow.ray"));
  EXPECT_EQ(nameOf(workspace), "moon");
  waitFor(workspace.render);
  EXPECT_EQ(workspace.render.picture().width, 30);

  EXPECT_FALSE(opened(workspace, path("nothing.ray")));
  EXPECT_EQ(workspace.document.file(), path("slow.ray"));
  const auto& log = workspace.log();
  EXPECT_TRUE(std::any_of(log.begin(), log.end(), [](const Workspace::LogEntry& entry) {
    return entry.level == Workspace::LogEntry::Level::error &&
           entry.text.find("nothing") != std::string::npos;
  }));
}

TEST_F(WorkspaceTest, OfSeveralFilesTheLastIsOpened) {
  Workspace workspace;
  SlowFile slow(path("slow.ray"));
  workspace.open(path("slow.ray"));
  slow.awaitReader();
  for (const char* name : {"nothing.ray", "scene.ray"}) workspace.open(path(name));
  slow.release(kScene);
  settled(workspace);
  EXPECT_EQ(workspace.document.file(), path("scene.ray"));
}

TEST_F(WorkspaceTest, AChangeOnDiskIsReadInTheBackgroundAndDestroysNoEdit) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  SlowFile slow(path("scene.ray"));
  for (; !workspace.reading(); workspace.update()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  workspace.document.edit("name", renamed(workspace.document.scene(), "moon"));
  workspace.document.choose("depth", "7");
  slow.release(sceneWith("star"));
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(nameOf(workspace), "star");
  EXPECT_EQ(workspace.document.settings().depth, 7);
  workspace.undo();
  EXPECT_EQ(nameOf(workspace), "moon");
}

TEST_F(WorkspaceTest, ADraggedTimeIsShownAtOnceAndReadInTheBackgroundAsOneStep) {
  write("scene.ray", kAnimated);
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  SlowFile slow(path("scene.ray"));
  workspace.choose("time", "0.5");
  workspace.choose("time", "1", true);
  workspace.document.choose("depth", "7");
  workspace.choose("time", "2", true);
  EXPECT_EQ(workspace.chosenSettings().time, 2);
  EXPECT_EQ(workspace.chosenSettings().depth, 7);
  EXPECT_EQ(workspace.document.settings().time, 0);
  EXPECT_EQ(xOf(workspace), 0);
  slow.release(kAnimated);
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.document.settings().time, 2);
  EXPECT_EQ(workspace.document.settings().depth, 7);
  EXPECT_EQ(xOf(workspace), 1);
  workspace.undo();
  EXPECT_EQ(xOf(workspace), 0);
  EXPECT_EQ(workspace.undoName(), "depth");
  EXPECT_THROW(workspace.choose("time", "soon"), Error);
  EXPECT_FALSE(workspace.reading());
}

TEST_F(WorkspaceTest, ADraggedTimeIsOneStepAlsoIfItIsShownOnTheWay) {
  write("scene.ray", kAnimated);
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  workspace.document.choose("depth", "7");
  SlowFile slow(path("scene.ray"));
  workspace.choose("time", "0.5");
  slow.releaseOne(kAnimated);
  workspace.choose("time", "1", true);
  slow.awaitReader();  // so the first is read
  workspace.choose("time", "2", true);
  workspace.update();
  EXPECT_EQ(xOf(workspace), 0.25);
  slow.release(kAnimated);
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(xOf(workspace), 1);
  workspace.undo();
  EXPECT_EQ(xOf(workspace), 0);
  EXPECT_EQ(workspace.undoName(), "depth");
}

TEST_F(WorkspaceTest, UndoTakesATimeBackThatIsStillBeingRead) {
  write("scene.ray", kAnimated);
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  SlowFile slow(path("scene.ray"));
  workspace.choose("time", "2");
  EXPECT_EQ(workspace.undoName(), "time");
  workspace.undo();
  EXPECT_EQ(workspace.undoName(), "");
  slow.release(kAnimated);
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.document.settings().time, 0);
  EXPECT_EQ(xOf(workspace), 0);
}

TEST_F(WorkspaceTest, ATimeThatCannotBeReadStaysWhatItWas) {
  write("scene.ray", kAnimated);
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  std::filesystem::remove(path("scene.ray"));
  workspace.choose("time", "2");
  EXPECT_FALSE(settled(workspace));
  EXPECT_EQ(workspace.chosenSettings().time, 0);
  EXPECT_FALSE(workspace.document.canUndo());
}

TEST_F(WorkspaceTest, AReferenceIsLoadedInTheBackground) {
  Picture picture(3, 2);
  picture.at(1, 1) = Color(1);
  writePicture(path("ordinary.png"), picture, Rounding::nearest);
  SlowFile slow(path("slow.png"));
  Workspace workspace;
  workspace.openReference(path("slow.png"));
  workspace.update();
  EXPECT_FALSE(workspace.reference());
  slow.release(readFile(path("ordinary.png")));
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(workspace.reference(), picture);
  EXPECT_EQ(workspace.referenceFile(), path("slow.png"));
}

TEST_F(WorkspaceTest, WhatIsBeingSavedIsSavedWhenTheWindowCloses) {
  {
    Workspace workspace;
    ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "900", {}}}));
    waitFor(workspace.render);
    for (const char* name : {"a.png", "b.png", "c.png"}) workspace.savePicture(path(name));
    workspace.document.edit("name", renamed(workspace.document.scene(), "moon"));
    workspace.saveScene(path("saved.ray"));
    EXPECT_TRUE(workspace.saving());
  }
  for (const char* name : {"a.png", "b.png", "c.png"}) EXPECT_EQ(readPicture(path(name)).width, 900) << name;
  EXPECT_NE(readFile(path("saved.ray")).find("moon"), std::string::npos);
}

TEST_F(WorkspaceTest, OtherFilesAreWrittenInTheBackgroundToo) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  workspace.saveBy(path("rays.svg"),
                   [file = path("rays.svg")](const Advance&) { writeFile(file, "<svg/>"); });
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(readFile(path("rays.svg")), "<svg/>");
  bool written = false;
  workspace.saveBy(path("scene.ray"), [&](const Advance&) { written = true; });
  EXPECT_FALSE(settled(workspace));
  EXPECT_FALSE(written);
  workspace.saveBy(path("none/rays.svg"),
                   [file = path("none/rays.svg")](const Advance&) { writeFile(file, "<svg/>"); });
  EXPECT_FALSE(settled(workspace));
}

TEST_F(WorkspaceTest, AFilmThatIsGivenUpIsNotWrittenAndSaysHowFarItIsBefore) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  std::atomic<bool> stopped = false;
  workspace.saveBy(path("film.apng"), [&](const Advance& advance) {
    while (advance(0.25)) std::this_thread::yield();
    stopped = true;
  });
  while (workspace.savingShare() == 0) std::this_thread::yield();
  EXPECT_EQ(workspace.savingShare(), 0.25);
  workspace.stopSaving();
  EXPECT_TRUE(settled(workspace)) << "this is no failure";
  EXPECT_TRUE(stopped);
  EXPECT_TRUE(tells(workspace, "film.apng was not written"));
  EXPECT_TRUE(workspace.takeWritten().empty());
  EXPECT_EQ(workspace.savingShare(), 0);
}

TEST_F(WorkspaceTest, TheKindOfAnEnvironmentIsTold) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  for (const char* face : {"posx", "negx", "posy", "negy", "posz", "negz"})
    writePicture(path(std::string("sky_") + face + ".png"), Picture(4, 4));
  writePicture(path("round.png"), Picture(8, 4));
  const auto isTold = [&](const char* file, const char* kind) {
    workspace.choose("environment", path(file));
    for (int i = 0; i < 5000 && !tells(workspace, kind); ++i) {  // once its render is there
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      workspace.update();
    }
    return tells(workspace, kind);
  };
  EXPECT_TRUE(isTold("sky_posx.png", "a cube of six faces"));
  EXPECT_TRUE(isTold("round.png", "a lat-long map"));
}

TEST_F(WorkspaceTest, NothingNewIsProposedAmongTheExamples) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  EXPECT_EQ(workspace.defaultPictureFile(), path("scene.png"));
  workspace.examples = std::filesystem::path(path("scene.ray")).parent_path().generic_string();
  const std::string here = std::filesystem::current_path().generic_string();
  EXPECT_EQ(workspace.defaultPictureFile(), here + "/scene.png");
  EXPECT_EQ(workspace.defaultSceneFile(), here + "/scene.ray");
  EXPECT_TRUE(workspace.newSceneFile().starts_with(here + "/scene")) << workspace.newSceneFile();
}

TEST_F(WorkspaceTest, WhatTheSceneIsMadeOfIsNotWrittenOver) {
  writePicture(path("land.png"), Picture(4, 4));
  const std::string land = readFile(path("land.png"));
  write("land.ray", std::string(kScene) + "height_field { file = \"land.png\"; }");
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("land.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);
  workspace.savePicture(path("land.png"));
  EXPECT_FALSE(settled(workspace));
  workspace.saveScene(path("land.ray"));  // its own file may be
  EXPECT_TRUE(settled(workspace));
  EXPECT_EQ(readFile(path("land.png")), land);
  EXPECT_FALSE(workspace.document.edited());
}

TEST_F(WorkspaceTest, AFragmentTakesNoWholePicturesPlace) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);
  workspace.savePicture(path("out.png"));
  ASSERT_TRUE(settled(workspace));
  const std::string whole = readFile(path("out.png"));
  workspace.document.choose("width", "3000");
  workspace.document.choose("spp", "100");
  workspace.update();
  workspace.render.stop();
  waitFor(workspace.render);
  workspace.savePicture(path("out.png"));
  ASSERT_TRUE(settled(workspace));
  if (workspace.render.session()->film().complete()) return;  // the render was quicker than this test
  EXPECT_EQ(readFile(path("out.png")), whole);
  EXPECT_TRUE(std::filesystem::exists(path("out.partial.png")));
}

TEST_F(WorkspaceTest, ASavedSceneIsWhatWasThereThenAndIsNotReadAgain) {
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray")));
  workspace.document.edit("name", renamed(workspace.document.scene(), "moon"));
  workspace.saveScene(path("scene.ray"));
  workspace.document.edit("name", renamed(workspace.document.scene(), "star"));  // while it is written
  EXPECT_TRUE(settled(workspace));
  EXPECT_NE(readFile(path("scene.ray")).find("moon"), std::string::npos);
  EXPECT_TRUE(workspace.document.edited());
  workspace.undo();
  EXPECT_FALSE(workspace.document.edited());
  const auto readings = workspace.document.readings();
  for (int i = 0; i < 60; ++i, workspace.update()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(workspace.document.readings(), readings);

  workspace.saveScene(path("no/such/folder.ray"));
  EXPECT_FALSE(settled(workspace));
  EXPECT_EQ(workspace.document.file(), path("scene.ray"));
  workspace.saveScene(path("late.ray"));
  ASSERT_TRUE(opened(workspace, path("scene.ray")));  // another document by then
  EXPECT_EQ(workspace.document.file(), path("scene.ray"));
}

TEST(BackgroundTask, DoesAllJobsInTurnOrOnlyTheNewest) {
  std::vector<int> done;
  {
    BackgroundTask<int> all(Jobs::all);
    for (int i = 0; i < 5; ++i)
      all.start([&done, i](const Cancelled& cancelled) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        EXPECT_FALSE(cancelled());
        return done.push_back(i), i;
      });
    while (!all.take()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(all.pending());
  }
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2, 3, 4}));

  BackgroundTask<int> newest;
  for (int i = 0; i < 5; ++i)
    newest.start([i](const Cancelled&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return i;
    });
  while (newest.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(newest.pending());
  EXPECT_EQ(newest.take(), 4);
  EXPECT_FALSE(newest.pending());
}

TEST(BackgroundTask, WithoutThreadsTakeDoesAJob) {
  std::vector<int> done;
  const auto job = [&done](int i) {
    return [&done, i](const Cancelled& cancelled) {
      EXPECT_FALSE(cancelled());
      return done.push_back(i), i;
    };
  };
  {
    BackgroundTask<int> all(Jobs::all, Threads::none), newest(Jobs::newest, Threads::none);
    for (int i = 0; i < 3; ++i) all.start(job(i)), newest.start(job(10 + i));
    EXPECT_TRUE(done.empty());
    EXPECT_TRUE(newest.busy() && newest.hasNews());
    EXPECT_EQ(newest.take(), 12);
    EXPECT_FALSE(newest.pending());
    EXPECT_EQ(newest.take(), std::nullopt);
    EXPECT_EQ(all.take(), 0);
    newest.start(job(13));
  }
  EXPECT_EQ(done, (std::vector<int>{12, 0, 1, 2})) << "files are written at the end, too";
}

TEST_F(WorkspaceTest, WithoutThreadsRendersBetweenFrames) {
  Session session;
  session.open(path("scene.ray"), std::vector<Choice>{{"width", "100", {}}});
  BackgroundRender render(Threads::none);
  render.start(std::make_shared<const Scene>(session.scene()), session.settings());
  std::vector<BackgroundRender::Phase> phases;
  for (; render.state().working(); render.advance())
    if (phases.empty() || phases.back() != render.state().phase) phases.push_back(render.state().phase);
  using Phase = BackgroundRender::Phase;
  EXPECT_EQ(phases, (std::vector<Phase>{Phase::building, Phase::coarse, Phase::tracing}));
  EXPECT_EQ(render.state().phase, Phase::finished);
  session.build();
  const RenderResult whole = session.renderPicture();
  EXPECT_EQ(render.picture().pixels, session.picture().pixels);
  EXPECT_EQ(render.result().statistics, whole.statistics);
}

TEST_F(WorkspaceTest, WithoutThreadsARenderIsStoppedAndReplaced) {
  Session session;
  session.open(path("scene.ray"), std::vector<Choice>{{"width", "100", {}}});
  const auto scene = std::make_shared<const Scene>(session.scene());
  Settings slow = session.settings();
  slow.spp = 4000000;
  BackgroundRender render(Threads::none);
  using Phase = BackgroundRender::Phase;
  const auto untilTracing = [&] {
    for (int i = 0; i < 20; ++i) render.advance();
    EXPECT_EQ(render.state().phase, Phase::tracing);
  };
  render.start(scene, slow);
  untilTracing();
  render.stop();
  EXPECT_EQ(render.state().phase, Phase::stopped);
  for (int i = 0; i < 3; ++i) render.advance();
  EXPECT_EQ(render.state().phase, Phase::stopped);
  EXPECT_EQ(render.result().end, End::cancelled);
  render.start(scene, slow);
  untilTracing();
  render.start(scene, session.settings());
  while (render.state().working()) render.advance();
  EXPECT_EQ(render.state().phase, Phase::finished);
}

TEST_F(WorkspaceTest, PinnedRaysGoWithTheirScene) {
  std::filesystem::copy_file(path("scene.ray"), path("other.ray"));
  Workspace workspace;
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);
  PixelInspector& inspector = workspace.inspector;
  const auto raysOf = [&](const std::shared_ptr<const Session>& session) {
    inspector.want(session, 5, 5, 0);
    waitFor(inspector);
    inspector.update();
  };
  raysOf(workspace.render.session());
  inspector.pin(true);
  raysOf(workspace.render.session());
  ASSERT_NE(inspector.pinned(), nullptr);
  ASSERT_TRUE(opened(workspace, path("scene.ray")));  // the same once more
  EXPECT_NE(inspector.pinned(), nullptr);
  ASSERT_TRUE(opened(workspace, path("other.ray")));
  EXPECT_EQ(inspector.pinned(), nullptr);
  waitFor(workspace.render);
  raysOf(workspace.render.session());
  EXPECT_EQ(inspector.pinned(), nullptr);
}

TEST_F(WorkspaceTest, ThePulseTellsWhetherThereIsSomethingNewToSee) {
  Workspace workspace;
  Workspace::Pulse before = workspace.pulse();
  const auto changed = [&] { return std::exchange(before, workspace.pulse()) != before; };
  EXPECT_FALSE(changed());
  ASSERT_TRUE(opened(workspace, path("scene.ray"), {{"width", "40", {}}}));
  waitFor(workspace.render);  // perhaps it ended while the file was opened
  waitFor(workspace.inspector);
  workspace.update();
  EXPECT_TRUE(changed());
  for (int i = 0; i < 50; ++i) {  // nothing happens, however long one looks
    workspace.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_FALSE(changed());
  }
  workspace.document.choose("rounding", "nearest");
  EXPECT_TRUE(changed());
  workspace.note("something");
  EXPECT_TRUE(changed());
  Settings slow = workspace.document.settings();
  slow.spp = 4000000;
  workspace.render.start(workspace.document.sharedScene(), slow);
  while (workspace.render.state().phase < BackgroundRender::Phase::tracing)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  // A pixel may be traced before one looks, so several are asked for.
  for (int x = 0; !before.tracing; x = 1 - x) {
    workspace.inspector.want(workspace.render.session(), x, 1, 0);
    changed();
  }
  workspace.inspector.forget();
  waitFor(workspace.inspector);
  EXPECT_TRUE(changed());
  EXPECT_FALSE(before.tracing);
  workspace.startRender();
  EXPECT_TRUE(changed());
}

}  // namespace
}  // namespace trace::test
