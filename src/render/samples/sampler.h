// The numbers of one sample of a pixel: where it lies in the picture, and every choice on its way.
//
// Each number is a function of (seed, pixel, sample, branch, dimension) and of nothing else, so that a
// picture has the same bits for any number of threads, and a pixel that is explained is the one that was
// rendered.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "image/film/pixel_filter.h"
#include "math/noise.h"
#include "render/samples/branch.h"
#include "render/samples/picture_size.h"

namespace trace {

class SampleRules;

/// Where a pair of numbers is drawn.
struct Draw {
  const SampleRules& rules;
  int x, y, k;           ///< the pixel and its sample
  std::uint64_t branch;  ///< a hash of the branch and the dimension
  std::uint64_t pixel;   ///< a hash of both and of the pixel
  /// The sampler where another pair is drawn.
  Draw beside() const { return {rules, x, y, k, mixBits(branch ^ kBeside), mixBits(pixel ^ kBeside)}; }

 private:
  static constexpr std::uint64_t kBeside = 0x62657369646521u;
};

/// THE table of generators: rules by which the samples of a pixel are spread. A new one is a row in
/// sampler.cpp and a value of SampleKind.
struct GeneratorRow {
  SampleKind kind;
  std::string_view name;
  std::string_view help;
  bool square;  ///< it takes 1, 4, 9, 16, ... samples
  /// The first samples of many are those of fewer, so that more can be added to a finished picture.
  bool continues;
  /// Two numbers from 0 up to 1: of all samples of a pixel they fill the square evenly.
  Vec2 (*pair)(const Draw& draw);
  /// The first of the two alone, where that takes less; else null.
  Real (*first)(const Draw& draw) = nullptr;
  /// Two more that with the pair fill four dimensions evenly; null: they have nothing to do with it.
  Vec2 (*second)(const Draw& draw) = nullptr;
  /// The pair and the second one, where both together take less; else null.
  Vec2 (*both)(const Draw& draw, Vec2& second) = nullptr;
};
std::span<const GeneratorRow> generators();
const GeneratorRow& generatorOf(const Settings& settings);

/// How many samples a pixel has: spp, or the next square number, as the generator has it. For divided pixels
/// it is the most that are one pixel's own.
int samplesOf(const Settings& settings);

/// Pixels are divided where their corners differ, instead of having samples of their own.
bool subdivides(const Settings& settings);
Subdivision subdivisionOf(const Settings& settings, const Size& size);

/// The data that the samplers of a picture share.
class SampleRules {
 public:
  SampleRules(const Settings& settings, const Size& size);

  int samples() const { return samples_; }  ///< number of samples of each pixel
  int grid() const { return grid_; }        ///< the square root of samples(), if the generator is square
  const Size& size() const { return size_; }
  const GeneratorRow& generator() const { return *generator_; }
  std::uint64_t seed() const { return seed_; }

  /// The generator "grid" places samples without numbers.
  bool onGrid() const { return onGrid_; }
  /// Where in the picture sample k of the pixel lies, from 0 to 1, (0, 0) at the bottom left, and what it
  /// counts in the pixel. Row y = 0 is the top. `u` places it in the pixel, unless onGrid().
  FilmSample film(int x, int y, int k, const Vec2& u) const;
  /// The weight of such a sample, where it is not a part of a mean: so much more.
  Real filterWeight() const { return filter_.weight(); }
  /// Calls use(x, y, share) for each pixel that sees that place of the picture: light that falls there and is
  /// spread evenly over the picture counts so much for the pixel.
  template <class Use>
  void spread(const Vec2& place, const Use& use) const {
    const Real x = place.x * size_.width, y = place.y * size_.height, reach = filter_.radius();
    const auto near = [&](Real at, int pixels) { return at > -reach - 1 && at < pixels + reach + 1; };
    if (!near(x, size_.width) || !near(y, size_.height)) return;  // a place may lie beyond all whole numbers
    const auto first = [&](Real at) { return std::max(0, static_cast<int>(std::ceil(at - reach - 0.5))); };
    const auto last = [&](Real at, int pixels) {
      return std::min(pixels - 1, static_cast<int>(std::floor(at + reach - 0.5)));
    };
    const Real all = Real{1} * size_.width * size_.height;
    for (int row = first(y); row <= last(y, size_.height); ++row)
      for (int column = first(x); column <= last(x, size_.width); ++column)
        use(column, size_.height - 1 - row,
            all * filter_.share(x - column - 0.5) * filter_.share(y - row - 0.5));
  }
  /// The middle of the pixel, likewise.
  Vec2 middle(int x, int y) const {
    return {(x + 0.5) / size_.width, (size_.height - 1 - y + 0.5) / size_.height};
  }
  /// The sampler of a corner of a pixel.
  Vec2 corner(const CornerPlace& place) const;
  /// From a sample to the next on the right and above, on the average.
  Vec2 spacing() const {
    const int across = divides_ ? 1 : grid_;
    return {1.0 / (size_.width * across), 1.0 / (size_.height * across)};
  }

 private:
  Real place(int pixel, int cell, int pixels) const;

  const GeneratorRow* generator_;
  PixelFilter filter_;
  Size size_;
  int samples_, grid_;
  std::uint64_t seed_;
  bool onGrid_;
  bool divides_;              ///< a sample is a corner
  bool toBorder_;             ///< the outermost rays go through the border of the picture
  std::vector<Real> places_;  ///< if they do not: of the cells of the grid within a pixel
};

/// Where a sample's numbers come from, if not from a generator.
class SampleNumbers {
 public:
  virtual ~SampleNumbers() = default;
  /// The two that are drawn there, from 0 up to 1: `branch` is a hash of the branch and the dimension.
  virtual Vec2 pair(std::uint64_t branch) = 0;
};

class Sampler {
 public:
  /// For sample 0 <= k < rules.samples(); the rules must outlive it.
  Sampler(const SampleRules& rules, int x, int y, int k)
      : rules_(&rules), x_(x), y_(y), k_(k), branch_(mixBits(rules.seed())) {
    const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    pixel_ = mixBits(bits(x) << 32 | bits(y));
  }

  /// For a sample whose numbers these are; they must outlive it, too.
  Sampler(const SampleRules& rules, SampleNumbers& numbers) : Sampler(rules, 0, 0, 0) { numbers_ = &numbers; }

  /// For a corner, whatever pixel it is said to be of: the numbers of the pixel whose lower left part it is
  /// in, so that the first samples of a generator are the corners of the larger squares.
  Sampler(const SampleRules& rules, const CornerPlace& place);

  /// Where in the picture the sample lies, and what it counts.
  FilmSample film() const {
    return rules_->film(x_, y_, k_, rules_->onGrid() ? Vec2{} : branch(Branch::film).next2());
  }

  /// The number of the sample in its pixel.
  int sample() const { return k_; }

  /// The next number, from 0 up to 1; the next two.
  Real next() {
    const Draw draw = nextDraw();
    if (numbers_) return numbers_->pair(draw.branch).x;
    const GeneratorRow& row = rules_->generator();
    return row.first ? row.first(draw) : row.pair(draw).x;
  }
  /// Leaves out a number, or a pair, that decides nothing, and gives 0: those after it stay what they are.
  Real skip() {
    ++dimension_;
    return 0;
  }
  Vec2 next2() {
    const Draw draw = nextDraw();
    return numbers_ ? numbers_->pair(draw.branch) : rules_->generator().pair(draw);
  }

  /// Two numbers that go with the pair that next2() gives first: of all samples of a pixel the four fill
  /// their space evenly, where the generator knows how.
  Vec2 second2() const {
    const Draw draw = drawAt(0);
    const GeneratorRow& row = rules_->generator();
    if (numbers_) return numbers_->pair(draw.beside().branch);
    return row.second ? row.second(draw) : row.pair(draw.beside());
  }

  /// next2(), and second2() where that takes less together.
  Vec2 next2(std::optional<Vec2>& second) {
    const GeneratorRow& row = rules_->generator();
    if (numbers_ || !row.both || dimension_ > 0) return next2();
    return row.both(nextDraw(), second.emplace());
  }

  /// Numbers of its own for the n-th ray that is sent from here, whatever has been drawn here and elsewhere:
  /// a changed depth, light or extra changes only its own rays.
  Sampler branch(std::uint32_t n) const {
    Sampler sampler(*this);
    sampler.branch_ = mixBits(branch_ + 1 + n);
    sampler.dimension_ = 0;
    return sampler;
  }
  /// The numbers of that decision, or of the n-th of several.
  Sampler branch(Branch decision, std::uint32_t n = 0) const {
    return branch(static_cast<std::uint32_t>(decision) + n);
  }

 private:
  Draw nextDraw() { return drawAt(dimension_++); }
  Draw drawAt(std::uint32_t dimension) const {
    const std::uint64_t branch = mixBits(branch_ ^ dimension);
    return {*rules_, x_, y_, k_, branch, mixBits(branch ^ pixel_)};
  }

  const SampleRules* rules_;
  int x_, y_, k_;
  std::uint64_t branch_;
  std::uint64_t pixel_;  ///< a hash of the pixel
  std::uint32_t dimension_ = 0;
  SampleNumbers* numbers_ = nullptr;
};

}  // namespace trace
