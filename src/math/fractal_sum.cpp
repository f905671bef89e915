#include "math/fractal_sum.h"

#include "math/fractal_kernel.h"
#include "math/noise_kernel.h"
#include "math/noise_lanes.h"

namespace trace {

template <int N>
Real FractalSum::at(std::array<Real, N> p, Real width, const std::int64_t* period) const {
  const auto with = [&]<bool kPeriodic>() {
    return fractal_kernel::summedBy<kPeriodic, N>(*this, p, width, period, noise_kernel::at<N, kPeriodic>);
  };
  if (period) return with.template operator()<true>();
  if constexpr (N == 3)
    if (const NoiseLanes* lanes = noiseLanes()) return lanes->sum(*this, p, width);
  return with.template operator()<false>();
}

template Real FractalSum::at<1>(std::array<Real, 1>, Real, const std::int64_t*) const;
template Real FractalSum::at<2>(std::array<Real, 2>, Real, const std::int64_t*) const;
template Real FractalSum::at<3>(std::array<Real, 3>, Real, const std::int64_t*) const;
template Real FractalSum::at<4>(std::array<Real, 4>, Real, const std::int64_t*) const;

}  // namespace trace
