#include "math/noise_kernel.h"
#include "math/noise_lanes.h"

namespace trace {

#if defined(TRACE_HAS_AVX2)
extern const NoiseLanes kNoiseLanesAvx2;  // compiled with its own flags

const NoiseLanes* noiseLanes() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has ? &kNoiseLanesAvx2 : nullptr;
}
#else
const NoiseLanes* noiseLanes() { return nullptr; }
#endif

template <int N>
Real gradientNoise(const std::array<Real, N>& p, std::uint32_t seed, const std::int64_t* period) {
  if (period) return noise_kernel::at<N, true>(p, seed, period);
  if constexpr (N == 3)
    if (const NoiseLanes* lanes = noiseLanes()) return lanes->noise(p, seed);
  return noise_kernel::at<N, false>(p, seed, nullptr);
}

template Real gradientNoise<1>(const std::array<Real, 1>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<2>(const std::array<Real, 2>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<3>(const std::array<Real, 3>&, std::uint32_t, const std::int64_t*);
template Real gradientNoise<4>(const std::array<Real, 4>&, std::uint32_t, const std::int64_t*);

}  // namespace trace
