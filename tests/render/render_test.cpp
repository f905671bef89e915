// Properties of whole pictures.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/passes.h"
#include "render/samples/integrator.h"
#include "support/rooms.h"
#include "support/scenes.h"

namespace trace::test::render_test {
namespace {

bool sameBits(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Color)) == 0;
}

TEST(Render, SameBitsAndCountsForAnyNumberOfThreads) {
  Random random(1);
  const Scene scene = randomScene(random, 20);
  Settings settings{.width = 66, .spp = 4, .depth = 4, .threads = 1};
  Statistics one;
  const Picture reference = picture(scene, settings, &one);
  for (int threads : {2, 7}) {
    settings.threads = threads;
    Statistics counts;
    EXPECT_TRUE(sameBits(reference, picture(scene, settings, &counts))) << threads;
    EXPECT_EQ(one, counts);
  }
}

/// Rendered by a wave of a tile at a time, as a window without threads does.
Picture pictureInParts(const Scene& scene, const Settings& settings, RenderResult& result, int& parts) {
  const World world = build(scene, settings);
  const Size size = pictureSize(settings, scene.camera);
  Film film = makeFilm(settings, size.width, size.height);
  Job job;
  const auto integrator = makeIntegrator(world, settings, job);
  const std::array moments{Moment{&world, integrator.get()}};
  RenderInParts render(moments, settings, film, job);
  std::optional<RenderResult> end;
  double fraction = 0;
  for (parts = 1; !(end = render.next(0)); ++parts) {
    EXPECT_GE(job.fraction(), fraction) << "it goes forward";
    fraction = job.fraction();
  }
  result = *end;
  EXPECT_EQ(job.fraction(), 1);
  return film.picture();
}

TEST(Render, SameBitsAndCountsInParts) {
  Scene scene = openRoom();
  Phong glass;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::scaling({0.4, 0.4, 0.4}), glass);
  const Settings plain{.width = 70, .spp = 4, .depth = 3, .threads = 1};
  const std::vector<std::pair<const char*, std::function<void(Settings&)>>> ways{
      {"plain", [](Settings&) {}},
      {"noise target",
       [](Settings& s) { s.integrator = IntegratorKind::path, s.spp = 40, s.noiseTarget = 0.1; }},
      {"subdivide", [](Settings& s) { s.spp = 1, s.subdivide = 2; }},
      {"light from lights", [](Settings& s) { s.integrator = IntegratorKind::bdpt; }},
      {"chains", [](Settings& s) { s.integrator = IntegratorKind::mlt; }},
  };
  for (const auto& [name, change] : ways) {
    Settings settings = plain;
    change(settings);
    Statistics whole;
    const Picture reference = picture(scene, settings, &whole);
    RenderResult result;
    int parts = 0;
    EXPECT_TRUE(sameBits(reference, pictureInParts(scene, settings, result, parts))) << name;
    EXPECT_EQ(result.statistics, whole) << name;
    EXPECT_EQ(result.end, End::finished) << name;
    EXPECT_GT(parts, 5) << name;
  }
}

TEST(Render, SameBitsWithAndWithoutHierarchy) {
  Random random(2);
  for (int s = 0; s < 5; ++s) {
    const Scene scene = randomScene(random, 15);
    Settings settings{.width = 80, .depth = 4};
    const Picture fast = picture(scene, settings);
    settings.accel = Accel::none;
    EXPECT_TRUE(sameBits(fast, picture(scene, settings)));
  }
}

TEST(Render, ScaleLeavesThePictureAlike) {
  const auto scaled = [](double scale) {
    Random random(3);
    return picture(randomScene(random, 20, scale), {.width = 40, .depth = 4});
  };
  const Picture unit = scaled(1);
  // Rounding may decide a silhouette differently; powers of ten are not exact in binary.
  for (double scale : {1e-4, 1e-2, 1e3, 1e6})
    EXPECT_LE(compareLevels(unit, scaled(scale)).beyondOne, 4) << scale;
  EXPECT_LE(compareLevels(unit, scaled(1024)).beyondOne, 1) << "powers of two are";
}

TEST(Render, BoxFilteredDisk) {
  // A glowing sphere whose outline is a circle of radius 0.3 of the picture: mean coverage 0.282743.
  Scene scene;
  Phong glow;
  glow.emissive = Color(1);
  scene.camera.position = {0, 0, 5};
  const Real tangent = 0.3;  // at distance 1 the picture is 1 high: radius 0.3 there
  const Real radius = 5 * std::sin(std::atan(tangent));
  addObject(scene, Sphere{}, Affine::scaling({radius, radius, radius}), glow);
  const Picture p = picture(scene, {.width = 200, .spp = 16});
  double sum = 0;
  for (const Color& c : p.pixels) sum += c.r;
  EXPECT_NEAR(sum / static_cast<double>(p.pixels.size()), 0.282743, 2e-4);
}

TEST(Render, PixelPositionsAreCornersOrCentres) {
  // A square that fills exactly the right half of the picture.
  Scene scene;
  Phong glow;
  glow.emissive = Color(1);
  addObject(scene, Square{}, Affine::translation({0.5, 0, -1}) * Affine::scaling({1, 2, 1}), glow);
  for (PixelPosition position : {PixelPosition::corner, PixelPosition::center}) {
    const Picture p = picture(scene, {.width = 10, .pixelPosition = position});
    EXPECT_EQ(p.at(4, 5).r, 0);
    EXPECT_EQ(p.at(5, 5).r, 1);  // the corner of column width / 2 lies exactly on the axis
  }
  // Row 0 is the top: look at the upper half only.
  Scene upper;
  addObject(upper, Square{}, Affine::translation({0, 0.5, -1}) * Affine::scaling({2, 1, 1}), glow);
  const Picture p = picture(upper, {.width = 10, .pixelPosition = PixelPosition::center});
  EXPECT_EQ(p.at(5, 0).r, 1);
  EXPECT_EQ(p.at(5, 9).r, 0);
}

TEST(Render, RegionIsTheSamePixelsAndBlackElsewhere) {
  Random random(5);
  const Scene scene = randomScene(random, 15);
  Settings settings{.width = 45};
  const Picture whole = picture(scene, settings);
  settings.region = {5, 10, 25, 30};
  const Picture part = picture(scene, settings);
  for (int y = 0; y < whole.height; ++y)
    for (int x = 0; x < whole.width; ++x) {
      const bool inside = x >= 5 && x < 25 && y >= 10 && y < 30;
      EXPECT_EQ(part.at(x, y), inside ? whole.at(x, y) : Color(0));
    }
}

TEST(Render, HeightFollowsTheAspectRatio) {
  Camera camera;
  camera.aspectratio = 1.9;
  EXPECT_EQ(pictureSize({.width = 400}, camera).height, 211);  // floor(400 / 1.9 + 0.5)
  EXPECT_EQ(pictureSize({.width = 400, .height = 7}, camera).height, 7);
  camera.aspectratio = 1e9;
  EXPECT_EQ(pictureSize({.width = 400}, camera).height, 1);
  camera.aspectratio = 1e-9;
  EXPECT_THROW(pictureSize({.width = 400}, camera), Error);
}

TEST(Render, BadSamplesAreDroppedCountedAndFound) {
  Scene scene;
  Phong bad;
  bad.emissive = Color(std::numeric_limits<double>::quiet_NaN());
  addObject(scene, Square{}, Affine::translation({0.5, 0, -1}) * Affine::scaling({1, 2, 1}), bad);
  const World world = build(scene);
  const Settings settings{.width = 10};
  Film film(10, 10);
  Job job;
  const RenderResult result = render(world, settings, film, job);
  EXPECT_EQ(result.statistics.badSamples, 50u);
  ASSERT_EQ(result.badSamples.size(), 50u);
  EXPECT_EQ(result.badSamples[0], (BadSample{5, 0, 0}));
  for (const Color& c : film.picture().pixels) EXPECT_EQ(c, Color(0));
}

TEST(Render, DoesNotWaitForATileThatTakesTooLong) {
  Phong glass;
  glass.reflective = glass.transmissive = Color(1);
  Scene scene;  // of two panes, which split each ray sixty times: years of work
  scene.camera.position = {0, 0, 9};
  for (const Real z : {0.0, -2.0})
    addObject(scene, Cube{}, Affine::translation({0, 0, z}) * Affine::scaling({99, 99, 1}), glass);
  Film film(8, 8);
  Job job;
  job.patience = {};
  const Settings settings{.width = 8, .depth = 60, .timeLimit = 0.01};
  EXPECT_EQ(render(build(scene), settings, film, job).end, End::timeLimit);
  EXPECT_EQ(job.done, 0);
}

TEST(Render, LooksAtTheTimeInEachTile) {  // a thousand rays can take long, as without a hierarchy
  Film film(64, 64);
  Job job;
  const Settings settings{.width = 64, .threads = 1, .timeLimit = 1e-9};
  EXPECT_EQ(render(build(Scene()), settings, film, job).end, End::timeLimit);
  EXPECT_EQ(job.done, 1);
}

TEST(Render, StopsWhenCancelledOrOutOfTime) {
  Random random(6);
  const Scene scene = randomScene(random, 30);
  const World world = build(scene);
  {
    Film film(400, 400);
    Job job;
    job.cancel = true;
    EXPECT_EQ(render(world, {.width = 400}, film, job).end, End::cancelled);
  }
  {
    Film film(4000, 4000, 100);
    Job job;
    const RenderResult result = render(world, {.width = 4000, .spp = 100, .timeLimit = 0.05}, film, job);
    EXPECT_EQ(result.end, End::timeLimit);
    EXPECT_GT(job.done, 0);
    EXPECT_LT(job.fraction(), 1);
  }
}

TEST(Render, SameBitsForAnySizeOfTiles) {
  Random random(8);
  const World world = build(randomScene(random, 15));
  const Settings settings = {.width = 45, .height = 45, .spp = 4};
  Film large(45, 45, 4), small(45, 45, 4, {}, 2);
  Job one, other;
  render(world, settings, large, one);
  render(world, settings, small, other);
  EXPECT_TRUE(small.complete());
  EXPECT_TRUE(sameBits(large.picture(), small.picture()));
}

TEST(Render, SupersampledPictureIsTheMeanOfTheGrid) {
  // 2 x 2 rays per pixel are the corner rays of a picture of twice the size.
  Random random(7);
  const Scene scene = randomScene(random, 15);
  const Picture fine = picture(scene, {.width = 80}), coarse = picture(scene, {.width = 40, .spp = 4});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const Color mean = (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) + fine.at(2 * x, 2 * y + 1) +
                          fine.at(2 * x + 1, 2 * y + 1)) /
                         4;
      EXPECT_NEAR(coarse.at(x, y).r, mean.r, 1e-12);
    }
}

TEST(Integrators, EveryChoiceHasItsRow) {
  const auto names = findOption("integrator").choices;
  ASSERT_EQ(integrators().size(), names.size());
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(integrators()[i].name, names[i]);
    EXPECT_EQ(static_cast<size_t>(integrators()[i].kind), i);
  }
}

}  // namespace
}  // namespace trace::test::render_test
