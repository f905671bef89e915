// Our side: a scene of one mesh, untransformed, compiled to a World. This file is the only one that calls the
// World; a faster call for one kind of ray is put to use here.
#include <malloc.h>

#include <array>
#include <optional>

#include "kernel.h"
#include "render/world/world.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

Ray worldRay(const BenchRay& ray) { return {Vec3(ray.origin), Vec3(ray.direction)}; }

std::optional<Found> closestHit(const World& world, const Ray& ray, Statistics& statistics) {
  return world.closest(ray, Faces::both, statistics);
}

Answer answerOf(const std::optional<Found>& found) {
  return found ? Answer{static_cast<float>(found->t), static_cast<std::uint32_t>(found->part)} : Answer{};
}

bool anyHitBefore(const World& world, const Ray& ray, Real tMost, Statistics& statistics) {
  bool hit = false;
  world.crossings(ray, tMost, Faces::both, statistics, [&](const Found&) { return hit = true; });
  return hit;
}

double heapBytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// The size that the World reports if it does, else how much the heap has grown.
template <class W>
double bytesOf(const W& world, double heapGrowth) {
  if constexpr (requires { world.bytes(); }) return static_cast<double>(world.bytes());
  return heapGrowth;
}

class WorldKernel : public Kernel {
 public:
  explicit WorldKernel(const MeshHandle& mesh) {
    Scene scene;
    scene.materials.emplace_back();
    scene.objects.push_back(
        {.name = {}, .shape = Mesh{mesh}, .worldFromObject = {}, .material = 0, .place = {}});
    Settings settings;
    settings.threads = 1;
    Messages messages;
    const double heap = heapBytes(), begin = processSeconds();
    world_ = compile(scene, settings, messages);
    buildSeconds = processSeconds() - begin;
    bytes = bytesOf(world_, heapBytes() - heap);
  }

  void closest(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Statistics statistics;
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers[i] = answerOf(closestHit(world_, worldRay(rays[i]), statistics));
  }

  void closestOfPackets(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Statistics statistics;
    for (std::size_t first = 0; first < rays.size(); first += RayPacket::kRays) {
      std::array<Ray, RayPacket::kRays> packet;
      std::array<const Ray*, RayPacket::kRays> asked;
      std::array<Found, RayPacket::kRays> hits;
      std::array<Found*, RayPacket::kRays> found;
      for (std::size_t i = 0; i < packet.size(); ++i) {
        packet[i] = worldRay(rays[first + i]);
        asked[i] = &packet[i];
        found[i] = &hits[i];
      }
      world_.closest(asked, Faces::both, statistics, found);
      for (std::size_t i = 0; i < packet.size(); ++i)
        answers[first + i] = hits[i].t < kInfinity ? answerOf(hits[i]) : Answer{};
    }
  }

  void anyHit(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    Statistics statistics;
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers[i] =
          anyHitBefore(world_, worldRay(rays[i]), rays[i].tMax, statistics) ? Answer{0, 0} : Answer{};
  }

 private:
  World world_;
};

}  // namespace

std::unique_ptr<Kernel> worldKernel(const MeshHandle& mesh) { return std::make_unique<WorldKernel>(mesh); }

}  // namespace trace::bench
