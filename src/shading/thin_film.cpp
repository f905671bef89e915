#include "shading/thin_film.h"

#include <array>
#include <cmath>
#include <vector>

#include "shading/dispersion.h"

namespace trace {
namespace {

/// What is the same for all wavelengths.
struct Faces {
  bool total = false;
  Real front[2],
      back[2];    ///< amplitudes that the faces mirror, of light across the plane of incidence and in it
  Real path = 0;  ///< how much longer the way through the film is, in nanometres

  Faces(const ThinFilm& film, Real cosine) {
    const Real c0 = max(0, min(1, cosine)), square = 1 - c0 * c0;
    const auto inside = [&](Real index) { return 1 - square / (index * index); };  // cos^2, by Snell's law
    const Real s1 = inside(film.index), s2 = inside(film.behind);
    total = !(s1 > 0) || !(s2 > 0);
    if (total) return;
    const Real c1 = std::sqrt(s1), c2 = std::sqrt(s2), n1 = film.index, n2 = film.behind;
    const auto amplitude = [](Real a, Real b) { return a + b > 0 ? (a - b) / (a + b) : 0; };
    front[0] = amplitude(c0, n1 * c1);
    back[0] = amplitude(n1 * c1, n2 * c2);
    front[1] = amplitude(n1 * c0, c1);
    back[1] = amplitude(n2 * c1, n1 * c2);
    path = 2 * n1 * c1 * film.nanometres;
  }

  Real mirrored(Real wavelength) const {
    if (total) return 1;
    const Real turn = std::cos(2 * kPi * path / wavelength);
    Real sum = 0;
    for (int i = 0; i < 2; ++i) {  // Airy's sum of all ways to and fro
      const Real r = front[i], s = back[i], cross = 2 * r * s * turn, below = 1 + r * r * s * s + cross;
      sum += below > 0 ? (r * r + s * s + cross) / below : 1;
    }
    return sum / 2;
  }
};

/// What is left of a wave over all wavelengths, by how much longer the way of one light is than that of the
/// other: the mean of cos(2 pi path / wavelength), weighed by the wavelength's colour. The weights of each
/// channel sum to 1.
class Coherence {
 public:
  Coherence() {
    std::array<Color, kWavelengths> weights;
    Color sum;
    for (std::size_t i = 0; i < kWavelengths; ++i) sum += weights[i] = spectralColor(wavelength(i));
    for (std::size_t step = 0; step <= kSteps; ++step)
      for (std::size_t i = 0; i < kWavelengths; ++i)
        at_[step] += weights[i] * std::cos(2 * kPi * kStep * static_cast<Real>(step) / wavelength(i));
    for (Color& c : at_) c = {c.r / sum.r, c.g / sum.g, c.b / sum.b};
  }

  /// Nothing beyond 24 micrometres.
  Color at(Real path) const {
    const Real place = path / kStep;
    if (!(place < kSteps)) return Color(0);
    const auto low = static_cast<std::size_t>(place);
    return lerp(place - static_cast<Real>(low), at_[low], at_[low + 1]);
  }

 private:
  static constexpr std::size_t kWavelengths = 61, kSteps = 12000;
  static constexpr Real kStep = 2;  // nanometres: what lies between is off by a ten-thousandth
  static Real wavelength(std::size_t i) { return 400.0 + 5 * static_cast<Real>(i); }

  std::vector<Color> at_ = std::vector<Color>(kSteps + 1);
};

/// Airy's sum over all wavelengths, as a series in how much longer the way is: with q = r s
///   1 / (1 + q^2 + 2 q cos x) = (1 + 2 sum (-q)^m cos(m x)) / (1 - q^2).
Color mirroredWhite(Real r, Real s, Real path) {
  static const Coherence kCoherence;
  const Real q = r * s, passes = (1 - r * r) * (1 - s * s), below = 1 - q * q;
  if (!(below > 0)) return Color(1);
  Color sum(1);
  Real factor = 2;
  for (int m = 1; m < 1000 && std::abs(factor) > 1e-5; ++m) sum += kCoherence.at(m * path) * (factor *= -q);
  return Color(1) + sum * (-passes / below);
}

}  // namespace

Real ThinFilm::mirrored(Real cosine, Real wavelength) const {
  return Faces(*this, cosine).mirrored(wavelength);
}

Color ThinFilm::mirrored(Real cosine) const {
  const Faces faces(*this, cosine);
  if (faces.total) return Color(1);
  const Color sum = (mirroredWhite(faces.front[0], faces.back[0], faces.path) +
                     mirroredWhite(faces.front[1], faces.back[1], faces.path)) *
                    0.5;
  const auto shown = [](Real x) { return max(0, min(1, x)); };
  return {shown(sum.r), shown(sum.g), shown(sum.b)};
}

}  // namespace trace
