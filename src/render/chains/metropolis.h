// Metropolis light transport (Veach and Guibas 1997) in primary sample space: Kelemen, Szirmay-Kalos, Antal
// and Csonka, A Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm, 2002.
//
// A chain walks among the samples of the whole picture, from each to one nearby or anywhere, and is the more
// often at a sample the brighter it is: once it has found a way for light that is hard to find, it looks
// around there. It knows the numbers of a sample only, so it serves any integrator.
//
// There is one chain for each wave of a tile, as long as that has samples. It starts at one of many samples
// taken at random, a brighter one more likely, so that no start has to be thrown away.
//
// Use it for light that is hard to find and must not be blurred: through gaps, keyholes and glass. Not for
// lights in the open, where the samples of path are spread more evenly, nor with a noise target or denoising:
// the error of a pixel is not known.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "image/film/film.h"
#include "render/chains/chain.h"
#include "render/chains/chain_move.h"
#include "render/chains/primary_sample.h"

namespace trace {

class Metropolis {
 public:
  /// The number of the chain that makes a tile's samples from that one on.
  static std::uint64_t numberOf(std::int64_t tile, int firstSample);

  /// Looks for light: takes Settings::chainStarts samples. `interrupt` is asked meanwhile, and may throw
  /// GivenUp. A cancelled job leaves no chains. The moments must outlive it.
  Metropolis(std::span<const Moment> moments, const Settings& settings, const Size& size, Job& job,
             const std::function<void()>& interrupt);

  /// Takes samples for a worker's chains.
  PixelTracer tracer() const { return {moments_, settings_, size_}; }

  /// Adds the splats of the chain of that number to the picture, in that many moves. Film::picture() divides
  /// the sum of all chains by the number of all moves. Chains of smaller waves, and of tiles before in the
  /// same wave, make `before` moves: where each chain knows how many, the samples that tell how bright the
  /// picture is are spread evenly over all chains.
  std::vector<Splat> chain(PixelTracer& tracer, std::uint64_t number, std::int64_t moves,
                           const ChainWatch& watch = {}, std::int64_t before = 0) const;
  /// The part of the picture where chains go.
  const Tile& area() const { return area_; }
  /// The standard error of how bright the picture is, relative to that: all that chains leave is in
  /// proportion to the mean light of samples taken first. Infinite where none of them found light.
  Real brightnessError() const { return error_; }
  /// With which their samples are taken.
  const Settings& settings() const { return settings_; }

 private:
  template <class Take>
  void look(std::span<const Moment> moments, std::int64_t samples, Job& job,
            const std::function<void()>& interrupt, const Take& take) const;
  std::vector<Real> startLights(Job& job, const std::function<void()>& interrupt) const;
  std::pair<Real, Real> wholeLight(Job& job, const std::function<void()>& interrupt) const;
  std::int64_t brightnessSamples() const;
  Real meanFor(PixelTracer& tracer, std::int64_t moves, std::int64_t before) const;
  PrimarySample startOf(std::uint64_t number, std::uint64_t moves) const;
  /// From which the numbers of a sample that is taken first follow.
  std::uint64_t seedOf(std::uint64_t start) const;

  std::span<const Moment> moments_;
  Settings settings_;
  Size size_;
  Tile area_;               ///< area of the picture that is rendered
  std::vector<Real> sums_;  ///< sums of the light of the first samples, up to and with each
  Real mean_ = 0;           ///< how bright the picture is: the light of a sample, on the average
  Real error_ = 0;
  std::unique_ptr<const veach::Chains> paths_;  ///< where paths are changed, not the numbers of samples
};

}  // namespace trace
