#include "math/noise_kernel.h"

namespace trace {

template <int N>
Real gradientNoise(const std::array<Real, N>& p, std::uint32_t seed, const std::int64_t* period) {
  return period ? noise_kernel::at<N, true>(p, seed, period) : noise_kernel::at<N, false>(p, seed, nullptr);
}

template Real gradientNoise<1>(const std::array<Real, 1>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<2>(const std::array<Real, 2>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<3>(const std::array<Real, 3>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<4>(const std::array<Real, 4>&, std::uint32_t, const std::int64_t*);

}  // namespace trace
