// What can be seen of a film while it is being made.
#include "image/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace trace {
namespace {

/// The same colour for every sample of a tile in a wave, and for its layers.
TileSamples uniform(const Film& film, std::int64_t tile, std::size_t wave, const Color& color) {
  const Tile area = film.tile(tile);
  const int pixels = (area.x1 - area.x0) * (area.y1 - area.y0);
  const std::vector<Color> colors(static_cast<std::size_t>(pixels * film.waves()[wave].count()), color);
  return {.area = area, .colors = colors, .layers = std::vector<std::vector<Color>>(film.layers(), colors)};
}

TEST(Film, ShowsTilesThatAreDone) {
  const std::vector<Film::LayerKind> kinds{{Color(7)}};
  Film film(Film::kTileSize + 5, 3, 1, kinds);
  ASSERT_EQ(film.tiles(), 2);
  ASSERT_EQ(film.layers(), 1u);
  EXPECT_EQ(film.picture().at(0, 0), Color(0));
  EXPECT_EQ(film.layer(0).at(0, 0), Color(7));
  film.add(1, 0, uniform(film, 1, 0, {1, 2, 3}));
  EXPECT_EQ(film.picture().at(Film::kTileSize - 1, 2), Color(0));
  EXPECT_EQ(film.layer(0).at(Film::kTileSize - 1, 2), Color(7));
  EXPECT_EQ(film.picture().at(Film::kTileSize, 0), Color(1, 2, 3));
  EXPECT_EQ(film.layer(0).at(Film::kTileSize + 4, 2), Color(1, 2, 3));
  EXPECT_FALSE(film.complete());
  film.add(0, 0, uniform(film, 0, 0, Color(1)));
  EXPECT_TRUE(film.complete());
}

TEST(Film, WavesTakeEverySampleOnce) {
  for (const int samples : {1, 2, 3, 4, 9, 16, 17, 100, 65536}) {
    int next = 0;
    for (const Wave& wave : wavesOf(samples)) {
      EXPECT_EQ(wave.first, next);
      EXPECT_GT(wave.count(), 0);
      EXPECT_LE(wave.count(), 16);
      next = wave.end;
    }
    EXPECT_EQ(next, samples);
  }
  EXPECT_EQ(wavesOf(9).size(), 5u);  // 1 1 2 4 1
}

TEST(Film, SumsWavesInTheirOrder) {
  // Sums of these depend on their order.
  const std::vector<Color> colors{Color(1e16), Color(1), Color(-1e16), Color(3)};
  const auto filmOf = [&](const std::vector<std::size_t>& order) {
    const std::vector<Film::LayerKind> kinds{{Color(0), Film::Keep::mean}, {Color(0), Film::Keep::first}};
    Film film(3, 3, 4, kinds);
    for (const std::size_t wave : order) {
      TileSamples samples =
          uniform(film, 0, wave, colors[static_cast<std::size_t>(film.waves()[wave].first)]);
      film.add(0, wave, samples);
    }
    EXPECT_TRUE(film.complete());
    return film;
  };
  const Film inOrder = filmOf({0, 1, 2}), backwards = filmOf({2, 1, 0});
  EXPECT_EQ(inOrder.picture(), backwards.picture());
  EXPECT_EQ(inOrder.layer(0), backwards.layer(0));
  EXPECT_EQ(inOrder.picture().at(1, 1), Color((1e16 + 1 - 1e16 - 1e16) / 4));
  EXPECT_EQ(inOrder.layer(0), inOrder.picture()) << "averaged";
  EXPECT_EQ(inOrder.layer(1).at(1, 1), Color(1e16)) << "of the first sample";
}

TEST(Film, APlainSurfaceStaysPlainWhateverItsSamplesCount) {
  for (const std::vector<double>& weights : {std::vector<double>{1.1, 1.1, -1.1, 1.1},
                                             {1.1, -1.1, 1.1, -1.1},
                                             {-1.1, -1.1, -1.1, -1.1},
                                             {1, 1, 1, 1}}) {
    Film film(2, 2, 4);
    std::size_t k = 0;
    for (std::size_t wave = 0; wave < film.waves().size(); ++wave) {
      TileSamples samples = uniform(film, 0, wave, Color(0.3));
      for (int pixel = 0; pixel < 4; ++pixel)
        for (int n = 0; n < film.waves()[wave].count(); ++n)
          samples.weights.push_back(weights[k + static_cast<std::size_t>(n)]);
      k += static_cast<std::size_t>(film.waves()[wave].count());
      film.add(0, wave, samples);
      EXPECT_NEAR(film.picture().at(1, 0).r, 0.3, 1e-12) << wave;
    }
  }
}

TEST(Film, AfterAWaveThePictureIsTheMeanSoFar) {
  Film film(2, 2, 4);
  film.add(0, 0, uniform(film, 0, 0, Color(1)));
  EXPECT_EQ(film.picture().at(0, 0), Color(1));
  film.add(0, 2, uniform(film, 0, 2, Color(7)));  // waits for the wave before
  EXPECT_EQ(film.picture().at(0, 0), Color(1));
  film.add(0, 1, uniform(film, 0, 1, Color(3)));
  EXPECT_EQ(film.picture().at(0, 0), Color(4.5));
}

TEST(Film, SamplesThatAreNotFiniteDoNotCount) {
  Film film(1, 1, 4);
  film.add(0, 0, uniform(film, 0, 0, Color(2)));
  film.add(0, 1, uniform(film, 0, 1, Color(std::numeric_limits<double>::quiet_NaN())));
  film.add(0, 2, uniform(film, 0, 2, Color(std::numeric_limits<double>::infinity())));
  EXPECT_EQ(film.picture().at(0, 0), Color(2));
}

TEST(Film, PixelsBesideOneOfOtherWeightsKeepTheirMeans) {
  Film film(2, 1, 2);
  film.add(0, 0, uniform(film, 0, 0, Color(1)));
  TileSamples next = uniform(film, 0, 1, Color(4));
  next.weights = {-0.5, 1};
  film.add(0, 1, next);
  EXPECT_EQ(film.picture().at(0, 0), Color(-2));  // (1 - 4 / 2) / (1 - 1 / 2)
  EXPECT_EQ(film.picture().at(1, 0), Color(2.5));
  Film again(2, 1, 2);
  again.restore(film.saved());
  EXPECT_EQ(again.picture(), film.picture());
  EXPECT_EQ(again.saved(), film.saved());
}

TEST(Film, KeepsNoLayersUnasked) { EXPECT_EQ(Film(4, 4).layers(), 0u); }

TEST(Film, GoesOnWithTheSameBitsFromWhatWasSaved) {
  const std::vector<Film::LayerKind> kinds{
      {Color(0), Film::Keep::mean}, {Color(7)}, {Color(0), Film::Keep::sum}};
  const auto chunk = [](const Film& film, std::int64_t tile, std::size_t wave) {
    const Tile area = film.tile(tile);
    TileSamples samples{.area = area, .colors = {}, .layers = std::vector<std::vector<Color>>(3)};
    const auto count =
        static_cast<std::size_t>((area.x1 - area.x0) * (area.y1 - area.y0) * film.waves()[wave].count());
    for (std::size_t i = 0; i < count; ++i) {
      samples.colors.push_back(Color(0.1 * static_cast<double>(i % 7), 1.0 / static_cast<double>(i + 1), 3));
      samples.weights.push_back(i % 5 == 0 ? -1 : 1);
      for (auto& layer : samples.layers) layer.push_back(Color(static_cast<double>(i)));
    }
    return samples;
  };
  const auto filmOf = [&](int samples) { return Film(Film::kTileSize + 5, 3, samples, kinds); };
  const auto takeAll = [&](Film& film) {
    for (std::size_t wave = 0; wave < film.waves().size(); ++wave)
      for (std::int64_t tile = 0; tile < film.tiles(); ++tile)
        if (!film.has(tile, wave)) film.add(tile, wave, chunk(film, tile, wave));
  };
  Film whole = filmOf(20), part = filmOf(20);
  takeAll(whole);
  part.add(0, 0, chunk(part, 0, 0)), part.add(0, 1, chunk(part, 0, 1)), part.add(1, 0, chunk(part, 1, 0));
  part.add(1, 2, chunk(part, 1, 2));  // before the wave that it waits for, and so not there
  Film back = filmOf(20);
  back.restore(part.saved());
  EXPECT_EQ(back.samplesDone(), 3);
  EXPECT_EQ(back.picture(), part.picture());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(back.layer(i), part.layer(i));
  takeAll(back);
  EXPECT_EQ(back.picture(), whole.picture());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(back.layer(i), whole.layer(i));

  Film more = filmOf(50);
  more.restore(whole.saved());
  EXPECT_EQ(more.samplesDone(), 40);
  EXPECT_FALSE(more.complete());
  EXPECT_EQ(more.waves().back().end, 50);
  takeAll(more);
  EXPECT_TRUE(more.complete());

  Film fewer = filmOf(7), few = filmOf(7);  // of 20 that were planned two are there
  fewer.restore(part.saved());
  EXPECT_EQ(fewer.samplesDone(), 3);
  takeAll(fewer);
  takeAll(few);
  EXPECT_TRUE(fewer.complete());
  EXPECT_EQ(fewer.picture(), few.picture());
}

TEST(Film, TakesNothingThatDoesNotFit) {
  Film film(40, 3, 4);
  for (std::size_t wave = 0; wave < film.waves().size(); ++wave)
    film.add(0, wave, uniform(film, 0, wave, Color(2)));
  const std::string bytes = film.saved();
  const auto refuses = [](Film other, std::string_view state) {
    EXPECT_THROW(other.restore(state), std::runtime_error);
    EXPECT_EQ(other.samplesDone(), 0);
    EXPECT_EQ(other.picture(), Film(other.width(), other.height()).picture());
  };
  refuses(Film(40, 4, 4), bytes);
  refuses(Film(41, 3, 4), bytes);
  refuses(Film(40, 3, 3), bytes);
  refuses(Film(40, 3, 4, std::vector<Film::LayerKind>{{Color(0)}}), bytes);
  refuses(Film(40, 3, 4), bytes + "x");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 50)
    refuses(Film(40, 3, 4), std::string_view(bytes).substr(0, length));
}

TEST(Film, SplatsLandAnywhereAndTheirOrderDoesNotMatter) {
  const auto chunk = [](const Film& film, std::int64_t tile, std::size_t wave) {
    TileSamples samples = uniform(film, tile, wave, Color(tile == 0 ? 2 : 0));
    for (int i = 0; i < 50; ++i)
      samples.splats.push_back({i % film.width(), i % 3, Color(0.1 * i, 1e-3, tile == 0 ? -1e3 : 1e5)});
    samples.splats.push_back({0, 0, Color(std::numeric_limits<double>::quiet_NaN())});
    samples.paths = static_cast<std::int64_t>(samples.colors.size());
    return samples;
  };
  const auto filmOf = [] {
    Film film(Film::kTileSize + 5, 3, 4);
    film.takeSplats();
    return film;
  };
  Film forward = filmOf(), backward = filmOf(), back = filmOf();
  for (std::size_t wave = 0; wave < forward.waves().size(); ++wave)
    for (std::int64_t tile = 0; tile < 2; ++tile) forward.add(tile, wave, chunk(forward, tile, wave));
  for (std::size_t wave = backward.waves().size(); wave-- > 0;)
    for (std::int64_t tile = 1; tile >= 0; --tile) {
      if (wave == 0 && tile == 0) {
        EXPECT_GT(luminanceOf(backward.picture().at(0, 0)), 0) << "splats of another tile are seen";
        back.restore(backward.saved());
        EXPECT_EQ(back.picture(), backward.picture());
      }
      backward.add(tile, wave, chunk(backward, tile, wave));
    }
  EXPECT_EQ(forward.picture(), backward.picture());
  for (std::size_t wave = 0; wave < back.waves().size(); ++wave)
    if (!back.has(0, wave)) back.add(0, wave, chunk(back, 0, wave));
  EXPECT_EQ(back.picture(), forward.picture());
  EXPECT_THROW(Film(Film::kTileSize + 5, 3, 4).restore(back.saved()), std::runtime_error);

  // The mean of a pixel's samples and what a path brings: of pixel (1, 1), splats 1 and 38 of six waves.
  const double paths = (Film::kTileSize + 5) * 3 * 4;
  EXPECT_NEAR(forward.picture().at(1, 1).r, 2 + 3 * 2 * (0.1 + 3.8 * (38 % 3 == 1)) / paths, 1e-6);
  EXPECT_NEAR(forward.picture().at(1, 1).g, 2 + 3 * 2 * 1e-3 / paths, 1e-6);
}

TEST(Film, SplatsMayBeVeryBrightOrVeryDark) {
  for (const double value : {1e-9, 1e12}) {
    Film film(1, 1);
    film.takeSplats();
    TileSamples samples = uniform(film, 0, 0, Color(0));
    samples.splats.assign(100000, {0, 0, Color(value)});
    samples.paths = 100000;
    film.add(0, 0, samples);
    EXPECT_NEAR(film.picture().at(0, 0).g / value, 1, 1e-3) << value;
  }
}

TEST(PixelSum, LeavesOutWeightsBelowZeroThatNearlyUndoTheOthers) {
  EXPECT_LE(Film::bytesPerPixel(0), 32u);
  PixelSum sum;
  sum.add(Color(0.5), 1), sum.add(Color(1), -0.25);
  const PixelSum copy = sum;
  sum.add(Color(3), -0.7);  // those below 0 nearly undo the others now, so they do not count
  EXPECT_NEAR(copy.mean().g, 0.25 / 0.75, 1e-12);
  EXPECT_NEAR(sum.mean().g, 0.5, 1e-12);
  EXPECT_NEAR(sum.colors().without(copy.colors()).mean().g, 3, 1e-12);
}

TEST(PixelSum, SettlesWhereItsErrorIsSmall) {
  PixelSum even, noisy, bright;
  for (int k = 0; k < 16; ++k) {
    EXPECT_FALSE(even.settles(1)) << k;
    even.add(Color(0.5), 1), noisy.add(Color(k % 2), 1), bright.add(Color(k % 2 ? 99 : 101), 1);
  }
  EXPECT_TRUE(even.settles(1e-9));
  EXPECT_NEAR(noisy.error(), std::sqrt(0.25 / 15), 1e-6);  // of samples 0 and 1
  EXPECT_FALSE(noisy.settles(0.1));
  EXPECT_TRUE(noisy.settles(0.15));
  EXPECT_NEAR(bright.error(), std::sqrt(1.0 / 15) / 100, 1e-6) << "a part of the mean";
  EXPECT_FALSE(even.settles(0)) << "off";
}

}  // namespace
}  // namespace trace
