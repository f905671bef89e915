// The kernel for machines with AVX-512. Compiled with -mavx512vl and so on; called only where the processor has
// them.
#include "geometry/mesh_kernel.h"

namespace trace {

extern const MeshKernel kMeshKernelAvx512;
const MeshKernel kMeshKernelAvx512{"avx512", simd::closestInMesh, simd::crossingsOfMesh};

}  // namespace trace
