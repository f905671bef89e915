// ray texture.
#include <gtest/gtest.h>

#include "image/codecs/codec.h"
#include "program.h"
#include "support/paths.h"

namespace trace::test {
namespace {

using TextureCommand = ProgramTest;

TEST_F(TextureCommand, IsWrittenAsAPicture) {
  EXPECT_EQ(run({"texture", "checker", "-o", "t.png", "--size", "4x2", "--across", "4"}).code, 0);
  const Picture picture = readPicture(path("t.png"));
  ASSERT_EQ(picture.width, 4);
  ASSERT_EQ(picture.height, 2);
  EXPECT_EQ(picture.at(0, 1), Color(1));
  EXPECT_EQ(picture.at(1, 1), Color(0));
  EXPECT_EQ(picture.at(0, 0), Color(0));

  writeFile(path("s.ray"),
            "SBT-raytracer 1.0\ntexture = checker { name = floor; a = (1, 0, 0); space = uv; }\n");
  EXPECT_EQ(run({"texture", "s.ray:floor", "-o", "t.png", "--size", "2x2", "--across", "2"}).code, 0);
  EXPECT_EQ(readPicture(path("t.png")).at(0, 1), Color(1, 0, 0));
  EXPECT_NE(run({"texture", "s.ray:flor", "-o", "t.png"}).err.find("did you mean \"floor\"?"),
            std::string::npos);
  EXPECT_NE(run({"texture", "marbel"}).err.find("did you mean \"marble\"?"), std::string::npos);
  EXPECT_NE(run({"texture", "marble", "-o", "t.png", "--size", "12"}).err.find("WIDTHxHEIGHT"),
            std::string::npos);
}

TEST_F(TextureCommand, ListsKindsAndFields) {
  EXPECT_NE(run({"texture"}).out.find("  granite "), std::string::npos);
  EXPECT_NE(run({"texture", "marble"}).out.find("  turbulence "), std::string::npos);
  EXPECT_EQ(run({"texture", "--markdown"}).out, readFile(test::sourceFolder() + "/docs/texture-fields.md"))
      << "run: ray texture --markdown >docs/texture-fields.md";
}

}  // namespace
}  // namespace trace::test
