// Chains that walk among paths of light and change them place by place (Veach and Guibas 1997).
//
// Use them if all light passes a gap: a path that has found it keeps it. Not for clear caustics, where the
// other chains are faster, nor for what veach_refuse.cpp lists.
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "render/chains/chain_move.h"
#include "render/chains/moves.h"

namespace trace::veach {

class Chains {
 public:
  Chains(std::span<const Moment> moments, const Settings& settings, const Size& size, const Tile& area);

  /// How bright the picture is by one sample of many, evenly spread: a path from the camera with all that it
  /// meets and asks for, and a path from anywhere. Its mean is that of light(), and it differs far less.
  Real brightness(PixelTracer& tracer, std::uint64_t seed, std::uint32_t sample) const;
  /// How bright the picture is by the path that is made from nothing with these numbers: over its density.
  Real light(PixelTracer& tracer, std::uint64_t seed) const;
  /// Adds the splats of a chain that starts at that path, in that many moves; `mean` is how bright the
  /// picture is.
  std::vector<Splat> chain(PixelTracer& tracer, std::uint64_t start, std::uint64_t seed, std::int64_t moves,
                           Real mean, const ChainWatch& watch) const;

 private:
  struct Stop;
  Path start(PixelTracer& tracer, Numbers& numbers) const;
  Paths paths(PixelTracer& tracer, std::size_t moment) const;
  std::size_t momentBy(Numbers& numbers) const;
  Offer offer(PixelTracer& tracer, Path& here, Numbers& numbers, MoveKind& kind) const;
  std::vector<MoveKind> mutationsOf(const Moves& moves, const Path& path) const;
  Real anywhereChance(const std::vector<MoveKind>& kinds) const;
  void leave(const Stop& at, Real mean, std::vector<Splat>& splats) const;
  Splat pixelOf(const Path& path) const;

  const Settings& settings_;
  Tile area_;
  SampleRules rules_;
  std::deque<Stage> stages_;  ///< stages of each moment
};

}  // namespace trace::veach
