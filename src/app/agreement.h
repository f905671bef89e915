// Do two integrators show the same picture? Each makes several by other seeds; of every tile the two means are
// compared by Welch's test, and the p-values of all tiles have to be spread evenly.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/options.h"

namespace trace {

struct Agreement {
  std::vector<double> p;  ///< of each tile, row by row
  double uniform = 0;     ///< the p-value of their being spread evenly (Kolmogorov and Smirnov)
  double meanA = 0, meanB = 0;  ///< light of the pictures
  double error = 0;             ///< standard error of the difference of these
};

/// Of pictures of the scene in the text, by so many seeds, with the choices over its own; tiles have that many
/// pixels a side. Throws what a render throws.
Agreement agreement(const std::string& scene, std::span<const Choice> a, std::span<const Choice> b, int seeds,
                    int tile);

/// A room of coloured walls with an open lamp, 32 pixels wide: with two boxes, a ball that mirrors or one of
/// glass; and one whose light comes through a door that stands ajar.
enum class Room { diffuse, mirror, glass, door };
std::string roomText(Room room);

}  // namespace trace
