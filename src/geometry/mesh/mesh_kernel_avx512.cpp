// The kernel for machines with AVX-512 and its 256-bit forms. Compiled with -mavx512f -mavx512vl, without the
// other parts, with which GCC moves the masks of lanes to and fro; called only where the processor has them.
#include "geometry/mesh/mesh_kernel.h"

namespace trace {

extern const MeshKernel kMeshKernelAvx512;
const MeshKernel kMeshKernelAvx512{
    "avx512", {simd::inMesh<NodeCount>, simd::inMesh<NodeWatch>}, simd::closestTogetherInMesh};

}  // namespace trace
