// What can be seen of a film while it is being made.
#include "image/film.h"

#include <gtest/gtest.h>

#include <limits>
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
    const std::vector<Film::LayerKind> kinds{{Color(0), true}, {Color(0), false}};
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

TEST(Film, KeepsNoLayersUnasked) { EXPECT_EQ(Film(4, 4).layers(), 0u); }

}  // namespace
}  // namespace trace
