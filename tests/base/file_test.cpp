#include "base/files/file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

std::string folder(const char* name) {
  const fs::path path = fs::path(testing::TempDir()) / name;
  fs::remove_all(path);
  fs::create_directories(path);
  return path.string();
}

size_t entries(const std::string& path) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

TEST(File, WritesAllBytesAndLeavesNothingElse) {
  const std::string here = folder("trace_write"), path = here + "/a.bin";
  const std::string bytes("a\n\r\n\0\x1a\xff", 7);
  writeFile(path, "old");
  writeFile(path, bytes);
  EXPECT_EQ(readFile(path), bytes);
  EXPECT_EQ(entries(here), 1u);
}

TEST(File, NamesFromAFolderAreTheWayFromIt) {
  EXPECT_EQ(nameFrom("/a/b", "/a/b/c.png"), "c.png");
  EXPECT_EQ(nameFrom("/a/b", "/a/c/d.png"), "../c/d.png");
  EXPECT_EQ(nameFrom("b", "/a/d.png"), "/a/d.png") << "no way leads there";
  if (!fs::path("C:/").has_root_name()) return;
  EXPECT_EQ(nameFrom("C:/a", "C:/b/d.png"), "../b/d.png");
  EXPECT_EQ(nameFrom("C:/a", "Z:/b/d.png"), "Z:/b/d.png");
}

TEST(File, ANameThatNoFileMayHaveIsAnError) {
  const std::string odd = "a\xff\xfe.png";  // not UTF-8
  if (!mayNameFile(odd)) EXPECT_THROW(besideFile("scene.ray", odd), Error);
  EXPECT_THROW(readBeside("scene.ray", odd), Error);
  EXPECT_TRUE(mayNameFile("Gl\xc3\xbc\xc3\xa7k.png"));
}

TEST(File, SaysWhyItCannot) {
  const std::string here = folder("trace_fail");
  for (const std::string& path : {here, here + "/none/a", std::string("/dev/null/a"), std::string()}) {
    EXPECT_THROW(writeFile(path, "x"), Error) << path;
    EXPECT_THROW(checkWritable(path), Error) << path;
    EXPECT_THROW(readFile(path), Error) << path;
  }
  EXPECT_EQ(entries(here), 0u);
  checkWritable(here + "/free.png");
  EXPECT_EQ(entries(here), 0u);
  try {
    readFile(here + "/missing.ray");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::io);
    EXPECT_NE(std::string(error.what()).find("missing.ray\": No such file"), std::string::npos);
  }
}

TEST(File, BesideFile) {
  EXPECT_EQ(besideFile("scenes/a.ray", "b.bmp"), "scenes/b.bmp");
  EXPECT_EQ(besideFile("a.ray", "b.bmp"), "b.bmp");
  EXPECT_EQ(besideFile("scenes/a.ray", "/b.bmp"), "/b.bmp");
}

}  // namespace
}  // namespace trace
