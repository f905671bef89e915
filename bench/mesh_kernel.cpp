// Our hierarchy of a mesh, without a World around it, by the kernel of an instruction set.
#include <algorithm>
#include <stdexcept>

#include "geometry/mesh/mesh_tree.h"
#include "kernel.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

const trace::MeshKernel& kernelOf(const std::string& instructions) {
  for (const trace::MeshKernel& kernel : meshKernels())
    if (kernel.name == instructions) return kernel;
  throw std::runtime_error("this machine has no kernel for " + instructions);
}

Ray meshRay(const BenchRay& ray) { return {Vec3(ray.origin), Vec3(ray.direction)}; }
Answer answerOf(const MeshHit& hit) {
  return hit.triangle == Bvh::kNoItem ? Answer{} : Answer{static_cast<float>(hit.hit.t), hit.triangle};
}
MeshHit nothingYet() {
  MeshHit hit;
  hit.hit.t = kInfinity;
  return hit;
}

class MeshOnly : public Kernel {
 public:
  MeshOnly(const MeshHandle& mesh, const std::string& instructions) {
    const double begin = processSeconds();
    tree_ = std::make_unique<MeshTree>(mesh, false, 1, kernelOf(instructions));
    buildSeconds = processSeconds() - begin;
    bytes = static_cast<double>(tree_->bytes());
  }

  void closest(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Counts counts;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      MeshHit best = nothingYet();
      tree_->closest(meshRay(rays[i]), best, nullptr, counts.both());
      answers[i] = answerOf(best);
    }
  }

  void closestOfPackets(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Counts counts;
    for (std::size_t first = 0; first < rays.size(); first += RayPacket::kRays) {
      Ray packet[RayPacket::kRays];
      const Ray* rayOf[RayPacket::kRays];
      MeshHit best[RayPacket::kRays];
      for (std::size_t i = 0; i < RayPacket::kRays; ++i) {
        packet[i] = meshRay(rays[first + i]);
        rayOf[i] = &packet[i];
        best[i] = nothingYet();
      }
      tree_->closest(rayOf, best, 255, counts.both());
      for (std::size_t i = 0; i < RayPacket::kRays; ++i) answers[first + i] = answerOf(best[i]);
    }
  }

  void anyHit(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Counts counts;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      bool hit = false;
      const auto end = [&](const MeshHit&) { return hit = true; };
      tree_->crossings(meshRay(rays[i]), static_cast<Real>(rays[i].tMax), end, counts.both());
      answers[i] = hit ? Answer{0, 0} : Answer{};
    }
  }

 private:
  struct Counts {
    NodeCount nodes;
    std::uint64_t triangles = 0;
    MeshCounts<> both() { return {nodes, triangles}; }
  };
  std::unique_ptr<MeshTree> tree_;
};

}  // namespace

std::unique_ptr<Kernel> meshKernel(const MeshHandle& mesh, const std::string& instructions) {
  return std::make_unique<MeshOnly>(mesh, instructions);
}

}  // namespace trace::bench
