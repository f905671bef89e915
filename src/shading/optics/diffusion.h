// How far light spreads inside a body that scatters much of it: the profiles R(r) of light that leaves a flat
// surface at the distance r from where it went in, of two models, each chosen from exactly.
//
// Dipole: Jensen, Marschner, Levoy and Hanrahan, A Practical Model for Subsurface Light Transport, SIGGRAPH
// 2001, equations 4 and 15. The light through the disk of radius r below each of the two sources has a closed
// form, (a'/2) (exp(-s z) - (z / d) exp(-s d)), which is inverted here.
// Normalised diffusion: Christensen and Burley, Approximate Reflectance Profiles for Efficient Subsurface
// Scattering, Pixar technical memo 15-04, equations 3 and 8, with the albedo of the dipole.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vec.h"

namespace trace {

/// The share of diffuse light that a smooth surface of that index mirrors: from outside (Egan and Hilgeman
/// 1973, as in d'Eon and Irving 2011), and from inside (the fit of equation 2 of Jensen and others).
Real diffuseFresnelInside(Real index);

/// The dipole of one colour channel.
struct Dipole {
  Real albedo = 0;            ///< albedo of the surface: all light that leaves over all that enters
  Real reduced = 0;           ///< a', the albedo of one scattering
  Real fade = 1;              ///< s, the effective transport coefficient
  Real above = 0, below = 0;  ///< heights of the virtual source and depth of the real one

  Dipole() = default;
  /// Coefficients along a unit of length: reduced scattering, absorption.
  Dipole(Real scatters, Real absorbs, Real index);

  Real profile(Real r) const;
  /// The distance that u from 0 up to 1 chooses, with the density profile(r) / albedo per area.
  Real distance(Real u) const;
};

struct NormalizedDiffusion {
  Real albedo = 0;
  Real reach = 1;  ///< d = l / s: the mean free path by the fit

  NormalizedDiffusion() = default;
  NormalizedDiffusion(Real scatters, Real absorbs, Real albedoOfSurface);

  Real profile(Real r) const;
  Real distance(Real u) const;
};

}  // namespace trace
