// Do two integrators show the same picture? Each makes several by other seeds; of every tile the two means
// are compared by Welch's test, and the p-values of all tiles have to be spread evenly.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

struct Agreement {
  std::vector<double> p;        ///< p of each tile, row by row
  double uniform = 0;           ///< the p-value of their being spread evenly (Kolmogorov and Smirnov)
  double least = 0;             ///< the p-value of the smallest of them being that small (Sidak 1967)
  double meanA = 0, meanB = 0;  ///< light of the pictures
  double error = 0;             ///< standard error of the difference of these
};

/// Compares so many pictures of the scene by each of the settings; tiles have that many pixels a side. A
/// `bias` says by which part of its light a tile of b may differ: it is asked whether it does by more. Then
/// `least` is what tells, for p-values of tiles that differ by less are not spread evenly.
Agreement agreement(const Scene& scene, const Settings& a, const Settings& b, int seeds, int tile,
                    double bias = 0);

}  // namespace trace
