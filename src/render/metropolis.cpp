#include "render/metropolis.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "image/srgb.h"
#include "math/noise.h"

namespace trace {
namespace {

/// How bright a sample is to a chain. A filter may take light away: that has to be found, too.
Real lightOf(const Splat& sample) { return isFinite(sample.value) ? std::abs(luminanceOf(sample.value)) : 0; }

/// A sample where a chain is, and how often it has been there, on the average over all that chance could do.
struct Stop {
  std::vector<Splat> splats;
  Real light = 0;
  Real target = 0;  ///< of that light
  Real visits = 0;
};

/// Takes the sample of the numbers: what it brings to its own pixel, and to others.
class Sampling {
 public:
  Sampling(PixelTracer& tracer, const Tile& area, const ChainTarget& target)
      : tracer_(tracer),
        area_(area),
        target_(target),
        pixels_(Real{1} * (area.x1 - area.x0) * (area.y1 - area.y0)) {
    tracer_.collect(&thrown_);
  }
  ~Sampling() { tracer_.collect(nullptr); }
  Sampling(const Sampling&) = delete;
  Sampling& operator=(const Sampling&) = delete;

  Stop at(PrimarySample& numbers) {
    thrown_.clear();
    Stop stop;
    stop.splats.push_back(tracer_.sample(numbers, area_));
    if (!isFinite(stop.splats.front().value)) ++tracer_.tracer().statistics().badSamples;
    for (const Splat& splat : thrown_)
      if (splat.x >= area_.x0 && splat.x < area_.x1 && splat.y >= area_.y0 && splat.y < area_.y1)
        stop.splats.push_back({splat.x, splat.y, splat.value * (1 / pixels_)});
    for (const Splat& splat : stop.splats) stop.light += lightOf(splat);
    stop.target = target_.of(stop.light);
    return stop;
  }
  Real pixels() const { return pixels_; }

 private:
  PixelTracer& tracer_;
  const Tile& area_;
  const ChainTarget& target_;
  Real pixels_;
  std::vector<Splat> thrown_;
};

}  // namespace

Metropolis::Metropolis(std::span<const Moment> moments, const Settings& settings, const Size& size, Job& job,
                       const std::function<void()>& interrupt)
    : moments_(moments), settings_(settings), size_(size), area_(areaOf(settings.region, size)) {
  settings_.sampling = SampleKind::random;  // no grid: a chain moves without steps
  settings_.noiseTarget = 0;
  settings_.denoise = false;
  constexpr std::int64_t kChunk = 1024;
  const std::int64_t starts = settings.chainStarts, chunks = (starts + kChunk - 1) / kChunk;
  sums_.resize(static_cast<std::size_t>(starts));
  Work work("looking for light", chunks);
  if (changesPaths(settings_))
    paths_ = std::make_unique<const veach::Chains>(moments_, settings_, size_, area_);
  std::atomic<std::int64_t> looked{0};
  Job looking;  // the other one counts what is done of the picture
  parallelChunks(chunks, settings.threads, looking, [&](std::int64_t chunk, int) {
    if (job.cancel) looking.cancel = true;
    if (looking.cancel) return;
    Budget budget(interrupt);
    const BudgetScope scope(&budget);
    PixelTracer tracer = this->tracer();
    Sampling samples(tracer, area_, target_);
    for (std::int64_t n = chunk * kChunk; n < std::min(starts, (chunk + 1) * kChunk); ++n) {
      PrimarySample numbers = startOf(static_cast<std::uint64_t>(n), 0);
      sums_[static_cast<std::size_t>(n)] =
          paths_ ? paths_->light(tracer, seedOf(static_cast<std::uint64_t>(n))) : samples.at(numbers).light;
    }
    work.reached(++looked);
  });
  if (job.cancel) return;
  target_ = ChainTarget(sums_);
  Real squares = 0;
  for (Real& one : sums_) {
    one = target_.of(one);
    squares += one * one;
  }
  for (std::size_t n = 1; n < sums_.size(); ++n) sums_[n] += sums_[n - 1];
  const Real count = static_cast<Real>(starts);
  mean_ = sums_.back() / count;
  error_ = std::sqrt(std::max(0.0, squares / count - mean_ * mean_) / count) / mean_;
  if (!(mean_ > 0)) error_ = kInfinity;
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
                                     const ChainWatch& watch) const {
  std::vector<Splat> splats;
  if (!(mean_ > 0)) return splats;
  constexpr std::uint64_t kChains = 0x636861696e73ull;  // other numbers than those of the starts
  std::uint64_t chances = mixBits(mixBits(static_cast<std::uint64_t>(settings_.seed) ^ kChains) ^ number);
  const auto chance = [&] { return unitFromBits(chances = mixBits(chances)); };
  const auto from = std::upper_bound(sums_.begin(), sums_.end() - 1, chance() * sums_.back());
  const auto start = static_cast<std::uint64_t>(from - sums_.begin());
  if (paths_) return paths_->chain(tracer, seedOf(start), mixBits(chances), moves, target_, mean_, watch);
  PrimarySample numbers = startOf(start, mixBits(chances));
  Sampling samples(tracer, area_, target_);
  // A chain's samples and those taken anywhere are two ways to choose, weighed by the balance heuristic: how
  // often both choose this one, for each move and on the average, is the density of the two.
  const auto leave = [&](const Stop& at) {
    if (!(at.target > 0)) return;
    const Real counts = samples.pixels() * at.visits / (at.target / mean_ + settings_.moveAnywhere);
    for (const Splat& splat : at.splats) splats.push_back({splat.x, splat.y, splat.value * counts});
  };

  Stop here = samples.at(numbers);
  const auto pixelOf = [](const Stop& at) -> const Splat& { return at.splats.front(); };
  const OfferedSample again = [&](PixelTracer& other) { return other.sample(numbers, area_); };
  if (watch)
    watch({-1, MoveKind::anywhere, pixelOf(here).x, pixelOf(here).y, pixelOf(here).value, here.target, 0, 1,
           true},
          again);
  for (std::int64_t n = 0; n < moves; ++n) {
    const bool anywhere = chance() < settings_.moveAnywhere;
    const MoveKind kind = anywhere ? MoveKind::anywhere : MoveKind::nearby;
    anywhere ? numbers.moveAnywhere() : numbers.moveNearby();
    Stop there = samples.at(numbers);
    const Real accepts = here.target > 0 ? std::min(1.0, there.target / here.target) : 1;
    there.visits = accepts + (anywhere ? 1 : 0);
    here.visits += 1 - accepts;
    const bool goes = chance() < accepts;
    if (watch)
      watch({n, kind, pixelOf(there).x, pixelOf(there).y, pixelOf(there).value, there.target, here.target,
             accepts, goes},
            again);
    if (goes) std::swap(here, there);
    goes ? numbers.keep() : numbers.undo();
    leave(there);
    tracer.tracer().statistics().count(kind, goes);
  }
  leave(here);
  return splats;
}

}  // namespace trace
