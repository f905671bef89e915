#include "accel/bvh_kernel.h"

#include <array>

namespace trace {

// Compiled from traverse.h, each in its own file with its own flags.
#if defined(TRACE_HAS_AVX2)
extern const BvhKernel kBvhKernelAvx512;
extern const BvhKernel kBvhKernelAvx2;
#endif
extern const BvhKernel kBvhKernelBase;

bool hasAvx2() {
#if defined(TRACE_HAS_AVX2)
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
#else
  return false;
#endif
}

bool hasAvx512() {
#if defined(TRACE_HAS_AVX2)
  static const bool has = hasAvx2() && __builtin_cpu_supports("avx512vl");
  return has;
#else
  return false;
#endif
}

std::span<const BvhKernel> bvhKernels() {
#if defined(TRACE_HAS_AVX2)
  static const std::array<BvhKernel, 3> kAll{kBvhKernelAvx512, kBvhKernelAvx2, kBvhKernelBase};
  return std::span(kAll).subspan(hasAvx512() ? 0 : hasAvx2() ? 1 : 2);
#else
  return {&kBvhKernelBase, 1};
#endif
}

}  // namespace trace
