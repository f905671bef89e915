// The interior of an object, as light inside sees it: a part of the materials that refract.
#pragma once

#include "base/field.h"
#include "math/color.h"
#include "shading/optics/dispersion.h"

namespace trace {

struct Interior {
  Real priority = 0;  ///< where objects overlap, the highest priority fills the space
  Color attenuationColor{1};
  Real attenuationDistance = 1;
  Disperses dispersion = Disperses::byAbbe;
  Real abbe = 0;

  static constexpr auto fields() {
    return Fields{Field{"priority", &Interior::priority, "", -kNoLimit, kNoLimit,
                        "where glass objects overlap, the one of highest priority fills the space"},
                  Field{"attenuation_color", &Interior::attenuationColor, "", 0, 1,
                        "transmittance of white light over attenuation_distance inside"},
                  Field{"attenuation_distance", &Interior::attenuationDistance, "units", 0, kNoLimit,
                        "distance inside with the transmittance attenuation_color"},
                  Field{"dispersion", &Interior::dispersion, "", 0, 0,
                        "dispersion of the index: by abbe, or that of an optical glass"},
                  Field{"abbe", &Interior::abbe, "", 0, kNoLimit,
                        "Abbe's number: a smaller one disperses more; 0 means no dispersion"}};
  }
  bool operator==(const Interior&) const = default;

  /// Beer's law: the transmittance of a unit of length.
  Color passesPerUnit() const {
    return attenuationColor == Color(1) ? Color(1) : pow(attenuationColor, 1 / attenuationDistance);
  }
};

}  // namespace trace
