// A medium inside an object that scatters, absorbs or emits light: smoke, clouds, milk, fire. A part
// of the material (medium_density and the other fields), as light that runs in it asks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "shading/material.h"

namespace trace {

/// At one place, along a unit of length.
struct Medium {
  Color scatters, absorbs;  ///< shares of the light
  Color glows;              ///< radiance
  Real forward = 0;         ///< the mean cosine of what is scattered

  Color loses() const { return scatters + absorbs; }
};

/// The part of light from `toLight` that continues where a ray comes from that runs along `direction`: per
/// solid angle, in all 1 (Henyey and Greenstein 1941), from the cosine of the two.
inline Real phase(Real forward, Real cosine) {
  const Real base = 1 + forward * forward - 2 * forward * cosine;
  return (1 - forward * forward) / (4 * kPi * base * std::sqrt(base));
}
/// The cosine that u from 0 up to 1 chooses with that density (pbrt, 3rd ed., section 15.2.3).
inline Real phaseCosine(Real forward, Real u) {
  if (std::abs(forward) < 1e-3) return 1 - 2 * u;
  const Real part = (1 - forward * forward) / (1 - forward + 2 * forward * u);
  return std::clamp((1 + forward * forward - part * part) / (2 * forward), -1.0, 1.0);
}
/// Beyond it nothing is seen from aside.
inline constexpr Real kMostForward = 0.999;

/// The medium in a body of that material, with its textures. What textures make of a field lies between 0 and
/// what the material says, except for what glows: so it is known how dense the medium is at most.
class MediumModel {
 public:
  MediumModel() = default;
  explicit MediumModel(const Material& material)
      : most_{material.mediumScatters * material.mediumDensity,
              material.mediumAbsorbs * material.mediumDensity, material.mediumGlows * material.mediumDensity,
              std::clamp(material.mediumForward, -kMostForward, kMostForward)} {
    for (std::size_t i = 0; i < kFields.size(); ++i)
      if (const Texture* texture = textureOf(material.textures, kFields[i]))
        textures_[i] = *texture, uniform_ = false;
  }
  static constexpr std::array<std::string_view, 5> kFields{
      "medium_density", "medium_scatters", "medium_absorbs", "medium_glows", "medium_forward"};
  /// The field is one of a medium.
  static bool has(std::string_view field) {
    return std::find(kFields.begin(), kFields.end(), field) != kFields.end();
  }

  bool none() const { return isBlack(most_.loses()) && isBlack(most_.glows); }
  bool uniform() const { return uniform_; }  ///< it is the same everywhere
  const Medium& most() const { return most_; }
  Medium at(const TexturePlace& place) const {
    Medium medium = most_;
    if (uniform_) return medium;
    if (textures_[0]) {
      const Real density = std::clamp(luminance(textures_[0]->at(place)), 0.0, 1.0);
      medium.scatters *= Color(density);
      medium.absorbs *= Color(density);
      medium.glows *= Color(density);
      if (density == 0) return medium;
    }
    if (textures_[1]) medium.scatters *= clamp01(textures_[1]->at(place));
    if (textures_[2]) medium.absorbs *= clamp01(textures_[2]->at(place));
    if (textures_[3]) medium.glows *= textures_[3]->at(place);
    if (textures_[4]) medium.forward *= std::clamp(luminance(textures_[4]->at(place)), -1.0, 1.0);
    return medium;
  }

 private:
  Medium most_;
  bool uniform_ = true;
  std::array<std::optional<Texture>, 5> textures_;
};

}  // namespace trace
