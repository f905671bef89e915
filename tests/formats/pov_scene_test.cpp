// Scenes of POV-Ray as Trace has them: each object, textures, lights, the camera.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "formats/format.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/prism.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"
#include "shading/materials/phong.h"
#include "shading/textures/image_map.h"
#include "shading/textures/solid.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::pov_scene_test {
namespace {

Scene sceneOf(const std::string& text, std::string* warnings = nullptr) {
  Messages messages;
  Scene scene = readScene("test.pov", "#version 3.7;\n" + text, messages);
  for (const Message& m : messages.all())
    if (warnings) *warnings += std::to_string(m.place.line) + ": " + m.what + "\n";
  return scene;
}
std::string choiceOf(const Scene& scene, std::string_view option) {
  std::string value;
  for (const Choice& choice : scene.choices)
    if (choice.option == option) value = choice.value;
  return value;
}
const Phong& phongOfFirst(const Scene& scene) {
  return *scene.materials.at(scene.objects.at(0).material).model.as<Phong>();
}
void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
  EXPECT_NEAR(a.z, b.z, 1e-9);
}

TEST(PovScene, TheCameraTurnsRound) {
  const Scene scene = sceneOf("camera { location <1, 2, -5> look_at <1, 2, 0> angle 90 right x * 2 up y }");
  EXPECT_EQ(scene.camera.position, (Vec3{1, 2, 5}));
  expectNear(normalize(scene.camera.viewdir), {0, 0, -1});
  expectNear(normalize(scene.camera.updir), {0, 1, 0});
  EXPECT_NEAR(scene.camera.aspectratio, 2, 1e-12);
}

TEST(PovScene, ARightHandedCameraKeepsZ) {
  const Scene scene = sceneOf("camera { location <0, 0, 5> right -x look_at 0 } sphere { <0, 0, 2>, 1 }");
  EXPECT_EQ(scene.camera.position, (Vec3{0, 0, 5}));
  EXPECT_EQ(scene.objects.at(0).worldFromObject.offset, (Vec3{0, 0, 2}));
}

TEST(PovScene, TheAngleIsHorizontal) {
  const Scene scene = sceneOf("camera { angle 90 right x up y }");
  EXPECT_NEAR(scene.camera.fov, 90, 1e-9);
}

TEST(PovScene, ShapesStandWhereTheyAre) {
  const Scene scene = sceneOf(
      "box { <0, 0, 0>, <2, 4, 6> } cylinder { <0, 1, 0>, <0, 3, 0>, 0.5 open } cone { 0, 1, y, 0 } torus { "
      "2, 0.5 } "
      "plane { y, -1 } union { sphere { 0, 1 } sphere { x, 1 } translate 2 * y }");
  ASSERT_EQ(scene.objects.size(), 7u) << "a union is its parts";
  expectNear(scene.objects[0].worldFromObject.offset, {1, 2, -3});
  EXPECT_FALSE(scene.objects[1].shape.as<Cylinder>()->capped);
  expectNear(scene.objects[1].worldFromObject * Vec3{0, 0, 1}, {0, 3, 0});
  EXPECT_EQ(scene.objects[3].shape.as<Torus>()->majorRadius, 2);
  expectNear(linear(scene.objects[3].worldFromObject, {0, 0, 1}), {0, 1, 0});
  expectNear(scene.objects[4].worldFromObject.offset, {0, -1, 0});
  expectNear(scene.objects[6].worldFromObject.offset, {1, 2, 0});
}

TEST(PovScene, TransformsFollowInOrder) {
  const Scene scene = sceneOf("sphere { x, 1 rotate 90 * z translate <0, 0, 4> scale 2 }");
  expectNear(scene.objects.at(0).worldFromObject.offset, {0, 2, -8});
}

TEST(PovScene, SolidsOfSolids) {
  const Scene scene = sceneOf(
      "difference { box { -1, 1 } sphere { 0, 1 } } intersection { sphere { 0, 1 } sphere { 0, 2 inverse } } "
      "merge { sphere { 0, 1 } box { 0, 1 } }");
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_TRUE(scene.objects[0].shape.is<Difference>());
  EXPECT_TRUE(scene.objects[1].shape.is<Difference>()) << "an inverse operand is cut out";
  EXPECT_EQ(scene.objects[1].shape.operands().list().size(), 2u);
}

TEST(PovScene, TexturesBecomeMaterials) {
  const Scene scene = sceneOf(
      "sphere { 0, 1 pigment { rgb <1, 0.5, 0> } finish { ambient 0.2 diffuse 0.5 specular 0.4 roughness "
      "0.02 reflection 0.25 } }");
  const Phong& phong = phongOfFirst(scene);
  EXPECT_EQ(phong.diffuse, Color(0.5, 0.25, 0));
  EXPECT_EQ(phong.ambient, Color(0.2, 0.1, 0));
  EXPECT_EQ(phong.specular, Color(0.4));
  EXPECT_EQ(phong.reflective, Color(0.25));
  EXPECT_NEAR(phong.shininess, 50, 1e-9);
}

TEST(PovScene, GlassLetsItsFilterThrough) {
  const Scene scene = sceneOf("sphere { 0, 1 pigment { rgbf <1, 0.5, 0, 0.8> } interior { ior 1.5 } }");
  const Phong& phong = phongOfFirst(scene);
  EXPECT_EQ(phong.transmissive, Color(0.8, 0.4, 0));
  EXPECT_EQ(phong.index, 1.5);
  EXPECT_NEAR(phong.diffuse.r, 0.6 * 0.2, 1e-12);
}

TEST(PovScene, MapsBecomeRamps) {
  const Scene scene = sceneOf(
      "sphere { 0, 1 pigment { leopard color_map { [0 rgb 0] [1 rgb 1] } turbulence 0.5 frequency 3 "
      "sine_wave } finish { diffuse 1 } }");
  const Texture* texture = textureOf(scene.materials.at(scene.objects.at(0).material).textures, "diffuse");
  ASSERT_TRUE(texture);
  const Solid* solid = (*texture)->model.as<Solid>();
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->kind, SolidPattern::leopard);
  EXPECT_EQ(solid->wave, SolidWave::sine);
  EXPECT_EQ(solid->frequency, 3);
  EXPECT_EQ(solid->turbulence, (Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(solid->ramp, (ColorRamp{{0, 0, 0, 0}, {1, 1, 1, 1}}));
}

/// The colour of the first object's diffuse texture at a point of the world.
Color seenAt(const Scene& scene, const Vec3& world) {
  const Object& object = scene.objects.at(0);
  const Texture* texture = textureOf(scene.materials.at(object.material).textures, "diffuse");
  if (!texture) return Color(-1);
  return (*texture).at({.point = inverse(object.worldFromObject) * world,
                        .uv = {},
                        .uvX = {},
                        .uvY = {},
                        .pointX = {},
                        .pointY = {}});
}

TEST(PovScene, PatternsStandInTheWorld) {
  const std::string paint =
      "pigment { checker rgb 1, rgb 0 scale <2, 1, 1> rotate 90 * z translate x } finish { diffuse 1 }";
  for (const std::string body :
       {"sphere { <5, 6, 7>, 3 ", "box { -4, <9, 3, 1> ", "cylinder { -x, <3, 4, 5>, 2 "}) {
    const Scene scene = sceneOf(body + paint + " }");
    EXPECT_EQ(seenAt(scene, {0.5, 0.5, -0.5}), Color(1)) << body;
    EXPECT_EQ(seenAt(scene, {0.5, 1.5, -0.5}), Color(1)) << body << "cells are two high";
    EXPECT_EQ(seenAt(scene, {0.5, 2.5, -0.5}), Color(0)) << body;
    EXPECT_EQ(seenAt(scene, {1.5, 0.5, -0.5}), Color(0)) << body;
  }
}

TEST(PovScene, TexturesMoveWithTheirObjects) {
  const Scene before =
      sceneOf("sphere { 0, 1 pigment { checker rgb 1, rgb 0 } finish { diffuse 1 } translate x }");
  EXPECT_EQ(seenAt(before, {1.5, 0.5, -0.5}), Color(1));
  const Scene after =
      sceneOf("sphere { 0, 1 translate x pigment { checker rgb 1, rgb 0 } finish { diffuse 1 } }");
  EXPECT_EQ(seenAt(after, {1.5, 0.5, -0.5}), Color(0));
}

TEST(PovScene, ShearedPatternsToo) {
  const Scene scene = sceneOf(
      "sphere { 0, 1 pigment { checker rgb 1, rgb 0 matrix <1, 0, 0, 0.5, 1, 0, 0, 0, 1, 0, 0, 0> } finish { "
      "diffuse 1 } }");
  EXPECT_EQ(seenAt(scene, {0.9, 0.5, -0.5}), Color(1)) << "from 0.25 to 1.25";
  EXPECT_EQ(seenAt(scene, {0.1, 0.5, -0.5}), Color(0));
}

TEST(PovScene, Lights) {
  const Scene scene = sceneOf(
      "light_source { <1, 2, 3>, rgb <1, 0.5, 0> fade_distance 4 fade_power 2 } light_source { 10 * y, 1 "
      "spotlight point_at 0 radius "
      "10 falloff 20 tightness 5 } light_source { 10 * y, 1 parallel point_at 0 } light_source { y, 1 "
      "area_light x * 2, z * 2, 3, 3 }");
  const auto& point = *scene.lights.at(0).light.as<PointLight>();
  EXPECT_EQ(point.position, (Vec3{1, 2, -3}));
  EXPECT_EQ(point.constant, 0.5);
  EXPECT_EQ(point.quadratic, 0.5 / 16);
  const auto& spot = *scene.lights.at(1).light.as<SpotLight>();
  EXPECT_EQ(spot.angle, 20);
  EXPECT_EQ(spot.fullAngle, 10);
  EXPECT_EQ(spot.exponent, 5);
  EXPECT_EQ(spot.edge, SpotEdge::smooth);
  expectNear(scene.lights.at(2).light.as<DirectionalLight>()->direction, {0, -1, 0});
  EXPECT_EQ(scene.lights.at(3).light.as<PointLight>()->radius, 1);
}

TEST(PovScene, GammaAndDepth) {
  EXPECT_EQ(choiceOf(sceneOf("global_settings { assumed_gamma 1 max_trace_level 9 }"), "depth"), "9");
  EXPECT_EQ(choiceOf(sceneOf("global_settings { assumed_gamma 1 }"), "transfer"), "srgb");
  EXPECT_EQ(choiceOf(sceneOf("global_settings { assumed_gamma 1 }"), "working-gamma"), "");
  EXPECT_EQ(choiceOf(sceneOf("global_settings { assumed_gamma 1.8 }"), "transfer"), "srgb");
  EXPECT_EQ(choiceOf(sceneOf("global_settings { assumed_gamma 1.8 }"), "working-gamma"), "1.8");
}

TEST(PovScene, AFileWithoutItsVersionHasTheGammaOfOlderFiles) {
  const auto toneOf = [](const char* version) {
    Messages messages;
    const Scene scene = readScene("test.pov", std::string(version) + "sphere { 0, 1 }", messages);
    std::string tone;
    for (const Choice& choice : scene.choices) tone += choice.option + " " + choice.value + "\n";
    return tone;
  };
  EXPECT_EQ(toneOf(""), toneOf("#version 3.5;\n"));
  EXPECT_NE(toneOf(""), toneOf("#version 3.7;\n"));
}

TEST(PovScene, ASkyWithAPatternHasItsPictures) {
  std::string warnings;
  const Scene scene = sceneOf(
      "sky_sphere { pigment { bozo color_map { [0 color rgb <0, 0, 1>] [1 color rgb 1] } } } sphere { 0, 1 }",
      &warnings);
  EXPECT_EQ(warnings, "");
  for (const Pixels* face : scene.background.faces()) {
    ASSERT_TRUE(face->map);
    EXPECT_EQ(face->map->width(), 256);
  }
}

TEST(PovScene, MirrorsAndGlassSeeTheBackground) {
  const Scene scene = sceneOf("background { rgb <0.1, 0.2, 0.3> } sphere { 0, 1 }");
  EXPECT_EQ(scene.background.gradient, std::vector<Color>{Color(0.1, 0.2, 0.3)});
}

TEST(PovScene, ALayerOfTheSkyLetsTheOneBelowThrough) {
  const auto skyOf = [](const std::string& top) {
    const Scene scene = sceneOf("background { rgb 0.3 } sky_sphere { " + top + " } sphere { 0, 1 }");
    return scene.background.gradient.at(0).g;
  };
  EXPECT_NEAR(skyOf("pigment { rgb 0.8 } pigment { rgbf <0.5, 0.5, 0.5, 0.6> }"), 0.5 * 0.4 + 0.8 * 0.5 * 0.6,
              1e-12);
  EXPECT_NEAR(skyOf("pigment { rgbt <0.5, 0.5, 0.5, 0.6> }"), 0.5 * 0.4 + 0.3 * 0.6, 1e-12);
}

TEST(PovScene, HighlightsAreThoseOfMostTextures) {
  const std::string phong = "sphere { 0, 1 finish { phong 0.5 phong_size 12 } } ",
                    specular = "sphere { 0, 1 finish { specular 0.5 roughness 0.01 } } ";
  const Scene mirrored = sceneOf(phong);
  EXPECT_EQ(choiceOf(mirrored, "highlight"), "phong");
  EXPECT_EQ(phongOfFirst(mirrored).shininess, 12);
  const Scene both = sceneOf(phong + specular + "union { " + specular + "}");
  EXPECT_EQ(choiceOf(both, "highlight"), "");
  EXPECT_EQ(phongOfFirst(both).shininess, 48) << "by the half-way vector four times the exponent is as wide";
}

TEST(PovScene, MirrorsGainAtGrazingAngles) {
  const Scene linear = sceneOf("sphere { 0, 1 finish { reflection { 0.1, 0.9 falloff 3 } } }");
  EXPECT_EQ(phongOfFirst(linear).reflective, Color(0.1));
  EXPECT_NEAR(phongOfFirst(linear).grazing.r, 0.8, 1e-12);
  EXPECT_EQ(phongOfFirst(linear).grazingExponent, 3);
  const Scene glass = sceneOf(
      "sphere { 0, 1 pigment { rgbf 1 } finish { reflection { 1 fresnel } conserve_energy } interior { ior "
      "1.5 "
      "} }");
  EXPECT_NEAR(phongOfFirst(glass).reflective.g, 0.04, 1e-12) << "Fresnel's formula along the normal";
  EXPECT_NEAR(phongOfFirst(glass).grazing.g, 0.96, 1e-12);
  EXPECT_EQ(phongOfFirst(glass).grazingExponent, 5);
  EXPECT_NEAR(phongOfFirst(glass).transmissive.g, 0.96, 1e-12);
  const Scene air = sceneOf("sphere { 0, 1 finish { reflection { 1 fresnel } } }");
  EXPECT_FALSE(phongOfFirst(air).mirrors()) << "nothing is mirrored where the index stays";
}

TEST(PovScene, BrillianceIsKept) {
  const Scene scene = sceneOf("sphere { 0, 1 pigment { rgb 1 } finish { diffuse 0.5 brilliance 3 } }");
  EXPECT_EQ(phongOfFirst(scene).brilliance, 3);
  EXPECT_EQ(phongOfFirst(scene).diffuse, Color(0.5));
}

TEST(PovScene, ColoursOfAMapAreMixedBeforeTheirTransparency) {
  const Scene scene = sceneOf(
      "sphere { 0, 1 pigment { gradient x color_map { [0 rgb 1] [1 rgbt <0, 0, 0, 1>] } } finish { diffuse 1 "
      "} "
      "}");
  const Texture* diffuse = textureOf(scene.materials.at(0).textures, "diffuse");
  ASSERT_TRUE(diffuse);
  TexturePlace place;
  const Affine object = inverse(scene.objects.at(0).worldFromObject);
  place.point = object * Vec3{0.5, 0, 0};
  EXPECT_NEAR(diffuse->at(place).r, 0.5 * (1 - 0.5), 1e-9);
}

TEST(PovScene, AnAngleOfAnOrthographicCameraIsThatOfAPerspectiveOne) {
  const Scene scene =
      sceneOf("camera { orthographic location <0, 0, -10> look_at 0 right x up y angle 90 } sphere { 0, 1 }");
  EXPECT_NEAR(std::stod(choiceOf(scene, "view-height")), 20, 1e-9);
}

TEST(PovScene, ReadsWhatPovRayForgives) {
  std::string warnings;
  const Scene scene = sceneOf(
      "#macro Ball(At, R) sphere { At, R } #end object { Ball(<0, 0, 0> 2) normal { average normal_map { "
      "[gradient x, -5 scale 0.5] } } } camera { location <0, 2, -10># }",
      &warnings);
  EXPECT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(warnings, "2: a # without a directive is left out\n");
}

TEST(PovScene, FormulasOfIsosurfaces) {
  const Scene scene = sceneOf(
      "#declare F = function { sqrt(x * x + y * y) - 1 }; isosurface { function { max(F(x, y, z), abs(z) - "
      "2) } contained_by { box { -3, 3 } } "
      "threshold 0.5 }");
  const Isosurface& shape = *scene.objects.at(0).shape.as<Isosurface>();
  EXPECT_EQ(shape.low, (Vec3{-3, -3, -3}));
  EXPECT_NEAR(Expression(shape.formula).at({2, 0, 0}), 0.5, 1e-12);
  EXPECT_NEAR(Expression(shape.formula).at({0, 0, 4}), 1.5, 1e-12);
}

TEST(PovScene, OmissionsAreToldOnceAndCounted) {
  std::string warnings;
  sceneOf("\nsphere { 0, 1 no_image }\nsphere { x, 1 no_image }", &warnings);
  EXPECT_EQ(warnings, "3: no_image is left out (2 times, first here)\n");
  warnings.clear();
  sceneOf("#declare F = finish { crand 0.1 } sphere { 0, 1 }", &warnings);
  EXPECT_EQ(warnings, "") << "what is not used is not left out";
}

TEST(PovScene, EachOmissionHasTheLineOfTheFirst) {
  std::string warnings;
  sceneOf(
      "sphere { 0, 1 pigment { rgb 1 } }\n"
      "sphere { 0, 1 pigment {\n slope y color_map { [0 rgb 0] [1 rgb 1] } } }\n"
      "sphere { 0, 1 texture { mandel 9\n texture_map { [0 pigment { rgb 0 }] [1 pigment { rgb 1 }] } } }\n"
      "sphere { 0, 1 pigment { rgbt 1 } interior { media { emission 1 }\n media { emission 1 } } }\n"
      "superellipsoid { <3, 0.5> }\n"
      "fog { distance 9 rgbt <1, 1, 1, 0.5>\n turbulence 0.3 }\n",
      &warnings);
  for (const char* expected :
       {"4: the pattern slope is left out", "5: the pattern mandel is left out", "8: a second media",
        "9: exponents of a superellipsoid are limited to 0.02 to 2",
        "10: the filter or transmit of a fog's colour", "11: the turbulence of a fog is left out"})
    EXPECT_NE(warnings.find(expected), warnings.npos) << expected << "\nin\n" << warnings;
}

TEST(PovScene, LinesThatTheSceneSaysAreReported) {
  std::string warnings;
  sceneOf("#debug concat(\"one\\n\", \"two\\n\")\n#warning \"beware\\n\"\n#debug \"one\\n\"\nsphere { 0, 1 }",
          &warnings);
  EXPECT_EQ(warnings, "2: #debug: one (2 times, first here)\n2: #debug: two\n3: the scene warns: beware\n");
}

TEST(PovScene, PatternsWithoutAMapHaveTheColoursOfPovRay) {
  const auto rampOf = [](const std::string& pattern) {
    const Scene scene = sceneOf("sphere { 0, 1 pigment { " + pattern + " } }");
    return (*textureOf(scene.materials.at(0).textures, "diffuse"))->model.as<Solid>()->ramp;
  };
  const ColorRamp radial = rampOf("radial");
  ASSERT_EQ(radial.size(), 4u);
  EXPECT_EQ(radial[0][1], 0);
  EXPECT_GT(radial[0][2], 0);
  EXPECT_EQ(rampOf("agate").size(), 5u);
  EXPECT_EQ(rampOf("bozo").size(), 4u);
  EXPECT_EQ(rampOf("leopard").size(), 2u);
}

TEST(PovScene, AnAverageKeepsTheHighlightOfOneOfItsTextures) {
  const Phong mean =
      phongOfFirst(sceneOf("sphere { 0, 1 texture { average texture_map { [pigment { rgb 1 }] [pigment { rgb "
                           "1 } finish { phong 1 }] } } }"));
  EXPECT_EQ(mean.specular, Color(0.5));
  EXPECT_EQ(mean.shininess, 40) << "phong_size";
}

TEST(PovScene, ATextBeginsWithItsFirstLetter) {
  const std::string font = "/usr/share/povray-3.7/include/cyrvetic.ttf";
  if (!std::filesystem::exists(font)) GTEST_SKIP() << "needs the package povray-includes";
  const Scene scene = sceneOf("text { ttf \"cyrvetic.ttf\" \"BD\" 0.1, 0 }");
  EXPECT_NEAR(bounds(scene).low.x, 0, 1e-3);
}

TEST(PovScene, ADensityColoursItsMedium) {
  const Scene scene = sceneOf(
      "sphere { 0, 1 pigment { rgbt 1 } interior { media { emission 2\n density { spherical color_map { [0 "
      "rgb 0] "
      "[1 rgb <1, 0, 0>] } } } } }");
  const Color glows = scene.materials.at(0).mediumGlows;
  EXPECT_GT(glows.r, 0);
  EXPECT_EQ(glows.g, 0);
  EXPECT_EQ(glows.b, 0);
  EXPECT_NEAR(luminance(glows), 2, 1e-12);
}

TEST(PovScene, PicturesAreFoundBesideTheFileThatNamesThem) {
  const test::Folder folder;
  std::filesystem::create_directories(folder / "parts");
  writeFile(folder / "parts/dots.ppm", "P3 1 1 255 9 8 7");
  writeFile(folder / "parts/dots.inc", "#declare P = pigment { image_map { ppm \"dots.ppm\" } }\n");
  const std::string scene = "#version 3.7;\n#include \"parts/dots.inc\"\nsphere { 0, 1 pigment { P } }\n";
  Messages messages;
  const Scene read = readScene(folder / "a.pov", scene, messages);
  EXPECT_TRUE(messages.all().empty()) << messages.all().front().what;
  const auto* map = (*textureOf(read.materials.at(0).textures, "diffuse"))->model.as<ImageMap>();
  ASSERT_TRUE(map && map->file.map);
  EXPECT_EQ(map->file.file, "dots.ppm");
}

TEST(PovScene, WhatCastsNoShadow) {
  const Scene scene = sceneOf(
      "light_source { 0, 1 shadowless looks_like { sphere { 0, 0.1 } } translate <0, 3, 0> } light_source { "
      "x, 1 } "
      "union { sphere { 0, 1 } box { 0, 1 } no_shadow } sphere { 0, 1 no_shadow off } "
      "difference { box { -1, 1 } sphere { 0, 1 } no_shadow }");
  ASSERT_EQ(scene.lights.size(), 3u) << "the last is ambient light";
  EXPECT_FALSE(scene.lights[0].links.castsShadows);
  EXPECT_TRUE(scene.lights[1].links.castsShadows);
  ASSERT_EQ(scene.objects.size(), 5u);
  const auto casts = [&](std::size_t i) { return scene.materials[scene.objects[i].material].castsShadow; };
  EXPECT_FALSE(casts(0)) << "what a light looks like does not block it";
  EXPECT_NEAR(length(scene.objects[0].worldFromObject * Vec3() - Vec3(0, 3, 0)), 0, 1e-12);
  EXPECT_FALSE(casts(1));
  EXPECT_FALSE(casts(2));
  EXPECT_TRUE(casts(3));
  EXPECT_FALSE(casts(4));
}

TEST(PovScene, EveryShapeOfTheCorpusIsRead) {
  Messages messages;
  const Scene scene = readScene(test::sourceFolder() + "/tests/corpus/pov/shapes.pov", messages);
  EXPECT_EQ(scene.objects.size(), 17u);
  for (const Message& m : messages.all()) ADD_FAILURE() << toString(m);
}

TEST(PovScene, ExamplesOfThePackageAreRead) {
  const std::string folder = "/usr/share/doc/povray/examples";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "Debian's package povray-examples is not installed";
  int files = 0, read = 0;
  for (const char* part : {"/objects", "/textures/patterns", "/incdemo/woods", "/language"})
    for (const auto& entry : std::filesystem::directory_iterator(folder + part)) {
      if (entry.path().extension() != ".pov") continue;
      ++files;
      try {
        Messages messages;
        readScene(entry.path().string(), messages);
        ++read;
      } catch (const Error& error) {
        if (error.messages().empty()) ADD_FAILURE() << entry.path();
      }
    }
  EXPECT_GE(read, files * 9 / 10) << "of " << files;
}

}  // namespace
}  // namespace trace::pov_scene_test
