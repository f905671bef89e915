// The interface of a measured kernel: it has built a structure over a mesh's triangles and answers arrays of
// rays.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "rays.h"

namespace trace::bench {

class Kernel {
 public:
  virtual ~Kernel() = default;
  virtual void closest(std::span<const BenchRay> rays, std::span<Answer> answers) const = 0;
  virtual void anyHit(std::span<const BenchRay> rays, std::span<Answer> answers) const = 0;
  /// closest() for eight rays at a time, whose number is a multiple of eight.
  virtual void closestOfPackets(std::span<const BenchRay> rays, std::span<Answer> answers) const = 0;

  void answer(const RaySet& set, std::span<Answer> answers) const {
    set.anyHit     ? anyHit(set.rays, answers)
    : set.together ? closestOfPackets(set.rays, answers)
                   : closest(set.rays, answers);
  }

  double buildSeconds = 0;  ///< CPU time of all threads; one thread is allowed
  double bytes = 0;         ///< what the kernel keeps beside the mesh's own points and indices
};

using MeshHandle = std::shared_ptr<const MeshData>;
std::unique_ptr<Kernel> worldKernel(const MeshHandle& mesh);
/// The mesh without a World, by the kernel of that instruction set.
std::unique_ptr<Kernel> meshKernel(const MeshHandle& mesh, const std::string& instructions);

enum class EmbreeMode { standard, robust };
/// `config` is Embree's own: "isa=avx2" keeps it from wider instructions.
std::unique_ptr<Kernel> embreeKernel(const MeshHandle& mesh, EmbreeMode mode, const std::string& config);

}  // namespace trace::bench
