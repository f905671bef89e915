// Pixels that fall into squares where their corners differ: --subdivide.
#include <gtest/gtest.h>

#include <thread>

#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "render/picture/passes.h"
#include "render/samples/pixel.h"
#include "shading/lights/directional_light.h"
#include "support/scenes.h"

namespace trace::test::subdivide_test {
namespace {

class Subdivide : public testing::Test {
 protected:
  Subdivide() {
    Phong phong;
    phong.ambient = Color(0.2), phong.diffuse = {0.7, 0.5, 0.3};
    addObject(scene_, Sphere{}, Affine::translation({0, 0, -3}), phong);
    addObject(scene_, Square{}, Affine::translation({0, 0, -5}) * Affine::scaling({3.9, 3.7, 1}), phong);
    scene_.lights.push_back({DirectionalLight{.direction = {-1, -1, -2}, .color = Color(1)}, {}});
    settings_.width = 80, settings_.height = 60, settings_.subdivide = 3, settings_.subdivideThreshold = 0.02;
    settings_.passes.add(Pass::samples);
  }
  struct Rendered {
    Film film;
    Statistics statistics;
  };
  Rendered rendered(const Settings& settings) {
    Film film = makeFilm(settings, settings.width, settings.height);
    Job job;
    const RenderResult result = render(build(scene_, settings), settings, film, job);
    EXPECT_EQ(result.end, End::finished);
    EXPECT_EQ(job.done, job.total);
    return {std::move(film), result.statistics};
  }
  static double raysOf(const Statistics& s) { return double(s.rays[std::size_t(RayKind::camera)]); }
  static double sumOf(const Picture& map) {
    double sum = 0;
    for (const Color& c : map.pixels) sum += c.r;
    return sum;
  }
  /// Every corner of the smallest squares, whatever it sees.
  Picture full() {
    const World world = build(scene_, settings_);
    const auto integrator = integratorOf(world, settings_);
    const Size size{settings_.width, settings_.height};
    Subdivision rules = subdivisionOf(settings_, size);
    rules.threshold = -1;
    PixelTracer tracer(world, *integrator, settings_, size);
    Picture picture(size.width, size.height);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        std::map<std::pair<int, int>, Color> seen;
        const auto colors = [&](Corner c) -> const Color& {
          const auto [at, isNew] = seen.try_emplace({c.x, c.y});
          if (isNew) at->second = tracer.corner({x, y, c}, [](const CameraRay&, const Sampler&) {});
          return at->second;
        };
        picture.at(x, y) = meanOver(rules, rules.depth, colors, colors);
      }
    return picture;
  }

  Scene scene_;
  Settings settings_;
};

TEST_F(Subdivide, TheSameBitsForAnyNumberOfThreads) {
  settings_.threads = 1;
  const Rendered one = rendered(settings_);
  for (const int threads : {2, 7}) {
    settings_.threads = threads;
    const Rendered more = rendered(settings_);
    EXPECT_EQ(more.film.picture(), one.film.picture());
    EXPECT_EQ(more.film.layer(0), one.film.layer(0));
    EXPECT_EQ(more.statistics, one.statistics);
  }
}

TEST_F(Subdivide, NothingButBackgroundCostsOneRayForEachCorner) {
  scene_.objects.clear();
  const Rendered r = rendered(settings_);
  EXPECT_EQ(raysOf(r.statistics), 81 * 61);
  EXPECT_EQ(r.film.layer(0).at(5, 40), Color(1));
  EXPECT_EQ(r.film.layer(0).at(79, 0), Color(4)) << "its own, and those of the rim";
}

// checks.md, E5.
TEST_F(Subdivide, NearlyThePictureOfAllCornersWithAFewOfThem) {
  const Rendered few = rendered(settings_);
  const Picture a = few.film.picture(), b = full();
  const double pixels = settings_.width * settings_.height;
  EXPECT_LT(raysOf(few.statistics), 0.4 * 64 * pixels);
  double off = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    off += std::abs(a.pixels[i].g - b.pixels[i].g) > 1.0 / 255;
  EXPECT_LE(off, 0.005 * pixels);
  EXPECT_GT(raysOf(few.statistics), 1.5 * pixels) << "the edges need more";
}

TEST_F(Subdivide, TheMapCountsEveryCameraRayOnce) {
  for (const Region& region : {Region{}, Region{10, 20, 50, 41}})
    for (const Stereo stereo : {Stereo::off, Stereo::sideBySide, Stereo::overUnder}) {
      settings_.region = region, settings_.stereo = stereo;
      const Rendered r = rendered(settings_);
      EXPECT_EQ(sumOf(r.film.layer(0)), raysOf(r.statistics));
      EXPECT_EQ(r.film.sampleCounts(), r.film.layer(0));
    }
}

TEST_F(Subdivide, ARegionIsAPartOfThePicture) {
  const Picture whole = rendered(settings_).film.picture();
  settings_.region = {10, 20, 50, 41};
  const Picture part = rendered(settings_).film.picture();
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const bool inside = x >= 10 && x < 50 && y >= 20 && y < 41;
      ASSERT_EQ(part.at(x, y), inside ? whole.at(x, y) : Color(0)) << x << " " << y;
    }
}

TEST_F(Subdivide, PassesAreTheMeanOfTheirSquares) {
  settings_.passes.add(Pass::normal);
  const Rendered r = rendered(settings_);
  const Picture normal = r.film.layer(0);
  EXPECT_EQ(normal.at(10, 30), Color(0, 0, 1)) << "of the wall";
  const Settings plain{.width = 80, .height = 60, .spp = 64, .passes = settings_.passes};
  const Picture same = rendered(plain).film.layer(0);
  double apart = 0;
  for (std::size_t i = 0; i < same.pixels.size(); ++i)
    apart += std::abs(same.pixels[i].b - normal.pixels[i].b);
  EXPECT_LT(apart / 4800, 0.012);
}

TEST_F(Subdivide, GoesOnFromWhatWasSaved) {
  const World world = build(scene_, settings_);
  const Rendered whole = rendered(settings_);
  Film part = makeFilm(settings_, settings_.width, settings_.height);
  Settings few = settings_;
  few.threads = 1;
  Job job;
  std::thread stopper([&] {  // in the midst of the second level
    while (job.done < part.tiles() + 2) std::this_thread::yield();
    job.cancel = true;
  });
  render(world, few, part, job);
  stopper.join();
  EXPECT_EQ(part.picture().width, 80) << "what is there can be looked at";
  Film back = makeFilm(settings_, settings_.width, settings_.height);
  back.restore(part.saved());
  EXPECT_EQ(back.picture(), part.picture());
  Job rest;
  render(world, settings_, back, rest);
  EXPECT_EQ(back.picture(), whole.film.picture());
  EXPECT_EQ(back.layer(0), whole.film.layer(0));
}

TEST_F(Subdivide, IsExplained) {
  for (const Stereo stereo : {Stereo::off, Stereo::sideBySide}) {
    settings_.stereo = stereo;
    const World world = build(scene_, settings_);
    const auto integrator = integratorOf(world, settings_);
    const Picture picture = rendered(settings_).film.picture();
    const Size size{settings_.width, settings_.height};
    std::size_t most = 0;
    for (int x = 0; x < size.width; ++x) {
      const Explanation e = explain(world, *integrator, settings_, size, x, 30, 3);
      EXPECT_EQ(e.pixel, picture.at(x, 30)) << x;
      EXPECT_EQ(e.tree.nodes[0].radiance, e.samples[3]) << x;
      EXPECT_EQ(e.corners[0], (Vec2{0, 0}));
      EXPECT_EQ(e.corners[3], (Vec2{1, 1})) << "the pixel's own come first";
      Real sum = 0;
      for (const Real weight : e.weights) sum += weight;
      EXPECT_NEAR(sum, static_cast<Real>(e.samples.size()), 1e-9);
      most = std::max(most, e.samples.size());
    }
    EXPECT_GT(most, 20u);
    EXPECT_THROW(explain(world, *integrator, settings_, size, 1, 1, 80), Error) << "it has no such corner";
  }
}

// A disk of radius 0.3 of the picture (checks.md, E5), and an edge that crosses pixels at an angle.
TEST(SubdivideShapes, CoversWhatADiskCovers) {
  Scene scene;
  Phong white;
  white.emissive = Color(1);
  addObject(scene, Sphere{}, Affine::translation({0, 0, -1000}) * Affine::scaling(Vec3{1, 1, 1} * 300),
            white);
  Settings settings{.width = 64, .height = 64, .subdivide = 4, .projection = Projection::orthographic};
  settings.viewHeight = 1000;
  const Picture picture = trace::test::picture(scene, settings);
  double sum = 0;
  for (const Color& c : picture.pixels) sum += c.g;
  EXPECT_NEAR(sum / (64 * 64), 0.282743, 2e-4);
  for (int x = 1; x < 32; ++x)
    EXPECT_GE(picture.at(x, 31).g, picture.at(x - 1, 31).g) << "the ramp of an edge does not go back";
}

}  // namespace
}  // namespace trace::test::subdivide_test
