// Strands that grow on the surfaces of objects: fur, hair, grass, bristles, pile.
//
// Roots are spread evenly over the surfaces of any objects without a formula for their areas: a line in a
// random position crosses equal areas equally often, whichever way they face (Crofton; Santalo, Integral
// Geometry and Geometric Probability, 1976, chapter 14). Each strand is then followed from its root: it bends
// by gravity, slides along the objects instead of entering them, is drawn to the middle of its clump, and is
// wound into a curl. Every number depends on the seed and the strand alone.
#pragma once

#include <memory>
#include <string_view>

#include "base/field.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/surfaces/curves.h"
#include "math/vec.h"

namespace trace {

struct Fur {
  static constexpr std::string_view kKeyword = "fur";
  static constexpr std::string_view kHelp = "strands that grow on the surfaces of objects: fur, hair, grass";
  static constexpr int kMostStrands = 2'000'000, kMostClumps = 5'000;

  Operands objects;
  int count = 2000, seed = 1;
  Real length = 0.3, lengthSpread = 0.2, width = 0.01, tipWidth = 0.002, spread = 0.15;
  Vec3 comb, gravity;
  int clumps = 0;
  Real clumping = 0.7, curl = 0, curlRadius = 0.02;
  bool round = true;

  static constexpr auto fields() {
    return Fields{
        Field{"objects", &Fur::objects, "", 0, 0,
              "what the strands grow on; it is not seen itself. The objects stand in the block"},
        Field{"count", &Fur::count, "", 0, kMostStrands, "number of strands"},
        Field{"seed", &Fur::seed, "", 0, kNoLimit, "seed of the random numbers"},
        Field{"length", &Fur::length, "units", 0, kNoLimit, "length of a strand"},
        Field{"length_spread", &Fur::lengthSpread, "", 0, 1, "random variation of the length, as a fraction"},
        Field{"width", &Fur::width, "units", 0, kNoLimit, "width at the root"},
        Field{"tip_width", &Fur::tipWidth, "units", 0, kNoLimit, "width at the tip"},
        Field{"spread", &Fur::spread, "", 0, 10, "random tilt at the root; at 1 up to 45 degrees"},
        Field{"comb", &Fur::comb, "", -kNoLimit, kNoLimit,
              "vector added to the normal, which gives the direction at the root"},
        Field{"gravity", &Fur::gravity, "", -kNoLimit, kNoLimit,
              "vector added to the direction from root to tip: it bends the strands"},
        Field{"clumps", &Fur::clumps, "", 0, kMostClumps, "number of clumps; 0: none"},
        Field{"clumping", &Fur::clumping, "", 0, 1,
              "fraction of the way to the middle of its clump that a tip is drawn"},
        Field{"curl", &Fur::curl, "turns", 0, 50, "turns of the curl along a strand"},
        Field{"curl_radius", &Fur::curlRadius, "units", 0, kNoLimit, "radius of the curl at the tip"},
        Field{"round", &Fur::round, "", 0, 0, "tubes; off: flat ribbons that face the ray"}};
  }
  bool operator==(const Fur&) const = default;

  /// Throws Error for an object that has no end or is squeezed flat.
  std::shared_ptr<const TracedCurves> prepared(const MeshTrees& made = {}) const;
  ShapeFacts checked() const;
};

}  // namespace trace
