// The picture while it is being made: sums of samples, tile by tile and wave by wave. Beside it, when asked
// for, layers of the same size: what else is kept of every pixel.
//
// A wave takes some samples of every pixel, so that a render shows the whole picture early and refines it.
// The unit of work is one wave of one tile. Whoever has it gives its samples to the film, which adds them in
// their order, whatever the order in which they come: the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "image/film/corner_samples.h"
#include "image/film/film_pixels.h"
#include "image/film/splat_plane.h"
#include "image/picture.h"
#include "image/srgb.h"

namespace trace {

/// The samples first <= k < end of each pixel.
struct Wave {
  int first, end;
  int count() const { return end - first; }
};

/// How many samples of a pixel a wave that begins with sample `first` takes at most: a stop waits for a wave
/// of a tile, and the picture is seen after each.
constexpr int longestWave(int first) { return std::clamp(first, 1, 16); }

/// One sample, one more, 2, 4, 8, and from then on 16 at a time; those from sample `first` on.
std::vector<Wave> wavesOf(int samples, int first = 0);

/// A pixel that is not rendered, beside one that is: PixelSum::firstErrorFor() of it.
struct PixelBeside {
  int x, y;
  float firstError;
};

/// The samples of one wave for the pixels of an area, row by row; of each pixel its samples in their order,
/// and none of those that have settled before.
struct TileSamples {
  Tile area{0, 0, 0, 0};
  std::vector<Color> colors;               ///< those that are not finite do not count
  std::vector<double> weights{};           ///< weights of the samples; empty if all are 1
  std::vector<std::vector<Color>> layers;  ///< the same of each layer; one that is missing stays blank
  std::vector<Splat> splats{};             ///< anywhere in the picture, where the film takes splats
  std::int64_t paths = 0;                  ///< that brought them
  std::vector<std::size_t> starts{};       ///< first sample of each divided pixel, and the end
  std::vector<Corner> corners{};           ///< that they are then
  std::vector<PixelBeside> beside{};       ///< pixels beside the tile, after the first judged wave
};

/// How far a picture has come.
struct Convergence {
  double samples = 0;   ///< samples of a pixel, on the average
  double error = 0;     ///< PixelSum::error(), on the average of those pixels that have two samples or more
  bool judged = false;  ///< there are such pixels, and their samples are their own
};

/// Two pictures of one half of the samples each, and how exact both together are: what removes noise needs.
struct Halves {
  Picture first, second;
  std::vector<double> variance;  ///< variance of the mean luminance, for independent samples
  std::vector<double> share;     ///< share of the first half; 0 if one half has none
};

/// One of `count` shares of a film's tiles, for one of several machines: number `number` from 0 on. Tiles
/// side by side belong to different ones, so that all shares take about as long.
struct TileShare {
  int number = 0, count = 1;
  bool operator==(const TileShare&) const = default;
};

/// A saved film has more samples than are asked for.
struct TooManySamples : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Film {
 public:
  static constexpr int kTileSize = 32;  ///< in pixels, of a side

  /// The way in which a layer keeps a pixel's samples. weighted: as the colour is kept, so that parts of the
  /// colour sum to it. counts: how many samples have each number, which is the red of their value.
  enum class Keep { first, mean, sum, weighted, counts };
  struct LayerKind {
    Color blank;  ///< the value wherever nothing is rendered
    Keep keep = Keep::first;
    std::uint32_t numbers = 0;  ///< for Keep::counts: they go from 1 to this one; 0 is not counted
  };

  /// For a picture of that many samples a pixel, or of fewer where PixelSum::settles(noise) and isSure().
  explicit Film(int width, int height, int samples = 1, std::span<const LayerKind> layers = {},
                double noise = 0, int tileSize = kTileSize);

  /// The luminance that shows as white, of which errors are parts. Before anything is added.
  void setWhite(double luminance) { white_ = luminance; }
  /// From now on light may land anywhere: a pixel is the sum of its samples' mean and of what a path brings
  /// there on the average. Before anything is added.
  void takeSplats() { splats_ = std::make_unique<SplatPlane>(width_, height_); }
  bool takesSplats() const { return splats_ != nullptr; }

  /// From now on a sample is what a corner sees, and a wave a level of corners: a pixel is the mean of the
  /// squares into which it falls. A wave looks at the corners of the one before, of all tiles. Before
  /// anything is added.
  void divide(const Subdivision& rules);
  /// Null where pixels are not divided.
  const CornerSamples* corners() const { return corners_.get(); }

  /// From now on halves() are kept, of splats too if they are taken. Before anything is added.
  void keepHalves() {
    first_.resize(pixels_.size());
    if (splats_) firstSplats_ = std::make_unique<SplatPlane>(width_, height_);
  }
  bool keepsHalves() const { return !first_.empty(); }
  /// The halves of what is there. From any thread while others add.
  Halves halves() const;

  /// From now on only the tiles of a share, not of more shares than there are tiles, are rendered and saved.
  /// Before anything is added; not where pixels are divided.
  void limitTo(const TileShare& share) { share_ = share; }
  const TileShare& share() const { return share_; }
  /// Whether the tile is to be rendered here: of a film that is not limited, each is.
  bool owns(std::int64_t tile) const { return isIn(share_, tile); }
  std::int64_t ownTiles() const;

  int width() const { return width_; }
  int height() const { return height_; }
  std::int64_t tiles() const { return std::int64_t{columns_} * rows_; }
  Tile tile(std::int64_t index) const;
  /// The index of the tile that the pixel lies in.
  std::int64_t tileAt(int x, int y) const { return std::int64_t{y / tileSize_} * columns_ + x / tileSize_; }
  const std::vector<Wave>& waves() const { return waves_; }
  std::size_t layers() const { return layers_.size(); }

  /// Whether pixels differ in the number of samples: then a wave of a tile may begin only after the one
  /// before.
  bool adaptive() const { return noise_ > 0 || corners_; }
  /// Whether pixels stop for this error: 0 where they do not.
  double noiseTarget() const { return corners_ ? 0 : noise_; }
  /// Whether the pixel takes no part in further waves. While nobody adds to its tile, and those around have
  /// the waves before.
  bool settled(int x, int y) const;

  /// Takes the samples of one wave of a tile. From any thread, each wave of a tile once, in any order.
  void add(std::int64_t tile, std::size_t wave, TileSamples samples);
  /// Whether it has them, and those of all waves before.
  bool has(std::int64_t tile, std::size_t wave) const;
  /// Samples of tiles that are there: the sum over all own tiles of what each pixel has, or could have.
  std::int64_t samplesDone() const;
  /// The share of the work that is done: of the samples, or, where pixels stop for an error, of those that it
  /// is likely to take, since an error falls with the square root of their number. From any thread.
  double shareDone() const;

  /// All that is there, for restore(). From any thread while others add: a tile is there with its last whole
  /// wave.
  std::string saved() const;
  /// Takes what saved() gave of a film of the same size and layers whose tiles have no more samples than
  /// this one asks for; these then count as taken. The bytes are not trusted: all counts and indices are
  /// checked, so that any bytes do no harm. Throws TooManySamples, or std::runtime_error with the reason if
  /// they do not fit; the film is then blank.
  void restore(std::string_view bytes);
  /// Adds the tiles and splats that saved() gave of a film of the same size, layers and samples that was
  /// limited to the share and is complete: with all shares, in any order, this film has the bits of one that
  /// was rendered whole. The bytes are not trusted, as with restore(). Throws std::runtime_error with the
  /// reason if they do not fit; the film is then blank.
  void merge(std::string_view bytes, const TileShare& share);
  /// Takes away all samples.
  void clear();

  /// All waves of all own tiles are there.
  bool complete() const;

  /// The mean of the pixel's samples, without what others have brought there. While nobody adds.
  Color ofSamples(int x, int y) const;
  /// The splats of other pixels there so far. From any thread while others add.
  Color ofSplats(int x, int y) const;
  /// The mean of what is there so far, black elsewhere. From any thread while others add.
  Picture picture() const;
  /// The picture of a layer, blank elsewhere. Of Keep::counts the number that most samples have.
  Picture layer(std::size_t number) const;
  /// The share of a pixel that has a number.
  struct Share {
    std::uint32_t number;
    double share;
    bool operator==(const Share&) const = default;
  };
  /// Shares of each pixel in a layer of Keep::counts, the largest first, and the lower number first of
  /// equal ones.
  std::vector<std::vector<Share>> shares(std::size_t number) const;
  /// PixelSum::variance() of each pixel with two samples or more, 0 elsewhere. From any thread.
  Picture variances() const;
  /// How many samples each pixel has. From any thread.
  Picture sampleCounts() const;
  /// PixelSum::error() of each pixel with two samples or more, 0 elsewhere. From any thread.
  Picture errors() const;
  /// How far the pixels that have samples have converged. From any thread.
  Convergence convergence() const;
  /// Puts what is there so far over a picture of the same size. From any thread.
  void copyDone(Picture& onto) const;

  /// Bytes that a pixel takes here, without splats and corners: at most 32 where nothing more is asked for.
  static std::uint64_t bytesPerPixel(std::size_t layers, bool halves = false, bool stops = false) {
    return FilmPixels::kBytes + layers * sizeof(Color) + (halves ? sizeof(WeightedMean) : 0) +
           (stops ? sizeof(float) : 0);
  }

 private:
  friend class FilmState;
  struct Count {
    std::uint32_t number, count;
  };
  struct Layer {
    LayerKind kind;
    Picture sums;                              ///< or the first values; empty for Keep::counts
    Picture below{};                           ///< for Keep::weighted: the part of samples of weights below 0
    std::vector<std::vector<Count>> counts{};  ///< for Keep::counts
  };
  /// Adds samples that are all of one wave to a pixel's layer.
  void addToLayer(Layer& layer, std::size_t pixel, const TileSamples& samples,
                  const std::vector<Color>* values, std::size_t first, std::size_t end, bool isFirstWave);
  struct TileState {
    mutable std::mutex mutex;
    std::size_t waves = 0;                     ///< that are summed
    std::map<std::size_t, TileSamples> early;  ///< that wait for the ones before them
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  /// Samples change halves in blocks of four, of which each fills the pixel evenly: even and odd ones of most
  /// generators lie on two sides of it.
  static bool isOfFirstHalf(int sample) { return (sample & 4) == 0; }
  bool isIn(const TileShare& share, std::int64_t tile) const {
    // Where rows have as many tiles of each share, each row begins with another one: no share is a column.
    const std::int64_t shift = columns_ % share.count == 0 ? tile / columns_ : 0;
    return (tile + shift) % share.count == share.number;
  }
  void sum(const Wave& wave, const TileSamples& samples);
  void sumSplats(const Wave& wave, const TileSamples& samples);
  void putCorners(std::int64_t tile, std::size_t level, TileSamples samples);
  /// Calls use(x, y, levels) for the pixels of every tile that has a wave: how many levels of corners are
  /// there, in this tile and around it. 0: the pixel has nothing but the corners that it is the home of.
  template <class Use>
  void forEachDivided(const Use& use) const;
  template <class Waves>
  std::size_t levelsOf(const Tile& area, const Waves& waves) const;
  Color ofCorners(int x, int y, int levels) const;
  /// Nobody adds splats while this lives. To be locked before a tile.
  std::unique_lock<std::mutex> lockSplats() const {
    return splats_ ? std::unique_lock(splats_->mutex) : std::unique_lock<std::mutex>();
  }
  /// Calls use(PixelSum, x, y) for those of every tile that has a wave, which no one changes meanwhile.
  template <class Use>
  void forEachDone(const Use& use) const;

  int width_, height_, tileSize_, columns_, rows_;
  double noise_;
  double white_ = 1;
  TileShare share_;
  std::vector<Wave> waves_;
  FilmPixels pixels_;
  std::vector<float>
      firstErrors_;  ///< PixelSum::firstErrorFor() of each pixel, where pixels stop for an error
  std::vector<Layer> layers_;
  std::unique_ptr<TileState[]> states_;
  std::unique_ptr<SplatPlane> splats_;  ///< null where none are taken
  std::unique_ptr<CornerSamples> corners_;
  std::vector<WeightedMean> first_;  ///< mean of the first half of each pixel's samples, if halves are kept
  std::unique_ptr<SplatPlane> firstSplats_;  ///< theirs
};

}  // namespace trace
