// Pixels that stop sampling once they are good enough: --noise-target.
#include <gtest/gtest.h>

#include <thread>

#include "render/picture/explain.h"
#include "render/picture/passes.h"
#include "shading/lights/directional_light.h"
#include "support/scenes.h"

namespace trace::test::adaptive_test {
namespace {

class Adaptive : public testing::Test {
 protected:
  Adaptive() {
    Phong phong;
    phong.ambient = Color(0.2), phong.diffuse = Color(0.7);
    addObject(scene_, Sphere{}, Affine::translation({0, 0, -3}), phong);
    scene_.lights.push_back({DirectionalLight{.direction = {-1, -1, -2}, .color = Color(1)}, {}});
    settings_.width = 80, settings_.height = 60, settings_.spp = 64, settings_.noiseTarget = 0.002;
    settings_.passes.add(Pass::samples);
  }
  Film rendered(int threads) {
    Settings settings = settings_;
    settings.threads = threads;
    Film film = makeFilm(settings, settings.width, settings.height);
    Job job;
    EXPECT_EQ(render(build(scene_, settings), settings, film, job).end, End::finished);
    EXPECT_EQ(job.done, job.total);
    return film;
  }

  Scene scene_;
  Settings settings_;
};

TEST_F(Adaptive, TheSameBitsForAnyNumberOfThreads) {
  const Film one = rendered(1);
  for (const int threads : {2, 7}) {
    const Film more = rendered(threads);
    EXPECT_EQ(more.picture(), one.picture());
    EXPECT_EQ(more.layer(0), one.layer(0));
  }
}

TEST_F(Adaptive, NearlyThePictureOfAllSamplesWithAFewOfThem) {
  const Film few = rendered(2);
  double taken = 0;
  for (const Color& c : few.layer(0).pixels) taken += c.r;
  settings_.noiseTarget = 0;
  settings_.sampling = SampleKind::sobol;
  const Film all = rendered(2);
  for (const Color& c : all.layer(0).pixels) ASSERT_EQ(c, Color(64));
  const double pixels = settings_.width * settings_.height;
  EXPECT_LT(taken, 0.4 * 64 * pixels);
  const Picture a = few.picture(), b = all.picture();
  double off = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    off += std::abs(a.pixels[i].g - b.pixels[i].g) > 1.0 / 255;
  EXPECT_LE(off, 0.005 * pixels);
  EXPECT_GT(taken, 16 * pixels) << "the edge needs more than the fewest";
}

TEST_F(Adaptive, AnErrorIsAPartOfWhatShowsAsWhite) {
  const Picture usual = rendered(2).layer(0);
  settings_.exposure = 3;
  const Picture exposed = rendered(2).layer(0);
  EXPECT_NE(exposed, usual);
  settings_.exposure = 0;
  scene_.lights[0].light = DirectionalLight{.direction = {-1, -1, -2}, .color = Color(8)};
  EXPECT_EQ(rendered(2).layer(0), exposed) << "as many samples as with three stops more light";
}

TEST_F(Adaptive, GoesOnFromWhatWasSaved) {
  const World world = build(scene_, settings_);
  const Film whole = rendered(1);
  Film part = makeFilm(settings_, settings_.width, settings_.height);
  Settings few = settings_;
  few.threads = 1;
  Job job;
  // Stops in the midst: after two of six tiles of the first wave in which pixels can have settled.
  std::thread stopper([&] {
    while (job.done < 16 * part.tiles() + 8) std::this_thread::yield();
    job.cancel = true;
  });
  render(world, few, part, job);
  stopper.join();
  Film back = makeFilm(settings_, settings_.width, settings_.height);
  back.restore(part.saved());
  Job rest;
  render(world, settings_, back, rest);
  EXPECT_EQ(back.picture(), whole.picture());
  EXPECT_EQ(back.layer(0), whole.layer(0));
}

TEST_F(Adaptive, ARegionHasTheBitsOfTheWholePicture) {
  const Film whole = rendered(1);
  settings_.region = {20, 12, 41, 33};  // its rim crosses the edge of the ball and the corners of tiles
  const Film part = rendered(2);
  for (int y = 0; y < settings_.height; ++y)
    for (int x = 0; x < settings_.width; ++x) {
      const bool isIn = x >= 20 && x < 41 && y >= 12 && y < 33;
      ASSERT_EQ(part.picture().at(x, y), isIn ? whole.picture().at(x, y) : Color(0)) << x << ',' << y;
      ASSERT_EQ(part.layer(0).at(x, y), isIn ? whole.layer(0).at(x, y) : Color(0)) << x << ',' << y;
    }
}

TEST_F(Adaptive, APixelThatSeesNothingIsHeldBackByOneBesideItThatDoes) {
  const Film film = rendered(1);
  int held = 0;
  for (int x = 1; x + 1 < settings_.width; ++x) {
    const auto taken = [&](int at) { return film.layer(0).at(at, 30).r; };
    if (film.errors().at(x, 30).r > settings_.noiseTarget) {
      EXPECT_GT(taken(x - 1), 16) << x;
      EXPECT_GT(taken(x + 1), 16) << x;
    }
    held += taken(x) > 16 && film.errors().at(x, 30).r == 0;
  }
  EXPECT_GT(held, 0);
}

TEST_F(Adaptive, TheWorkThatIsLeftIsReckonedFromHowErrorsFall) {
  settings_.noiseTarget = 0.01;
  settings_.width = 32, settings_.height = 32, settings_.spp = 400;
  Film film(32, 32, 400, {}, 0.01);
  const auto add = [&](std::size_t wave) {
    TileSamples samples{.area = film.tile(0), .colors = {}, .layers = {}};
    const Wave w = film.waves()[wave];
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        if (!film.settled(x, y))
          for (int k = w.first; k < w.end; ++k)  // an error of a tenth of white by the root of their number
            samples.colors.push_back(Color(x < 16 ? 0.5 : 0.5 + (k % 2 == 0 ? 0.1 : -0.1)));
    film.add(0, wave, std::move(samples));
  };
  EXPECT_EQ(film.shareDone(), 0);
  for (std::size_t wave = 0; wave < 5; ++wave) add(wave);  // 16 samples
  EXPECT_NEAR(film.shareDone(), 32. / (16 + 100), 0.02) << "half of the pixels needs 16, half 100";
  for (std::size_t wave = 5; wave < 9; ++wave) add(wave);  // 80
  EXPECT_NEAR(film.shareDone(), (16 + 80.) / (16 + 100), 0.03);
  for (std::size_t wave = 9; wave < film.waves().size(); ++wave) add(wave);
  EXPECT_EQ(film.shareDone(), 1);
}

TEST_F(Adaptive, IsExplained) {
  const World world = build(scene_, settings_);
  const auto integrator = integratorOf(world, settings_);
  const Film film = rendered(2);
  const Size size{settings_.width, settings_.height};
  int settled = 0;
  for (int x = 0; x < size.width; x += 3) {
    const Explanation e = explain(world, *integrator, settings_, size, x, 30, 3);
    EXPECT_EQ(e.pixel, film.picture().at(x, 30)) << x;
    EXPECT_EQ(static_cast<double>(e.samples.size()), film.layer(0).at(x, 30).r);
    settled += e.settled;
  }
  EXPECT_GT(settled, 10);
  EXPECT_THROW(explain(world, *integrator, settings_, size, 1, 1, 63), Error) << "it has no such sample";
}

}  // namespace
}  // namespace trace::test::adaptive_test
