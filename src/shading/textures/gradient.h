// A number that grows along a line, from an axis, from a point, or around an axis.
#pragma once

#include "math/elementary.h"
#include "shading/textures/pattern.h"

namespace trace {

enum class GradientShape { linear, radial, spherical, angular };
constexpr std::array<std::string_view, 4> names(GradientShape) {
  return {"linear", "radial", "spherical", "angular"};
}
enum class Repeat { none, saw, triangle, smooth };
constexpr std::array<std::string_view, 4> names(Repeat) { return {"none", "saw", "triangle", "smooth"}; }

struct Gradient : PatternColors {
  static constexpr std::string_view kKeyword = "gradient";
  static constexpr std::string_view kHelp =
      "grows along x, from the z axis, from the origin, or once around the z axis";

  GradientShape shape = GradientShape::linear;
  Repeat repeat = Repeat::none;
  TextureSpace space = TextureSpace::point;

  static constexpr auto fields() {
    return Fields{PatternColors::fields(),
                  Field{"shape", &Gradient::shape, "", -kNoLimit, kNoLimit, "which way it grows"},
                  Field{"repeat", &Gradient::repeat, "", -kNoLimit, kNoLimit, "the pattern beyond 1"},
                  Field{"space", &Gradient::space, "", -kNoLimit, kNoLimit, "solid, or in u and v"}};
  }
  bool operator==(const Gradient&) const = default;

  Real pattern(const TexturePlace& place) const {
    const Real t = number(PatternPlace(place, space).at);
    switch (repeat) {
      case Repeat::none: break;
      case Repeat::saw: return wave(WaveForm::saw, t);
      case Repeat::triangle: return wave(WaveForm::triangle, t / 2);
      case Repeat::smooth: return wave(WaveForm::smooth, t / 2);
    }
    return t;
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }

 private:
  Real number(const Vec3& p) const {
    switch (shape) {
      case GradientShape::linear: break;
      case GradientShape::radial: return std::sqrt(p.x * p.x + p.y * p.y);
      case GradientShape::spherical: return length(p);
      case GradientShape::angular: {
        const Real turn = math::atan2(p.y, p.x) / (2 * kPi);
        return turn < 0 ? turn + 1 : turn;
      }
    }
    return p.x;
  }
};

}  // namespace trace
