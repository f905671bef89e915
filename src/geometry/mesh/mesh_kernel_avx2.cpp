// The kernel for machines with AVX2. Compiled with -mavx2 -mfma; called only where the processor has them.
#include "geometry/mesh/mesh_kernel.h"

namespace trace {

extern const MeshKernel kMeshKernelAvx2;
const MeshKernel kMeshKernelAvx2{
    "avx2", {simd::inMesh<NodeCount>, simd::inMesh<NodeWatch>}, simd::closestTogetherInMesh};

}  // namespace trace
