#include "render/samples/sampler.h"

#include <array>
#include <cmath>

#include "math/low_discrepancy.h"
#include "scene/integrators.h"

namespace trace {
namespace {

std::uint32_t number(int k) { return static_cast<std::uint32_t>(k); }

/// Independent numbers. For comparison with the others; not for pictures, where each of them has less noise.
Vec2 randomPair(const Draw& d) {
  const std::uint64_t bits = mixBits(d.pixel ^ mixBits(number(d.k)));
  return {unitFromBits(bits), unitFromBits(mixBits(bits))};
}

/// Which of count cells the sample has, in an order of the draw's own. Of few cells Kensler's hash knows but
/// a few orders, in which two draws would keep the same samples together.
std::uint32_t cellOf(const Draw& d, std::uint32_t count) {
  switch (count) {
    case 4: return permutedOf<4>(number(d.k), d.pixel);
    case 9: return permutedOf<9>(number(d.k), d.pixel);
    default: return permuted(number(d.k), count, d.pixel);
  }
}

/// One in each cell of a grid, the cells in an order of their own. For pictures as in Cook 1986; not for
/// edges that are nearly upright or level, because rows and columns are not filled evenly.
Vec2 jitteredPair(const Draw& d) {
  const std::uint32_t n = number(d.rules.grid()), cell = cellOf(d, n * n);
  const Vec2 within = randomPair(d);
  return {(cell % n + within.x) / n, (cell / n + within.y) / n};
}

/// Kensler, Correlated Multi-Jittered Sampling, 2013: the same, and of n x n samples one lies in each of n x
/// n columns and rows. For a square number of samples that is known before; not where more are added later.
Vec2 multiJitteredPair(const Draw& d) {
  const std::uint32_t n = number(d.rules.grid()), cell = cellOf(d, n * n);
  const std::uint32_t column = permuted(cell % n, n, d.pixel ^ 1), row = permuted(cell / n, n, d.pixel ^ 2);
  const Vec2 within = randomPair(d);
  return {(cell % n + (row + within.x) / n) / n, (cell / n + (column + within.y) / n) / n};
}

/// For any number of samples, best 6, 36, 216; not for 2, 4, 8, ... samples of paths, where sobol also
/// spreads the direction from a vertex together with the point on the lamp.
Vec2 haltonPair(const Draw& d) { return haltonPoint(number(d.k), d.pixel); }
/// For paths, best with 2, 4, 8, ... samples; not for so few that noise is visible, where blue is finer. The
/// grid takes it for all but the camera rays: for pictures of the courses; not for patterns as fine as
/// pixels.
Vec2 sobolPair(const Draw& d) { return sobolPoint(number(d.k), d.pixel); }
Real sobolFirst(const Draw& d) { return sobolPair(d).x; }
Vec2 sobolSecondPair(const Draw& d) { return sobolPointBeside(number(d.k), d.pixel); }
Vec2 sobolBothPairs(const Draw& d, Vec2& second) {
  const std::uint32_t k = sobolOrder(number(d.k), d.pixel);
  second = sobolPointBesideInOrder(k, d.pixel);
  return sobolPointInOrder(k, d.pixel);
}

/// Bits of v at the even places.
constexpr std::uint32_t spread(std::uint32_t v) {
  v &= 0xffffu;
  v = (v | v << 8) & 0x00ff00ffu;
  v = (v | v << 4) & 0x0f0f0f0fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
}

/// Ahmed and Wonka, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
/// of Pixels, 2020: one sequence for all pixels, along a curve whose quarters stand in random order at each
/// level. What a pixel gets too much, its neighbours get too little. For a picture of few samples; not where
/// more are added later.
Vec2 bluePair(const Draw& d) {
  int digits = 0;  // digits in base 4 of the number of a sample
  while ((std::int64_t{1} << (2 * digits)) < d.rules.samples()) ++digits;
  const std::uint64_t place = std::uint64_t{spread(number(d.x)) | spread(number(d.y)) << 1} << (2 * digits);
  const std::uint64_t index = place | number(d.k);
  const std::uint64_t shuffled =
      shuffledDigits<4>(index, 16 + digits, d.branch,
                        [](std::uint32_t digit, std::uint64_t prefix) { return permuted(digit, 4, prefix); });
  return sobolPoint(static_cast<std::uint32_t>(shuffled), d.branch);
}

constexpr std::array kGenerators{
    GeneratorRow{SampleKind::grid, "grid", "camera rays on a regular grid in each pixel, all else by sobol",
                 true, false, sobolPair, sobolFirst, sobolSecondPair, sobolBothPairs},
    GeneratorRow{SampleKind::random, "random", "independent of one another", false, true, randomPair},
    GeneratorRow{SampleKind::jittered, "jittered", "one at random in each cell of a grid", true, false,
                 jitteredPair},
    GeneratorRow{SampleKind::stratified, "stratified",
                 "jittered so that rows and columns are filled evenly, too", true, false, multiJitteredPair},
    GeneratorRow{SampleKind::halton, "halton", "Halton's sequence in bases 2 and 3, scrambled", false, true,
                 haltonPair},
    GeneratorRow{SampleKind::sobol, "sobol", "Sobol's sequence, scrambled as Owen does", false, true,
                 sobolPair, sobolFirst, sobolSecondPair, sobolBothPairs},
    GeneratorRow{SampleKind::blue, "blue", "sobol, with neighbouring pixels unlike each other: finer noise",
                 false, false, bluePair},
};

}  // namespace

std::span<const GeneratorRow> generators() { return kGenerators; }

const GeneratorRow& generatorOf(const Settings& settings) {
  // Some samples of a grid are a part of the pixel, of the others all of it.
  const bool anyNumber =
      (settings.noiseTarget > 0 || settings.denoise) && settings.sampling == SampleKind::grid;
  return kGenerators[static_cast<std::size_t>(anyNumber ? SampleKind::sobol : settings.sampling)];
}

bool subdivides(const Settings& settings) {
  return settings.subdivide > 0 && !hasTrait(settings, Trait::splats);
}

Subdivision subdivisionOf(const Settings& settings, const Size& size) {
  const bool under = settings.stereo == Stereo::overUnder;
  const bool two = settings.stereo != Stereo::off;
  return {settings.subdivide, settings.subdivideThreshold, areaOf(settings.region, size),
          two && !under ? size.width / 2 : 0, under ? (size.height + 1) / 2 : 0};
}

int samplesOf(const Settings& settings) {
  if (subdivides(settings)) return 1 << (2 * settings.subdivide);
  if (!generatorOf(settings).square) return settings.spp;
  const int side = static_cast<int>(std::ceil(std::sqrt(settings.spp)));
  return side * side;
}

SampleRules::SampleRules(const Settings& settings, const Size& size)
    : generator_(&generatorOf(settings)),
      filter_(settings.filter, settings.filterRadius),
      size_(size),
      samples_(samplesOf(settings)),
      grid_(static_cast<int>(std::sqrt(samples_))),
      seed_(static_cast<std::uint64_t>(settings.seed)),
      onGrid_(generator_->kind == SampleKind::grid),
      divides_(subdivides(settings)),
      toBorder_(settings.pixelPosition == PixelPosition::border) {
  // A cell of the grid is sampled where a whole pixel would be: at its lower left corner or centre.
  const Real within = settings.pixelPosition == PixelPosition::center ? 0.5 : 0.0;
  for (int cell = 0; cell < grid_; ++cell) places_.push_back((cell + within) / grid_);
}

Real SampleRules::place(int pixel, int cell, int pixels) const {
  if (!toBorder_) return (pixel + places_[static_cast<std::size_t>(cell)]) / pixels;
  const int last = pixels * grid_ - 1;
  return last > 0 ? static_cast<Real>(pixel * grid_ + cell) / last : 0.5;
}

FilmSample SampleRules::film(int x, int y, int k, const Vec2& u) const {
  const int fromBottom = size_.height - 1 - y;
  if (onGrid_ && filter_.isPixel())
    return {{place(x, k % grid_, size_.width), place(fromBottom, k / grid_, size_.height)}, 1};
  const auto within = [&](int cell) { return (cell + 0.5) / grid_; };
  const FilmSample sample = filter_.sample(onGrid_ ? Vec2{within(k % grid_), within(k / grid_)} : u);
  return {{(x + 0.5 + sample.place.x) / size_.width, (fromBottom + 0.5 + sample.place.y) / size_.height},
          sample.weight < 0 ? -1.0 : 1.0};  // what all have in common drops out of the mean
}

Vec2 SampleRules::corner(const CornerPlace& place) const {
  const auto along = [&](int pixel, int within, int pixels) {
    return (pixel * grid_ + within) / static_cast<Real>(pixels * grid_);
  };
  return {along(place.x, place.corner.x, size_.width),
          along(size_.height - 1 - place.y, place.corner.y, size_.height)};
}

namespace {

/// Corners of larger squares come first: the bits of both coordinates in turn, the highest first.
int orderOf(int x, int y, int side) {
  int order = 0;
  for (int bit = 0; (side >>= 1) > 0; ++bit)
    order |= ((x & side) != 0) << (2 * bit) | ((y & side) != 0) << (2 * bit + 1);
  return order;
}

}  // namespace

Sampler::Sampler(const SampleRules& rules, const CornerPlace& place)
    : Sampler(rules, place.x + place.corner.x / rules.grid(), place.y - place.corner.y / rules.grid(),
              orderOf(place.corner.x % rules.grid(), place.corner.y % rules.grid(), rules.grid())) {}

}  // namespace trace
