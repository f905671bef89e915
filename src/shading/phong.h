// The material of the courses: emission, ambient light, Lambert's diffuse term, a highlight by Phong
// (CACM 18(6), 1975) or Blinn (SIGGRAPH 1977), and the weights of mirror and refracted rays.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// Which angle the highlight measures: normal against half-way vector, or eye against mirrored light.
enum class Highlight { blinn, phong };

/// What a surface scatters of a light, in parts.
struct Scatter {
  Color diffuse, specular;
  Color sum() const { return diffuse + specular; }
};

struct Phong {
  static constexpr std::string_view kKeyword = "material";
  static constexpr std::string_view kHelp = "Phong or Blinn-Phong surface with mirror and glass terms";

  Color emissive, ambient, diffuse, specular, reflective, transmissive;
  Real shininess = 0;  ///< exponent of the highlight
  Real index = 1;      ///< of refraction
  Real shadow = 1;     ///< how dark shadows on it are: 0 shows none

  static constexpr auto fields() {
    return std::tuple{
        Field{"emissive", &Phong::emissive, "", 0, kNoLimit, "light the surface gives off by itself"},
        Field{"ambient", &Phong::ambient, "", 0, 1, "share of the ambient light given back"},
        Field{"diffuse", &Phong::diffuse, "", 0, 1, "share of light scattered evenly"},
        Field{"specular", &Phong::specular, "", 0, 1, "strength of the highlight"},
        Field{"reflective", &Phong::reflective, "", 0, 1, "weight of the mirrored ray"},
        Field{"transmissive", &Phong::transmissive, "", 0, 1,
              "weight of the refracted ray, filter of shadows"},
        Field{"shininess", &Phong::shininess, "", 0, kNoLimit, "sharpness of the highlight"},
        Field{"index", &Phong::index, "", 0, kNoLimit, "index of refraction"},
        Field{"shadow", &Phong::shadow, "", 0, 1,
              "share of a light that a shadow on the surface takes away"}};
  }
  bool operator==(const Phong&) const = default;

  /// No `reflective` was given after the last `specular`: some conventions then mirror with `specular`.
  bool mirrorsSpecular = false;
  // Set by compile() from the conventions, not by scenes:
  Highlight highlight = Highlight::blinn;
  bool litFromBehind = false;  ///< light from behind comes through: |N.L|, and a highlight straight ahead

  bool transmits() const { return !isBlack(transmissive); }
  bool mirrors() const { return !isBlack(reflective); }

  /// What of light from `toLight` goes toward `toEye` at a surface of normal `n` (all unit vectors).
  /// The highlight is not multiplied by N.L.
  Scatter scatter(const Vec3& n, const Vec3& toLight, const Vec3& toEye) const {
    const Real cosLight = dot(n, toLight);
    Scatter scatter{diffuse * (litFromBehind ? std::abs(cosLight) : std::max(0.0, cosLight)), {}};
    if (isBlack(specular)) return scatter;
    Real cosHighlight;
    if (highlight == Highlight::blinn) {
      const Vec3 half = toLight + toEye;
      const Real l = length(half);
      cosHighlight = l > 0 ? dot(n, half) / l : 0;
    } else {
      const Real cosMirror = litFromBehind ? std::max(0.0, cosLight) : cosLight;
      cosHighlight = dot(n * (2 * cosMirror) - toLight, toEye);
    }
    if (cosHighlight > 0 || shininess == 0)
      scatter.specular = specular * std::pow(std::max(0.0, cosHighlight), shininess);
    return scatter;
  }
};

/// Every field mixed linearly: the materials of a triangle's corners.
inline Phong mix(const Phong& a, const Phong& b, const Phong& c, const Real (&w)[3]) {
  Phong m = a;
  forEachField<Phong>([&](const auto& f) {
    m.*f.member = (a.*f.member) * w[0] + (b.*f.member) * w[1] + (c.*f.member) * w[2];
  });
  return m;
}

}  // namespace trace
