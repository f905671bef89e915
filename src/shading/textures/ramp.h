// Colours for the numbers of another texture.
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

struct Ramp : PatternColors {
  static constexpr std::string_view kKeyword = "ramp";
  static constexpr std::string_view kHelp = "maps the luminance of another texture, its value, to colours";

  Real value = 0;

  static constexpr auto fields() {
    return Fields{Field{"value", &Ramp::value, "", -kNoLimit, kNoLimit, "a number, usually a texture"},
                  PatternColors::fields()};
  }
  bool operator==(const Ramp&) const = default;

  Real pattern(const TexturePlace&) const { return value; }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
