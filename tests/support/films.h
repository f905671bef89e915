// Films in the midst of a render, one of each kind that a checkpoint may hold, and what a render does with
// them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "image/film/film.h"

namespace trace::test {

constexpr int kFilmKinds = 7;
inline const char* filmKindName(int kind) {
  constexpr const char* kNames[kFilmKinds] = {"plain",  "layers",  "halves",          "adaptive",
                                              "splats", "divided", "halves of splats"};
  return kNames[kind];
}

/// Of 7 x 5 pixels in tiles of 4 x 4, and 20 samples or three levels of corners.
inline Film blankFilm(int kind) {
  const std::vector<Film::LayerKind> layers{
      {Color(0), Film::Keep::mean}, {Color(7)}, {Color(0), Film::Keep::sum}};
  const bool layered = kind == 1 || kind == 5;
  Film film(7, 5, 20, layered ? std::span(layers) : std::span<const Film::LayerKind>(), kind == 3 ? 0.05 : 0,
            4);
  if (kind == 4 || kind == 6) film.takeSplats();
  if (kind == 2 || kind == 6) film.keepHalves();
  if (kind == 5) film.divide({2, 0.1, {1, 0, 6, 5}, 0, 0});
  return film;
}

/// One wave of a tile, as a render takes it, of a picture with an edge and some noise.
inline void renderWave(Film& film, std::int64_t tile, std::size_t wave) {
  const auto seen = [](int x, int y, int k) {
    const double noise = (x * 31 + y * 17 + k * 7) % 11 / 11.0;
    return Color(x < 3 ? 0.5 : 0.5 * noise, y < 2 ? 1 : 0, noise);
  };
  Tile area = film.tile(tile);
  const auto count = film.waves()[wave].count();
  TileSamples samples{.area = area, .colors = {}, .layers = std::vector<std::vector<Color>>(film.layers())};
  const auto take = [&](const Color& color) {
    samples.colors.push_back(color);
    for (auto& layer : samples.layers) layer.push_back(color);
  };
  if (const CornerSamples* corners = film.corners()) {
    const Tile& all = corners->rules().area;
    area = {std::max(area.x0, all.x0), std::max(area.y0, all.y0), std::min(area.x1, all.x1),
            std::min(area.y1, all.y1)};
    samples.area = area;
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) {
        samples.starts.push_back(samples.corners.size());
        for (const Corner corner : corners->wanted(x, y, static_cast<int>(wave))) {
          samples.corners.push_back(corner);
          take(seen(x, y, corner.x + corner.y));
        }
      }
    samples.starts.push_back(samples.corners.size());
  } else {
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) {
        if (film.settled(x, y)) continue;
        for (int k = 0; k < count; ++k) {
          take(seen(x, y, film.waves()[wave].first + k));
          samples.weights.push_back(k % 5 == 4 ? -0.5 : 1);
        }
        if (film.takesSplats())
          samples.splats.push_back({6 - x, 4 - y, Color(0.25), film.waves()[wave].first});
        samples.paths += count;
      }
  }
  film.add(tile, wave, std::move(samples));
}

/// All that is missing of the first `waves`; of the last of these only the first tile.
inline void renderPart(Film& film, std::size_t waves) {
  for (std::size_t wave = 0; wave < waves; ++wave)
    for (std::int64_t tile = 0; tile < (wave + 1 < waves ? film.tiles() : 1); ++tile)
      if (!film.has(tile, wave)) renderWave(film, tile, wave);
}
inline void renderRest(Film& film) {
  for (std::size_t wave = 0; wave < film.waves().size(); ++wave)
    for (std::int64_t tile = 0; tile < film.tiles(); ++tile)
      if (!film.has(tile, wave)) renderWave(film, tile, wave);
}

/// Asks for everything that can be made of a film.
inline void lookAtAll(const Film& film) {
  film.picture();
  for (std::size_t i = 0; i < film.layers(); ++i) film.layer(i);
  film.sampleCounts();
  film.errors();
  film.convergence();
  film.shareDone();
  if (film.keepsHalves()) film.halves();
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) film.ofSamples(x, y), film.ofSplats(x, y), film.settled(x, y);
}

}  // namespace trace::test
