// Parts common to patterns: the space they lie in, the colours of their numbers, and waves.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "math/color.h"
#include "math/noise.h"
#include "shading/texture_place.h"

namespace trace {

/// The space of a pattern.
enum class TextureSpace { point, uv };
constexpr std::array<std::string_view, 2> names(TextureSpace) { return {"point", "uv"}; }

/// Where a pattern is asked for, and how wide a pixel is there along each axis.
struct PatternPlace {
  Vec3 at, width;

  PatternPlace(const TexturePlace& place, TextureSpace space) {
    if (space == TextureSpace::uv) {
      at = {place.uv.x, place.uv.y, 0};
      width = {std::abs(place.uvX.x) + std::abs(place.uvY.x), std::abs(place.uvX.y) + std::abs(place.uvY.y),
               0};
    } else {
      at = place.point;
      width = abs(place.pointX) + abs(place.pointY);
    }
  }
  std::array<Real, 3> point() const { return {at.x, at.y, at.z}; }
  Real widest() const { return maxComponent(width); }
};

/// The cell of x in a lattice of whole numbers. A face of an object often lies on the border of two cells;
/// what rounding leaves of it counts as the upper one.
inline Lattice cellOf(Real x) { return Lattice(x + 0x1p-30); }
/// A pixel that is no wider, in cells, is a point: across a face, its width is only rounding.
inline constexpr Real kLeastWidth = 0x1p-25;

/// The share of the pixel [x - width/2, x + width/2] where an even cell is: its mean (Ebert and others,
/// Texturing and Modeling, 3rd ed., section 2.8, box filtering).
inline Real evenShare(Real x, Real width) {
  if (!(width > kLeastWidth)) return cellOf(x).whole % 2 == 0;
  if (width >= 0x1p30) return 0.5;
  const auto evenUpTo = [](Real t) {  // the length of even cells between 0 and t
    const Lattice pair(t / 2);
    return static_cast<Real>(pair.whole) + min(2 * pair.rest, 1);
  };
  return max(min((evenUpTo(x + width / 2) - evenUpTo(x - width / 2)) / width, 1), 0);
}

/// From 0 to 1 without a corner.
constexpr Real smoothStep(Real t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

/// How a number that grows goes round from 0 to 1.
enum class WaveForm { smooth, triangle, saw };
constexpr std::array<std::string_view, 3> names(WaveForm) { return {"smooth", "triangle", "saw"}; }

/// 0 where t is whole. `smooth` comes within 0.01 of (1 - cos(2 pi t)) / 2, and has the same bits everywhere.
inline Real wave(WaveForm kind, Real t) {
  const Real rest = Lattice(t).rest;
  if (kind == WaveForm::saw) return rest;
  const Real triangle = 1 - std::abs(2 * rest - 1);
  return kind == WaveForm::triangle ? triangle : smoothStep(triangle);
}

/// Colours at rising positions: (position, red, green, blue). Between two they are mixed, beyond the ends
/// they stay, and two at one position are an edge.
using ColorRamp = std::vector<std::array<Real, 4>>;

/// Precondition: the ramp is not empty.
inline Color colorAt(const ColorRamp& ramp, Real t) {
  const auto color = [](const std::array<Real, 4>& stop) { return Color(stop[1], stop[2], stop[3]); };
  std::size_t next = 0;
  while (next < ramp.size() && ramp[next][0] <= t) ++next;
  if (next == 0) return color(ramp.front());
  if (next == ramp.size()) return color(ramp.back());
  const auto &low = ramp[next - 1], &high = ramp[next];
  return lerp((t - low[0]) / (high[0] - low[0]), color(low), color(high));
}

/// The colours of a pattern whose numbers go from 0 to 1.
struct PatternColors {
  Color a{1}, b{};
  ColorRamp ramp;

  static constexpr auto fields() {
    return Fields{
        Field{"a", &PatternColors::a, "", 0, kNoLimit, "the colour where the pattern is 0"},
        Field{"b", &PatternColors::b, "", 0, kNoLimit, "the colour where it is 1"},
        Field{"ramp", &PatternColors::ramp, "", -kNoLimit, kNoLimit,
              "((position, red, green, blue), ...): colours at increasing positions, in place of a and b"}};
  }
  bool operator==(const PatternColors&) const = default;

  /// For t up to 0 only a counts, and from 1 on only b.
  Color shade(Real t) const {
    if (!ramp.empty()) return colorAt(ramp, t);
    return lerp(t > 0 ? min(t, 1) : 0, a, b);
  }
};

}  // namespace trace
