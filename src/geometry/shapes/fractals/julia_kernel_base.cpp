// The kernel for what every machine of the architecture can run: SSE2, NEON, WebAssembly or plain C++.
#include "geometry/shapes/fractals/julia_kernel.h"

namespace trace {

extern const JuliaKernel kJuliaKernelBase;
const JuliaKernel kJuliaKernelBase{"base", simd::lookAt<Iteration::square>, simd::lookAt<Iteration::cube>,
                                   simd::lookAt<Iteration::hypercomplex>};

}  // namespace trace
