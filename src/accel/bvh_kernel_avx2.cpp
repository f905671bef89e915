// The kernel for machines with AVX2. Compiled with -mavx2 -mfma; called only where the processor has them.
#include "accel/bvh_kernel.h"
#include "accel/packet.h"

namespace trace {

extern const BvhKernel kBvhKernelAvx2;
const BvhKernel kBvhKernelAvx2{
    "avx2", {simd::queryLeaves<NodeCount>, simd::queryLeaves<NodeWatch>}, simd::queryLeavesTogether};

}  // namespace trace
