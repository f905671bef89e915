// Branching plants by Lindenmayer systems (Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants,
// 1990, chapter 1): a text is rewritten by rules, then read as the orders of a turtle in space, which leaves
// branches: spheres carried along lines, traced as the union they are.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"

namespace trace {

struct Plant {
  static constexpr std::string_view kKeyword = "plant";
  static constexpr std::string_view kHelp = "branches grown by an L-system, from the origin up along z";
  static constexpr std::size_t kMostSymbols = 4'000'000, kMostBranches = 400'000;

  std::string axiom = "X";
  std::vector<std::string> rules{"X = FF[+X]/////[+X]/////!FX"};
  int iterations = 5, seed = 1;
  Real angle = 25, jitter = 0.2, height = 1, radius = 0.03, taper = 0.98, narrow = 0.7;

  static constexpr auto fields() {
    return Fields{
        Field{"axiom", &Plant::axiom, "", 0, 0, "the text to begin with"},
        Field{"rules", &Plant::rules, "", 0, 0,
              "list of \"X = text\"; among several for one symbol, one is chosen at random"},
        Field{"iterations", &Plant::iterations, "", 0, 20, "number of times that all symbols are replaced"},
        Field{"seed", &Plant::seed, "", 0, kNoLimit, "seed of the random numbers"},
        Field{"angle", &Plant::angle, "degrees", 0, 360, "of a turn"},
        Field{"jitter", &Plant::jitter, "", 0, 1, "largest random deviation of a turn, as a fraction"},
        Field{"height", &Plant::height, "", 0, kNoLimit, "height of the plant, which is scaled to it"},
        Field{"radius", &Plant::radius, "", 0, kNoLimit, "radius of the trunk at its foot"},
        Field{"taper", &Plant::taper, "", 0, 1,
              "radius at the end of each step, as a fraction of the previous one"},
        Field{"narrow", &Plant::narrow, "", 0, 1, "radius after [ and !, as a fraction of the previous one"}};
  }
  bool operator==(const Plant&) const = default;

  /// Throws Error if a rule cannot be read, or if more would grow than memory holds.
  std::shared_ptr<const TracedSweep> prepared() const;
};

}  // namespace trace
