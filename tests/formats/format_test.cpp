#include "formats/format.h"

#include <gtest/gtest.h>

#include "ray_helpers.h"
#include "support/paths.h"

namespace trace::format_test {
namespace {

TEST(Format, TheTableNamesEachFormatOnce) {
  for (const SceneFormat& format : sceneFormats()) {
    EXPECT_FALSE(format.name.empty());
    EXPECT_FALSE(format.help.empty());
    for (const SceneFormat& other : sceneFormats())
      EXPECT_TRUE(&format == &other || format.name != other.name);
  }
}

TEST(Format, SaysWhatAFileIsThatIsNoScene) {
  const std::pair<std::string_view, const char*> cases[] = {
      {"", "an empty file"},
      {" \r\n", "only white space"},
      {" {\"a\": 1}", "what looks like JSON"},
      {"[1]", "what looks like JSON"},
      {"<html>", "what looks like XML or HTML"},
      {"\x89PNG\r\n", "a PNG picture"},
      {"\xff\xd8\xff\xe0", "a JPEG picture"},
      {std::string_view("a\0b", 3), "binary data"},
  };
  std::string formats;
  for (const SceneFormat& format : sceneFormats())
    formats += (formats.empty() ? "" : ", ") + std::string(format.name);
  const auto hintFor = [&](std::string_view kind) {
    return kind == "an empty file" || kind == "only white space"
               ? "the first line of a .ray file is Trace 1, or SBT-raytracer 1.1 as the courses have it"
               : "formats Trace reads: " + formats;
  };
  for (const auto& [bytes, kind] : cases)
    EXPECT_EQ(errorsOfFile(bytes), std::string("0:0: named .ray, but ") +
                                       (bytes.empty() ? "it is " : "holds ") + std::string(kind) + " [" +
                                       hintFor(kind) + "]");
  for (const std::string text : {"hello", "SBT-ray 1.0", "/* not closed SBT-raytracer 1.0"})
    EXPECT_EQ(
        errorsOfFile(text + "\nsphere { }"),
        "1:1: expected Trace 1 on the first line, found \"" + text +
            "\" [every .ray file begins with the line Trace 1, or SBT-raytracer 1.1 as the courses have it]");
}

TEST(Format, ReadsFilesByName) {
  Messages messages;
  const std::string file = test::sourceFolder() + "/tests/corpus/ray/plain.ray";
  const Scene scene = readScene(file, messages);
  EXPECT_EQ(scene.file, file);
  EXPECT_EQ(scene.format, "ray");
  EXPECT_EQ(scene.objects.size(), 3u);
  try {
    readScene(file + ".no", messages);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::io);
  }
}

}  // namespace
}  // namespace trace::format_test
