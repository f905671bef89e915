// How the index of refraction changes with the wavelength, and what colours wavelengths have.
//
// Colour is RGB everywhere. Where light is refracted by a body that disperses it, an integrator follows
// several wavelengths, each weighed by its colour; the weights of a fan sum to white exactly.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// Wavelengths in nanometres of the lines of Fraunhofer: indices are given at d, Abbe's number is
/// (n_d - 1) / (n_F - n_C).
inline constexpr Real kLineC = 656.2725, kLineD = 587.5618, kLineF = 486.1327;

/// Sellmeier's formula (1871): n^2 - 1 is the sum of b L^2 / (L^2 - c), L the wavelength in micrometres.
struct Sellmeier {
  std::array<Real, 3> b, c;
  Real index(Real nanometres) const;
};

/// By what a material disperses light: Abbe's number, or as a glass of the table in dispersion.cpp.
enum class Disperses { byAbbe, bk7, baf10, fk51a, lasf9, sf5, sf10, sf11 };
constexpr std::array<std::string_view, 8> names(Disperses) {
  return {"abbe", "BK7", "BAF10", "FK51A", "LASF9", "SF5", "SF10", "SF11"};
}
/// Null for byAbbe.
const Sellmeier* sellmeier(Disperses glass);

/// The change of an index of refraction with the wavelength.
class Dispersion {
 public:
  Dispersion() = default;
  /// By Cauchy's formula n = A + B / L^2 with Abbe's number, where that is above 0; or of a glass.
  Dispersion(Disperses glass, Real abbe, Real index);

  bool none() const { return !glass_ && cauchy_ == 0; }
  /// The index of a body whose index at the line d is this. Wavelength 0 stands for all of them: the index
  /// itself.
  Real index(Real atD, Real nanometres) const {
    return nanometres == 0 || none() ? atD : shifted(atD, nanometres);
  }
  bool operator==(const Dispersion&) const = default;

 private:
  Real shifted(Real atD, Real nanometres) const;

  const Sellmeier* glass_ = nullptr;
  Real cauchy_ = 0;  ///< B, in square micrometres
};

/// A wavelength of a fan. The weights of a fan sum to white.
struct SpectralShare {
  Real nanometres;
  Color weight;
};
/// `count` wavelengths from 400 to 700 nm at even distances, moved by `shift` of a distance (0 to 1).
/// The weights are colour matching functions (spectralColor) without what is below 0.
std::vector<SpectralShare> spectralFan(int count, Real shift = 0.5);

/// The colour, in linear Rec. 709, of light of one wavelength, by the fit of Wyman, Sloan and Shirley to the
/// CIE's observer of 1931 (JCGT 2(2), 2013, listing 2). Components may be negative: such light is more
/// colourful than any screen's.
Color spectralColor(Real nanometres);

}  // namespace trace
