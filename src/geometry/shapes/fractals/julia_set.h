// A Julia set of powers as the kernels see it (julia_kernel.h).
#pragma once

#include <span>

#include "geometry/shapes/fractals/julia_step.h"
#include "geometry/solve/stretch_search.h"

namespace trace {

struct JuliaSet {
  static constexpr int kMostIterations = 50;
  static constexpr int kSurely = 6;  ///< so many numbers count however far apart they have come

  julia::Number<Real> constant;
  Real share;  ///< share of the place in what is added at each step: 0, or 1 for a Mandelbrot set
  int iterations;
  /// A number that is greater at a step surely escapes, one that is less surely stays.
  Real escapes[kMostIterations + 1], stays[kMostIterations + 1];
  Real mostGrowth;    ///< most growth of the distances between numbers: an orbit that passes it ends before
  Real mostConstant;  ///< the size of what is added, at most
  Real reach;         ///< the set lies within
};

/// Looks at four stretches of the line from `place` on along `unit`, each twice `half` long; compiled for one
/// instruction set.
struct JuliaKernel {
  using Look = FourStretches (*)(const JuliaSet& set, const julia::Number<Real>& place,
                                 const julia::Number<Real>& unit, Real half);
  std::string_view name;
  Look square, cube, hypercomplex;
};

/// The kernels that the machine can run, the fastest first.
std::span<const JuliaKernel> juliaKernels();

}  // namespace trace
