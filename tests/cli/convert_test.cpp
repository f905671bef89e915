// ray convert: from any format to any that can be written, with a camera, lights and a material of one's own.
#include <gtest/gtest.h>

#include "program.h"
#include "support/gltf.h"

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

TEST_F(Convert, WritesWhatVrml2outWroteOfAVrmlFileAlone) {
  std::filesystem::create_directory(path("deep"));
  write("deep/park.wrl", "#VRML V1.0 ascii\nSphere { radius 2 }\n");
  const auto alone = run({"convert", "deep/park.wrl"});
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_TRUE(alone.last.starts_with("wrote deep/park.out (1 object")) << alone.last;
  EXPECT_EQ(run({"convert", "deep/park.wrl", "two.out"}).code, 0);
  EXPECT_EQ(read("deep/park.out"), read("two.out"));
  const auto other = run({"convert", "tri.off"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(test::contains(other.err, "expected the names of two files, found 1"));
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

/// Four colours around, dark below: the picture stands upright on what is seen from the front, and is not
/// mirrored. Every format that names it shows the same.
TEST_F(Convert, PutsAPictureOnAProfile) {
  Raster four(4, 2, 3, 255);
  four.samples = std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255,  // above
                                           51,  0, 0, 0, 51,  0, 0, 0, 51,  51,  51,  51};
  for (const char* name : {"pictures", "out"}) std::filesystem::create_directory(path(name));
  write("pictures/four.png", encodePng(four));
  write("can.txt", "1 0\n1 2\n");
  const std::vector<std::string> view{"--camera", "position = (0, 1, 50); look_at = (0, 1, 0); fov = 3",
                                      "--light", "ambient_light { color = 1; }"};
  const auto convert = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "convert");
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), {"--allow-read", path("pictures")});
    const auto r = run(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return r;
  };
  convert({"--revolve", "can.txt", "out/can.ray", "--picture", "pictures/four.png"});
  EXPECT_TRUE(test::contains(read("out/can.ray"), "\"../pictures/four.png\""));
  const auto rendered = [&](const std::string& scene) {
    EXPECT_EQ(run({scene, "-w", "40", "-o", "seen.ppm", "--allow-read", path("pictures")}).code, 0) << scene;
    return readPicture(path("seen.ppm"));
  };
  const Picture seen = rendered("out/can.ray");
  constexpr int kLeft = 9, kRight = 30, kAbove = 12, kBelow = 27;  // in the middle of a texel, nearly
  const auto expectNear = [&](int x, int y, const Color& wanted) {
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
      EXPECT_NEAR(seen.at(x, y).*channel, wanted.*channel, 0.1) << x << ", " << y;
  };
  expectNear(kLeft, kAbove, {0, 0, 1});
  expectNear(kRight, kAbove, Color(1));
  expectNear(kLeft, kBelow, {0, 0, 0.2});
  expectNear(kRight, kBelow, Color(0.2));

  EXPECT_TRUE(
      test::contains(run({"info", "out/can.ray", "--allow-read", path("pictures")}).out, "objects (1)"));
  for (const char* name : {"out/can.obj", "out/can.ply"}) {
    const auto r = convert({"--revolve", "can.txt", name, "--picture", "pictures/four.png"});
    EXPECT_FALSE(test::contains(r.err, "texture")) << r.err;
    convert({name, "again.ray"});
    EXPECT_EQ(rendered("again.ray"), seen) << name;
  }
  EXPECT_TRUE(test::contains(read("out/can.mtl"), "map_Kd ../pictures/four.png\n"));

  EXPECT_EQ(run({"convert", "--revolve", "can.txt", "a.ray", "--picture", "no.png"}).code, 1);
  EXPECT_FALSE(exists("a.ray"));
  EXPECT_EQ(run({"convert", "tri.off", "a.ray", "--picture", "pictures/four.png"}).code, 2);
}

TEST_F(Convert, WritesNothingWhereOneOfItsFilesCannotBeWritten) {
  const std::string precious = "mtllib kept.mtl\nprecious";
  write("kept.obj", precious);
  std::filesystem::create_directory(path("kept.mtl"));
  const auto refused = run({"convert", "tri.off", "kept.obj"});
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_TRUE(refused.last.starts_with("nothing written")) << refused.last;
  EXPECT_EQ(read("kept.obj"), precious);
}

TEST_F(Convert, SparesMaterialsThatBelongToSomethingElse) {
  write("y.mtl", "precious");
  const auto first = run({"convert", "tri.off", "y.obj"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(read("y.mtl"), "precious");
  EXPECT_TRUE(first.last.starts_with("wrote y.obj and y-2.mtl (1 object, 1 triangle) in ")) << first.last;
  EXPECT_TRUE(first.last.ends_with("; y.mtl is kept as it is, for y.obj did not name it")) << first.last;
  EXPECT_TRUE(test::contains(read("y.obj"), "mtllib y-2.mtl\n"));
  EXPECT_TRUE(test::contains(read("y-2.mtl"), "newmtl "));
  write("y-2.mtl", "of y.obj");
  EXPECT_EQ(run({"convert", "tri.off", "y.obj"}).code, 0);
  EXPECT_TRUE(test::contains(read("y-2.mtl"), "newmtl ")) << "y.obj names it, so it is replaced with it";
  EXPECT_FALSE(exists("y-3.mtl"));
}

TEST_F(Convert, ReplacesTheMaterialsOfTheFileItReplaces) {
  ASSERT_EQ(run({"convert", "tri.off", "z.obj"}).code, 0);
  const auto again = run({"convert", "tri.off", "z.obj", "--material", "diffuse = (0.25, 0, 0)"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(again.last.starts_with("wrote z.obj and z.mtl (")) << again.last;
  EXPECT_EQ(again.last.find("kept"), std::string::npos) << again.last;
  EXPECT_TRUE(test::contains(read("z.mtl"), "Kd 0.25 0 0"));
  EXPECT_FALSE(exists("z-2.mtl"));
}

TEST_F(Convert, CountsWhatItWrote) {
  write("mixed.ray",
        "SBT-raytracer 1.0\ncamera { }\nsphere { }\nplane { }\ntranslate(3, 0, 0, cylinder { })\n");
  ASSERT_EQ(run({"convert", "mixed.ray", "mixed.obj"}).code, 0);
  std::istringstream lines(read("mixed.obj"));
  std::size_t triangles = 0;
  for (std::string line; std::getline(lines, line);) triangles += line.starts_with("f ");
  ASSERT_GT(triangles, 100u);
  const std::string counts = "(2 objects, " + std::to_string(triangles) + " triangles)";
  for (const char* name : {"mixed.obj", "mixed.ply"})
    EXPECT_TRUE(test::contains(run({"convert", "mixed.ray", name}).last, counts)) << name;
  const auto composer = run({"convert", "mixed.ray", "mixed.out"});  // keeps spheres as they are
  EXPECT_TRUE(test::contains(run({"info", "mixed.out"}).out, "objects (2)"));
  EXPECT_TRUE(test::contains(composer.last, "(2 objects, ")) << composer.last;
  EXPECT_FALSE(test::contains(composer.last, counts)) << composer.last;
  EXPECT_TRUE(test::contains(run({"convert", "mixed.ray", "all.ray"}).last, "(3 objects)"));
}

TEST_F(Convert, TakesTheMomentThatTheSceneChooses) {
  const std::string scene =
      "SBT-raytracer 1.0\ncamera { position=(0,0,9); viewdir=(0,0,-1); updir=(0,1,0); }\n"
      "settings { time = 2; }\ntranslate(key((0, 0), (2, 0.5)), 0, 0, sphere { })\n";
  write("moving.ray", scene);
  const auto converted = run({"convert", "moving.ray", "still.ray"});
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_TRUE(test::contains(converted.err, "an animated scene is written as it is at 2 s")) << converted.err;
  EXPECT_TRUE(test::contains(read("still.ray"), "translate(0.5, 0, 0")) << read("still.ray");
  EXPECT_TRUE(
      test::contains(run({"convert", "moving.ray", "later.ray", "--time", "1"}).err, "as it is at 1 s"));
  EXPECT_TRUE(test::contains(read("later.ray"), "translate(0.25, 0, 0")) << read("later.ray");
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

TEST_F(Convert, SaysWhatIsLeftOut) {
  write("all.ray",
        "SBT-raytracer 1.0\ncamera { position=(0,0,9); viewdir=(0,0,-1); updir=(0,1,0); }\n"
        "point_light { position=(0,0,5); color=(1,1,1); }\nbackground { color = (0, 0, 1); }\n"
        "sphere { material = { diffuse = checker { }; } }\n");
  const std::string rest =
      "left out, as the format has none of them: the camera, the light, the background and "
      "textures of 1 material";
  for (const char* file : {"all.obj", "all.ply"}) {
    const auto r = run({"convert", "all.ray", file});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(test::contains(r.err, rest)) << r.err;
  }
  const std::string composer = run({"convert", "all.ray", "all.out"}).err;
  EXPECT_TRUE(test::contains(composer, "the background is left out")) << composer;
  EXPECT_TRUE(test::contains(composer, "textures are left out, but for pictures of diffuse")) << composer;
  EXPECT_FALSE(test::contains(run({"convert", "tri.off", "tri.ply"}).err, "left out"));
}

/// Three pictures, two of one name.
std::vector<InsideFile> threePictures() {
  return {{"wheel", test::smallPng(200, 0, 0)},
          {"wheel", test::smallPng(0, 200, 0)},
          {"The roof.png", test::smallPng(0, 0, 200)}};
}

TEST_F(Convert, PicturesInsideTheFileAreWrittenBesideIt) {
  const std::vector<InsideFile> pictures = threePictures();
  write("car.glb", test::gltfOf(pictures, true));
  const auto first = run({"convert", "car.glb", "my car.ray"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(
      first.last.starts_with("wrote my car.ray, my-car-wheel.png, my-car-wheel-2.png and "
                             "my-car-The-roof.png (3 objects, 6 triangles) in "))
      << first.last;
  EXPECT_EQ(read("my-car-wheel.png"), pictures[0].bytes);
  EXPECT_EQ(read("my-car-wheel-2.png"), pictures[1].bytes);
  EXPECT_EQ(read("my-car-The-roof.png"), pictures[2].bytes);
  EXPECT_FALSE(test::contains(first.err, "left out")) << first.err;

  const std::size_t files = this->files();
  const auto second = run({"convert", "car.glb", "my car.ray"});
  EXPECT_EQ(second.last.substr(0, second.last.find(" in ")), first.last.substr(0, first.last.find(" in ")));
  EXPECT_EQ(this->files(), files) << "the same pictures have the same names again";

  // By itself the file has the kind defaults, and the scene made of it has not: their colours are alike.
  const auto has = [](const Picture& picture, Real Color::*most, Real Color::*other, Real Color::*third) {
    return std::any_of(picture.pixels.begin(), picture.pixels.end(), [&](const Color& c) {
      return c.*most > 0.2 && c.*most > 1.5 * c.*other && c.*most > 1.5 * c.*third;
    });
  };
  for (const char* scene : {"car.glb", "my car.ray"}) {
    ASSERT_EQ(run({scene, "-w", "40", "-o", "a.ppm"}).code, 0);
    const Picture picture = readPicture(path("a.ppm"));
    EXPECT_TRUE(has(picture, &Color::r, &Color::g, &Color::b)) << scene;
    EXPECT_TRUE(has(picture, &Color::g, &Color::r, &Color::b)) << scene;
    EXPECT_TRUE(has(picture, &Color::b, &Color::r, &Color::g)) << scene;
  }
}

TEST_F(Convert, ReplacesThePicturesOfTheFileItReplacesAndNoOther) {
  const std::vector<InsideFile> pictures = threePictures();
  write("car.glb", test::gltfOf(pictures, true));
  write("out-wheel.png", "precious");
  const auto first = run({"convert", "car.glb", "out.ray"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(read("out-wheel.png"), "precious");
  EXPECT_EQ(read("out-wheel-2.png"), pictures[0].bytes);
  EXPECT_EQ(read("out-wheel-3.png"), pictures[1].bytes);
  EXPECT_TRUE(first.last.ends_with("; out-wheel.png is kept as it is, for out.ray did not name it"))
      << first.last;

  const std::vector<InsideFile> repainted{
      {"wheel", test::smallPng(9, 9, 9)}, pictures[1], {"The roof.png", test::smallPng(7, 7, 7)}};
  write("car.glb", test::gltfOf(repainted, false));
  EXPECT_EQ(run({"convert", "car.glb", "out.ray"}).code, 0);
  EXPECT_EQ(read("out-wheel.png"), "precious");
  EXPECT_EQ(read("out-wheel-2.png"), repainted[0].bytes) << "out.ray named it";
  EXPECT_EQ(read("out-wheel-3.png"), repainted[1].bytes);
  EXPECT_EQ(read("out-The-roof.png"), repainted[2].bytes);

  // A picture that the scene itself is made of stays, though the file that is replaced names it as well.
  write("in.ray",
        "SBT-raytracer 1.0\nmesh { file = \"car.glb\"; }\nsphere { material = { diffuse = "
        "map(\"out-The-roof.png\"); } }\n");
  const auto both = run({"convert", "in.ray", "out.ray"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_TRUE(test::contains(read("out.ray"), "out-The-roof.png\"")) << "the sphere's";
  EXPECT_TRUE(test::contains(read("out.ray"), "out-The-roof-2.png\"")) << "the mesh's";
  EXPECT_EQ(read("out-The-roof.png"), repainted[2].bytes);
}

TEST_F(Convert, PicturesInsideTheFileAreNamedAsLostWhereNothingLiesBeside) {
  write("inside.wrl",
        "#VRML V2.0 utf8\nShape { appearance Appearance { texture PixelTexture { image 1 1 3 0xff0000 } }\n"
        "geometry Box { } }\n");
  std::filesystem::create_symlink("/dev/null", path("nothing.ray"));
  const std::size_t files = this->files();
  const auto r = run({"convert", "inside.wrl", "nothing.ray"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(test::contains(r.err, "pictures that lie inside the file are left out: 1")) << r.err;
  EXPECT_EQ(this->files(), files);
  EXPECT_EQ(run({"convert", "inside.wrl", "nothing.ray", "--strict"}).code, 3) << "warnings are errors";
}

TEST_F(Convert, WarningsStandInTheOrderOfTheFile) {
  write("order.ray",
        "SBT-raytracer 1.0\nsphere { wobble = 1; }\nbox { material = { diffuse = (7, 0, 0); } }\n"
        "cone { wibble = 1; }\nsphere { wobble = 2; }\n");
  const std::string err = run({"render", "order.ray", "-w", "4"}).err;
  std::size_t last = 0;
  for (const char* line : {":2:", ":3:", ":4:"}) {
    const std::size_t at = err.find(line);
    EXPECT_NE(at, std::string::npos) << err;
    EXPECT_GT(at, last) << err;
    last = at;
  }
}

}  // namespace
}  // namespace trace
