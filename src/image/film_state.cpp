// A film as bytes and back, so that a render can go on after its process ended: Film::saved, Film::restore.
//
// Numbers stand as they do in memory, so that the same machine, or one like it, goes on with the same bits.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "image/film.h"

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
    to.put(pixel.taken_);
    to.put(pixel.squares_);
    put(to, pixel.colors_);
  }

  static void put(Writer& to, const WeightedMean& mean) {
    const bool alike = mean.sum_ == mean.above_ && mean.weights_ == mean.weightsAbove_;  // nearly always
    to.put(static_cast<std::uint8_t>(alike));
    to.put(mean.sum_);
    to.put(mean.weights_);
    if (alike) return;
    to.put(mean.above_);
    to.put(mean.weightsAbove_);
  }

  static void take(Reader& from, PixelSum& pixel) {
    pixel.taken_ = from.take<int>();
    pixel.squares_ = from.take<double>();
    take(from, pixel.colors_);
  }

  static void take(Reader& from, WeightedMean& mean) {
    const bool alike = from.take<std::uint8_t>() != 0;
    mean.sum_ = from.take<Color>();
    mean.weights_ = from.take<double>();
    mean.above_ = alike ? mean.sum_ : from.take<Color>();
    mean.weightsAbove_ = alike ? mean.weights_ : from.take<double>();
  }

  static void put(Writer& to, const SplatPlane& splats) {
    to.put(splats.paths_);
    for (const SplatPlane::Sum& sum : splats.sums_) to.put(sum);
  }
  static void take(Reader& from, SplatPlane& splats) {
    splats.paths_ = from.take<std::int64_t>();
    for (SplatPlane::Sum& sum : splats.sums_) sum = from.take<SplatPlane::Sum>();
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
    for (std::vector<Color>& all : level.values) takeAll(from, all);
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
    for (std::int64_t i = 0; i < film.tiles(); ++i) {
      const Film::TileState& state = film.states_[static_cast<std::size_t>(i)];
      const std::lock_guard lock(state.mutex);
      to.put(static_cast<std::uint32_t>(state.waves));
      if (film.corners_)
        for (std::size_t level = 0; level < state.waves; ++level)
          put(to, film.corners_->level(static_cast<std::size_t>(i), level));
      if (state.waves == 0 || film.corners_) continue;
      const Tile area = film.tile(i);
      for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
          put(to, film.pixels_[film.index(x, y)]);
          if (film.noise_ > 0) to.put(film.pixels_[film.index(x, y)].firstError_);
          for (const Film::Layer& layer : film.layers_) to.put(layer.sums.at(x, y));
          if (film.keepsHalves()) put(to, film.first_[film.index(x, y)]);
        }
    }
    return std::move(to.bytes());
  }

  /// Throws with the film half changed.
  static void restore(Film& film, std::string_view bytes) {
    Reader from(bytes);
    from.expect(kMark, "it was written by another kind of machine");
    from.expect(film.width_, "it is of another size");
    from.expect(film.height_, "it is of another size");
    from.expect(film.tileSize_, "its tiles are of another size");
    from.expect(static_cast<std::uint32_t>(film.layers_.size()), "it has other passes");
    std::vector<Wave> waves;
    for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
      const int first = waves.empty() ? 0 : waves.back().end, end = from.take<int>();
      if (end <= first) throw std::runtime_error("its waves of samples make no sense");
      waves.push_back({first, end});
    }
    if (waves.empty()) throw std::runtime_error("it has no samples");
    const int asked = film.waves_.back().end, planned = waves.back().end;
    while (waves.back().end > asked && waves.size() > 1) waves.pop_back();
    const std::size_t known = waves.size();
    for (const Wave& wave : wavesOf(asked, waves.back().end)) waves.push_back(wave);
    film.waves_ = std::move(waves);
    from.expect(static_cast<std::uint8_t>(film.takesSplats()), "it was made in another way");
    if (film.takesSplats()) take(from, *film.splats_);
    for (std::int64_t i = 0; i < film.tiles(); ++i) {
      Film::TileState& state = film.states_[static_cast<std::size_t>(i)];
      state.waves = from.take<std::uint32_t>();
      if (state.waves > known && planned > asked)
        throw std::runtime_error("it has more samples a pixel than the " + std::to_string(asked) +
                                 " that are asked for");
      if (state.waves > known) throw std::runtime_error("a tile has more waves than there are");
      if (film.corners_)
        for (std::size_t level = 0; level < state.waves; ++level) {
          CornerSamples::Level taken;
          take(from, taken, film.layers_.size() + 1);
          film.corners_->put(static_cast<std::size_t>(i), level, std::move(taken));
        }
      if (state.waves == 0 || film.corners_) continue;
      const Tile area = film.tile(i);
      for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
          take(from, film.pixels_[film.index(x, y)]);
          if (film.noise_ > 0) film.pixels_[film.index(x, y)].firstError_ = from.take<float>();
          for (Film::Layer& layer : film.layers_) layer.sums.at(x, y) = from.take<Color>();
          if (film.keepsHalves()) take(from, film.first_[film.index(x, y)]);
        }
    }
    if (!from.atEnd()) throw std::runtime_error("it goes on where it should end");
  }

  static void clear(Film& film, std::vector<Wave> waves) {
    film.waves_ = std::move(waves);
    std::fill(film.pixels_.begin(), film.pixels_.end(), PixelSum{});
    for (Film::Layer& layer : film.layers_)
      std::fill(layer.sums.pixels.begin(), layer.sums.pixels.end(), Color(0));
    for (std::int64_t i = 0; i < film.tiles(); ++i) film.states_[static_cast<std::size_t>(i)].waves = 0;
    std::fill(film.first_.begin(), film.first_.end(), WeightedMean{});
    if (film.takesSplats()) film.takeSplats();
    if (film.corners_) film.corners_->clear();
  }
};

std::string Film::saved() const { return FilmState::saved(*this); }

void Film::restore(std::string_view bytes) {
  const std::vector<Wave> before = waves_;
  try {
    FilmState::restore(*this, bytes);
  } catch (const std::runtime_error&) {
    FilmState::clear(*this, before);
    throw;
  }
}

}  // namespace trace
