// A film as bytes and back, so that a render can continue after its process ended, or on several machines:
// Film::saved, Film::restore, Film::merge.
//
// Numbers stand as they do in memory, so that the same machine, or one like it, continues with the same bits.
//
// The bytes are not trusted, for anyone may have written them. A colour or a weight may be any number, as it
// may in a render; whatever counts, selects or ends something is checked here, and nothing after this checks
// it again.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "image/film/film.h"

namespace trace {
namespace {

constexpr std::uint32_t kMark = 0x01020304;  // reads otherwise where bytes stand in another order

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    if (bytes_.size() < sizeof value) throw std::runtime_error("it ends too early");
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  template <class T>
  void expect(const T& value, const char* reason) {
    if (take<T>() != value) throw std::runtime_error(reason);
  }
  std::size_t left() const { return bytes_.size(); }
  bool atEnd() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

}  // namespace

/// Sees the inside of a film and of its pixels.
class FilmState {
 public:
  static void put(Writer& to, const PixelSum& pixel) {
    const bool plain = FilmPixels::isPlain(pixel);
    to.put(pixel.taken_);
    to.put(pixel.spread_);
    to.put(static_cast<std::uint8_t>(plain));
    plain ? to.put(pixel.colors_.sum_) : put(to, pixel.colors_);
  }

  static void put(Writer& to, const WeightedMean& mean) {
    const bool alike = !mean.above_;  // nearly always
    to.put(static_cast<std::uint8_t>(alike));
    to.put(mean.sum_);
    to.put(mean.weights_);
    if (alike) return;
    to.put(*mean.above_);
  }

  static void take(Reader& from, PixelSum& pixel) {
    pixel.taken_ = from.take<int>();
    pixel.spread_ = from.take<float>();
    const auto plain = from.take<std::uint8_t>();
    if (plain > 1) throw std::runtime_error("a pixel is neither of one kind nor of the other");
    if (plain) {
      pixel.colors_.sum_ = from.take<Color>();
      pixel.colors_.weights_ = pixel.taken_;
      return;
    }
    take(from, pixel.colors_);
    if (FilmPixels::isPlain(pixel))
      throw std::runtime_error("a pixel is of one kind and said to be of another");
  }
  /// Throws unless the pixel of a tile with that many waves has the samples of all of them, or was left out,
  /// or, where pixels stop for an error, stopped after one of them.
  static void checkTaken(const Film& film, const PixelSum& pixel, std::span<const Wave> there) {
    const auto endsThere = [&](const Wave& wave) { return wave.end == pixel.taken_; };
    const auto possible = film.noise_ > 0 ? there : there.last(1);
    if (pixel.taken_ != 0 && std::none_of(possible.begin(), possible.end(), endsThere))
      throw std::runtime_error("a pixel has another number of samples than its tile");
  }

  static void take(Reader& from, WeightedMean& mean) {
    const auto alike = from.take<std::uint8_t>();
    if (alike > 1) throw std::runtime_error("a mean is neither of one kind nor of the other");
    mean.sum_ = from.take<Color>();
    mean.weights_ = from.take<double>();
    mean.above_ = alike ? nullptr : std::make_unique<WeightedMean::Above>(from.take<WeightedMean::Above>());
  }

  static void put(Writer& to, const Film::Layer& layer, std::size_t pixel) {
    if (layer.kind.keep == Film::Keep::counts) return putAll(to, layer.counts[pixel]);
    to.put(layer.sums.pixels[pixel]);
    if (layer.kind.keep == Film::Keep::weighted) to.put(layer.below.pixels[pixel]);
  }
  /// Reads a layer of a pixel with so many samples.
  static void take(Reader& from, Film::Layer& layer, std::size_t pixel, int samples) {
    if (layer.kind.keep == Film::Keep::counts) {
      takeAll(from, layer.counts[pixel]);
      std::int64_t counted = 0;
      for (const auto& [number, count] : layer.counts[pixel]) {
        if (number < 1 || number > layer.kind.numbers) throw std::runtime_error("it counts unknown numbers");
        counted += count;
      }
      if (counted > samples) throw std::runtime_error("it counts more samples than a pixel has");
      return;
    }
    layer.sums.pixels[pixel] = from.take<Color>();
    if (layer.kind.keep == Film::Keep::weighted) layer.below.pixels[pixel] = from.take<Color>();
  }

  static void put(Writer& to, const SplatPlane& splats) {
    to.put(splats.paths_);
    for (const SplatPlane::Sum& sum : splats.sums_) to.put(sum);
  }
  static void take(Reader& from, SplatPlane& splats) {
    constexpr std::int64_t kMostPaths = std::int64_t{1} << 62;  // as many can still be added
    splats.paths_ = from.take<std::int64_t>();
    if (splats.paths_ < 0 || splats.paths_ > kMostPaths)
      throw std::runtime_error("its number of paths makes no sense");
    for (SplatPlane::Sum& sum : splats.sums_) {
      sum = from.take<SplatPlane::Sum>();
      for (const SplatPlane::Whole part : sum)
        if (part < -SplatPlane::kLimit || part > SplatPlane::kLimit)
          throw std::runtime_error("more light has landed in a pixel than its paths can bring");
    }
  }

  /// Those of the first half of the paths that have brought `all`.
  static void takeFirst(Reader& from, SplatPlane& first, const SplatPlane& all) {
    take(from, first);
    if (first.paths_ > all.paths_) throw std::runtime_error("its number of paths makes no sense");
  }

  static void add(SplatPlane& to, const SplatPlane& splats) {
    constexpr SplatPlane::Whole kMost = SplatPlane::kLimit / 2;  // two such sums are one that is read again
    const auto isMuch = [](SplatPlane::Whole part) { return part < -kMost || part > kMost; };
    to.paths_ += splats.paths_;
    for (std::size_t i = 0; i < to.sums_.size(); ++i)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        SplatPlane::Whole& sum = to.sums_[i][channel];
        const SplatPlane::Whole more = splats.sums_[i][channel];
        if (isMuch(sum) || isMuch(more))
          throw std::runtime_error("more light has landed in a pixel than its paths can bring");
        sum += more;
      }
  }

  template <class T>
  static void putAll(Writer& to, const std::vector<T>& values) {
    to.put(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) to.put(value);
  }
  template <class T>
  static void takeAll(Reader& from, std::vector<T>& values) {
    const auto count = from.take<std::uint64_t>();
    if (count > from.left() / sizeof(T)) throw std::runtime_error("it ends too early");
    values.resize(static_cast<std::size_t>(count));
    for (T& value : values) value = from.take<T>();
  }

  static void put(Writer& to, const CornerSamples::Level& level) {
    to.put(level.area);
    putAll(to, level.starts);
    putAll(to, level.corners);
    for (const std::vector<Color>& values : level.values) putAll(to, values);
  }
  static void take(Reader& from, CornerSamples::Level& level, std::size_t values) {
    level.area = from.take<Tile>();
    takeAll(from, level.starts);
    takeAll(from, level.corners);
    level.values.resize(values);
    for (std::vector<Color>& all : level.values) {
      takeAll(from, all);
      if (all.size() != level.corners.size())
        throw std::runtime_error("its corners have too few or too many values");
    }
  }

  /// Throws unless the tile's level holds the corners that a render looks at, and no others. Those of lower
  /// levels have been checked, of all tiles: they decide which these are.
  static void check(const CornerSamples& corners, const Tile& tile, const CornerSamples::Level& level,
                    int number) {
    const auto fail = [] { throw std::runtime_error("its corners are not those of the divided pixels"); };
    const Tile& all = corners.rules().area;
    const Tile area{std::max(tile.x0, all.x0), std::max(tile.y0, all.y0), std::min(tile.x1, all.x1),
                    std::min(tile.y1, all.y1)};
    if (!(level.area == area)) fail();
    std::vector<std::size_t> starts;
    std::vector<Corner> wanted;
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) {
        starts.push_back(wanted.size());
        const std::vector<Corner> ofPixel = corners.wanted(x, y, number);
        wanted.insert(wanted.end(), ofPixel.begin(), ofPixel.end());
      }
    starts.push_back(wanted.size());
    if (level.starts != starts || level.corners != wanted) fail();
  }

  /// How many levels of each tile are saved: a wave looks at the corners of those before in all tiles, so
  /// none is two ahead of another; but while one tile is read others continue.
  static std::vector<std::size_t> levelsThere(const Film& film) {
    std::vector<std::size_t> levels;
    for (std::size_t i = 0; i < static_cast<std::size_t>(film.tiles()); ++i) {
      const std::lock_guard lock(film.states_[i].mutex);
      levels.push_back(film.states_[i].waves);
    }
    const std::size_t most = *std::min_element(levels.begin(), levels.end()) + 1;
    for (std::size_t& level : levels) level = std::min(level, most);
    return levels;
  }

  static void takeCorners(Reader& from, Film& film) {
    CornerSamples& corners = *film.corners_;
    std::size_t least = film.waves_.size(), most = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(film.tiles()); ++i) {
      const std::size_t levels = takeWaves(from, film.waves_.size());
      film.states_[i].waves = levels;
      least = std::min(least, levels);
      most = std::max(most, levels);
      for (std::size_t level = 0; level < levels; ++level) {
        CornerSamples::Level taken;
        take(from, taken, film.layers_.size() + 1);
        corners.put(i, level, std::move(taken));
      }
    }
    if (most > least + 1) throw std::runtime_error("a tile is further than the corners around it allow");
    for (std::size_t level = 0; level < most; ++level)
      for (std::size_t i = 0; i < static_cast<std::size_t>(film.tiles()); ++i)
        if (level < film.states_[i].waves)
          check(corners, film.tile(static_cast<std::int64_t>(i)), corners.level(i, level),
                static_cast<int>(level));
  }

  /// A tile's number of waves, of those that are known.
  static std::size_t takeWaves(Reader& from, std::size_t known) {
    const std::size_t waves = from.take<std::uint32_t>();
    if (waves > known) throw std::runtime_error("a tile has more waves than there are");
    return waves;
  }

  static std::string saved(const Film& film) {
    Writer to;
    const auto splats = film.lockSplats();
    to.put(kMark);
    to.put(film.width_);
    to.put(film.height_);
    to.put(film.tileSize_);
    to.put(static_cast<std::uint32_t>(film.layers_.size()));
    to.put(static_cast<std::uint32_t>(film.waves_.size()));
    for (const Wave& wave : film.waves_) to.put(wave.end);
    to.put(static_cast<std::uint8_t>(film.takesSplats()));
    if (film.takesSplats()) put(to, *film.splats_);
    if (film.firstSplats_) put(to, *film.firstSplats_);
    if (film.corners_) {
      const std::vector<std::size_t> levels = levelsThere(film);
      for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::lock_guard lock(film.states_[i].mutex);
        to.put(static_cast<std::uint32_t>(levels[i]));
        for (std::size_t level = 0; level < levels[i]; ++level) put(to, film.corners_->level(i, level));
      }
      return std::move(to.bytes());
    }
    for (std::int64_t i = 0; i < film.tiles(); ++i) {
      const Film::TileState& state = film.states_[static_cast<std::size_t>(i)];
      const std::lock_guard lock(state.mutex);
      const std::size_t there = film.owns(i) ? state.waves : 0;
      to.put(static_cast<std::uint32_t>(there));
      if (there == 0) continue;
      const Tile area = film.tile(i);
      for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
          put(to, film.pixels_.at(x, y));
          if (film.noise_ > 0) to.put(film.firstErrors_[film.index(x, y)]);
          for (const Film::Layer& layer : film.layers_) put(to, layer, film.index(x, y));
          if (film.keepsHalves()) put(to, film.first_[film.index(x, y)]);
        }
    }
    return std::move(to.bytes());
  }

  /// The waves of what saved() gave of a film like this one, from its start.
  static std::vector<Wave> takeHead(Reader& from, const Film& film) {
    from.expect(kMark, "it was written by another kind of machine");
    from.expect(film.width_, "it is of another size");
    from.expect(film.height_, "it is of another size");
    from.expect(film.tileSize_, "its tiles are of another size");
    from.expect(static_cast<std::uint32_t>(film.layers_.size()), "it has other passes");
    std::vector<Wave> waves;
    for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
      const int first = waves.empty() ? 0 : waves.back().end, end = from.take<int>();
      if (end <= first || end - first > longestWave(first))
        throw std::runtime_error("its waves of samples make no sense");
      waves.push_back({first, end});
    }
    if (waves.empty()) throw std::runtime_error("it has no samples");
    return waves;
  }

  static void takeFirstError(Reader& from, float& error) {
    error = from.take<float>();
    if (!(error >= 0)) throw std::runtime_error("an error is negative or no number");
  }

  /// The pixels of a tile that has these waves.
  static void takeTile(Reader& from, Film& film, std::int64_t tile, std::span<const Wave> there) {
    const Tile area = film.tile(tile);
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x) {
        PixelSum pixel;
        take(from, pixel);
        checkTaken(film, pixel, there);
        const int taken = pixel.taken_;
        film.pixels_.put(x, y, std::move(pixel));
        if (film.noise_ > 0) takeFirstError(from, film.firstErrors_[film.index(x, y)]);
        for (Film::Layer& layer : film.layers_) take(from, layer, film.index(x, y), taken);
        if (film.keepsHalves()) take(from, film.first_[film.index(x, y)]);
      }
  }

  /// Throws with the film half changed.
  static void restore(Film& film, std::string_view bytes) {
    Reader from(bytes);
    std::vector<Wave> waves = takeHead(from, film);
    if (film.corners_) {
      if (waves.size() != film.waves_.size() || waves.back().end != film.waves_.back().end)
        throw std::runtime_error("its pixels are divided more or less often");
      from.expect(static_cast<std::uint8_t>(film.takesSplats()), "it was made in another way");
      takeCorners(from, film);
      if (!from.atEnd()) throw std::runtime_error("it continues where it should end");
      return;
    }
    const int asked = film.waves_.back().end;
    const std::size_t wavesSaved = waves.size();
    while (waves.back().end > asked && waves.size() > 1) waves.pop_back();
    const std::size_t known = waves.size();
    for (const Wave& wave : wavesOf(asked, waves.back().end)) waves.push_back(wave);
    film.waves_ = std::move(waves);
    from.expect(static_cast<std::uint8_t>(film.takesSplats()), "it was made in another way");
    if (film.takesSplats()) take(from, *film.splats_);
    if (film.firstSplats_) takeFirst(from, *film.firstSplats_, *film.splats_);
    for (std::int64_t i = 0; i < film.tiles(); ++i) {
      Film::TileState& state = film.states_[static_cast<std::size_t>(i)];
      state.waves = takeWaves(from, wavesSaved);
      if (state.waves > known)
        throw TooManySamples("it has more samples a pixel than the " + std::to_string(asked) +
                             " that are asked for");
      if (state.waves == 0) continue;
      if (!film.owns(i)) throw std::runtime_error("it has a tile of another part");
      takeTile(from, film, i, {film.waves_.data(), state.waves});
    }
    if (!from.atEnd()) throw std::runtime_error("it continues where it should end");
  }

  /// Throws with the film half changed.
  static void merge(Film& film, std::string_view bytes, const TileShare& share) {
    if (share.count == 1) {
      restore(film, bytes);
      if (!film.complete()) throw std::runtime_error("it is not finished");
      return;
    }
    if (film.corners_) throw std::runtime_error("its pixels are divided");
    Reader from(bytes);
    const std::vector<Wave> waves = takeHead(from, film);
    if (const int has = waves.back().end, asked = film.waves_.back().end; has != asked)
      throw std::runtime_error("it has " + std::to_string(has) + " samples a pixel and not " +
                               std::to_string(asked));
    from.expect(static_cast<std::uint8_t>(film.takesSplats()), "it was made in another way");
    if (film.takesSplats()) {
      SplatPlane splats(film.width_, film.height_), first(film.width_, film.height_);
      take(from, splats);
      constexpr std::int64_t kMostPaths = std::int64_t{1} << 62;
      if (splats.paths_ > kMostPaths - film.splats_->paths_)
        throw std::runtime_error("its number of paths makes no sense");
      add(*film.splats_, splats);
      if (film.firstSplats_) {
        takeFirst(from, first, splats);
        add(*film.firstSplats_, first);
      }
    }
    for (std::int64_t i = 0; i < film.tiles(); ++i) {
      const bool expected = film.isIn(share, i);
      if (takeWaves(from, waves.size()) != (expected ? waves.size() : 0))
        throw std::runtime_error("it has other tiles than this part of the picture");
      if (!expected) continue;
      std::size_t& there = film.states_[static_cast<std::size_t>(i)].waves;
      if (there > 0) throw std::runtime_error("another part has brought its tiles already");
      takeTile(from, film, i, waves);
      there = film.waves_.size();
    }
    if (!from.atEnd()) throw std::runtime_error("it continues where it should end");
  }

  static void clear(Film& film, std::vector<Wave> waves) {
    film.waves_ = std::move(waves);
    film.pixels_.clear();
    std::fill(film.firstErrors_.begin(), film.firstErrors_.end(), 0.0f);
    for (Film::Layer& layer : film.layers_) {
      std::fill(layer.sums.pixels.begin(), layer.sums.pixels.end(), Color(0));
      std::fill(layer.below.pixels.begin(), layer.below.pixels.end(), Color(0));
      for (auto& counts : layer.counts) counts.clear();
    }
    for (std::int64_t i = 0; i < film.tiles(); ++i) film.states_[static_cast<std::size_t>(i)].waves = 0;
    std::fill(film.first_.begin(), film.first_.end(), WeightedMean{});
    if (film.takesSplats()) film.takeSplats();
    if (film.keepsHalves()) film.keepHalves();
    if (film.corners_) film.corners_->clear();
  }
};

void Film::clear() { FilmState::clear(*this, waves_); }

std::string Film::saved() const { return FilmState::saved(*this); }

void Film::restore(std::string_view bytes) {
  const std::vector<Wave> before = waves_;
  try {
    FilmState::restore(*this, bytes);
  } catch (...) {
    FilmState::clear(*this, before);
    throw;
  }
}

void Film::merge(std::string_view bytes, const TileShare& share) {
  const std::vector<Wave> before = waves_;
  try {
    FilmState::merge(*this, bytes, share);
  } catch (...) {
    FilmState::clear(*this, before);
    throw;
  }
}

}  // namespace trace
