// Two colours in turn, in cubes or, by texture coordinates, in squares.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "base/field.h"
#include "math/color.h"
#include "shading/texture_place.h"

namespace trace {

/// What a pattern lies in.
enum class TextureSpace { point, uv };
constexpr std::array<std::string_view, 2> names(TextureSpace) { return {"point", "uv"}; }

struct Checker {
  static constexpr std::string_view kKeyword = "checker";
  static constexpr std::string_view kHelp = "two colours in turn, in cubes of side 1 or squares of u and v";

  Color a{1}, b{};
  TextureSpace space = TextureSpace::point;

  static constexpr auto fields() {
    return std::tuple{Field{"a", &Checker::a, "", 0, kNoLimit, "the colour at (0.5, 0.5, 0.5)"},
                      Field{"b", &Checker::b, "", 0, kNoLimit, "the other"},
                      Field{"space", &Checker::space, "", -kNoLimit, kNoLimit, "cubes, or squares of u and v"}};
  }
  bool operator==(const Checker&) const = default;

  Color at(const TexturePlace& place) const {
    const Vec3 p = space == TextureSpace::uv ? Vec3{place.uv.x, place.uv.y, 0} : place.point;
    const Real sum = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
    return sum / 2 == std::floor(sum / 2) ? a : b;
  }
};

}  // namespace trace
