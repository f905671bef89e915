#include "render/chains/metropolis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/budget.h"
#include "image/srgb.h"
#include "math/low_discrepancy.h"
#include "math/noise.h"
#include "render/integrators/make_integrator.h"

namespace trace {
namespace {

/// How bright a sample is to a chain. A filter may take light away: that has to be found, too.
Real lightOf(const Splat& sample) { return isFinite(sample.value) ? std::abs(luminanceOf(sample.value)) : 0; }

Real pixelsOf(const Tile& area) { return Real{1} * (area.x1 - area.x0) * (area.y1 - area.y0); }

/// Other samples than those at which chains may start.
constexpr std::uint64_t kBrightness = 0x627269676874ull;

/// A sample where a chain is, and how often it has been there, on the average over all that chance could do.
struct Stop {
  std::vector<Splat> splats;
  Real light = 0;
  Real visits = 0;
};

/// Takes the sample of the numbers: what it brings to its own pixel, and to others. Keeps its memory.
class Sampling {
 public:
  Sampling(PixelTracer& tracer, const Tile& area) : tracer_(tracer), area_(area), pixels_(pixelsOf(area)) {
    tracer_.collect(&thrown_);
  }
  ~Sampling() { tracer_.collect(nullptr); }
  Sampling(const Sampling&) = delete;
  Sampling& operator=(const Sampling&) = delete;

  void take(SampleNumbers& numbers, Stop& stop) {
    thrown_.clear();
    stop.splats.clear();
    stop.light = 0;
    stop.splats.push_back(tracer_.sample(numbers, area_));
    if (!isFinite(stop.splats.front().value)) ++tracer_.tracer().statistics().badSamples;
    for (const Splat& splat : thrown_)
      if (splat.x >= area_.x0 && splat.x < area_.x1 && splat.y >= area_.y0 && splat.y < area_.y1)
        stop.splats.push_back({splat.x, splat.y, splat.value * (1 / pixels_)});
    for (const Splat& splat : stop.splats) stop.light += lightOf(splat);
  }
  /// How bright the sample is, alone.
  Real lightAt(SampleNumbers& numbers) {
    take(numbers, looked_);
    return looked_.light;
  }
  Real pixels() const { return pixels_; }
  PixelTracer& tracer() { return tracer_; }

 private:
  PixelTracer& tracer_;
  const Tile& area_;
  Real pixels_;
  std::vector<Splat> thrown_;
  Stop looked_;
};

/// Numbers of one of many samples that are spread evenly over the picture, whose place is drawn first. The
/// others are independent: pairs of Sobol's points that are matched at random are no better where many count
/// together, but up to twice as bad.
class EvenSample final : public SampleNumbers {
 public:
  EvenSample(std::uint64_t seed, std::uint32_t sample)
      : seed_(seed), own_(mixBits(seed ^ mixBits(sample))), sample_(sample) {}
  Vec2 pair(std::uint64_t branch) override {
    if (!first_) first_ = branch;
    if (branch == *first_) return sobolPoint(sample_, seed_);
    const std::uint64_t bits = mixBits(own_ ^ branch);
    return {unitFromBits(bits), unitFromBits(mixBits(bits))};
  }

 private:
  std::uint64_t seed_, own_;
  std::uint32_t sample_;
  std::optional<std::uint64_t> first_;
};

}  // namespace

/// Takes so many samples, each once, side by side.
template <class Take>
void Metropolis::look(std::span<const Moment> moments, std::int64_t samples, Job& job,
                      const std::function<void()>& interrupt, const Take& take) const {
  constexpr std::int64_t kChunk = 1024;
  const std::int64_t chunks = (samples + kChunk - 1) / kChunk;
  Work work("looking for light", chunks);
  std::atomic<std::int64_t> looked{0};
  Job looking;  // the other one counts what is done of the picture
  parallelChunks(chunks, settings_.threads, looking, [&](std::int64_t chunk, int) {
    if (job.cancel) looking.cancel = true;
    if (looking.cancel) return;
    Budget budget(interrupt);
    const BudgetScope scope(&budget);
    PixelTracer tracer(moments, settings_, size_);
    Sampling sampling(tracer, area_);
    for (std::int64_t n = chunk * kChunk; n < std::min(samples, (chunk + 1) * kChunk); ++n) take(sampling, n);
    work.reached(++looked);
  });
}

Metropolis::Metropolis(std::span<const Moment> moments, const Settings& settings, const Size& size, Job& job,
                       const std::function<void()>& interrupt)
    : moments_(moments), settings_(settings), size_(size), area_(areaOf(settings.region, size)) {
  settings_.sampling = SampleKind::random;  // no grid: a chain moves without steps
  settings_.noiseTarget = 0;
  settings_.denoise = false;
  if (changesPaths(settings_))
    paths_ = std::make_unique<const veach::Chains>(moments_, settings_, size_, area_);
  sums_ = startLights(job, interrupt);
  if (job.cancel) return;
  std::tie(mean_, error_) = wholeLight(job, interrupt);
  for (std::size_t n = 1; n < sums_.size(); ++n) sums_[n] += sums_[n - 1];
  if (!(sums_.back() > 0)) mean_ = 0;  // there is no place to start at
  if (!(mean_ > 0)) error_ = kInfinity;
}

/// How bright the samples are at which chains may start.
std::vector<Real> Metropolis::startLights(Job& job, const std::function<void()>& interrupt) const {
  std::vector<Real> found(static_cast<std::size_t>(settings_.chainStarts));
  look(moments_, std::ssize(found), job, interrupt, [&](Sampling& sampling, std::int64_t n) {
    const auto number = static_cast<std::uint64_t>(n);
    StartSample numbers(seedOf(number));
    found[static_cast<std::size_t>(n)] =
        paths_ ? paths_->light(sampling.tracer(), seedOf(number)) : sampling.lightAt(numbers);
  });
  return found;
}

/// How bright the picture is, and the standard error as a part of that, by samples of their own: each shows
/// all ways to put its paths together. Those at which chains start tell it less exactly: among them a few
/// count a thousand times as much as most, and it is random how many see a small lamp. They are spread
/// evenly, all of them better than each of several parts, whose means so tell an error that is rather larger
/// than the true one.
std::pair<Real, Real> Metropolis::wholeLight(Job& job, const std::function<void()>& interrupt) const {
  constexpr std::int64_t kParts = 16;
  const std::int64_t samples = (brightnessSamples() + kParts - 1) / kParts * kParts;
  std::vector<Real> found(static_cast<std::size_t>(samples));
  const std::uint64_t seed = mixBits(static_cast<std::uint64_t>(settings_.seed) ^ kBrightness);
  if (paths_) {
    look(moments_, samples, job, interrupt, [&](Sampling& sampling, std::int64_t n) {
      found[static_cast<std::size_t>(n)] =
          paths_->brightness(sampling.tracer(), seed, static_cast<std::uint32_t>(n));
    });
  } else {
    Settings settings = settings_;
    settings.integrator = settings.chains == Chains::bdpt ? IntegratorKind::bdpt : IntegratorKind::path;
    settings.lightVertices = settings.cameraVertices = -1;
    settings.unweighted = false;
    std::vector<std::unique_ptr<const Integrator>> integrators;
    std::vector<Moment> moments;
    for (const Moment& moment : moments_) {
      integrators.push_back(makeIntegrator(*moment.world, settings, job));
      moments.push_back({moment.world, integrators.back().get()});
    }
    look(moments, samples, job, interrupt, [&](Sampling& sampling, std::int64_t n) {
      EvenSample numbers(seed, static_cast<std::uint32_t>(n));
      found[static_cast<std::size_t>(n)] = sampling.lightAt(numbers);
    });
  }
  std::array<Real, kParts> parts{};
  for (std::int64_t n = 0; n < samples; ++n)
    parts[static_cast<std::size_t>(n * kParts / samples)] +=
        found[static_cast<std::size_t>(n)] * kParts / static_cast<Real>(samples);
  Real mean = 0, squares = 0;
  for (const Real part : parts) mean += part / kParts;
  for (const Real part : parts) squares += (part - mean) * (part - mean);
  return {mean, std::sqrt(squares / (kParts * (kParts - 1))) / mean};
}

std::int64_t Metropolis::brightnessSamples() const {
  return std::int64_t{settings_.chainStarts} * (paths_ ? 8 : 1);
}

/// How bright the picture is, for a chain: by samples taken first and by one more for each kEvery of its
/// moves. So the more chains there are, the less the first samples decide. What chains before it have found
/// it does not know, but counts: on the average over all chains its own samples stand for theirs, and all of
/// them are spread evenly together.
Real Metropolis::meanFor(PixelTracer& tracer, std::int64_t moves, std::int64_t before) const {
  constexpr std::int64_t kEvery = 8;
  const std::int64_t own = moves / kEvery, since = before / kEvery;
  if (!paths_ || own == 0 || since == 0) return mean_;
  constexpr std::uint64_t kOnTheWay = 0x6f6e746865ull;
  const std::uint64_t seed = mixBits(static_cast<std::uint64_t>(settings_.seed) ^ kOnTheWay);
  Real sum = 0;
  for (std::int64_t n = 0; n < own; ++n)
    sum += paths_->brightness(tracer, seed, static_cast<std::uint32_t>(since + n));
  const Real first = static_cast<Real>(brightnessSamples()), others = static_cast<Real>(since);
  return (first * mean_ + others * sum / static_cast<Real>(own)) / (first + others);
}

PrimarySample Metropolis::startOf(std::uint64_t number, std::uint64_t moves) const {
  return {seedOf(number), moves, settings_.moveSize};
}

std::uint64_t Metropolis::seedOf(std::uint64_t start) const {
  return mixBits(static_cast<std::uint64_t>(settings_.seed) ^ mixBits(start + 1));
}

std::uint64_t Metropolis::numberOf(std::int64_t tile, int firstSample) {
  return mixBits(static_cast<std::uint64_t>(tile) << 32 | static_cast<std::uint32_t>(firstSample));
}

std::vector<Splat> Metropolis::chain(PixelTracer& tracer, std::uint64_t number, std::int64_t moves,
                                     const ChainWatch& watch, std::int64_t before) const {
  std::vector<Splat> splats;
  if (!(mean_ > 0)) return splats;
  constexpr std::uint64_t kChains = 0x636861696e73ull;  // other numbers than those of the starts
  std::uint64_t chances = mixBits(mixBits(static_cast<std::uint64_t>(settings_.seed) ^ kChains) ^ number);
  const auto chance = [&] { return unitFromBits(chances = mixBits(chances)); };
  const auto from = std::upper_bound(sums_.begin(), sums_.end() - 1, chance() * sums_.back());
  const auto start = static_cast<std::uint64_t>(from - sums_.begin());
  if (paths_) {
    const Real mean = meanFor(tracer, moves, before);
    return paths_->chain(tracer, seedOf(start), mixBits(chances), moves, mean, watch);
  }
  PrimarySample numbers = startOf(start, mixBits(chances));
  Sampling samples(tracer, area_);
  // A chain's samples and those taken anywhere are two ways to choose, weighed by the balance heuristic: how
  // often both choose this one, for each move and on the average, is the density of the two.
  const auto leave = [&](const Stop& at) {
    if (!(at.light > 0)) return;
    const Real counts = samples.pixels() * at.visits / (at.light / mean_ + settings_.moveAnywhere);
    for (const Splat& splat : at.splats) splats.push_back({splat.x, splat.y, splat.value * counts});
  };

  Stop here, there;
  samples.take(numbers, here);
  const OfferedSample again = [&](PixelTracer& other) { return other.sample(numbers, area_); };
  const auto tell = [&](ChainMove move, const Stop& at) {
    // Its own pixel, or one that a path from a light came to.
    const Splat& to =
        *std::max_element(at.splats.begin(), at.splats.end(),
                          [](const Splat& a, const Splat& b) { return lightOf(a) < lightOf(b); });
    move.x = to.x, move.y = to.y, move.brings = to.value, move.light = at.light;
    watch(move, again);
  };
  if (watch) tell({.number = -1, .kind = MoveKind::anywhere}, here);
  for (std::int64_t n = 0; n < moves; ++n) {
    const bool anywhere = chance() < settings_.moveAnywhere;
    const MoveKind kind = anywhere ? MoveKind::anywhere : MoveKind::nearby;
    anywhere ? numbers.moveAnywhere() : numbers.moveNearby();
    samples.take(numbers, there);
    const Real accepts = here.light > 0 ? std::min(1.0, there.light / here.light) : 1;
    there.visits = accepts + (anywhere ? 1 : 0);
    here.visits += 1 - accepts;
    const bool goes = chance() < accepts;
    if (watch)
      tell({.number = n, .kind = kind, .before = here.light, .chance = accepts, .made = goes}, there);
    if (goes) std::swap(here, there);
    goes ? numbers.keep() : numbers.undo();
    leave(there);
    tracer.tracer().statistics().count(kind, goes);
  }
  leave(here);
  return splats;
}

}  // namespace trace
