// ray convert: from any format to any that can be written, with a camera, lights and a material of one's own.
#include <gtest/gtest.h>

#include "program.h"

namespace trace {
namespace {

class Convert : public test::ProgramTest {
 protected:
  Convert() { write("tri.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0.125\n3 0 1 2\n"); }
  std::string read(const std::string& name) const { return readFile(path(name)); }
};

TEST_F(Convert, GoesRoundThroughTheFormats) {
  const auto ray = run({"convert", "tri.off", "tri.ray"});
  EXPECT_EQ(ray.code, 0) << ray.err;
  EXPECT_TRUE(ray.last.starts_with("wrote tri.ray (1 object, 1 triangle) in")) << ray.last;
  EXPECT_EQ(ray.out, "");
  EXPECT_EQ(run({"convert", "tri.ray", "tri.obj"}).code, 0);
  EXPECT_TRUE(exists("tri.mtl"));
  EXPECT_EQ(run({"convert", "--ascii", "tri.obj", "tri.ply"}).code, 0);
  EXPECT_TRUE(test::contains(read("tri.ply"), "end_header\n0 0 0\n1 0 0\n0 1 0.125\n3 0 1 2\n"));
  EXPECT_EQ(run({"convert", "--digits", "2", "tri.off", "short.ray"}).code, 0);
  EXPECT_TRUE(test::contains(read("short.ray"), "(0, 1, 0.12)"));
}

TEST_F(Convert, ReplacesCameraLightsAndMaterial) {
  const auto converted =
      run({"convert", "tri.off", "tri.ray", "--camera", "position = (0, 0, 9); fov = 20", "--light",
           "point_light { position = (1, 2, 3); color = (1, 1, 1); }", "--light",
           "ambient_light { color = 0.5; }", "--material", "diffuse = (1, 0, 0)"});
  ASSERT_EQ(converted.code, 0) << converted.err;
  EXPECT_FALSE(test::contains(converted.err, "warning")) << converted.err;
  const std::string text = read("tri.ray");
  for (const char* part : {"position = (0, 0, 9);", "fov = 20;", "point_light {", "color = (0.5, 0.5, 0.5);",
                           "material = { diffuse = (1, 0, 0); };"})
    EXPECT_TRUE(test::contains(text, part));
  EXPECT_FALSE(test::contains(text, "directional_light"));
  EXPECT_EQ(run({"convert", "tri.off", "tri.ray", "--light", "sphere { }"}).code, 2);
  EXPECT_EQ(run({"convert", "tri.off", "tri.ray", "--camera", "fov = x"}).code, 3);
}

TEST_F(Convert, TurnsAProfile) {
  write("can.txt", "# a can\n0 0\n1 0\n1 2\n0 2\n");
  const auto turned = run({"convert", "--revolve", "can.txt", "can.ply", "--steps", "8"});
  EXPECT_EQ(turned.code, 0) << turned.err;
  EXPECT_TRUE(test::contains(turned.last, "32 triangles")) << turned.last;
  write("wrong.txt", "0 0\n-1 2\n");
  const auto wrong = run({"convert", "--revolve", "wrong.txt", "wrong.ply"});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_TRUE(
      test::contains(wrong.err, "wrong.txt:2:1: error: expected a distance from the axis of 0 or more"));
  EXPECT_FALSE(exists("wrong.ply"));
}

TEST_F(Convert, WritesNothingWhereOneOfItsFilesCannotBeWritten) {
  write("kept.obj", "precious");
  std::filesystem::create_directory(path("kept.mtl"));
  const auto refused = run({"convert", "tri.off", "kept.obj"});
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_TRUE(refused.last.starts_with("nothing written")) << refused.last;
  EXPECT_EQ(read("kept.obj"), "precious");
}

TEST_F(Convert, TakesTheMomentThatTheSceneChooses) {
  const std::string scene =
      "SBT-raytracer 1.0\ncamera { position=(0,0,9); viewdir=(0,0,-1); updir=(0,1,0); }\n"
      "settings { time = 2; }\ntranslate(key((0, 0), (2, 0.5)), 0, 0, sphere { })\n";
  write("moving.ray", scene);
  const auto converted = run({"convert", "moving.ray", "still.ray"});
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_TRUE(test::contains(converted.err, "what changes with time is written as it is at 2 s"))
      << converted.err;
  EXPECT_TRUE(test::contains(read("still.ray"), "translate(0.5, 0, 0")) << read("still.ray");
}

TEST_F(Convert, SaysWhatItCannotDo) {
  write("endless.ray", "SBT-raytracer 1.0 plane { }");
  EXPECT_EQ(run({"convert", "tri.off"}).code, 2);
  EXPECT_EQ(run({"convert", "tri.off", "tri.off"}).code, 2) << "OFF is only read";
  EXPECT_EQ(run({"convert", "no.off", "tri.ray"}).code, 1);
  EXPECT_EQ(run({"convert", "endless.ray", "endless.ply"}).code, 3) << "a plane has no triangles";
  EXPECT_EQ(run({"convert", "--steps", "2", "tri.off", "tri.ray"}).code, 2);
  const std::string scene = readFile(path("white.ray"));
  EXPECT_EQ(run({"convert", "white.ray", "./white.ray"}).code, 2) << "its comments and keys would be lost";
  EXPECT_EQ(readFile(path("white.ray")), scene);
}

}  // namespace
}  // namespace trace
