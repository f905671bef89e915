#include "image/film/film_pixels.h"

#include <algorithm>

namespace trace {

FilmPixels::FilmPixels(int width, int height, int tileSize)
    : width_(width),
      height_(height),
      tileSize_(tileSize),
      columns_((width + tileSize - 1) / tileSize),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      weights_(static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>((height + tileSize - 1) / tileSize)) {}

PixelSum FilmPixels::plain(const Pixel& pixel) {
  PixelSum sum;
  sum.colors_.sum_ = pixel.sum;
  sum.colors_.weights_ = pixel.taken;
  sum.taken_ = pixel.taken;
  sum.spread_ = pixel.spread;
  return sum;
}

PixelSum FilmPixels::at(int x, int y) const {
  PixelSum sum = plain(pixels_[index(x, y)]);
  if (const std::vector<Weights>& weights = weights_[tileAt(x, y)]; !weights.empty()) {
    const Weights& own = weights[inTile(x, y)];
    sum.colors_.weights_ = own.sum;
    if (own.above) sum.colors_.above_ = std::make_unique<WeightedMean::Above>(*own.above);
  }
  return sum;
}

PixelSum FilmPixels::taken(int x, int y) {
  PixelSum sum = plain(pixels_[index(x, y)]);
  if (std::vector<Weights>& weights = weights_[tileAt(x, y)]; !weights.empty()) {
    Weights& own = weights[inTile(x, y)];
    sum.colors_.weights_ = own.sum;
    sum.colors_.above_ = std::move(own.above);
  }
  return sum;
}

std::vector<FilmPixels::Weights>& FilmPixels::weightsOf(int x, int y) {
  std::vector<Weights>& weights = weights_[tileAt(x, y)];
  if (!weights.empty()) return weights;
  weights.resize(static_cast<std::size_t>(tileSize_) * static_cast<std::size_t>(tileSize_));
  const int x0 = x / tileSize_ * tileSize_, y0 = y / tileSize_ * tileSize_;
  for (int v = y0; v < std::min(y0 + tileSize_, height_); ++v)
    for (int u = x0; u < std::min(x0 + tileSize_, width_); ++u)
      weights[inTile(u, v)].sum = pixels_[index(u, v)].taken;
  return weights;
}

void FilmPixels::put(int x, int y, PixelSum pixel) {
  if (!isPlain(pixel) || !weights_[tileAt(x, y)].empty())
    weightsOf(x, y)[inTile(x, y)] = {pixel.colors_.weights_, std::move(pixel.colors_.above_)};
  pixels_[index(x, y)] = {pixel.colors_.sum_, pixel.taken_, pixel.spread_};
}

void FilmPixels::clear() {
  std::fill(pixels_.begin(), pixels_.end(), Pixel{});
  for (std::vector<Weights>& weights : weights_) weights.clear();
}

}  // namespace trace
