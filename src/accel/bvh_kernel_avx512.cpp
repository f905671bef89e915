// The kernel for machines with AVX-512 and its 256-bit forms. Compiled like
// geometry/mesh/mesh_kernel_avx512.cpp; called only where the processor has them.
#include "accel/bvh_kernel.h"
#include "accel/packet.h"

namespace trace {

extern const BvhKernel kBvhKernelAvx512;
const BvhKernel kBvhKernelAvx512{
    "avx512", {simd::queryLeaves<NodeCount>, simd::queryLeaves<NodeWatch>}, simd::queryLeavesTogether};

}  // namespace trace
