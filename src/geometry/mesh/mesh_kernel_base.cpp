// The kernel for what every machine of the architecture can run: SSE2, NEON, WebAssembly or plain C++.
#include "geometry/mesh/mesh_kernel.h"

namespace trace {

extern const MeshKernel kMeshKernelBase;
const MeshKernel kMeshKernelBase{
    "base", {simd::inMesh<NodeCount>, simd::inMesh<NodeWatch>}, simd::closestTogetherInMesh};

}  // namespace trace
