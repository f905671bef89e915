// THE table of substances: indices of refraction of transparent materials. shading/library.h makes materials
// of them.
#pragma once

#include <span>
#include <string_view>

#include "math/color.h"
#include "shading/optics/dispersion.h"

namespace trace {

/// Light passes all of them. Indices are those at the line d or D (588 or 589 nm), of liquids at 20 degrees
/// Celsius, of gases at 0; of crystals that refract doubly that of the ordinary ray.
struct Substance {
  std::string_view name;   ///< "heavy flint"
  std::string_view group;  ///< "glass", "liquid", "gem", ...
  Real index;
  Real abbe = 0;  ///< Abbe's number; 0: not in the table
  std::string_view source{};
  Disperses dispersion = Disperses::byAbbe;
  Color color{1};  ///< the transmittance of a unit of length, as a picture of it looks; chosen by eye
};

std::span<const Substance> substances();

/// Light spreads in these: coefficients of reduced scattering and of absorption for red, green and blue, per
/// millimetre (shading/materials/subsurface.h).
struct Translucent {
  std::string_view name;
  Color scatters, absorbs;
  Real index;
  Real roughness;  ///< roughness of its surface, by eye
  std::string_view source;
};

std::span<const Translucent> translucents();

}  // namespace trace
