// Gradient noise in three dimensions with the eight corners of a cell in lanes, where the processor has AVX2:
// a third of the instructions, and the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "math/fractal_sum.h"

namespace trace {

/// gradientNoise<3>() and FractalSum::at<3>() of what does not repeat.
struct NoiseLanes {
  Real (*noise)(const std::array<Real, 3>& p, std::uint32_t seed);
  Real (*sum)(const FractalSum& f, const std::array<Real, 3>& p, Real width);
};

/// Null where the processor lacks the lanes.
const NoiseLanes* noiseLanes();

}  // namespace trace
