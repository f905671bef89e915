// What comes back from a half space that scatters light evenly in all directions: Chandrasekhar's function H
// (Radiative Transfer, 1960, chapter V).
#pragma once

#include <array>
#include <cmath>

#include "math/vec.h"

namespace trace::test {

class HalfSpace {
 public:
  /// A half-space of that albedo of one scattering.
  explicit HalfSpace(Real albedo) : albedo_(albedo) {
    h_.fill(1);
    for (int pass = 0; pass < 3000; ++pass) {
      std::array<Real, kSteps> next;
      for (std::size_t i = 0; i < kSteps; ++i) next[i] = value(at(i));
      h_ = next;
    }
  }
  Real value(Real mu) const {
    Real sum = 0;
    for (std::size_t i = 0; i < kSteps; ++i) sum += at(i) * h_[i] / (mu + at(i)) / kSteps;
    return 1 / (std::sqrt(1 - albedo_) + albedo_ / 2 * sum);
  }
  /// The share of light from the cosine mu that comes back.
  Real reflects(Real mu) const { return 1 - value(mu) * std::sqrt(1 - albedo_); }
  /// The radiance toward mu under light of irradiance pi, across its way, from mu0.
  Real radiance(Real mu, Real mu0) const { return albedo_ / 4 * mu0 / (mu + mu0) * value(mu) * value(mu0); }

 private:
  static constexpr std::size_t kSteps = 200;
  static Real at(std::size_t i) { return (static_cast<Real>(i) + 0.5) / kSteps; }
  Real albedo_;
  std::array<Real, kSteps> h_;
};

}  // namespace trace::test
