// What the .ray reader says of bad scenes: the text, the place, the hint.
#include <gtest/gtest.h>

#include "ray_helpers.h"

namespace trace::ray_errors_test {
namespace {

constexpr const char* kOneFile =
    "2:1: \"include\": this does not read another file [include \"pieces.ray\" reads a scene "
    "(docs/language.md), mesh { file = \"name.obj\"; } a mesh]";

struct Case {
  const char* text;
  const char* errors;
};

TEST(RayErrors, NamePlaceExpectedAndFound) {
  const Case cases[] = {
      // what stands where objects do
      {"foo;", "2:1: expected an object, found \"foo\""},
      {"sphere;", "2:1: expected an object, found \"sphere\" [\"sphere\" is followed by { or (]"},
      {"shpere;", "2:1: expected an object, found \"shpere\" [did you mean \"sphere\"?]"},
      {"5", "2:1: expected an object, found 5"},
      {"include(\"x.ray\")", kOneFile},
      {"include = \"x.ray\";", kOneFile},
      {"include { file = \"x.ray\"; }", kOneFile},
      {"include;", kOneFile},
      {"scale(2, for(i, 0, 10, sphere { }))",
       "2:10: \"for\": expected an object [docs/language.md has let a = 1, define f(a) { }, for i in 0..9 { "
       "}, "
       "if (a < 1) { } else { }]"},
      {"(1, 2)", "2:1: expected an object, found (1, 2)"},
      {"sphere(1)", "2:7: sphere: expected { ... }, found (1)"},
      {"camera(1)", "2:7: camera: expected { ... }, found (1)"},
      {"{ diffuse = 1 }", "2:3: expected an object, found diffuse = 1"},
      {"{ camera { } }",
       "2:3: expected an object, found camera { } [camera belongs to the top of a file, outside of "
       "transforms and groups]"},
      {"scale(2, point_light { })",
       "2:10: expected an object, found point_light { } [point_light belongs to the top of a file, outside "
       "of "
       "transforms and groups]"},
      // transforms
      {"translate(1, 2, sphere{})", "2:1: expected translate(x, y, z, object)"},
      {"translate(1, 2, 3)", "2:1: expected translate(x, y, z, object) [the object is missing]"},
      {"translate { }", "2:1: expected translate(x, y, z, object) [the object is missing]"},
      {"scale(1, 2, sphere{})", "2:1: expected scale(factor, object) or scale(x, y, z, object)"},
      {"rotate(1, 2, 3, sphere{})", "2:1: expected rotate(x, y, z, radians, object)"},
      {"rotate(0, 0, 0, 1, sphere{})", "2:8: rotate: expected an axis, found one of length 0"},
      {"translate(1, 2, 3, sphere{}, box{})",
       "2:1: expected translate(x, y, z, object) [several objects stand in a group { }]"},
      {"transform((1,0,0,0),(0,1,0,0),(0,0,1,0),sphere{})",
       "2:1: expected transform((a, b, c, d), (e, f, g, h), (i, j, k, l), (0, 0, 0, 1), object)"},
      {"transform((1,0,0),(0,1,0),(0,0,1),(0,0,0),sphere{})",
       "2:1: expected transform((a, b, c, d), (e, f, g, h), (i, j, k, l), (0, 0, 0, 1), object)"},
      {"translate(nan, 0, 0, sphere{})", "2:11: expected translate(x, y, z, object), found \"nan\""},
      {"scale(2, nan, 1, sphere{})",
       "2:10: expected scale(factor, object) or scale(x, y, z, object), found \"nan\""},
      {"translate(1e999, 0, 0, sphere{})", "2:11: expected a finite number, found \"1e999\""},
      // shapes
      {"sphere { 5 }", "2:10: sphere: expected a field, as in name = value, found 5"},
      {"cone { height = tall; }", "2:17: height: expected a number, found \"tall\""},
      {"cone { capped = 1; }", "2:17: capped: expected true or false, found 1"},
      {"sphere { name = (1); }", "2:17: name: expected a name, found (1)"},
      // materials
      {"sphere { material = red; }",
       "2:21: expected the name of a material, found \"red\" [a material is named before its first use: "
       "material = { "
       "name = foo; ... }]"},
      {"material { name = red; } sphere { material = rad; }",
       "2:46: expected the name of a material, found \"rad\" [did you mean \"red\"?]"},
      {"sphere { material = 5; }", "2:21: material: expected { ... } or the name of a material, found 5"},
      {"material = { diffuse = (1, 2); }", "2:24: diffuse: expected (red, green, blue), found (1, 2)"},
      {"material = { diffuse = (1, 2, 3, 4); }",
       "2:24: diffuse: expected (red, green, blue), found (1, 2, 3, 4)"},
      {"material = { diffuse = (1, 2, x); }", "2:24: diffuse: expected (red, green, blue), found (1, 2, x)"},
      {"material = { diffuse = map(3); }",
       "2:24: map: expected map(\"file\") or map(\"file\", constant), found map(3)"},
      {"material = { shininess = (1); }", "2:26: shininess: expected a number, found (1)"},
      {"material = { gennormals; }",
       "2:14: material: expected a field, as in diffuse = (1, 1, 1), found \"gennormals\""},
      // camera
      {"camera { viewdir = (0, 0, -1); }",
       "2:10: viewdir: expected updir as well [add the up direction, as in updir = (0, 1, 0)]"},
      {"camera { updir = (0, 0, -1); }", "2:10: updir: expected viewdir as well"},
      {"camera { viewdir = (0, 0, 0); updir = (0, 1, 0); }",
       "2:20: viewdir: expected a direction, found (0, 0, 0)"},
      {"camera { viewdir = (0, 0, 1); updir = (0, 0, 0); }",
       "2:39: updir: expected a direction, found (0, 0, 0)"},
      {"camera { viewdir = (1e300, 0, 1); updir = (0, 1, 0); }",
       "2:20: viewdir: expected a direction between 1e-75 and 1e75 long, found (1e300, 0, 1)"},
      {"camera { viewdir = (0.1, 0.2, 0.3); updir = (-0.2, -0.4, -0.6); }",
       "2:45: updir: expected a direction that is not parallel to the view, found (-0.2, -0.4, -0.6)"},
      {"camera { look_at = (1, 2, 3); position = (1, 2, 3) }",
       "2:20: look_at: expected a point other than the camera's position, found (1, 2, 3)"},
      {"camera { look_at = (0, 2, 0); updir = (0, 1, 0) }",
       "2:39: updir: expected a direction that is not parallel to the view, found (0, 1, 0)"},
      {"camera { quaternian = (0, 0, 0, 0) }",
       "2:23: quaternian: expected a quaternion that is not zero, found (0, 0, 0, 0)"},
      {"camera { quaternian = (0, 0, 0) }", "2:23: quaternian: expected (x, y, z, w), found (0, 0, 0)"},
      {"camera { fov = 0 }", "2:16: fov: expected an angle between 0 and 180 degrees, found 0"},
      {"camera { fov = 180 }", "2:16: fov: expected an angle between 0 and 180 degrees, found 180"},
      {"camera { fov = wide }", "2:16: fov: expected a number, found \"wide\""},
      {"camera { aspectratio = -1 }",
       "2:24: aspectratio: expected a number above 0, width / height, found -1"},
      {"camera { position = 5 }", "2:21: position: expected (x, y, z), found 5"},
      {"camera { 1 }", "2:10: camera: expected a field, as in fov = 45, found 1"},
      // lights
      {"point_light { color = 1 }", "2:1: point_light: expected a position"},
      {"point_light { position = (1, 1, 1) }", "2:1: point_light: expected a color"},
      {"directional_light { color = 1 }", "2:1: directional_light: expected a direction"},
      {"directional_light { color = 1; direction = (0, 0, 0) }",
       "2:1: directional_light: expected a direction, found one of length 0"},
      {"ambient_light { }", "2:1: ambient_light: expected a color"},
      {"point_light { position = (0, 0, 0); colour = red; }",
       "2:46: color: expected (red, green, blue), found \"red\" [(1, 1, 1) is white, and #ff8000, as on web "
       "pages, "
       "orange]"},
      // meshes
      {"polymesh { points = 5 }", "2:21: points: expected a list ( ... ), found 5"},
      {"polymesh { points = ((0,0,0), (1,1)) }", "2:31: point 1: expected (x, y, z), found (1,1)"},
      {"polymesh { points = ((1e39,0,0)) }",
       "2:22: point 0: expected numbers of at most 3.4e38, found (1e39,0,0)"},
      {"polymesh { normals = (1) }", "2:23: normal 0: expected (x, y, z), found 1"},
      {"polymesh { texture_uv = ((0,0,0)) }", "2:26: texture_uv 0: expected (u, v), found (0,0,0)"},
      {"polymesh { points = ((0,0,0)); normals = ((0,0,1),(0,0,1)) }",
       "2:42: normals: expected one for each of the 1 points, found 2"},
      {"polymesh { points = ((0,0,0)); materials = ({},{}) }",
       "2:44: materials: expected one for each of the 1 points, found 2"},
      {"polymesh { texture_uv = ((0,0)) }",
       "2:25: texture_uv: expected one for each of the 0 points, found 1"},
      {"polymesh { faces = ((0,1,2)) }", "2:22: face 0 uses point 0 but the mesh has 0"},
      {"polymesh { points = ((0,0,0),(1,0,0),(0,1,0)); faces = ((0,1,2),\n(0, 1, 3)) }",
       "3:8: face 1 uses point 3 but the mesh has 3 [points are counted from 0]"},
      {"polymesh { points = ((0,0,0),(1,0,0),(0,1,0)); faces = ((0,1,-2)) }",
       "2:62: face 0: expected the number of a point, a whole number from 0, found -2"},
      {"polymesh { points = ((0,0,0),(1,0,0),(0,1,0)); faces = ((0,1,1.5)) }",
       "2:62: face 0: expected the number of a point, a whole number from 0, found 1.5"},
      {"polymesh { points = ((0,0,0),(1,0,0),(0,1,0)); faces = ((0,1,1e300)) }",
       "2:62: face 0 uses point 1e300 but the mesh has 3 [points are counted from 0]"},
      {"polymesh { points = ((0,0,0),(1,0,0)); faces = ((0,1)) }",
       "2:49: face 0: expected at least 3 points, found (0,1)"},
      {"polymesh { faces = (1) }", "2:21: face 0: expected a list of points, as in (0, 1, 2), found 1"},
      {"polymesh { capped; }",
       "2:12: polymesh: expected a field, as in points = ((0, 0, 0), (1, 0, 0), (0, 1, 0)), found "
       "\"capped\""},
      {"polymesh { gennormals = 2 }", "2:25: gennormals: expected true or false, found 2"},
      // settings
      {"settings { depht = 3; }", "2:12: unknown option \"depht\" [did you mean \"depth\"?]"},
      {"settings { depth = deep; }",
       "2:20: depth: expected a whole number from 0 to 1000 bounces, found \"deep\""},
      {"settings { highlight = phogn; }",
       "2:24: highlight: expected blinn | phong, found \"phogn\" [did you mean \"phong\"?]"},
      {"settings { depth }", "2:12: settings: expected a field, as in name = value, found \"depth\""},
  };
  for (const Case& c : cases) EXPECT_EQ(errorsOf(c.text), c.errors) << c.text;
}

TEST(RayErrors, OfTheHeader) {
  EXPECT_EQ(errorsOfFile("SBT-raytracer"), "1:1: expected a version after SBT-raytracer, as in 1.0");
  EXPECT_EQ(errorsOfFile("SBT-raytracer camera { }"),
            "1:1: expected a version after SBT-raytracer, as in 1.0");
  EXPECT_EQ(errorsOfFile("// x\nSBT-raytracer 2.0"),
            "2:15: expected version 1.1 or older of the format, found 2.0");
  EXPECT_EQ(errorsOfFile("SBT-raytracer = 1.0"), "1:1: expected SBT-raytracer 1.0 or Trace 1");
  EXPECT_EQ(errorsOfFile("SBT-raytracer1.0"), "1:1: expected SBT-raytracer 1.0 or Trace 1");
}

TEST(RayErrors, OfTheKindTrace1SpeakOfItsForms) {
  const auto of = [](const std::string& text) { return errorsOfFile("Trace 1\n" + text); };
  EXPECT_NE(of("rotate 45 { sphere { } }").find("rotate y 45 { ... }"), std::string::npos);
  EXPECT_EQ(
      of("translate(0, 1) { sphere { } }"),
      "2:1: expected translate(x, y, z, object) [a number is missing, as in translate(1, 2, 3) { sphere { } "
      "}]");
  EXPECT_EQ(
      of("translate(1,0,0) plane { }"),
      "2:1: expected braces after translate(1, 0, 0) [the object that it moves stands in them: translate(1, "
      "0, 0) { sphere { } }]");
  EXPECT_EQ(
      of("let s = 2\nscale(s)\nsphere { }"),
      "3:1: expected braces after scale(2) [the object that it scales stands in them: scale(2) { sphere { } "
      "}]");
  EXPECT_EQ(
      of("rotate(0, 1, 0, 30) box { }"),
      "2:1: expected braces after rotate(0, 1, 0, 30) [the object that it rotates stands in them: rotate(0, "
      "1, 0, 30) { sphere { } }]");
  EXPECT_NE(of("sphere { material = peel }").find("let foo = material { ... }"), std::string::npos);
  EXPECT_NE(of("sphere { material = { colour = (1, 0, 0) } }").find("diffuse = (red, green, blue)"),
            std::string::npos);
  EXPECT_NE(of("sphere { material = { diffuse = 0.8, 0.2, 0.1 } }").find("stand in parentheses"),
            std::string::npos);
}

TEST(RayErrors, WhatOtherProgramsSayInAnotherWayHasAHint) {
  const auto holds = [](const std::string& text, const std::string& hint) {
    EXPECT_NE(errorsOfFile("Trace 1\n" + text).find("[" + hint), std::string::npos)
        << text << "\n"
        << errorsOfFile("Trace 1\n" + text);
  };
  for (const char* size : {"radius", "size", "width"})
    holds("box { " + std::string(size) + " = 2 }", "scale(2) { box { } } makes it twice as large");
  holds("cylinder { height = 2 }", "scale(1, 1, 2) { cylinder { } } makes it twice as long along z");
  holds("for (i = 0; i < 5; i++) { sphere { } }", "for i in 0..4 { } makes five turns, from i = 0 to i = 4");
  holds("sphere { material = { library = red marble } }",
        "a name of several words stands in quotation marks");
  EXPECT_EQ(errorsOfFile("Trace 1\nsphere { material = { library = red marble } }").find('\n'),
            std::string::npos);
  holds("sphere { material = { colour = (1, 0, 0) } }", "diffuse = (red, green, blue) is its colour");
  holds("sphere { center = (1, 2, 3) }", "translate(1, 2, 3) { sphere { } } puts it there");
  holds("cone { position = (1, 2, 3) }", "translate(1, 2, 3) { cone { } } puts it there");
  holds("torus { major = 2 }", "did you mean \"major_radius\"?");
  holds("let red = (1, 0, 0)\nsphere { material = red }", "material = { diffuse = red } has that colour");
  holds("sphere { material = (1, 0, 0) }", "material = { diffuse = (1, 0, 0) } has that colour");
  holds("sphere { material = wood { } }",
        "a texture is the value of a field: material = { diffuse = wood { } }");
  holds("sphere { material = { library = \"carrara marble\" } }",
        "it has \"marble\", \"white marble\", \"black marble\"");
  holds("torus { color = (1, 0, 0) }", "material = { diffuse = (red, green, blue) } is its colour");
  holds("sphere { material = { colr = (1, 0, 0) } }", "diffuse = (red, green, blue) is its colour");
  holds("sphere { material = { diffuse: (1, 0, 0) } }", "a field gets its value by =");
  holds("sphere { material = { library = red marble } }",
        "a name of several words stands in quotation marks: \"red marble\"");
  holds("rectangle_light { direction = (0, -1, 0) }", "u and v are its edges");
  holds("let n = 4\nn = n + 1", "a name gets its value once");
  EXPECT_EQ(errorsOfFile("Trace 1\nrotate y { box { } }\nbox { }"),
            "2:10: expected an angle, as in rotate y 30 deg { }, found \"{\"");
}

TEST(RayErrors, AreReportedTogether) {
  EXPECT_EQ(errorsOf("cone { height = a; }\nsphere { material = b; }\nfoo"),
            "2:17: height: expected a number, found \"a\"\n"
            "3:21: expected the name of a material, found \"b\" [a material is named before its first use: "
            "material = { "
            "name = foo; ... }]\n"
            "4:1: expected an object, found \"foo\"");
  std::string many;
  for (int i = 0; i < 100; ++i) many += "5\n";
  const std::string errors = errorsOf(many);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n') + 1, Messages::kMostErrors);
}

TEST(RayErrors, ShowTheLine) {
  try {
    Messages messages;
    readScene("dir/a.ray", "SBT-raytracer 1.0\r\nsphere {\r\n\tmaterial = { diffuse = red }\r\n}\r\n",
              messages);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::scene);
    EXPECT_EQ(std::string(error.what()),
              "dir/a.ray:3:25: error: diffuse: expected (red, green, blue), found \"red\"\n"
              "  \tmaterial = { diffuse = red }\n"
              "  \t                       ^\n"
              "  hint: (1, 1, 1) is white, and #ff8000, as on web pages, orange\n");
  }
}

TEST(RayErrors, LightsThatLightNothingOrAllAreToldOf) {
  const std::string point = "point_light { position = (0, 0, 5); color = 1; ";
  EXPECT_NE(warningsOf(point + "lights = (); }").find("a list without names is as none"), std::string::npos);
  EXPECT_EQ(warningsOf(point + "}"), "");
  const std::string flaps = "warn_light { position = (0, 0, 5); color = 1; direction = (0, 0, -1); ";
  EXPECT_NE(warningsOf(flaps + "y_min = 2; y_max = 1; }").find("expected y_min below y_max: it is dark"),
            std::string::npos);
  EXPECT_EQ(warningsOf(flaps + "y_min = 1; y_max = 2; }"), "");
}

TEST(RayErrors, NoneIsNoFileUnlessItIsInQuotes) {
  const std::string lamp =
      "goniometric_light { position = (0, 0, 5); color = 1; direction = (0, -1, 0); file = ";
  EXPECT_EQ(errorsOf(lamp + "none; }"), "");
  EXPECT_NE(errorsOf(lamp + "\"none\"; }"), "");
}

}  // namespace
}  // namespace trace::ray_errors_test
