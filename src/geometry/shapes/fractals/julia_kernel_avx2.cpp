// The kernel for machines with AVX2. Compiled with -mavx2 -mfma; called only where the processor has them.
#include "geometry/shapes/fractals/julia_kernel.h"

namespace trace {

extern const JuliaKernel kJuliaKernelAvx2;
const JuliaKernel kJuliaKernelAvx2{"avx2", simd::lookAt<Iteration::square>, simd::lookAt<Iteration::cube>,
                                   simd::lookAt<Iteration::hypercomplex>};

}  // namespace trace
