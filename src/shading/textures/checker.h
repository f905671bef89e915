// Two colours in turn, in cubes or, by texture coordinates, in squares.
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

struct Checker {
  static constexpr std::string_view kKeyword = "checker";
  static constexpr std::string_view kHelp =
      "two alternating colours, in cubes of side 1 or squares of u and v";

  Color a{1}, b{};
  TextureSpace space = TextureSpace::point;

  static constexpr auto fields() {
    return Fields{Field{"a", &Checker::a, "", 0, kNoLimit, "the colour at (0.5, 0.5, 0.5)"},
                  Field{"b", &Checker::b, "", 0, kNoLimit, "the other colour"},
                  Field{"space", &Checker::space, "", -kNoLimit, kNoLimit, "cubes, or squares of u and v"}};
  }
  bool operator==(const Checker&) const = default;

  bool wantsFootprint() const { return true; }
  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, space);
    // The product of three waves of 1 and -1, each filtered along its axis.
    Real even = 1;
    for (int axis = 0; axis < 3; ++axis) even *= 2 * evenShare(p.at[axis], p.width[axis]) - 1;
    return (1 - even) / 2;
  }
  Color shade(Real t) const { return lerp(t, a, b); }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
