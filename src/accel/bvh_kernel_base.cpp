// The kernel for what every machine of the architecture can run: SSE2, NEON, WebAssembly or plain C++.
#include "accel/bvh_kernel.h"
#include "accel/packet.h"

namespace trace {

extern const BvhKernel kBvhKernelBase;
const BvhKernel kBvhKernelBase{
    "base", {simd::queryLeaves<NodeCount>, simd::queryLeaves<NodeWatch>}, simd::queryLeavesTogether};

}  // namespace trace
