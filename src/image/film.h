// The picture while it is being made: square tiles, each written by one worker and then marked done. Beside
// it, when asked for, layers of the same size: what else is kept of every pixel.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "image/picture.h"

namespace trace {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Tile {
  int x0, y0, x1, y1;
};

class Film {
 public:
  static constexpr int kTileSize = 32;  ///< in pixels, of a side

  /// With one layer for each of `blank`, of that value wherever nothing is rendered.
  explicit Film(int width, int height, std::span<const Color> blank = {}, int tileSize = kTileSize)
      : picture_(width, height),
        tileSize_(tileSize),
        columns_((width + tileSize - 1) / tileSize),
        rows_((height + tileSize - 1) / tileSize),
        done_(std::make_unique<std::atomic<bool>[]>(static_cast<std::size_t>(tiles()))) {
    for (const Color& color : blank) layers_.push_back({filled(color), color});
  }

  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  std::int64_t tiles() const { return std::int64_t{columns_} * rows_; }
  Tile tile(std::int64_t index) const {
    const int x = static_cast<int>(index % columns_) * tileSize_,
              y = static_cast<int>(index / columns_) * tileSize_;
    return {x, y, std::min(x + tileSize_, width()), std::min(y + tileSize_, height())};
  }

  /// Each pixel is set by the one worker that has its tile, before that tile is marked done.
  void set(int x, int y, const Color& color) { picture_.at(x, y) = color; }
  void set(std::size_t layer, int x, int y, const Color& value) { layers_[layer].values.at(x, y) = value; }
  void markDone(std::int64_t index) {
    done_[static_cast<std::size_t>(index)].store(true, std::memory_order_release);
  }

  bool complete() const {
    for (std::int64_t i = 0; i < tiles(); ++i)
      if (!done_[static_cast<std::size_t>(i)].load(std::memory_order_acquire)) return false;
    return true;
  }

  /// What is done so far, black elsewhere. May be called from any thread while workers write.
  Picture picture() const { return doneOf(picture_, Color(0)); }
  /// Calls use(picture) with the same; no copy is made once all is done.
  template <class Use>
  void withPicture(Use use) const {
    if (complete())
      use(picture_);
    else
      use(picture());
  }
  /// The same of a layer, blank elsewhere.
  Picture layer(std::size_t index) const { return doneOf(layers_[index].values, layers_[index].blank); }
  std::size_t layers() const { return layers_.size(); }
  /// Puts what is done so far over a picture of the same size. From any thread.
  void copyDone(Picture& onto) const { copyDone(picture_, onto); }

 private:
  struct Layer {
    Picture values;
    Color blank;
  };

  Picture filled(const Color& color) const {
    Picture picture(width(), height());
    std::fill(picture.pixels.begin(), picture.pixels.end(), color);
    return picture;
  }
  Picture doneOf(const Picture& all, const Color& blank) const {
    Picture copy = filled(blank);
    copyDone(all, copy);
    return copy;
  }
  void copyDone(const Picture& all, Picture& onto) const {
    for (std::int64_t i = 0; i < tiles(); ++i) {
      if (!done_[static_cast<std::size_t>(i)].load(std::memory_order_acquire)) continue;
      const Tile t = tile(i);
      for (int y = t.y0; y < t.y1; ++y)
        std::copy(&all.at(t.x0, y), &all.at(t.x0, y) + (t.x1 - t.x0), &onto.at(t.x0, y));
    }
  }

  Picture picture_;
  std::vector<Layer> layers_;
  int tileSize_, columns_, rows_;
  std::unique_ptr<std::atomic<bool>[]> done_;
};

}  // namespace trace
