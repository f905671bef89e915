#include "base/files/read_scope.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/named_file.h"
#include "base/parallel.h"
#include "support/folder.h"

namespace trace::read_scope_test {
namespace {

namespace fs = std::filesystem;

/// home/scene.ray with what lies around it.
class ReadScopeTest : public testing::Test {
 protected:
  ReadScopeTest() {
    for (const char* name : {"home/in", "homely", "textures"}) fs::create_directories(folder_ / name);
    for (const char* name : {"home/a.png", "home/in/b.png", "homely/c.png", "textures/d.png"})
      writeFile(folder_ / name, name);
    std::error_code ignored;  // Windows lets only some users make links
    fs::create_symlink("../textures/d.png", folder_ / "home/link.png", ignored);
    fs::create_directory_symlink("../textures", folder_ / "home/linked", ignored);
    links_ = fs::exists(folder_ / "home/linked", ignored);
  }
  bool may(const std::string& name) const { return mayRead(folder_ / name); }

  const test::Folder folder_;
  bool links_ = false;  // there are some
  const std::string scene_ = folder_ / "home/scene.ray";
};

TEST_F(ReadScopeTest, WithoutASceneAllMayBeRead) { EXPECT_TRUE(may("textures/d.png")); }

TEST_F(ReadScopeTest, ASceneReadsBelowItsFolderAndNoLinkLeadsOut) {
  const ReadScope scope = ReadScope::ofScene(scene_);
  for (const char* name : {"home/a.png", "home/in/b.png", "home/in/../a.png", "home/not-there.png"})
    EXPECT_TRUE(may(name)) << name;
  for (const char* name : {"textures/d.png", "home/../textures/d.png", "homely/c.png", "not-there.png"})
    EXPECT_FALSE(may(name)) << name;
  for (const char* name : {"home/link.png", "home/linked/d.png"})
    EXPECT_EQ(may(name), !links_) << name << ": no link leads out";
  EXPECT_FALSE(mayRead("/etc/passwd"));
}

TEST_F(ReadScopeTest, WhatIsAllowedAndDenied) {
  const ReadScope command({folder_ / "textures", folder_ / "homely/c.png"}, {folder_ / "home/in"});
  const ReadScope scope = ReadScope::ofScene(scene_);
  EXPECT_TRUE(may("textures/d.png"));
  EXPECT_TRUE(may("home/link.png"));
  EXPECT_TRUE(may("homely/c.png"));
  EXPECT_FALSE(may("home/in/b.png")) << "denial is stronger";
}

TEST_F(ReadScopeTest, WhereLettersOfBothCasesNameOneFileTheyHaveOneRule) {
  const bool same = fs::exists(folder_ / "home/IN/B.png");
  const ReadScope command({folder_ / "Textures"}, {folder_ / "home/in"});
  const ReadScope scope = ReadScope::ofScene(folder_ / "HOME/scene.ray");
  for (const char* name : {"home/a.png", "Home/a.png", "textures/d.png", "TEXTURES/d.png"})
    EXPECT_EQ(may(name), same) << name;
  for (const char* name : {"HOME/In/b.png", "HOME/IN/b.png"}) EXPECT_EQ(may(name), !same) << name;
  EXPECT_FALSE(may("home/in/b.png")) << "denied as it is spelled";
}

TEST_F(ReadScopeTest, TheRootIsAllFilesOnEveryDrive) {
  const ReadScope program({"/"});
  const ReadScope scope = ReadScope::ofScene(scene_);
  for (const std::string& name :
       {folder_ / "textures/d.png", std::string("/etc/passwd"), std::string("Q:/a.png")})
    EXPECT_TRUE(mayRead(name)) << name;
}

TEST_F(ReadScopeTest, ThePartOfASceneHasTheRulesOfTheScene) {
  const ReadScope scope = ReadScope::ofScene(scene_);
  const ReadScope part = ReadScope::ofScene(folder_ / "textures/mesh.obj");
  EXPECT_TRUE(may("home/a.png"));
  EXPECT_FALSE(may("textures/d.png"));
}

TEST_F(ReadScopeTest, WorkersHaveTheRulesToo) {
  const ReadScope scope = ReadScope::ofScene(scene_);
  Job job;
  std::atomic<int> allowed = 0;
  parallelChunks(8, 4, job, [&](std::int64_t, int) { allowed += may("textures/d.png"); });
  EXPECT_EQ(allowed, 0);
}

TEST_F(ReadScopeTest, TheMessageIsTheSameForWhatIsThereAndWhatIsNot) {
  const ReadScope scope = ReadScope::ofScene(scene_);
  const auto said = [&](const std::string& name) -> std::string {
    try {
      readBeside(scene_, name);
    } catch (const ReadDenied& denied) {
      EXPECT_EQ(denied.fault(), Fault::scene);
      return denied.what();
    }
    return "";
  };
  const std::string there = said("../textures/d.png"), missing = said("../textures/x.png");
  EXPECT_NE(there.find("--allow-read "), std::string::npos) << there;
  EXPECT_NE(there.find("/textures allows it"), std::string::npos) << there;
  std::string expected = there;
  expected.replace(expected.find("d.png"), 5, "x.png");
  EXPECT_EQ(missing, expected);
}

// --- names -------------------------------------------------------------------------------------------------

TEST_F(ReadScopeTest, NamesAsOtherProgramsWriteThem) {
  writeFile(folder_ / "home/my tex.png", "x");
  const ReadScope scope = ReadScope::ofScene(scene_);
  const std::pair<const char*, const char*> cases[] = {
      {"a.png", "home/a.png"},
      {"\"a.png\"", "home/a.png"},
      {" a.png\r", "home/a.png"},
      {"in\\b.png", "home/in/b.png"},
      {"C:\\stuff\\in\\b.png", "home/in/b.png"},
      {"C:\\stuff\\in\\a.png", "home/a.png"},
      {"/home/somebody/a.png", "home/a.png"},
      {"my%20tex.png", "home/my tex.png"},
      {"file://in/b.png", "home/in/b.png"},
      {"../elsewhere/a.png", "home/a.png"},
  };
  for (const auto& [name, file] : cases) {
    const NamedFile found = namedFile(scene_, name);
    EXPECT_TRUE(fs::exists(found.path) && fs::equivalent(found.path, folder_ / file))
        << name << ": " << found.path;
    EXPECT_EQ(found.remark, "") << name;
  }
}

TEST_F(ReadScopeTest, LettersOfAnotherCaseAreRemarked) {
  if (fs::exists(folder_ / "home/a.PNG")) GTEST_SKIP() << "names of files ignore the case of letters here";
  const ReadScope scope = ReadScope::ofScene(scene_);
  for (const char* name : {"A.PNG", "In/B.png", "IN\\b.PNG", "Textures/A.png"}) {
    const NamedFile found = namedFile(scene_, name);
    EXPECT_TRUE(fs::exists(found.path)) << name;
    EXPECT_NE(found.remark.find("letters differ in their case"), std::string::npos) << name;
  }
}

TEST_F(ReadScopeTest, TheExactNameIsBetterThanOneOfAnotherCase) {
  if (fs::exists(folder_ / "home/a.PNG")) GTEST_SKIP() << "names of files ignore the case of letters here";
  writeFile(folder_ / "home/A.png", "other");
  EXPECT_EQ(readFile(namedFile(scene_, "A.png").path), "other");
  EXPECT_EQ(readFile(namedFile(scene_, "a.png").path), "home/a.png");
}

TEST_F(ReadScopeTest, NothingOutsideIsLookedFor) {
  const ReadScope scope = ReadScope::ofScene(scene_);
  EXPECT_FALSE(namesFile(scene_, "textures/d.png")) << "which lies above";
  EXPECT_FALSE(namesFile(scene_, "TEXTURES/D.PNG"));
  EXPECT_FALSE(namesFile(scene_, folder_ / "textures/d.png"));
  const ReadScope more({folder_ / "textures"});
  EXPECT_TRUE(namesFile(scene_, "textures/d.png"));
}

}  // namespace
}  // namespace trace::read_scope_test
