// Two textures mixed by a third.
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

struct Mix {
  static constexpr std::string_view kKeyword = "mix";
  static constexpr std::string_view kHelp =
      "two colours or textures, mixed by a number or the luminance of a third";

  Color a{1}, b{};
  Real amount = 0.5;

  static constexpr auto fields() {
    return Fields{Field{"a", &Mix::a, "", 0, kNoLimit, "used where amount is 0"},
                  Field{"b", &Mix::b, "", 0, kNoLimit, "used where amount is 1"},
                  Field{"amount", &Mix::amount, "", 0, 1, "fraction of b"}};
  }
  bool operator==(const Mix&) const = default;

  Real pattern(const TexturePlace&) const { return amount > 0 ? min(amount, 1) : 0; }
  Color shade(Real t) const { return lerp(t, a, b); }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
