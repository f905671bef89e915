// The densities of all strategies for a path that is joined from two ends, as two sums at each end (van
// Antwerpen, Recursive MIS Computation for Streaming BDPT on the GPU, 2011; Georgiev, Implementing Vertex
// Connection and Merging, 2012): MIS weights take no loop over the path.
//
//   vcm  densities of all strategies in which the vertex was not joined from the other end, over that of this
//        path
//   vc   those in which the vertex before it was not reached from this end, likewise
#pragma once

#include "render/paths/path_place.h"

namespace trace {

/// The partial sums of one end's path, by the power heuristic.
struct PartialSums {
  static Real power(Real density) { return density * density; }

  Real vcm = 0, vc = 0;

  /// The path has arrived: its density was over solid angle, and is over area now.
  void arrive(Real distance2, Real cosine) {
    const Real c = 1 / power(cosine);
    vcm *= power(distance2) * c;
    vc *= c;
  }
  /// It continues: in a direction of a lobe with that density, which the other way round is `reverse`; at
  /// `cosine` to the surface.
  void leave(Real density, Real reverse, Real cosine) {
    vc = power(cosine / density) * (vc * power(reverse) + vcm);
    vcm = power(1 / density);
  }
  /// It continues from that surface with that ray, having come from there.
  void leave(const PathPlace& place, const Onward::Ray& next, const Vec3& from) {
    const Real cosine = place.cosine(next.direction);
    if (next.density > 0)
      leave(next.density, place.density(next.direction, from), cosine);
    else
      reflect(cosine);
  }
  /// In the only direction of a mirror or of glass, where nothing is joined.
  void reflect(Real cosine) {
    vc *= power(cosine);
    vcm = 0;
  }
  /// The weights of all other strategies that start on this end, where the other end comes upon the place
  /// with that density, and the place sends its path back with `reverse`.
  Real others(Real density, Real reverse) const { return power(density) * (vcm + vc * power(reverse)); }
};

}  // namespace trace
