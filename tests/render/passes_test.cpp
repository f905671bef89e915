// What passes measure, against places and distances known by hand.
#include "render/picture/passes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "scene/options.h"
#include "support/scenes.h"

namespace trace::test::passes_test {
namespace {

/// A wall at z = -4 that fills the left half of the picture, nothing on the right; object 2 of two.
Scene wallOnTheLeft() {
  Scene scene;
  addObject(scene, Sphere{}, Affine::translation({0, 0, 50}), Phong{});
  addObject(scene, Square{}, Affine::translation({-4, 0, -4}) * Affine::scaling({8, 8, 1}), Phong{});
  scene.camera.fov = 90;  // the picture at z = -4 reaches from -4 to 4
  return scene;
}

Settings asking(EnumSet<Pass> passes) {
  Settings settings{.width = 8, .height = 8};
  settings.pixelPosition = PixelPosition::center;
  settings.passes = passes;
  return settings;
}

std::vector<Picture> layers(const Scene& scene, const Settings& settings) {
  const World world = build(scene, settings);
  Film film = makeFilm(settings, settings.width, settings.height);
  Job job;
  render(world, settings, film, job);
  std::vector<Picture> all;
  for (std::size_t i = 0; i < film.layers(); ++i) all.push_back(film.layer(i));
  return all;
}

Picture layer(const Scene& scene, const Settings& settings) { return layers(scene, settings).front(); }

TEST(Passes, RowsAreThoseOfTheOption) {
  const Option& option = findOption("passes");
  ASSERT_EQ(passRows().size(), option.choices.size());
  for (std::size_t i = 0; i < passRows().size(); ++i) {
    EXPECT_EQ(passRows()[i].name, option.choices[i]);
    EXPECT_EQ(static_cast<std::size_t>(passRows()[i].pass), i);
  }
}

TEST(Passes, ChangeNothingInThePicture) {
  Random random(1);
  const Scene scene = randomScene(random, 15);
  Settings settings{.width = 60, .spp = 4};
  const Picture plain = picture(scene, settings);
  for (const PassRow& row : passRows()) settings.passes.add(row.pass);
  Film film = makeFilm(settings, plain.width, plain.height);
  const World world = build(scene, settings);
  Job job;
  render(world, settings, film, job);
  EXPECT_EQ(film.picture(), plain);
}

// Whoever wants the picture alone gives a film of that: a layer that is not there must never be written.
TEST(Passes, AreMadeOnlyInAFilmThatHasALayerForEach) {
  const Scene scene = wallOnTheLeft();
  Settings settings = asking({});
  const Picture plain = picture(scene, settings);
  for (const PassRow& row : passRows()) settings.passes.add(row.pass);
  const World world = build(scene, settings);
  for (std::size_t count = 0; count < layersOf(settings).size(); ++count) {
    const std::vector<Film::LayerKind> kinds(count, {Color(0.5)});
    Film film(settings.width, settings.height, 1, kinds);
    Job job;
    EXPECT_EQ(render(world, settings, film, job).end, End::finished);
    EXPECT_EQ(film.picture(), plain);
    ASSERT_EQ(film.layers(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(film.layer(i).at(0, 0), Color(0.5));
  }
}

TEST(Passes, SameBitsForAnyNumberOfThreadsAndWithoutHierarchy) {
  Random random(2);
  const Scene scene = randomScene(random, 15);
  Settings settings{.width = 70, .height = 70, .spp = 4, .threads = 1};
  for (const PassRow& row : passRows()) settings.passes.add(row.pass);
  const std::vector<Picture> one = layers(scene, settings);
  const auto expectSame = [&](const Settings& other) {
    const std::vector<Picture> again = layers(scene, other);
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_EQ(
          std::memcmp(one[i].pixels.data(), again[i].pixels.data(), one[i].pixels.size() * sizeof(Color)), 0)
          << passRows()[i].name;
  };
  for (int threads : {2, 7}) settings.threads = threads, expectSame(settings);
  settings.accel = Accel::none, expectSame(settings);
}

TEST(Passes, DepthIsAlongTheViewOrTheRay) {
  Settings settings = asking({Pass::depth});
  const Picture along = layer(wallOnTheLeft(), settings);
  settings.passDepth = PassDepth::ray;
  const Picture ray = layer(wallOnTheLeft(), settings);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      if (x >= 4) {
        EXPECT_EQ(along.at(x, y), Color(kInfinity));
        EXPECT_EQ(ray.at(x, y), Color(kInfinity));
        continue;
      }
      EXPECT_NEAR(along.at(x, y).r, 4, 1e-12);
      const Vec3 place{x + 0.5 - 4, y + 0.5 - 4, -4};
      EXPECT_NEAR(ray.at(x, y).r, length(place), 1e-12);
    }
}

TEST(Passes, DepthIsMeasuredAlongTheViewInEveryCameraFrame) {
  for (CameraAxes axes : {CameraAxes::orthonormal, CameraAxes::raw, CameraAxes::normalized}) {
    Scene scene = wallOnTheLeft();
    scene.camera.viewdir = {0, 0, -3};
    scene.camera.updir = {0, 1, -0.5};
    Settings settings = asking({Pass::depth});
    settings.cameraAxes = axes;
    const Picture picture = layer(scene, settings);
    EXPECT_NEAR(picture.at(1, 4).r, 4, 1e-12);
  }
}

TEST(Passes, DepthIsShownFromTheNearestToTheFarthestOrAsTold) {
  const PassRow& depth = passRows()[0];
  Picture values(4, 1);
  values.pixels = {Color(2), Color(3), Color(4), Color(kInfinity)};
  const auto shown = [&](const Settings& settings) {
    std::vector<double> grey;
    for (const Color& c : depth.shown(values, settings).pixels) grey.push_back(c.r);
    return grey;
  };
  EXPECT_EQ(shown({}), (std::vector<double>{0, 0.5, 1, 1}));
  Settings settings;
  settings.passFar = 4;
  EXPECT_EQ(shown(settings), (std::vector<double>{0.5, 0.75, 1, 1}));
  settings.passNear = 3;
  EXPECT_EQ(shown(settings), (std::vector<double>{0, 0, 1, 1}));
  settings.passNear = 0, settings.passFar = 8;
  EXPECT_EQ(shown(settings), (std::vector<double>{0.25, 0.375, 0.5, 1}));
  settings.tone = Tone::stretch;  // the nearest that is seen becomes black, a background stays white
  EXPECT_EQ(shown(settings), (std::vector<double>{0, (0.375 - 0.25) / 0.75, (0.5 - 0.25) / 0.75, 1}));
}

TEST(Passes, WhatIsTooNearIsBlackAndWhatIsTooFarIsBackground) {
  Scene scene = wallOnTheLeft();
  Settings settings = asking({Pass::depth, Pass::id});
  for (const bool nearer : {true, false}) {
    scene.camera.near = nearer ? 4.5 : 0, scene.camera.far = nearer ? kInfinity : 4.5;
    const std::vector<Picture> all = layers(scene, settings);
    const Picture shown = passRows()[0].shown(all[0], settings);
    int seen = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Real distance = length({x + 0.5 - 4, y + 0.5 - 4, -4});
        const bool cut = x < 4 && !(nearer ? distance >= 4.5 : distance <= 4.5);
        if (cut) {
          EXPECT_EQ(all[0].at(x, y), Color(nearer ? 0 : kInfinity));
        }
        EXPECT_EQ(all[1].at(x, y), Color(x < 4 && !cut ? 2 : 0));
        if (cut || x >= 4) {
          EXPECT_EQ(shown.at(x, y), Color(cut && nearer ? 0 : 1));
        }
        seen += x < 4 && !cut;
      }
    EXPECT_GT(seen, 4);
  }
  Picture values(3, 1);
  values.pixels = {Color(0), Color(2), Color(4)};
  const Picture shown = passRows()[0].shown(values, {});
  EXPECT_EQ(shown.pixels, (std::vector<Color>{Color(0), Color(0), Color(1)}));
}

TEST(Passes, NormalsAreAveragedAndNothingElseIs) {
  // Of 4 x 4 samples in the one pixel, the left half meet the wall; the first does, too.
  Settings settings = asking({Pass::depth, Pass::normal, Pass::id, Pass::uv, Pass::position});
  settings.width = settings.height = 1;
  settings.spp = 16;
  const std::vector<Picture> all = layers(wallOnTheLeft(), settings);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_NEAR(all[0].at(0, 0).r, 4, 1e-12);
  EXPECT_EQ(all[1].at(0, 0), Color(0, 0, 0.5));
  EXPECT_EQ(all[2].at(0, 0), Color(2));
  EXPECT_NEAR(all[4].at(0, 0).r, -3, 1e-12);
  EXPECT_NEAR(all[4].at(0, 0).g, -3, 1e-12);
  EXPECT_EQ(all[4].at(0, 0).b, -4);
}

TEST(Passes, AreBackgroundOutsideTheRegion) {
  Settings settings = asking({Pass::depth, Pass::id});
  settings.region = {2, 2, 4, 4};
  const std::vector<Picture> all = layers(wallOnTheLeft(), settings);
  EXPECT_EQ(all[0].at(1, 2), Color(kInfinity));
  EXPECT_EQ(all[1].at(1, 2), Color(0));
  EXPECT_EQ(all[1].at(2, 2), Color(2));
}

TEST(Passes, AreShownFromZeroToOne) {
  Random random(3);
  const Scene scene = randomScene(random, 15);
  Settings settings{.width = 40, .height = 40};
  for (const PassRow& row : passRows()) settings.passes.add(row.pass);
  const std::vector<Picture> all = layers(scene, settings);
  const std::vector<const PassRow*> rows = layersOf(settings);
  ASSERT_EQ(rows.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ValueRange range = finiteRange(rows[i]->shown(all[i], settings));
    EXPECT_GE(range.low, 0) << rows[i]->name;
    EXPECT_LE(range.high, 1) << rows[i]->name;
    // All pixels have one sample, and without names and motion there is nothing to see.
    constexpr EnumSet<Pass> kEven{Pass::samples, Pass::object, Pass::material, Pass::motion};
    if (kEven.has(rows[i]->pass)) continue;
    EXPECT_GT(range.high - range.low, 0.1) << rows[i]->name;
  }
}

}  // namespace
}  // namespace trace::test::passes_test
