// Fields that lamps have in common: those that stand at a place, fade with the distance, and may be balls.
#pragma once

#include "base/field.h"

namespace trace {

/// The fields of 1 / (a + b d + c d^2), by which a lamp fades (faded() in illumination.h).
template <class L>
constexpr auto fadingFields() {
  return Fields{Field{"constant_attenuation_coeff", &L::constant, "", 0, kNoLimit, "a"},
                Field{"linear_attenuation_coeff", &L::linear, "", 0, kNoLimit, "b"},
                Field{"quadratic_attenuation_coeff", &L::quadratic, "", 0, kNoLimit, "c"}};
}

/// The field of the ball that a lamp is (towardBall() in illumination.h).
template <class L>
constexpr auto ballField() {
  return Field{"radius", &L::radius, "units",
               0,        kNoLimit,   "radius of the luminous sphere; above 0 its shadows are soft"};
}

/// The fields of a light that shines to one side.
template <class L>
constexpr auto beamFields(const char* whereTo) {
  return Fields{Field{"position", &L::position, "", -kNoLimit, kNoLimit, "where it is"},
                Field{"direction", &L::direction, "", -kNoLimit, kNoLimit, whereTo},
                Field{"color", &L::color, "", 0, kNoLimit, "its intensity on the axis"}};
}

}  // namespace trace
