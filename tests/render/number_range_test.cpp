// What is too far away, too large or too small for its lengths to be squared is left out, with a warning; the
// rest of the picture is as if it had never been there.
#include "render/world/number_range.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/plane.h"
#include "shading/light_list.h"
#include "support/lights.h"
#include "support/rooms.h"
#include "support/shapes.h"

namespace trace::test::number_range_test {
namespace {

constexpr Real kBad[] = {1e76, 1e150, 1e200, 1e300, 1e-76, 1e-150, 1e-200, 1e-300};

/// A ball on a floor under a sky, with a ball of glass, a lamp and a light.
Scene scene() {
  Scene scene;
  addObject(scene, Square{}, turned({1, 0, 0}, -0.5) * scaled(10), diffuse(0.7));
  addObject(scene, Sphere{}, Affine::translation({0, 1, 0}), diffuse({0.7, 0.3, 0.3}));
  Phong glass;
  glass.transmissive = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0, 0.5, 1.6}) * scaled(0.5), glass);
  addObject(scene, Square{}, Affine::translation({2, 3, 0}) * turned({1, 0, 0}, 0.5), diffuse(0, 5));
  scene.lights.push_back({PointLight{.position = {-3, 4, 2}, .color = Color(1)}, {}});
  scene.background.gradient = {{Color(0.1), Color(0.9, 0.9, 1)}};
  scene.camera.position = {0, 1, 6}, scene.camera.fov = 40;
  return scene;
}

Settings settingsOf(IntegratorKind integrator) {
  Settings settings;
  settings.integrator = integrator;
  settings.width = settings.height = 8;
  settings.spp = 1, settings.depth = 4;
  settings.photons = 2000, settings.chainStarts = 500, settings.occlusionReach = 0;
  settings.threads = 1;
  return settings;
}

std::string warningsOf(const Scene& scene) {
  Messages messages;
  compile(scene, {}, messages);
  std::string all;
  for (const Message& m : messages.all()) all += toString(m);
  return all;
}

/// That object is left out of it, and nothing else changes.
void expectLeftOut(Scene with, const Scene& without, const std::string& what,
                   std::initializer_list<IntegratorKind> kinds = {
                       IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::photon}) {
  EXPECT_NE(warningsOf(with).find(what + " is left out: its numbers"), std::string::npos) << warningsOf(with);
  for (const IntegratorKind kind : kinds)
    EXPECT_EQ(picture(with, settingsOf(kind)), picture(without, settingsOf(kind)));
}

TEST(NumberRange, ABallFarAwayLeavesTheSkyItsPhotons) {
  Scene far = scene();
  addObject(far, Sphere{}, Affine::translation({1e200, 0, 0}), diffuse(0.5));
  for (const IntegratorRow& row : integrators())
    EXPECT_EQ(picture(far, settingsOf(row.kind)), picture(scene(), settingsOf(row.kind))) << row.name;
}

TEST(NumberRange, ObjectsOfEveryShapeAreLeftOut) {
  const Scene rest = scene();
  const World without = build(rest);
  Scene all = rest;
  for (const ShapeType& type : shapeTypes()) {
    Shape shape = typical(type);
    Random random(3);
    if (type.keyword == Mesh::kKeyword) shape = Mesh{ballMesh(4, random)};
    for (const Real bad : kBad) {
      SCOPED_TRACE(std::string(type.keyword) + " " + std::to_string(std::log10(bad)));
      for (const Affine& place : {scaled(bad), Affine::translation({0, -bad, 0})}) {
        if (bad < 1 && place == Affine::translation({0, -bad, 0})) continue;  // that is beside the origin
        Scene with = rest;
        addObject(with, shape, place, diffuse(0.5, 1));
        EXPECT_NE(warningsOf(with).find("this object is left out: its numbers"), std::string::npos);
        EXPECT_EQ(build(with).bounds(), without.bounds());
        if (bad != 1e200) continue;
        all.objects.push_back(with.objects.back());
        all.objects.back().material = 0;
      }
    }
  }
  expectLeftOut(all, rest, "this object");
}

TEST(NumberRange, MeshesAreLeftOut) {
  Scene with = scene();
  MeshData data;
  data.points = {{0, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}};
  data.triangles = {{0, 1, 2}};
  addObject(with, Mesh{std::make_shared<MeshData>(data)}, scaled(1e40), diffuse(0.5, 1));
  expectLeftOut(with, scene(), "this object");
}

TEST(NumberRange, LightsOfEveryKindAreLeftOut) {
  forEachType<LightList>([&]<class Kind>(Kind*) {
    forEachField<Kind>([&](const auto& field) {
      for (const Real bad : kBad) {
        if (field.keyword == "position" && bad < 1) continue;
        Kind light;
        if constexpr (requires { light.color; }) light.color = Color(1);
        auto& value = light.*field.member;
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Vec3>)
          value = {0, bad, 0};
        else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Real>) {
          if (field.keyword != "radius") continue;
          value = bad;
        } else {
          continue;
        }
        SCOPED_TRACE(std::string(Kind::kKeyword) + "." + std::string(field.keyword) + " " +
                     std::to_string(std::log10(bad)));
        Scene with = scene();
        with.lights.push_back({light, SourcePlace{.file = "a.ray", .line = 3, .column = 7}});
        expectLeftOut(with, scene(), "a.ray:3:7: warning: this light", {IntegratorKind::whitted});
      }
    });
  });
}

TEST(NumberRange, OneWarningCountsThem) {
  Scene with = scene();
  for (int i = 0; i < 3; ++i) addObject(with, Sphere{}, Affine::translation({0, 1e99, 0}), diffuse(0.5));
  EXPECT_NE(warningsOf(with).find("(the first of 3)"), std::string::npos);
  with.objects.resize(with.objects.size() - 2);
  EXPECT_EQ(warningsOf(with).find("the first"), std::string::npos);
}

TEST(NumberRange, CamerasThatCannotLookAreRefused) {
  for (const Real bad : kBad) {
    for (int field = 0; field < 3; ++field) {
      Scene with = scene();
      Vec3& value = field == 0 ? with.camera.position : field == 1 ? with.camera.viewdir : with.camera.updir;
      if (field == 0 && bad < 1) continue;
      value = field == 1 ? Vec3{0, 0, -bad} : Vec3{0, bad, 0};
      EXPECT_THROW(build(with), Error) << field << " " << bad;
    }
  }
}

TEST(NumberRange, MediaThatAreTooDenseAreLeftOut) {
  for (const Real bad : {1e76, 1e200, 1e300}) {
    Scene with = scene();
    addCloud(with, Sphere{}, Affine::translation({0, 1, 3}), bad);
    expectLeftOut(with, scene(), "this object");
  }
}

TEST(NumberRange, WhatIsInRangeIsTraced) {
  for (const Real size : {1e70, 1e-70}) {
    Scene scaled = scene();
    const Affine change = Affine::scaling({size, size, size});
    for (Object& object : scaled.objects) object.worldFromObject = change * object.worldFromObject;
    scaled.camera.position = scaled.camera.position * size;
    scaled.lights.clear();
    EXPECT_EQ(warningsOf(scaled), "");
    Scene usual = scene();
    usual.lights.clear();
    for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::photon}) {
      Settings settings = settingsOf(kind);
      settings.spp = 16, settings.photons = 20000;
      EXPECT_NEAR(mean(picture(scaled, settings)) / mean(picture(usual, settings)), 1, 0.02) << size;
    }
  }
}

}  // namespace
}  // namespace trace::test::number_range_test
