// The pixels of a film in as little memory as they need: a picture of 8K has 33 million.
//
// Nearly always each sample has the weight 1 and is finite. Such a pixel is its sum, the number of its
// samples and their spread, in 32 bytes. A tile that has another pixel keeps the weights of all its pixels as
// well.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "image/film/pixel_sum.h"

namespace trace {

class FilmPixels {
 public:
  /// Tiles are numbered row by row.
  FilmPixels(int width, int height, int tileSize);

  /// Bytes of a pixel, where all weights are 1.
  static constexpr std::size_t kBytes = 32;

  std::size_t size() const { return pixels_.size(); }

  /// The pixel in that tile. Different tiles may be read and changed by different threads.
  PixelSum at(int x, int y) const;
  /// Calls change(PixelSum&) for the pixel, and keeps what that becomes.
  template <class Change>
  void change(int x, int y, const Change& change) {
    PixelSum pixel = taken(x, y);
    change(pixel);
    put(x, y, std::move(pixel));
  }
  void put(int x, int y, PixelSum pixel);
  void clear();

  /// All samples of the pixel are finite and have the weight 1.
  static bool isPlain(const PixelSum& pixel) {
    return !pixel.colors_.above_ && pixel.colors_.weights_ == pixel.taken_;
  }

 private:
  struct Pixel {
    Color sum;
    int taken = 0;
    float spread = 0;
  };
  static_assert(sizeof(Pixel) == kBytes);
  /// Weights of a pixel that is not plain.
  struct Weights {
    double sum = 0;
    std::unique_ptr<WeightedMean::Above> above;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  std::size_t tileAt(int x, int y) const {
    return static_cast<std::size_t>(y / tileSize_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x / tileSize_);
  }
  std::size_t inTile(int x, int y) const {
    return static_cast<std::size_t>(y % tileSize_) * static_cast<std::size_t>(tileSize_) +
           static_cast<std::size_t>(x % tileSize_);
  }
  static PixelSum plain(const Pixel& pixel);
  /// The pixel, without its weights above 0 here.
  PixelSum taken(int x, int y);
  /// The weights of a tile, from now on kept.
  std::vector<Weights>& weightsOf(int x, int y);

  int width_, height_, tileSize_, columns_;
  HugeVector<Pixel> pixels_;
  std::vector<std::vector<Weights>> weights_;  ///< those of each tile; empty if all are plain
};

}  // namespace trace
