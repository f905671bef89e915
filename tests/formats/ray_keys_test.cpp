// Values that change with time: the interpolations by hand, and keys in every kind of place.
#include <gtest/gtest.h>

#include "formats/ray/file/format.h"
#include "geometry/mesh/mesh.h"
#include "math/keyframes.h"
#include "ray_helpers.h"
#include "shading/lights/point_light.h"

namespace trace::ray_keys_test {
namespace {

Scene at(Real time, std::string_view text) {
  Messages messages;
  return readRay("test.ray", "SBT-raytracer 1.0\n" + std::string(text), messages, time);
}

// --- interpolation --------------------------------------------------------------------------------------

const std::vector<Real> kTimes{1, 2, 4}, kValues{10, 20, 0};

Real value(Real time, Interpolation interpolation) {
  return interpolate(kTimes, kValues, time, interpolation);
}

TEST(Keyframes, AreExactAtKeysAndStandStillOutside) {
  for (Interpolation i : {Interpolation::linear, Interpolation::smooth, Interpolation::spline}) {
    for (std::size_t k = 0; k < kTimes.size(); ++k) EXPECT_EQ(value(kTimes[k], i), kValues[k]);
    EXPECT_EQ(value(-100, i), 10);
    EXPECT_EQ(value(100, i), 0);
    const std::vector<Real> one{3}, seven{7};
    EXPECT_EQ(interpolate(one, seven, 5, i), 7);
  }
}

TEST(Keyframes, BetweenKeysByHand) {
  EXPECT_EQ(value(1.25, Interpolation::linear), 12.5);
  EXPECT_EQ(value(3, Interpolation::linear), 10);
  EXPECT_EQ(value(1.25, Interpolation::smooth), 10 + 10 * (0.0625 * 2.5));
  EXPECT_EQ(value(3, Interpolation::smooth), 10);
  // Slopes at the keys 10, -10/3, -10; half way the Hermite curve is the mean plus span/8 of their
  // difference.
  EXPECT_NEAR(value(1.5, Interpolation::spline), 15 + (10 + 10 / 3.0) / 8, 1e-12);
  EXPECT_NEAR(value(3, Interpolation::spline), 10 + 2 * (-10 / 3.0 + 10) / 8, 1e-12);
}

TEST(Keyframes, ASplineHasNoCorners) {
  const Real h = 1e-6;
  const Real before = (value(2, Interpolation::spline) - value(2 - h, Interpolation::spline)) / h;
  const Real behind = (value(2 + h, Interpolation::spline) - value(2, Interpolation::spline)) / h;
  EXPECT_NEAR(before, behind, 1e-4);
  EXPECT_NEAR(before, -10 / 3.0, 1e-4);
}

TEST(Keyframes, ASplineThroughALineIsTheLine) {
  const std::vector<Real> times{0, 1, 5, 6}, line{1, 3, 11, 13};
  for (Real t = 0; t <= 6; t += 0.25)
    EXPECT_NEAR(interpolate(times, line, t, Interpolation::spline), 1 + 2 * t, 1e-12);
}

// --- in scenes ------------------------------------------------------------------------------------------

TEST(RayKeys, StandWhereverANumberOrAListStands) {
  const std::string_view text = R"(
camera { position = key((0, (0, 0, 8)), (2, (4, 0, 8))); fov = key((0, 30), (2, 50)); }
point_light { position = (key((0, 0), (2, 1)), 2, 3); color = key((0, 1), (2, (0.5))); constant_attenuation_coeff = 1; }
translate(key((0, 0), (2, 6)), 0, 0, rotate(0, 0, 1, key((0, 0), (2, 3)), sphere {
  material = { diffuse = key((0, (1, 0, 0)), (2, (0, 1, 0))); shininess = key((0, 1), (2, 5)); } }))
polymesh { points = ((0,0,0), (key((0, 1), (2, 3)), 0, 0), (0,1,0)); faces = ((0,1,2)); }
settings { spp = key((0, 1), (2, 9)); }
)";
  // A grey and a list of one number are not alike, so the light's color is told below.
  EXPECT_NE(errorsOf(text).find("key: expected a value like the first one, 1, found (0.5)"),
            std::string::npos);
  std::string good(text);
  good.replace(good.find("(0.5)"), 5, "0.5");
  const Scene scene = at(1, good);
  EXPECT_EQ(scene.camera.position, Vec3(2, 0, 8));
  EXPECT_EQ(scene.camera.fov, 40);
  const PointLight& light = *scene.lights.at(0).light.as<PointLight>();
  EXPECT_EQ(light.position, Vec3(0.5, 2, 3));
  EXPECT_EQ(light.color, Color(0.75));
  EXPECT_EQ(scene.objects.at(0).worldFromObject,
            Affine::translation({3, 0, 0}) * Affine::rotation({0, 0, 1}, 1.5));
  EXPECT_EQ(phongOf(scene, 0).diffuse, Color(0.5, 0.5, 0));
  EXPECT_EQ(phongOf(scene, 0).shininess, 3);
  EXPECT_EQ(scene.objects.at(1).shape.as<Mesh>()->data->points[1], (Vec3f{2, 0, 0}));
  EXPECT_EQ(scene.choices.at(0).value, "5");
}

TEST(RayKeys, AtAKeyTheSceneIsTheOneWrittenWithoutKeys) {
  const auto scene = [](const std::string& x, const std::string& color) {
    return "translate(" + x + ", 0, 0, cylinder { material = { diffuse = " + color + "; } })";
  };
  const std::string keyed =
      scene("key(spline, (0, 0.1), (1, 0.7), (3, 0.2))", "key((0, (1,1,1)), (3, (0.1,0.2,0.3)))");
  Scene a = at(3, keyed), b = at(0, scene("0.2", "(0.1,0.2,0.3)"));
  for (Scene* s : {&a, &b}) s->objects[0].place = {};
  EXPECT_EQ(a, b);
}

TEST(RayKeys, ReadingWithoutATimeIsAtZero) {
  Messages messages;
  const std::string text = "SBT-raytracer 1.0 camera { fov = key((-1, 20), (1, 40)); }";
  EXPECT_EQ(readScene("test.ray", text, messages).camera.fov, 30);
  EXPECT_EQ(readScene("test.ray", text, messages, 0.5).camera.fov, 35);
}

TEST(RayKeys, WrongOnesAreToldWithTheirPlace) {
  const auto wrong = [](const std::string& key) { return errorsOf("camera { fov = " + key + "; }"); };
  EXPECT_NE(wrong("key()").find("2:16: expected key((time, value)"), std::string::npos) << wrong("key()");
  EXPECT_NE(wrong("key(0, 1)").find("2:20: key: expected (time, value), found 0"), std::string::npos);
  EXPECT_NE(wrong("key((0, 1), (0, 2))").find("2:29: key: expected a time after 0, found 0"),
            std::string::npos);
  EXPECT_NE(wrong("key((1, 1), (0, 2))").find("expected a time after 1"), std::string::npos);
  EXPECT_NE(wrong("key((0, 1, 2))").find("expected (time, value)"), std::string::npos);
  EXPECT_NE(wrong("key((0, a))").find("expected a number or a list of numbers, found \"a\""),
            std::string::npos);
  EXPECT_NE(wrong("key((0, key((0, 1))))").find("expected a number or a list of numbers"), std::string::npos);
  EXPECT_NE(wrong("key((0, 1), (1, (2, 3, 4)))").find("expected a value like the first one"),
            std::string::npos);
  EXPECT_NE(wrong("key(smoth, (0, 1))").find("did you mean \"smooth\"?"), std::string::npos);
  EXPECT_NE(wrong("key((0, 1), smooth)").find("expected (time, value), found \"smooth\""), std::string::npos);
  EXPECT_NE(wrong("key((0, (1, 2, 3)))").find("fov: expected a number, found key((0, (1, 2, 3)))"),
            std::string::npos);
}

TEST(RayKeys, WhatTraceChoosesStaysWhileTheSceneMoves) {
  const auto whole = [](const std::string& statements, Real time) {
    Messages messages;
    return readScene("test.ray", "Trace 1\n" + statements, messages, time);
  };
  const std::string ball = "plane { }\ntranslate(key((0, -3), (4, 3)), 1, 0) { sphere { } }\n";
  const Scene begin = whole(ball, 0);
  for (const Real time : {1.0, 4.0, 7.0}) {
    const Scene later = whole(ball, time);
    EXPECT_EQ(later.camera, begin.camera) << time;
    EXPECT_EQ(later.lights, begin.lights) << time;
    EXPECT_NE(later.objects, begin.objects) << time;
  }
  const Scene still = whole("plane { }\ntranslate(-3, 1, 0) { sphere { } }\n", 0);
  EXPECT_GT(length(begin.camera.position), 1.2 * length(still.camera.position)) << "it shows the whole way";

  const std::string sparks =
      "particles { rate = 50; lifetime = 3; velocity = (0, 4, 0); gravity = (0, -2, 0); size = 0.1 }\n";
  const Scene none = whole("", 0), spark = whole(sparks, 2);
  EXPECT_NE(spark.camera, none.camera) << "it shows what there is not yet at the start";
  EXPECT_EQ(whole(sparks, 1).camera, spark.camera);

  // A sun behind the shoulder of a camera that turns, and a lamp that comes nearer.
  const std::string turning =
      "sphere { }\ncamera { position = key((0, (0, 0, 9)), (2, (9, 0, 0))); look_at = (0, 0, 0) }\n";
  EXPECT_NE(whole(turning, 2).camera, whole(turning, 0).camera);
  EXPECT_EQ(whole(turning, 2).lights, whole(turning, 0).lights);
  const std::string nearing = "sphere { }\npoint_light { position = (0, 0, key((0, 8), (2, 4))) }\n";
  const auto colorAt = [&](Real time) {
    return whole(nearing, time).lights.at(0).light.as<PointLight>()->color;
  };
  EXPECT_EQ(colorAt(0), Color(64));
  EXPECT_EQ(colorAt(2), colorAt(0)) << "so it is four times as bright on the ball";
}

TEST(RayKeys, HugeValuesOverflowIntoAnError) {
  Messages messages;
  const std::string text = "SBT-raytracer 1.0 camera { fov = key((0, -1.7e308), (1, 1.7e308)); }";
  EXPECT_THROW(readScene("test.ray", text, messages, 0.5), Error);
}

TEST(RayKeys, TheWordIsFreeElsewhere) {
  EXPECT_EQ(load("sphere { name = key; }").scene.objects.at(0).name, "key");
  EXPECT_EQ(load("sphere { name = \"key\"; }").scene.objects.at(0).name, "key");
}

}  // namespace
}  // namespace trace::ray_keys_test
