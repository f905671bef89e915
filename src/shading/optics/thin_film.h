// Colours of thin films: light from the two faces of a film adds up or cancels by its wavelength, as on soap
// bubbles, oil on water and tempered steel (Airy 1833; Born and Wolf, Principles of Optics, section 7.6).
#pragma once

#include "math/color.h"
#include "math/vec.h"
#include "shading/optics/metals.h"

namespace trace {

/// A layer so thin that light from both its faces interferes.
struct ThinFilm {
  Real index = 1.33;    ///< index of refraction, of the film
  Real behind = 1;      ///< and of what is behind it; before it is air
  Real nanometres = 0;  ///< its thickness

  /// The share that it mirrors of unpolarised light of one wavelength, in nanometres; `cosine` is that of the
  /// light to the normal. 1 under total internal reflection. A film of thickness 0 changes nothing.
  Real mirrored(Real cosine, Real wavelength) const;

  /// The reflectance for white light, in linear Rec. 709: from 400 to 700 nm, by the CIE's observer of 1931
  /// (spectralColor), for light that holds as much of every wavelength, which is white. Colours outside what
  /// a screen shows are cut off. From a few micrometres on the colours wash out, as they do in life.
  Color mirrored(Real cosine) const;

  /// The reflectance of a film on a metal of the index eta + i k, in place of `behind`.
  Real mirroredOn(Real eta, Real k, Real cosine, Real wavelength) const;
  /// Each channel by its index, which is taken to be that of all wavelengths.
  Color mirroredOn(const ComplexIndex& metal, Real cosine) const;
  /// How much more is mirrored with the film than without it, of a metal that is known by its colour alone.
  Color changeOn(const Color& alongNormal, Real cosine) const;
};

}  // namespace trace
