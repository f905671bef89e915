// The colour of what glows because it is hot.
#pragma once

#include <string_view>

#include "base/field.h"
#include "shading/optics/blackbody.h"
#include "shading/texture_place.h"

namespace trace {

struct Blackbody {
  static constexpr std::string_view kKeyword = "blackbody";
  static constexpr std::string_view kHelp =
      "the colour and brightness of a black body: fire, embers, molten metal";

  Real temperature = 1900;
  Real brightness = 1;

  static constexpr auto fields() {
    return Fields{Field{"temperature", &Blackbody::temperature, "kelvin", 0, kNoLimit,
                        "a candle has 1900; a texture scales it"},
                  Field{"brightness", &Blackbody::brightness, "", 0, kNoLimit,
                        "how bright it is at 1900 kelvin; hotter is brighter"}};
  }
  bool operator==(const Blackbody&) const = default;

  Color at(const TexturePlace&) const { return blackbodyColor(temperature) * brightness; }
};

}  // namespace trace
