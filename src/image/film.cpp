#include "image/film.h"

#include <algorithm>
#include <cmath>

namespace trace {

double PixelSum::error() const {
  const double n = taken_, mean = luminanceOf(colors_.mean());
  const double variance = std::max(0.0, squares_ / n - mean * mean) * n / std::max(1.0, n - 1);
  return std::sqrt(variance / n) / std::max(1.0, mean);
}

std::vector<Wave> wavesOf(int samples, int first) {
  constexpr int kMost = 16;  // a stop waits for a wave of a tile, and the picture is seen after each
  std::vector<Wave> waves;
  while (first < samples) {
    const int end = std::min(samples, first + std::clamp(first, 1, kMost));
    waves.push_back({first, end});
    first = end;
  }
  return waves;
}

Film::Film(int width, int height, int samples, std::span<const LayerKind> layers, double noise, int tileSize)
    : width_(width),
      height_(height),
      tileSize_(tileSize),
      columns_((width + tileSize - 1) / tileSize),
      rows_((height + tileSize - 1) / tileSize),
      noise_(noise),
      waves_(wavesOf(samples)),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      states_(std::make_unique<TileState[]>(static_cast<std::size_t>(tiles()))) {
  for (const LayerKind& kind : layers) layers_.push_back({kind, Picture(width, height)});
}

Tile Film::tile(std::int64_t index) const {
  const int x = static_cast<int>(index % columns_) * tileSize_;
  const int y = static_cast<int>(index / columns_) * tileSize_;
  return {x, y, std::min(x + tileSize_, width_), std::min(y + tileSize_, height_)};
}

void Film::add(std::int64_t tile, std::size_t wave, TileSamples samples) {
  TileState& state = states_[static_cast<std::size_t>(tile)];
  const auto splats = lockSplats();
  const std::lock_guard lock(state.mutex);
  if (wave != state.waves) {
    state.early.emplace(wave, std::move(samples));
    return;
  }
  sum(waves_[state.waves++], samples);
  for (auto next = state.early.begin(); next != state.early.end() && next->first == state.waves;
       next = state.early.erase(next))
    sum(waves_[state.waves++], next->second);
}

void Film::sum(const Wave& wave, const TileSamples& samples) {
  if (splats_) splats_->add(samples.splats, samples.paths);
  const Tile& area = samples.area;
  const auto count = static_cast<std::size_t>(wave.count());
  std::size_t at = 0;
  for (int y = area.y0; y < area.y1; ++y)
    for (int x = area.x0; x < area.x1; ++x) {
      PixelSum& pixel = pixels_[index(x, y)];
      if (pixel.settles(noise_)) continue;
      for (std::size_t k = at; k < at + count; ++k)
        pixel.add(samples.colors[k], samples.weights.empty() ? 1 : samples.weights[k]);
      for (std::size_t i = 0; i < layers_.size(); ++i) {
        const auto value = [&](std::size_t k) {
          return i < samples.layers.size() ? samples.layers[i][k] : layers_[i].kind.blank;
        };
        Color& sum = layers_[i].sums.at(x, y);
        if (layers_[i].kind.keep != Keep::first)
          for (std::size_t k = at; k < at + count; ++k) sum += value(k);
        else if (wave.first == 0)
          sum = value(at);
      }
      at += count;
    }
}

bool Film::has(std::int64_t tile, std::size_t wave) const {
  const TileState& state = states_[static_cast<std::size_t>(tile)];
  const std::lock_guard lock(state.mutex);
  return wave < state.waves;
}

std::int64_t Film::samplesDone() const {
  std::int64_t done = 0;
  for (std::int64_t i = 0; i < tiles(); ++i) {
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves > 0) done += waves_[state.waves - 1].end;
  }
  return done;
}

bool Film::complete() const {
  for (std::int64_t i = 0; i < tiles(); ++i) {
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves < waves_.size()) return false;
  }
  return true;
}

template <class Use>
void Film::forEachDone(const Use& use) const {
  for (std::int64_t i = 0; i < tiles(); ++i) {
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves == 0) continue;
    const Tile area = tile(i);
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) use(pixels_[index(x, y)], x, y);
  }
}

Picture Film::picture() const {
  Picture picture(width_, height_);
  copyDone(picture);
  return picture;
}

void Film::copyDone(Picture& onto) const {
  const auto splats = lockSplats();
  const bool anywhere = splats_ && splats_->paths() > 0;
  if (anywhere) std::fill(onto.pixels.begin(), onto.pixels.end(), Color(0));
  forEachDone([&](const PixelSum& pixel, int x, int y) { onto.at(x, y) = pixel.mean(); });
  if (!anywhere) return;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) onto.at(x, y) += splats_->mean(x, y);
}

Picture Film::layer(std::size_t number) const {
  const Layer& layer = layers_[number];
  Picture picture(width_, height_);
  std::fill(picture.pixels.begin(), picture.pixels.end(), layer.kind.blank);
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    if (pixel.taken() == 0) return;
    const Color& sum = layer.sums.at(x, y);
    picture.at(x, y) = layer.kind.keep == Keep::mean ? sum / pixel.taken() : sum;
  });
  return picture;
}

}  // namespace trace
