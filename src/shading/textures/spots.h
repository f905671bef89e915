// Balls at the middle of cells, or discs in u and v.
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

struct Spots {
  static constexpr std::string_view kKeyword = "spots";
  static constexpr std::string_view kHelp = "round spots, one in each cube of side 1 or square of u and v";

  Color a{0.85, 0.1, 0.1}, b{1};
  Real radius = 0.3, jitter = 0, softness = 0;
  TextureSpace space = TextureSpace::point;
  int seed = 0;

  static constexpr auto fields() {
    return Fields{
        Field{"a", &Spots::a, "", 0, kNoLimit, "the colour of the spots"},
        Field{"b", &Spots::b, "", 0, kNoLimit, "the colour between them"},
        Field{"radius", &Spots::radius, "", 0, 0.5, "radius of a spot"},
        Field{"jitter", &Spots::jitter, "", 0, 1,
              "largest random offset from the middle, as far as there is room"},
        Field{"softness", &Spots::softness, "", 0, 1, "the width of their edge"},
        Field{"space", &Spots::space, "", -kNoLimit, kNoLimit, "balls, or discs in u and v"},
        Field{"seed", &Spots::seed, "", -kNoLimit, kNoLimit, "chooses among patterns of the same kind"}};
  }
  bool operator==(const Spots&) const = default;

  bool wantsFootprint() const { return true; }
  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, space);
    const int axes = space == TextureSpace::uv ? 2 : 3;
    Real away[3] = {};
    std::uint32_t bits = static_cast<std::uint32_t>(seed);
    for (int axis = 0; axis < axes; ++axis) {
      const Lattice at(p.at[axis]);
      away[axis] = at.rest - 0.5;
      bits += axisBits(at.whole, axis);
    }
    Real squared = 0;
    const Real room = jitter > 0 ? jitter * max(0.5 - radius, 0) : 0;
    for (int axis = 0; axis < axes; ++axis) {
      bits = mixBits32(bits);
      const Real d = away[axis] - room * (bits * 0x1p-31 - 1);
      squared += d * d;
    }
    const Real edge = max(softness, p.widest()), inside = radius - std::sqrt(squared);
    return edge > 0 ? smoothStep(0.5 - inside / edge) : !(inside > 0);
  }
  Color shade(Real t) const { return lerp(t, a, b); }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
