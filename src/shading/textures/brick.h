// Bricks in courses, each half a brick along, with mortar between.
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

struct Brick {
  static constexpr std::string_view kKeyword = "brick";
  static constexpr std::string_view kHelp = "bricks and mortar: courses are stacked along y";

  Color a{0.55, 0.18, 0.12}, b{0.75, 0.72, 0.68};
  Vec3 size{1, 0.4, 0.5};
  Real mortar = 0.06, offset = 0.5;
  TextureSpace space = TextureSpace::point;

  static constexpr auto fields() {
    return Fields{Field{"a", &Brick::a, "", 0, kNoLimit, "the colour of the bricks"},
                  Field{"b", &Brick::b, "", 0, kNoLimit, "the colour of the mortar"},
                  Field{"size", &Brick::size, "", 0, kNoLimit,
                        "a brick with its mortar; 0 along an axis: no joints there"},
                  Field{"mortar", &Brick::mortar, "", 0, kNoLimit, "the width of the joints"},
                  Field{"offset", &Brick::offset, "", 0, 1,
                        "offset of a course from the one below, as a fraction of a brick"},
                  Field{"space", &Brick::space, "", -kNoLimit, kNoLimit,
                        "solid, or in u and v, without joints along z"}};
  }
  bool operator==(const Brick&) const = default;

  bool wantsFootprint() const { return true; }
  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, space);
    const Real course = size.y > 0 ? static_cast<Real>(cellOf(p.at.y / size.y).whole) : 0;
    const Real layer =
        space == TextureSpace::point && size.z > 0 ? static_cast<Real>(cellOf(p.at.z / size.z).whole) : 0;
    Real brick = share(p.at.x + (course + layer) * offset * size.x, p.width.x, size.x) *
                 share(p.at.y, p.width.y, size.y);
    if (space == TextureSpace::point) brick *= share(p.at.z, p.width.z, size.z);
    return 1 - brick;
  }
  Color shade(Real t) const { return lerp(t, a, b); }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }

 private:
  /// How much of a pixel is brick: joints are at whole bricks, half on each side.
  Real share(Real x, Real width, Real length) const {
    const Real joint = length > 0 ? mortar / length : 0;
    if (!(joint > 0)) return 1;
    if (joint >= 1) return 0;
    const Real t = x / length - joint / 2, w = width / length;
    if (!(w > kLeastWidth)) return cellOf(t).rest < 1 - joint;
    if (w >= 0x1p30) return 1 - joint;
    const auto upTo = [&](Real s) {  // the length of brick between 0 and s
      const Lattice cell(s);
      return static_cast<Real>(cell.whole) * (1 - joint) + min(cell.rest, 1 - joint);
    };
    return max(min((upTo(t + w / 2) - upTo(t - w / 2)) / w, 1), 0);
  }
};

}  // namespace trace
