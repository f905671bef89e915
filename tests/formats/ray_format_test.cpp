// What the .ray reader makes of good scenes: docs/ray-format.md.
#include <gtest/gtest.h>

#include <cmath>

#include "base/files/read_scope.h"
#include "base/match.h"
#include "formats/ray/file/format.h"
#include "formats/ray/read/texture.h"
#include "formats/ray/write/writer.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/curves.h"
#include "geometry/shapes/surfaces/prism.h"
#include "image/codecs/codec.h"
#include "ray_helpers.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/rectangle_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"

namespace trace::ray_format_test {
namespace {

void expectNear(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

Vec3 moved(std::string_view text, const Vec3& p) {
  return load(text).scene.objects.at(0).worldFromObject * p;
}

// --- shapes -------------------------------------------------------------------------------------------

TEST(RayFormat, ReadsEveryShapeOfTheList) {
  for (const ShapeType& type : shapeTypes()) {
    const std::string text =
        std::string(type.keyword) + " { name = \"x\"; material = { diffuse = (1, 1, 1); } }";
    if (type.keyword == Mesh::kKeyword) {
      onlyShape<Mesh>(text);
      continue;
    }
    EXPECT_EQ(load(text).scene.objects.at(0).shape, Shape(type)) << text;
  }
}

// A value other than the default, and how a file says it.
std::string other(bool& value) { return value = !value, value ? "true" : "false"; }
std::string other(Real& value) { return value = 3.5, "3.5"; }
std::string other(Vec3& value) { return value = {1, -2, 3.5}, "(1, -2, 3.5)"; }

std::string other(EnumValue& value) {
  value.set(2);
  return std::string(value.name());
}
std::string other(int& value) { return value = 2, "2"; }
std::string other(std::string& value) { return value = "x^2 - y", "\"x^2 - y\""; }
std::string other(std::array<Real, 4>& v) { return v = {1, 0.5, -0.5, 0}, "(1, 0.5, -0.5, 0)"; }
std::string other(std::vector<std::array<Real, 2>>& v) { return v = {{1, 2}, {3, -4}}, "((1, 2), (3, -4))"; }
std::string other(std::vector<std::array<Real, 4>>& v) { return v = {{1, 2, 3, 4}}, "((1, 2, 3, 4))"; }
std::string other(std::vector<std::array<Real, 5>>& v) { return v = {{1, 2, 3, 4, 5}}, "((1, 2, 3, 4, 5))"; }
std::string other(std::vector<std::array<Real, 8>>& v) {
  return v = {{1, 2, 3, 4, 5, 6, 7, 8}}, "((1, 2, 3, 4, 5, 6, 7, 8))";
}
std::string other(std::vector<std::array<Real, 12>>& v) {
  v = {{0.5, 0, 0, 1, 0, 0.5, 0, 0, 0, 0, 0.5, 0}};
  return "((0.5, 0, 0, 1, 0, 0.5, 0, 0, 0, 0, 0.5, 0))";
}
std::string other(std::vector<std::string>& v) {
  return v = {"F = F[+F]F", "X = "}, "(\"F = F[+F]F\", \"X = \")";
}
std::string other(std::vector<BezierPatches::Points>& v) {
  v = {BezierPatches::Points(16, {1, 2, 3})};
  std::string points = "(1, 2, 3)";
  for (int i = 1; i < 16; ++i) points += ", (1, 2, 3)";
  return "((" + points + "))";
}
std::string other(std::vector<Curves::Strand>& v) {
  v = {{{1, 2, 3, 4}, {5, 6, 7, 8}}, {}};
  return "(((1, 2, 3, 4), (5, 6, 7, 8)), ())";
}
std::string other(Heights& value) {
  const std::string file = ::testing::TempDir() + "ray_format_heights.png";
  Picture picture(3, 2);
  picture.at(1, 0) = Color(1), picture.at(2, 1) = Color(1);
  writePicture(file, picture);
  auto grid = std::make_shared<HeightGrid>(3, 2);
  grid->at(1, 1) = grid->at(2, 0) = 1;  // the first row of a picture is the farthest
  value = {file, grid};
  return "\"" + file + "\"";
}
std::string other(std::vector<Prism::Outline>& v) {
  return v = {{{1, 2}, {3, 4}}, {}}, "(((1, 2), (3, 4)), ())";
}
std::string other(MaterialList& value) { return value = {{0, 1}}, "({ }, { diffuse = (1, 0, 0); })"; }
std::string other(Operands& value) { return value = Operands({{"", Sphere{}, {}, 0}}), "{ sphere { } }"; }

TEST(RayFormat, ReadsEveryFieldOfEveryShape) {
  const ReadScope allowed({testing::TempDir()});
  for (const ShapeType& type : shapeTypes())
    for (const AnyField& field : Shape(type).fields()) {
      Shape expected(type);
      std::string text = std::string(type.keyword) + "{" + std::string(field.keyword) + "=";
      editEachField(expected, [&](const AnyField& f, auto& value) {
        if (f.keyword == field.keyword) text += other(value) + "}";
      });
      EXPECT_EQ(load(text).scene.objects.at(0).shape, expected) << text;
    }
}

TEST(RayFormat, ManyObjectsKnowTheirPlacesWithoutTheTextOfTheirLines) {
  constexpr std::size_t kMany = 10000;
  std::string text;
  for (std::size_t i = 0; i <= kMany; ++i) text += "  sphere { }\n";
  const Scene scene = load(text).scene;
  ASSERT_EQ(scene.objects.size(), kMany + 1);
  EXPECT_EQ(scene.objects[1].place, (SourcePlace{"test.ray", 3, 3, "  sphere { }"}));
  EXPECT_EQ(scene.objects[kMany].place, (SourcePlace{"test.ray", static_cast<int>(kMany) + 2, 3, ""}));
}

TEST(RayFormat, ReadsSolidsOfSolids) {
  const char* text =
      "difference { material = { diffuse = (1, 0, 0) }\n box { }\n { sphere { } translate(1, 0, 0, sphere { "
      "material = { diffuse = (0, 1, 0) } }) } }";
  const Loaded loaded = load(text);
  const Operands objects = onlyShape<Difference>(text).objects;
  ASSERT_EQ(objects.list().size(), 2u);
  const auto& group = objects.list()[1].shape.as<Union>()->objects.list();
  ASSERT_EQ(group.size(), 2u);
  const auto color = [&](const Operand& o) {
    return loaded.scene.materials.at(o.material).model.as<Phong>()->diffuse;
  };
  EXPECT_EQ(color(objects.list()[0]), Color(1, 0, 0));
  EXPECT_EQ(color(group[1]), Color(0, 1, 0));
  EXPECT_EQ(group[1].wholeFromOperand * (Vec3{}), Vec3(1, 0, 0));
  EXPECT_EQ(onlyShape<Union>("union(sphere{}, box{})").objects.list().size(), 2u);
  EXPECT_EQ(onlyShape<Difference>("subtraction(sphere{}, box{})").objects.list().size(), 2u);
  EXPECT_EQ(errorsOf("union { square { } }"),
            "2:9: expected a solid, found square { } [an open object can only be the first in a clip { }]");
  EXPECT_EQ(warningsOf("union { }"), "2:1: union without objects is empty");
}

TEST(RayFormat, MakesObjectsOfParticlesAtTheFramesTime) {
  const std::string text =
      "SBT-raytracer 1.0\n translate(0, 0, 1, particles { rate = 10; lifetime = 100; velocity = (1, 0, 0); "
      "velocity_spread = 0; spread = (0, 0, 0); gravity = (0, 0, 0); lifetime_spread = 0; size = 0.5; "
      "end_size = "
      "0.5; end_color = (0, 1, 1); material = { diffuse = (0.5, 0.5, 0.5) }; box { } })";
  Messages messages;
  const Scene scene = readRay("test.ray", text, messages, 1.001);
  ASSERT_EQ(scene.objects.size(), 11u);
  EXPECT_TRUE(scene.objects[0].shape.is<Cube>());
  expectNear(scene.objects[1].worldFromObject * Vec3{0.5, 0, 0}, {0.901 + 0.25, 0, 1});
  EXPECT_EQ(scene.materials.at(scene.objects[10].material).model.as<Phong>()->diffuse, Color(0.5));
  EXPECT_TRUE(readRay("test.ray", text, messages, -1).objects.empty());
  EXPECT_EQ(onlyShape<Sphere>("particles { rate = 1; duration = 0.5; }"), Sphere{});
  EXPECT_EQ(errorsOf("particles { rate = 1e9; begin = -5; }"),
            "2:1: particles: more than 100000 would be alive [give a lower rate or a shorter lifetime]");
}

TEST(RayFormat, SaysWhatIsWrongWithListsNamesAndFormulas) {
  EXPECT_EQ(errorsOf("lathe { spline = bezir; }"),
            "2:18: spline: expected linear, bezier, bspline or catmull, found \"bezir\" [did you mean "
            "\"bezier\"?]");
  EXPECT_EQ(errorsOf("lathe { profile = ((1, 2), (3, 4, 5)); }"),
            "2:28: profile: expected (a, b), found (3, 4, 5)");
  EXPECT_EQ(errorsOf("menger { levels = 1.5; }"), "2:19: levels: expected a whole number, found 1.5");
  EXPECT_EQ(errorsOf("isosurface { formula = \"x +\"; }"),
            "2:1: formula: expected a number, x, y, z, a function or \"(\" at character 4, found the end");
}

TEST(RayFormat, KeepsNamesPlacesAndOrder) {
  const Scene scene =
      load("sphere { name = first; }\n  scale(2, box { name = \"second one\"; })\nsquare{}").scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.file, "test.ray");
  EXPECT_EQ(scene.format, "ray");
  EXPECT_EQ(scene.objects[0].name, "first");
  EXPECT_EQ(scene.objects[1].name, "second one");
  EXPECT_EQ(scene.objects[2].name, "");
  EXPECT_EQ(scene.objects[1].place,
            (SourcePlace{"test.ray", 3, 12, "  scale(2, box { name = \"second one\"; })"}));
}

TEST(RayFormat, MakesConesOfNegativeSizePositive) {
  const Cone radii = onlyShape<Cone>("cone { bottom_radius = -2; top_radius = -0.5; capped = false; }");
  EXPECT_EQ(radii.bottomRadius, 2);
  EXPECT_EQ(radii.topRadius, 0.5);
  EXPECT_FALSE(radii.capped);
  EXPECT_EQ(warningsOf("cone { height = -3; }"), "");
  EXPECT_EQ(warningsOf("cone { bottom_radius = -2; height = -3; }"),
            "2:8: bottom_radius of cone: expected at least 0, found -2");

  // Down from z = 0 to z = -3, the bottom radius still at z = 0.
  const char* down = "translate(0, 0, 5, cone { height = -3; bottom_radius = 2; top_radius = 1; })";
  const Cone cone = onlyShape<Cone>(down);
  EXPECT_EQ(cone.height, 3);
  EXPECT_EQ(cone.bottomRadius, 2);
  EXPECT_EQ(moved(down, {2, 0, 0}), Vec3(2, 0, 5));
  EXPECT_EQ(moved(down, {1, 0, 3}), Vec3(1, 0, 2));

  EXPECT_DOUBLE_EQ(onlyShape<Cone>("cone { height = 2; bottom_radius = 1; top_radius = 1; }").topRadius,
                   1.002);
  EXPECT_EQ(warningsOf("cone { height = 0; }"), "2:1: a cone of height 0 is left out");
  EXPECT_EQ(warningsOf("cone { bottom_radius = 0; }"), "2:1: a cone of radius 0 is left out");
}

TEST(RayFormat, ALightOfARadiusBelow0HasNoSize) {
  const std::string text = "point_light { position = (0, 1, 0); color = (1, 1, 1); radius = -1; }";
  EXPECT_EQ(warningsOf(text),
            "2:56: radius of point_light: expected at least 0, found -1: the light has no size");
  EXPECT_EQ(load(text).scene.lights.at(0).light.as<PointLight>()->radius, 0);
}

// --- transforms ---------------------------------------------------------------------------------------

TEST(RayFormat, MultipliesTransformsInnermostFirst) {
  const char* text = "translate(1, 2, 3, scale(2, 3, 4, rotate(0, 0, 5, 1.5707963267948966, sphere { })));";
  expectNear(moved(text, {1, 0, 0}), {1, 5, 3});
  expectNear(moved(text, {0, 1, 0}), {-1, 2, 3});
  expectNear(moved("scale(-2, sphere{})", {1, 2, 3}), {-2, -4, -6});
  expectNear(moved("rotate(1, 1, 1, 2.0943951023931953, box{})", {1, 0, 0}), {0, 1, 0});
  expectNear(moved("rotate(1e200, 0, 0, 1.5707963267948966, box{})", {0, 1, 0}), {0, 0, 1});
}

TEST(RayFormat, ReadsMatricesByRows) {
  const char* text = "transform((1, 2, 3, 10), (0, 1, 4, 20), (0, 0, 1, 30), (0, 0, 0, 1), box{})";
  EXPECT_EQ(moved(text, {1, 1, 1}), Vec3(16, 25, 31));
  EXPECT_EQ(moved("transform((2,0,0,4),(0,2,0,6),(0,0,2,8),(0,0,0,2),box{})", {1, 1, 1}), Vec3(3, 4, 5));
  EXPECT_EQ(warningsOf("transform((2,0,0,4),(0,2,0,6),(0,0,2,8),(0,0,0,2),box{})"), "");
  for (const std::string row : {"(1, 0, 0, 2)", "(0, 0, 0, 0)"}) {
    const std::string odd = "transform((1,0,0,0),(0,1,0,0),(0,0,1,0)," + row + ",box{})";
    EXPECT_EQ(moved(odd, {1, 1, 1}), Vec3(1, 1, 1));
    EXPECT_EQ(warningsOf(odd),
              "2:41: transform: expected a last row of (0, 0, 0, 1), found " + row + "; it is ignored");
  }
}

TEST(RayFormat, LeavesOutObjectsOfSingularTransforms) {
  for (const char* text : {"scale(0, sphere{})", "scale(1, 0, 1, sphere{})",
                           "scale(1e-150, scale(1e-150, sphere{}))", "scale(1e200, scale(1e200, sphere{}))",
                           "transform((1,2,3,0),(2,4,6,0),(0,0,1,0),(0,0,0,1),sphere{})"}) {
    const Loaded loaded = load(std::string(text) + "\nbox{}");
    EXPECT_EQ(loaded.scene.objects.size(), 1u) << text;
    EXPECT_NE(warningsOf(text).find("an object is left out: its transform"), std::string::npos) << text;
  }
  EXPECT_EQ(warningsOf("scale(0, sphere{})\nscale(0, box{})"),
            "2:10: an object is left out: its transform makes it flat, or infinitely large or small (2 "
            "times, first here)");
}

TEST(RayFormat, TakesGroupsAnywhereAnObjectMayStand) {
  const Scene scene =
      load("translate(1, 0, 0, { sphere{} { box{}; scale(2, { cone{} square{} }) } }) { cylinder{} }").scene;
  ASSERT_EQ(scene.objects.size(), 5u);
  EXPECT_EQ(scene.objects[0].worldFromObject * Vec3(0, 0, 0), Vec3(1, 0, 0));
  EXPECT_EQ(scene.objects[3].worldFromObject * Vec3(1, 1, 1), Vec3(3, 2, 2));
  EXPECT_EQ(scene.objects[4].worldFromObject, Affine{});
}

// --- materials ----------------------------------------------------------------------------------------

TEST(RayFormat, ReadsEveryFieldOfMaterials) {
  const Phong phong =
      phongOf(load("sphere { material = { emissive = (1, 2, 3); ambient = (0, 0.1, 0.2); diffuse = 0.5;"
                   " specular = (0.25, 0.5, 0.75); reflective = (0.1, 0.1, 0.1);"
                   " transmissive = (0.9, 0.8, 0.7); shininess = 25.6; index = 1.5; } }")
                  .scene,
              0);
  EXPECT_EQ(phong.emissive, Color(1, 2, 3));
  EXPECT_EQ(phong.ambient, Color(0, 0.1, 0.2));
  EXPECT_EQ(phong.diffuse, Color(0.5));
  EXPECT_EQ(phong.specular, Color(0.25, 0.5, 0.75));
  EXPECT_EQ(phong.reflective, Color(0.1));
  EXPECT_EQ(phong.transmissive, Color(0.9, 0.8, 0.7));
  EXPECT_EQ(phong.shininess, 25.6);
  EXPECT_EQ(phong.index, 1.5);
  EXPECT_EQ(phongOf(load("sphere { }").scene, 0), Phong{});
}

TEST(RayFormat, MaterialsInheritFromTheDefaultThatStandsBeforeThem) {
  const Scene scene = load(
                          "sphere { }"
                          "material = { diffuse = (1, 0, 0); shininess = 20 }"
                          "sphere { } sphere { material = { ambient = (0, 1, 0) } }"
                          "material = { index = 2 }"
                          "sphere { }")
                          .scene;
  EXPECT_EQ(phongOf(scene, 0), Phong{});
  EXPECT_EQ(phongOf(scene, 1).diffuse, Color(1, 0, 0));
  EXPECT_EQ(phongOf(scene, 2).diffuse, Color(1, 0, 0));
  EXPECT_EQ(phongOf(scene, 2).ambient, Color(0, 1, 0));
  EXPECT_EQ(phongOf(scene, 3).index, 2);
  EXPECT_EQ(phongOf(scene, 3).shininess, 20);
}

TEST(RayFormat, MaterialsOfGroupsEndWithThem) {
  const Scene scene = load(
                          "material = { index = 2; }"
                          "scale(2, { sphere{} material = { index = 3 }; sphere{} { material = { index = 4 } "
                          "sphere{} } sphere{} })"
                          "sphere{}")
                          .scene;
  ASSERT_EQ(scene.objects.size(), 5u);
  for (const auto& [object, index] : {std::pair{0, 2.0}, {1, 3.0}, {2, 4.0}, {3, 3.0}, {4, 2.0}})
    EXPECT_EQ(phongOf(scene, static_cast<size_t>(object)).index, index) << object;
}

TEST(RayFormat, MaterialsGoByName) {
  const Scene scene =
      load(
          "material { name = red; diffuse = (1, 0, 0); }\n"
          "material { name = \"#2\"; diffuse = (0, 1, 0); }\n"
          "sphere { material = red; } sphere { material = \"red\" } sphere { material = \"#2\" }\n"
          "sphere { material = { name \"blue\"; diffuse = (0, 0, 1); } } sphere { material = blue }\n"
          "material = red; sphere{ material = { name green; ambient = 1 } } sphere { }")
          .scene;
  ASSERT_EQ(scene.objects.size(), 7u);
  for (const auto& [object, color] : {std::pair{0u, Color(1, 0, 0)},
                                      {1u, Color(1, 0, 0)},
                                      {2u, Color(0, 1, 0)},
                                      {3u, Color(0, 0, 1)},
                                      {4u, Color(0, 0, 1)},
                                      {5u, Color(1, 0, 0)},
                                      {6u, Color(1, 0, 0)}})
    EXPECT_EQ(phongOf(scene, object).diffuse, color) << object;
  EXPECT_EQ(scene.materials[scene.objects[0].material].name, "red");
  EXPECT_EQ(scene.materials[scene.objects[5].material].name, "green");
  EXPECT_EQ(warningsOf("material { diffuse = 1 }"),
            "2:1: a material without a name is never used [material = { ... } is that of the objects after "
            "it; name "
            "= red; in it gives it a name]");
}

TEST(RayFormat, EqualMaterialsAreStoredOnce) {
  const Scene scene =
      load(
          "sphere { material = { diffuse = (1, 0, 0) } } box { material = { diffuse = (1, 0, 0) } }"
          "sphere { material = { diffuse = (0, 0, 0) } } box { material = { diffuse = (-0, 0, 0) } }")
          .scene;
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST(RayFormat, RemembersWhetherReflectiveWasGiven) {
  const std::pair<const char*, bool> cases[] = {
      {"specular = 1", true},
      {"specular = 1; reflective = 0", false},
      {"reflective = 0; specular = 1", false},
      {"diffuse = 1", false},
      {"specular = map(\"a.bmp\")", true},
  };
  for (const auto& [fields, mirrors] : cases)
    EXPECT_EQ(phongOf(load("sphere { material = {" + std::string(fields) + "} }").scene, 0).mirrorsSpecular,
              mirrors)
        << fields;
  // In another block, `reflective` has not been seen yet.
  const Scene scene =
      load(
          "material = { specular = 1; reflective = 0.5 } sphere { material = { specular = 0.7 } }"
          "sphere { material = { diffuse = 1 } } material = { specular = 1 } sphere { material = { diffuse = "
          "1 } }")
          .scene;
  EXPECT_TRUE(phongOf(scene, 0).mirrorsSpecular);
  EXPECT_EQ(phongOf(scene, 0).reflective, Color(0.5));
  EXPECT_FALSE(phongOf(scene, 1).mirrorsSpecular);
  EXPECT_TRUE(phongOf(scene, 2).mirrorsSpecular);
}

TEST(RayFormat, KeepsMapsByField) {
  const char* text =
      "material = { diffuse = map(\"a.bmp\"); shininess = 7; }\n"
      "sphere { material = { specular = \"b.png\"; shininess = map(\"c.png\"); } }\n"
      "sphere { material = { diffuse = (0.5, 0.5, 0.5); } }";
  const Scene scene = load(text).scene;
  const Material& first = scene.materials[scene.objects[0].material];
  EXPECT_EQ(first.textures, (std::vector<FieldTexture>{{"diffuse", rayfile::mappedPicture("a.bmp")},
                                                       {"shininess", rayfile::mappedPicture("c.png")},
                                                       {"specular", rayfile::mappedPicture("b.png")}}));
  EXPECT_EQ(phongOf(scene, 0).diffuse, Color(1));
  EXPECT_EQ(phongOf(scene, 0).specular, Color(1));
  EXPECT_EQ(phongOf(scene, 0).shininess, 128) << "a picture has exponents from 0 to 128";
  EXPECT_TRUE(scene.materials[scene.objects[1].material].textures.empty());
  EXPECT_EQ(warningsOf(text),
            "2:24: the textures \"a.bmp\", \"c.png\" and \"b.png\" cannot be read: \"a.bmp\": No such "
            "file or directory [a checker of magenta and black shows instead]");
  EXPECT_EQ(
      warningsOf("sphere { material = { diffuse = \"red\"; } }"),
      "2:33: the texture \"red\" cannot be read: No such file or directory [a checker of magenta and black "
      "shows instead; a colour is (red, green, blue), each from 0 to 1]");
}

// --- camera -------------------------------------------------------------------------------------------

TEST(RayFormat, ReadsTheCamera) {
  EXPECT_EQ(load("").scene.camera, Camera{});
  EXPECT_EQ(load("camera { }").scene.camera, Camera{});
  const Camera camera =
      load(
          "camera { fov = 30 } camera { position = (1, 2, 3); viewdir = (0, 0, -2); updir = (0, 3, 1);"
          " aspectratio = 1.5; }")
          .scene.camera;
  EXPECT_EQ(camera.position, Vec3(1, 2, 3));
  EXPECT_EQ(camera.viewdir, Vec3(0, 0, -2));
  EXPECT_EQ(camera.updir, Vec3(0, 3, 1));
  EXPECT_EQ(camera.aspectratio, 1.5);
  EXPECT_EQ(camera.fov, Camera{}.fov) << "the last camera wins, whole";
}

TEST(RayFormat, LooksAtAPoint) {
  const Camera camera = load("camera { look_at = (1, 0, 1); position = (1, 0, 5); }").scene.camera;
  EXPECT_EQ(camera.viewdir, Vec3(0, 0, -1));
  EXPECT_EQ(camera.updir, Vec3(0, 1, 0));
  EXPECT_EQ(load("camera { look_at = (0, -3, 0); }").scene.camera.updir, Vec3(1, 0, 0));
  EXPECT_EQ(load("camera { look_at = (0, -3, 0); updir = (0, 0, 2); }").scene.camera.updir, Vec3(0, 0, 2));
  EXPECT_EQ(load("camera { updir = (0, 0, 2); look_at = (0, -3, 0); }").scene.camera.viewdir, Vec3(0, -1, 0));
  EXPECT_EQ(warningsOf("camera { look_at = (0, 0, 3); viewdir = (1, 0, 0); }"),
            "2:31: viewdir is ignored, since look_at is given");
}

TEST(RayFormat, TurnsTheCameraByAQuaternion) {
  // A quarter turn about y, the real part last, of any length.
  for (const char* q :
       {"(0, 0.70710678118654752, 0, 0.70710678118654752)", "(0, 3, 0, 3)", "(0, -1, 0, -1)"}) {
    const Camera camera = load("camera { quaternian = " + std::string(q) + "; }").scene.camera;
    expectNear(camera.viewdir, {-1, 0, 0});
    expectNear(camera.updir, {0, 1, 0});
  }
  const Camera still = load("camera { quaternion = (0, 0, 0, 1); }").scene.camera;
  EXPECT_EQ(still.viewdir, Vec3(0, 0, -1));
  const Camera overridden =
      load("camera { viewdir = (1, 0, 0); updir = (0, 0, 1); quaternian = (0, 3, 0, 3); }").scene.camera;
  EXPECT_EQ(overridden.viewdir, Vec3(1, 0, 0));
}

// --- lights -------------------------------------------------------------------------------------------

TEST(RayFormat, ReadsLights) {
  const Scene scene =
      load(
          "point_light { position = (1, 2, 3); colour = (0.5, 1, 2); linear_attenuation_coeff = 0.25; }\n"
          "directional_light { color = (1, 1, 1); direction = (0, -3, 0); }\n"
          "ambient_light { color = 0.25 }")
          .scene;
  ASSERT_EQ(scene.lights.size(), 3u);
  const auto& point = *scene.lights[0].light.as<PointLight>();
  EXPECT_EQ(point.position, Vec3(1, 2, 3));
  EXPECT_EQ(point.color, Color(0.5, 1, 2));
  EXPECT_EQ(point.constant, 0);
  EXPECT_EQ(point.linear, 0.25);
  EXPECT_EQ(point.quadratic, 1);
  EXPECT_EQ(scene.lights[1].light.as<DirectionalLight>()->direction, Vec3(0, -3, 0));
  EXPECT_EQ(scene.lights[2].light.as<AmbientLight>()->color, Color(0.25));
  EXPECT_EQ(scene.lights[1].place.line, 3);
  EXPECT_EQ(warningsOf("point_light { position = (0,0,0); color = 1; position = (1,1,1); color = 2 }"),
            "2:46: position of point_light given again; the last counts\n"
            "2:66: color of point_light given again; the last counts");
}

TEST(RayFormat, WarnsOfEmptiness) {
  const auto warnings = [](const char* text) { return load(text).warnings; };
  ASSERT_EQ(warnings("").size(), 1u);
  EXPECT_EQ(warnings("")[0].what, "no object: the picture will be empty");
  EXPECT_EQ(warnings("")[0].place, (SourcePlace{"test.ray", 0, 0, ""}));
  EXPECT_TRUE(warnings("ambient_light { color = 1 } sphere{}").empty());
}

TEST(RayFormat, ReadsBackgroundsAndHorizontalAngles) {
  EXPECT_EQ(load("background { color = (0.1, 0.2, 0.3); }").scene.background.colors,
            (std::vector<Color>{{0.1, 0.2, 0.3}}));
  const Background bands = load("background { colors = ((1,0,0), 0.5); limits = (0.25); }").scene.background;
  EXPECT_EQ(bands.colors, (std::vector<Color>{{1, 0, 0}, Color(0.5)}));
  EXPECT_EQ(bands.limits, (std::vector<Real>{0.25}));
  EXPECT_EQ(errorsOf("background { colors = (1, 1); limits = (0.5, 0.75); }"),
            "2:12: background: expected one limit less than colors, found 2 and 2");
  const Background sky =
      load("background { gradient = ((1,0,0), 0.5); elevations = (-10, 90); turbidity = 3; sun = (0,1,0); }")
          .scene.background;
  EXPECT_EQ(sky.gradient, (std::vector<Color>{{1, 0, 0}, Color(0.5)}));
  EXPECT_EQ(sky.elevations, (std::vector<Real>{-10, 90}));
  EXPECT_EQ(sky.turbidity, 3);
  EXPECT_EQ(sky.sun, (Vec3{0, 1, 0}));
  EXPECT_EQ(errorsOf("background { gradient = (1, 1); elevations = (0); }"),
            "2:12: background: expected an elevation for each color of the gradient, found 1 and 2");
  EXPECT_EQ(errorsOf("background { gradient = (1, 1); elevations = (5, 5); }"),
            "2:12: background: expected elevations that ascend, from -90 to 90 degrees");
  EXPECT_EQ(errorsOf("background { turbidity = 2; sun = (0, 0, 0); }"),
            "2:35: background: expected a direction to the sun, found (0, 0, 0)");
  EXPECT_EQ(warningsOf("background { sun = (0, 0, 0); }"),
            "2:20: background: expected a direction to the sun, found (0, 0, 0)");
  EXPECT_EQ(errorsOf("background { colors = 1; }"),
            "2:23: colors: expected a list ((red, green, blue), (red, green, blue), ...), found 1");
  EXPECT_EQ(errorsOf("background { limits = ((1, 2)); }"), "2:24: limits: expected a number, found (1, 2)");
  const Camera wide = load("camera { horizontal_fov = 90; aspectratio = 2; }").scene.camera;
  EXPECT_NEAR(std::tan(wide.fov * kPi / 360), 0.5, 1e-15);
  EXPECT_EQ(errorsOf("camera { horizontal_fov = 180; }"),
            "2:27: horizontal_fov: expected an angle between 0 and 180 degrees, found 180");
}

// --- meshes -------------------------------------------------------------------------------------------

constexpr const char* kPoints = "points = ((0,0,0), (1,0,0), (1,1,0), (0,1,0), (0,0,1));";

std::shared_ptr<const MeshData> meshOf(const std::string& fields) {
  return onlyShape<Mesh>("polymesh {" + fields + "}").data;
}

TEST(RayFormat, ReadsMeshes) {
  const auto mesh = meshOf("faces = ((0,1,2,3), (0, 1, 4)); " + std::string(kPoints));
  EXPECT_EQ(mesh->points.size(), 5u);
  EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
  EXPECT_TRUE(mesh->normals.empty() && mesh->materials.empty() && mesh->uvs.empty());
  EXPECT_FALSE(mesh->generateNormals);
  EXPECT_TRUE(meshOf("gennormals;")->generateNormals);
  EXPECT_TRUE(meshOf("gennormals " + std::string(kPoints))->generateNormals);
  EXPECT_TRUE(meshOf("gennormals = true;")->generateNormals);
  EXPECT_FALSE(meshOf("gennormals = false;")->generateNormals);
  EXPECT_TRUE(meshOf("two_sided;")->twoSided);
  EXPECT_TRUE(meshOf("two_sided = true;")->twoSided);
  EXPECT_FALSE(meshOf("two_sided = false;")->twoSided);
  EXPECT_FALSE(meshOf("")->twoSided);
  EXPECT_EQ(onlyShape<Mesh>("trimesh { }").data->points.size(), 0u);
  EXPECT_EQ(load("polymesh { name = \"cow\" }").scene.objects[0].name, "cow");
}

TEST(RayFormat, WarnsOfNumbersThatNothingHas) {
  EXPECT_EQ(warningsOf("sphere { material = { emissive = (1e30, 1, 1); } }"),
            "2:23: emissive of material: expected 0 to 1e12, found 1e+30 [the sun's disk is 50000 times as "
            "bright as white paper in it]");
  EXPECT_EQ(warningsOf("sphere { material = { emissive = (1e9, 1, 1); } }"), "");
  EXPECT_EQ(
      warningsOf("sphere { material = { bump = texture(noise { }, 1e30); } }"),
      "2:23: bump of material: expected heights of the object's size, found 1e+30: every normal lies in "
      "the surface [bump = texture(noise { }, 0.1) is usual]");
}

TEST(RayFormat, ReadsWhatMeshesSayPerPoint) {
  const std::string rest =
      "normals = ((0,0,1),(0,0,2),(0,1,0),(1,0,0),(1,1,1)) texture_uv = ((0,0),(1,0),(1,1),(0,1),(0.5,0.5))";
  const auto mesh = meshOf(kPoints + rest + "faces = ((0,1,2))");
  ASSERT_EQ(mesh->normals.size(), 5u);
  EXPECT_EQ(mesh->normals[1], Vec3f(0, 0, 2)) << "lengths stay: they weigh the interpolation";
  ASSERT_EQ(mesh->uvs.size(), 5u);
  EXPECT_EQ(mesh->uvs[4], (Vec2{0.5, 0.5}));
  EXPECT_EQ(warningsOf("polymesh {" + (kPoints + rest) + "faces = ((0,1,2)) }"), "");
  EXPECT_TRUE(load("polymesh {" + (kPoints + rest) + "}").scene.unrendered.empty());
  EXPECT_TRUE(meshOf("normals = (); materials = (); texture_uv = (); points = ((0,0,0))")->normals.empty());
}

TEST(RayFormat, VertexMaterialsInheritFromTheMeshSoFar) {
  const Scene scene =
      load(
          "material { name = glow; emissive = 1; }\n"
          "polymesh { material = { diffuse = (1, 0, 0) } points = ((0,0,0),(1,0,0),(0,1,0))\n"
          " materials = ({ ambient = 0.5 }, { ambient = 0.5 }, glow) material = { diffuse = (0, 1, 0) } }")
          .scene;
  const auto& materials = scene.objects[0].shape.as<Mesh>()->data->materials;
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[0], materials[1]);
  const Phong& first = *scene.materials[materials[0]].model.as<Phong>();
  EXPECT_EQ(first.diffuse, Color(1, 0, 0));
  EXPECT_EQ(first.ambient, Color(0.5));
  EXPECT_EQ(scene.materials[materials[2]].model.as<Phong>()->emissive, Color(1));
  EXPECT_EQ(phongOf(scene, 0).diffuse, Color(0, 1, 0));
}

TEST(RayFormat, RepairsNormalsAndDropsTrianglesWithoutArea) {
  const char* text =
      "polymesh { points = ((0,0,0),(1,0,0),(0,1,0),(0,0,0),(2,0,0))\n"
      " faces = ((0,1,2), (0,1,1), (0,3,1), (0,1,4))\n"
      " normals = ((0,0,0),(0,1,0),(1e-60,0,0),(0,0,0),(1,0,0)) }";
  const auto mesh = onlyShape<Mesh>(text).data;
  EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh->normals[0], Vec3f(0, 0, 1));
  EXPECT_EQ(mesh->normals[1], Vec3f(0, 1, 0));
  EXPECT_EQ(mesh->normals[2], Vec3f(0, 0, 1)) << "it is zero as a float";
  EXPECT_EQ(warningsOf(text),
            "3:10: triangles without area are left out: 3\n"
            "4:12: normals of length 0 are taken from the faces: 3");
  EXPECT_EQ(warningsOf(std::string(text) + text).find("3:10: triangles without area are left out: 6"), 0u)
      << "one sum over the file";
  EXPECT_EQ(warningsOf("polymesh { gennormals; points = ((0,0,0)); normals = ((0,0,0)); }"),
            "2:10: polymesh: nothing of it can be seen, for it has no faces");
}

TEST(RayFormat, ReadsTheAreaLightsOfStudents) {
  for (const char* size : {"bottom_radius", "light_radius", "radius"}) {
    const Scene scene = load("area_light { position = (0, 4, 0); color = (1, 1, 0.5); " + std::string(size) +
                             " = 0.5; constant_attenuation_coeff = 2; }")
                            .scene;
    const auto& light = *scene.lights.at(0).light.as<PointLight>();
    EXPECT_EQ(light.radius, 0.5);
    EXPECT_EQ(light.constant, 2);
    EXPECT_TRUE(scene.unrendered.empty());
  }
}

TEST(RayFormat, RowsCopyTheirObjects) {
  const Scene scene = load(
                          "translate(0, 0, 5, rows { count = (3, 2, 1); step = (2, 10, 7); scale(2, sphere { "
                          "name = \"s\"; }) box { } })")
                          .scene;
  ASSERT_EQ(scene.objects.size(), 12u);
  expectNear(scene.objects[0].worldFromObject * Vec3{1, 0, 0}, {2, 0, 5});
  expectNear(scene.objects[11].worldFromObject * Vec3{}, {4, 10, 5});
  EXPECT_EQ(scene.objects[10].name, "s");
  EXPECT_EQ(scene.objects[0].material, scene.objects[11].material);
  // Rows in rows, and chance: the same each time, within its bounds.
  const std::string chance =
      "rows { count = (1, 1, 4); step = (0, 0, 1); rows { count = (5, 1, 1); step = (1, 0, 0); "
      "spread = (0.1, 0.2, 0); size_spread = 0.25; seed = 3; sphere { } } }";
  const Scene some = load(chance).scene;
  EXPECT_EQ(some.objects, load(chance).scene.objects);
  ASSERT_EQ(some.objects.size(), 20u);
  Real most = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const Vec3 at = some.objects[i].worldFromObject * Vec3{}, off = at - Vec3(i % 5, 0, i / 5);
    EXPECT_LE(std::abs(off.x), 0.1);
    EXPECT_LE(std::abs(off.y), 0.2);
    EXPECT_EQ(off.z, 0);
    most = std::max(most, std::abs(off.y));
    const Real size = length(linear(some.objects[i].worldFromObject, Vec3{1, 0, 0}));
    EXPECT_TRUE(size >= 0.75 && size <= 1.25);
  }
  EXPECT_GT(most, 0.05);
  // Lights, at the top of the file only.
  const Scene lit = load(
                        "rows { count = (1, 3, 1); step = (0, 2, 0); point_light { position = (1, 1, 1); "
                        "color = (1, 1, 1); } } sphere { }")
                        .scene;
  ASSERT_EQ(lit.lights.size(), 3u);
  EXPECT_EQ(lit.lights[2].light.as<PointLight>()->position, (Vec3{1, 5, 1}));
  EXPECT_NE(errorsOf("translate(1, 0, 0, rows { point_light { position = (1, 1, 1); color = (1, 1, 1); } })")
                .find("belongs to the top of a file"),
            std::string::npos);
  EXPECT_EQ(errorsOf("rows { count = (2.5, 1, 1); sphere { } }"),
            "2:1: rows: expected whole numbers of copies, at least 1, found 2.5");
  EXPECT_NE(errorsOf("rows { count = (2000, 2000, 1); sphere { } }").find("are more than 2000000 objects"),
            std::string::npos);
  EXPECT_EQ(warningsOf("rows { count = (2, 1, 1); }"), "2:1: rows without objects are empty");
}

TEST(RayFormat, RowsMoveAllThatALightHas) {
  const Scene scene =
      load(
          "rows { count = (2, 1, 1); step = (3, 0, 0); warn_light { position = (-3, 2, 0); direction = "
          "(0, -1, 0); color = (1, 1, 1); x_min = -4; x_max = -2; radius = 0.5; } sphere { } }")
          .scene;
  ASSERT_EQ(scene.lights.size(), 2u);
  const auto& second = *scene.lights[1].light.as<WarnLight>();
  EXPECT_EQ(second.position, (Vec3{0, 2, 0}));
  EXPECT_EQ(second.xMin, -1);
  EXPECT_EQ(second.xMax, 1);
  EXPECT_EQ(second.yMax, kNoLimit);
  // A copy of another size: the light keeps its place in the lamp.
  const Scene sizes =
      load(
          "rows { count = (1, 1, 2); step = (0, 0, 9); size_spread = 0.5; rectangle_light { position = (0, "
          "2, 0); u = (1, 0, 0); v = (0, 0, 1); color = (1, 1, 1); } translate(0, 2, 0, sphere { }) }")
          .scene;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& panel = *sizes.lights.at(i).light.as<RectangleLight>();
    expectNear(panel.position, sizes.objects.at(i).worldFromObject * Vec3{});
    expectNear(panel.u, linear(sizes.objects.at(i).worldFromObject, Vec3{1, 0, 0}));
  }
  EXPECT_EQ(load("rows { directional_light { direction = (0, -1, 0); color = (1, 1, 1); } sphere { } }")
                .scene.lights.size(),
            1u)
      << "a sun has no place, so there is one";
}

TEST(RayFormat, RowsOfNothingEnd) {
  EXPECT_EQ(warningsOf("rows { count = (2000000, 2000000, 2000000); rows { } }"),
            "2:45: rows without objects are empty");
}

TEST(RayFormat, ReadsTheSpotLightsOfStudents) {
  const auto spot = [](const std::string& fields) {
    const Loaded loaded =
        load("spot_light { position = (0, 4, 0); direction = (0, -1, 0); colour = (1, 1, 1); " + fields +
             " } sphere { }");
    EXPECT_TRUE(loaded.warnings.empty()) << fields << ": " << loaded.warnings.front().what;
    return *loaded.scene.lights.at(0).light.as<SpotLight>();
  };
  // Half of Blender's angle; what fades is a part of the cone, measured along its axis.
  const SpotLight blender = spot("size = 70; blend = 0.4;");
  EXPECT_EQ(blender.angle, 35);
  const Real edge = std::cos(35 * kPi / 180);
  EXPECT_NEAR(std::cos(blender.fullAngle * kPi / 180), edge + 0.4 * (1 - edge), 1e-12);
  EXPECT_EQ(spot("blend = 0; size = 160;").fullAngle, 80) << "nothing fades";
  EXPECT_EQ(spot("edgeplace = (30, 0, 0);").angle, 30);
  EXPECT_EQ(spot("edgeplace = (60, 0, 0);").fullAngle, 60);
  EXPECT_EQ(spot("edgeplace = 20;").angle, 20);
  EXPECT_EQ(spot("angle = 30;").angle, 30);
  EXPECT_EQ(spot("atten_angle = 25; fall_rate = 3;").angle, 25);
  EXPECT_EQ(spot("atten_angle = 25; fall_rate = 3;").exponent, 3);
}

TEST(RayFormat, ReadsAndWritesLinksAndFlaps) {
  const std::string text =
      "warn_light { position = (0, 4, 0); direction = (0, -1, 0); color = (1, 1, 1); exponent = 8; x_min = "
      "-2; "
      "z_max = 0.5; name = \"key light\"; lights = (\"ball\", floor); excludes = (\"wall\"); }\n"
      "sphere { name = \"ball\"; }";
  const Loaded loaded = load(text);
  EXPECT_EQ(loaded.warnings.size(), 0u);
  const LightSource& source = loaded.scene.lights.at(0);
  const auto& light = *source.light.as<WarnLight>();
  EXPECT_EQ(light.xMin, -2);
  EXPECT_EQ(light.xMax, kInfinity);
  EXPECT_EQ(source.links.name, "key light");
  EXPECT_EQ(source.links.lights, (std::vector<std::string>{"ball", "floor"}));
  EXPECT_EQ(source.links.excludes, (std::vector<std::string>{"wall"}));
  Messages messages;
  const Scene back =
      readScene("back.ray", writeRay(loaded.scene, "back.ray", {}, messages).front().bytes, messages);
  EXPECT_EQ(back.lights.at(0).light, source.light);
  EXPECT_EQ(back.lights.at(0).links, source.links);
}

TEST(RayFormat, ReadsAndWritesWhatCastsNoShadow) {
  const Loaded loaded = load(
      "directional_light { direction = (0, -1, 0); color = (1, 1, 1); casts_shadows = off; }\n"
      "directional_light { direction = (1, -1, 0); color = (1, 1, 1); casts_shadows = true; }\n"
      "sphere { material = { diffuse = (1, 1, 1); casts_shadow = off; } }\n"
      "sphere { material = { diffuse = (1, 1, 0); casts_shadow = on; } }");
  EXPECT_EQ(loaded.warnings.size(), 0u);
  Messages messages;
  const Scene back =
      readScene("back.ray", writeRay(loaded.scene, "back.ray", {}, messages).front().bytes, messages);
  for (const Scene* scene : {&loaded.scene, &back}) {
    EXPECT_FALSE(scene->lights.at(0).links.castsShadows);
    EXPECT_TRUE(scene->lights.at(1).links.castsShadows);
    EXPECT_FALSE(scene->materials[scene->objects.at(0).material].castsShadow);
    EXPECT_TRUE(scene->materials[scene->objects.at(1).material].castsShadow);
  }
}

TEST(RayFormat, ReadsAndWritesTheLightsThatObjectsName) {
  const Loaded loaded = load(
      "directional_light { name = \"key\"; direction = (0, -1, 0); color = (1, 1, 1); }\n"
      "sphere { name = \"ball\"; lit_by = (\"key\", \"fill\"); }\n"
      "polymesh { not_lit_by = (\"key\"); points = ((0, 0, 0), (1, 0, 0), (0, 1, 0)); faces = ((0, 1, 2)); "
      "}\n"
      "rows { count = (2, 1, 1); box { lit_by = (\"rim\"); } }");
  EXPECT_EQ(loaded.warnings.size(), 0u);
  const std::vector<Object>& objects = loaded.scene.objects;
  EXPECT_EQ(objects.at(0).links, (ObjectLinks{.litBy = {"key", "fill"}, .notLitBy = {}}));
  EXPECT_EQ(objects.at(1).links, (ObjectLinks{.litBy = {}, .notLitBy = {"key"}}));
  EXPECT_EQ(objects.at(3).links, (ObjectLinks{.litBy = {"rim"}, .notLitBy = {}}))
      << "copies as what they copy";
  Messages messages;
  const Scene back =
      readScene("back.ray", writeRay(loaded.scene, "back.ray", {}, messages).front().bytes, messages);
  for (std::size_t i = 0; i < objects.size(); ++i) EXPECT_EQ(back.objects.at(i).links, objects[i].links) << i;
  const Loaded part = load(
      "directional_light { name = \"key\"; direction = (0, -1, 0); color = (1, 1, 1); }\n"
      "union { sphere { lit_by = (\"key\"); } box { } }");
  ASSERT_EQ(part.warnings.size(), 1u);
  EXPECT_NE(part.warnings[0].what.find("the whole says them"), std::string::npos);
}

TEST(RayFormat, RefusesProjectorsWithoutAView) {
  const std::string light =
      "projector_light { position = (0, 4, 0); direction = (0, -1, 0); color = (1, 1, 1); ";
  EXPECT_THROW(load(light + "fov = 180; }"), Error);
  EXPECT_THROW(load(light + "fov = 0; }"), Error);
  EXPECT_EQ(load(light + "} sphere { }").warnings.size(), 0u);
  const Loaded along = load(light + "up = (0, 2, 0); } sphere { }");
  ASSERT_EQ(along.warnings.size(), 1u);
  EXPECT_NE(along.warnings[0].what.find("not along the direction"), std::string::npos);
}

TEST(RayFormat, NamesTheMisspeltFieldThatALightCannotDoWithout) {
  try {
    load("point_light { position = (0, 1, 0); colr = (1, 1, 1); }");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("\"colr\" is not known: did you mean \"color\"?"),
              std::string::npos)
        << error.what();
  }
}

// --- what is not rendered, and what is unknown --------------------------------------------------------

TEST(RayFormat, KeepsWhatItDoesNotRender) {
  const char* text =
      "shape_light { position = (0, 0, 1); }\nshape_light { }\n"
      "translate(1, 2, 3, metaball { a = 1; })\ncsg(sphere{}, box{})\n"
      "sphere { material = { environment = \"b.png\"; diffuse = meteorite { depth = 4 } } }";
  const Loaded loaded = load(text);
  EXPECT_EQ(
      warningsOf(text),
      "2:1: \"shape_light\" is not rendered yet (2 times, first here) [Trace has warn_light { }, with a cone "
      "and flaps, and projector_light { }, with a picture]\n"
      "4:20: \"metaball\" is not rendered yet [Trace has metaballs { threshold = 0.5; balls = ((x, y, z, "
      "radius, strength), ...); }]\n"
      "5:1: \"csg\" is not rendered yet [Trace has union, intersection and difference, as in difference { "
      "box { } sphere { } }]\n"
      "6:23: \"environment\" is not rendered yet\n"
      "6:56: \"meteorite\" is not rendered yet");
  ASSERT_EQ(loaded.scene.unrendered.size(), 6u);
  EXPECT_EQ(loaded.scene.unrendered[0].kind, "shape_light");
  EXPECT_EQ(loaded.scene.unrendered[0].text, "shape_light { position = (0, 0, 1); }");
  EXPECT_EQ(loaded.scene.unrendered[0].place.line, 2);
  EXPECT_EQ(loaded.scene.unrendered[2].text,
            "transform((1, 0, 0, 1), (0, 1, 0, 2), (0, 0, 1, 3), (0, 0, 0, 1),\nmetaball { a = 1; })");
  EXPECT_EQ(loaded.scene.objects.size(), 1u);
  EXPECT_EQ(phongOf(loaded.scene, 0).diffuse, Color(1));
}

TEST(RayFormat, WarnsOfUnknownWords) {
  EXPECT_EQ(warningsOf("spehre { }"),
            "2:1: \"spehre\" is not known and is left out [did you mean \"sphere\"?]");
  EXPECT_EQ(warningsOf("horizon = 1"), "2:1: \"horizon\" is not known and is left out");
  EXPECT_EQ(warningsOf("{ zzz(1, 2) }"), "2:3: \"zzz\" is not known and is left out");
  EXPECT_EQ(warningsOf("camera { focaldistance = 4; }"),
            "2:10: focaldistance of camera is ignored: everything is in focus");
  EXPECT_EQ(warningsOf("camera { viewdri = 4; viewdri = 5 }"),
            "2:10: unknown field \"viewdri\" of camera is ignored (2 times, first here) [did you mean "
            "\"viewdir\"?]");
  EXPECT_EQ(
      warningsOf("sphere { material = { difuse = 4 } capped = true }"),
      "2:23: unknown field \"difuse\" of material is ignored [did you mean \"diffuse\"?]\n"
      "2:36: unknown field \"capped\" of sphere is ignored [it has material, name, lit_by, not_lit_by]");
  EXPECT_EQ(warningsOf("torus { tube = 1 }"),
            "2:9: unknown field \"tube\" of torus is ignored [it has material, name, lit_by, not_lit_by, "
            "major_radius, minor_radius]");
  EXPECT_EQ(warningsOf("polymesh { point = () }"),
            "2:12: unknown field \"point\" of polymesh is ignored [did you mean \"points\"?]\n"
            "2:10: polymesh: nothing of it can be seen, for it has no faces");
  EXPECT_EQ(warningsOf("ambient_light { color = 1; colr = 2; }"),
            "2:28: unknown field \"colr\" of ambient_light is ignored [did you mean \"color\"?]");
}

TEST(RayFormat, WarnsOfValuesOutOfRange) {
  const char* text =
      "sphere { material = { diffuse = (0, 1.5, 0); index = -1 } } box { material = { diffuse = (2, 3, 4) } "
      "}";
  EXPECT_EQ(warningsOf(text),
            "2:23: diffuse of material: expected 0 to 1, found 1.5 (4 times, first here) [a colour goes from "
            "0 to 1; #ff8000 is "
            "one as picture programs write it]\n"
            "2:46: index of material: expected at least 0, found -1");
  EXPECT_EQ(phongOf(load(text).scene, 0).diffuse, Color(0, 1.5, 0));
  EXPECT_EQ(warningsOf("julia { iteration = cube; iterations = 40; }"),
            "2:1: iterations of julia: numbers can follow a cube 36 times, found 40; 36 are used");
}

// --- settings and dialects ----------------------------------------------------------------------------

TEST(RayFormat, TakesSettingsAsChoices) {
  const Scene scene = load(
                          "settings { depth = 3; like = ut;\n highlight = phong; region = (0, 0, 8, 9); "
                          "shininess-scale = 1.5e1 "
                          "limit-attenuation = off; }")
                          .scene;
  std::string text;
  for (const Choice& choice : scene.choices)
    text += choice.option + "=" + choice.value + "@" + std::to_string(choice.place.line) + ":" +
            std::to_string(choice.place.column) + " ";
  EXPECT_EQ(text,
            "depth=3@2:12 like=ut@2:23 highlight=phong@3:2 region=0,0,8,9@3:21 shininess-scale=1.5e1@3:44 "
            "limit-attenuation=off@3:68 ");
}

/// The line of the sign that makes a scene one of 2001; 0 if it is none.
int lineOf2001(const std::string& text) {
  for (const Choice& choice : load(text).scene.choices)
    if (choice.option == "like" && choice.value == "uw2001") return choice.place.line;
  return 0;
}

TEST(RayFormat, RecognisesTheDialectOf2001) {
  const std::string small = "\nsphere { material = { specular = 0.5; shininess = 0.2; } }";
  const std::string large = "\nsphere { material = { specular = 0.5; shininess = 20; } }";
  const std::pair<std::string, int> cases[] = {
      {"", 0},
      {"camera { focaldistance = 3; }", 2},
      {"camera { quaternion = (0, 0, 0, 1); }", 2},
      {"\nmaterial { name = a; }", 0},
      {"sphere { material { diffuse = 1; } }", 0},
      {"material { name = gold; diffuse = (0.8, 0.6, 0.1); specular = 0.5; shininess = 40; }", 0},
      {"material { name = gold; specular = 0.5; shininess = 0.3; }", 2},
      {"polymesh { gennormals = true; }", 2},
      {small, 3},
      {large, 0},
      {small + large, 0},
      {large + "material { name = a; }", 0},
      {large + "camera { quaternion = (0, 0, 0, 1); }", 0},
      {"material = { }" + small, 0},
      {"polymesh { gennormals; }" + small, 0},
      {"camera { quaternian = (0, 0, 0, 1); }" + small, 0},
      {"sphere { material = { shininess = 0.2; } }", 0},
      {"sphere { material = { shininess = 20; } }" + small, 3},
      {"sphere { material = { specular = 1; shininess = 0; } }" + small, 0},
      {"sphere { material = { shininess = 1; specular = 1; } }", 2},
      {"settings { like = uw; }" + small, 0},
      {"settings { depth = 2; }" + small, 3},
  };
  for (const auto& [text, line] : cases) EXPECT_EQ(lineOf2001(text), line) << text;
  EXPECT_EQ(warningsOf("camera { quaternion = (0, 0, 0, 1); }"), "");
}

TEST(RayFormat, TakesVersionsUpTo1_1) {
  for (const char* header :
       {"SBT-raytracer 1.0", "SBT-raytracer 1.1", "SBT-raytracer 0.9;", "\r\n// x\r\nSBT-raytracer\n1",
        "\xef\xbb\xbfSBT-raytracer 1.0", "/* c */ SBT-raytracer 1.0 // d"})
    EXPECT_EQ(errorsOfFile(header), "") << header;
}

}  // namespace
}  // namespace trace::ray_format_test
