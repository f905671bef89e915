#include "shading/optics/thin_film.h"

#include <array>
#include <cmath>
#include <vector>

#include "math/complex.h"
#include "shading/optics/dispersion.h"

namespace trace {
namespace {

/// Terms that are the same for all wavelengths.
struct Faces {
  bool total = false;
  Real front[2],
      back[2];  ///< amplitudes that the faces mirror, of light across the plane of incidence and in it
  Real turn[2] = {0, 0};  ///< change of the phase, at the back, in radians
  Real path = 0;          ///< how much longer the way through the film is, in nanometres

  Faces(const ThinFilm& film, Real cosine) {
    const Real s2 = meet(film, cosine, {film.behind}).re;
    total |= !(s2 > 0);
    if (total) return;
    const Real c1 = inFilm_, c2 = std::sqrt(s2), n1 = film.index, n2 = film.behind;
    back[0] = amplitude(n1 * c1, n2 * c2);
    back[1] = amplitude(n2 * c1, n1 * c2);
  }
  Faces(const ThinFilm& film, const Complex& metal, Real cosine) {
    const Complex c2 = sqrt(meet(film, cosine, metal));
    if (total) return;
    const Complex a{film.index * inFilm_}, b = metal * c2, c = inFilm_ * metal, d = film.index * c2;
    const Complex amplitudes[2] = {(a - b) / (a + b), (c - d) / (c + d)};
    for (int i = 0; i < 2; ++i) {
      back[i] = abs(amplitudes[i]);
      turn[i] = arg(amplitudes[i]);
    }
  }

  Real mirrored(Real wavelength) const {
    if (total) return 1;
    Real sum = 0;
    for (int i = 0; i < 2; ++i) {  // Airy's sum of all ways to and fro
      const Real r = front[i], s = back[i];
      const Real cross = 2 * r * s * math::cos(2 * kPi * path / wavelength + turn[i]);
      const Real below = 1 + r * r * s * s + cross;
      sum += below > 0 ? (r * r + s * s + cross) / below : 1;
    }
    return sum / 2;
  }
  /// The share of white light that is mirrored.
  Color mirrored() const;

 private:
  static Real amplitude(Real a, Real b) { return a + b > 0 ? (a - b) / (a + b) : 0; }
  /// The front, and the square of the cosine behind the film, by Snell's law.
  Complex meet(const ThinFilm& film, Real cosine, const Complex& behind) {
    const Real c0 = max(0, min(1, cosine)), square = 1 - c0 * c0, n1 = film.index;
    const Real s1 = 1 - square / (n1 * n1);
    total = !(s1 > 0);
    inFilm_ = std::sqrt(max(0, s1));
    front[0] = amplitude(c0, n1 * inFilm_);
    front[1] = amplitude(n1 * c0, inFilm_);
    path = 2 * n1 * inFilm_ * film.nanometres;
    return Complex{1} - Complex{square} / (behind * behind);
  }

  Real inFilm_ = 0;  ///< the cosine there
};

/// The mean of a wave over all wavelengths, by how much longer the way of one light is than that of the
/// other: the mean of the cosine or sine of 2 pi path / wavelength, weighed by the wavelength's colour. The
/// weights of each channel sum to 1.
class Coherence {
 public:
  explicit Coherence(Real (*wave)(Real)) {
    std::array<Color, kWavelengths> weights;
    Color sum;
    for (std::size_t i = 0; i < kWavelengths; ++i) sum += weights[i] = spectralColor(wavelength(i));
    for (std::size_t step = 0; step <= kSteps; ++step)
      for (std::size_t i = 0; i < kWavelengths; ++i)
        at_[step] += weights[i] * wave(2 * kPi * kStep * static_cast<Real>(step) / wavelength(i));
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

const Coherence& cosines() {
  static const Coherence kTable([](Real x) { return math::cos(x); });
  return kTable;
}
const Coherence& sines() {
  static const Coherence kTable([](Real x) { return math::sin(x); });
  return kTable;
}

/// Airy's sum over all wavelengths, as a series in how much longer the way is: with q = r s
///   1 / (1 + q^2 + 2 q cos x) = (1 + 2 sum (-q)^m cos(m x)) / (1 - q^2),
/// where x is the phase of that way and `turn`.
Color mirroredWhite(Real r, Real s, Real turn, Real path) {
  const Real q = r * s, passes = (1 - r * r) * (1 - s * s), below = 1 - q * q;
  if (!(below > 0)) return Color(1);
  Color sum(1);
  Real factor = 2;
  for (int m = 1; m < 1000 && std::abs(factor) > 1e-5; ++m) {
    factor *= -q;
    if (turn == 0)
      sum += cosines().at(m * path) * factor;
    else
      sum += (cosines().at(m * path) * math::cos(m * turn) + sines().at(m * path) * -math::sin(m * turn)) *
             factor;
  }
  return Color(1) + sum * (-passes / below);
}

Color Faces::mirrored() const {
  if (total) return Color(1);
  const Color sum =
      (mirroredWhite(front[0], back[0], turn[0], path) + mirroredWhite(front[1], back[1], turn[1], path)) *
      0.5;
  const auto shown = [](Real x) { return max(0, min(1, x)); };
  return {shown(sum.r), shown(sum.g), shown(sum.b)};
}

}  // namespace

Real ThinFilm::mirrored(Real cosine, Real wavelength) const {
  return Faces(*this, cosine).mirrored(wavelength);
}

Color ThinFilm::mirrored(Real cosine) const { return Faces(*this, cosine).mirrored(); }

Real ThinFilm::mirroredOn(Real eta, Real k, Real cosine, Real wavelength) const {
  return Faces(*this, {eta, k}, cosine).mirrored(wavelength);
}

Color ThinFilm::mirroredOn(const ComplexIndex& metal, Real cosine) const {
  const auto of = [&](Real eta, Real k) { return Faces(*this, {eta, k}, cosine).mirrored(); };
  return {of(metal.eta.r, metal.k.r).r, of(metal.eta.g, metal.k.g).g, of(metal.eta.b, metal.k.b).b};
}

Color ThinFilm::changeOn(const Color& alongNormal, Real cosine) const {
  const ComplexIndex metal = indexMirroring(alongNormal);
  return mirroredOn(metal, cosine) + ThinFilm{index, behind, 0}.mirroredOn(metal, cosine) * -1;
}

}  // namespace trace
