#include "rays.h"

#include <utility>

namespace trace::bench {
namespace {

/// PCG-XSH-RR 32 (O'Neill 2014): small, and the same everywhere, unlike std::shuffle.
class Random {
 public:
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return (mixed >> turn) | (mixed << ((32 - turn) & 31));
  }
  double unit() { return next() * 0x1p-32; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * static_cast<double>(n)); }

 private:
  std::uint64_t state_ = 20261121;
};

Vec3 aroundNormal(const Vec3& n, Random& random) {
  const double angle = 2 * kPi * random.unit(), r2 = random.unit();
  const Vec3 helper = std::abs(n.x) > 0.5 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 u = normalize(cross(helper, n)), v = cross(n, u);
  const double r = std::sqrt(r2);
  return normalize(u * (r * std::cos(angle)) + v * (r * std::sin(angle)) + n * std::sqrt(1 - r2));
}

}  // namespace

std::vector<BenchRay> primaryRays(const View& view) {
  const Vec3 forward = view.forward(), right = view.right(), up = view.up();
  std::vector<BenchRay> rays;
  rays.reserve(static_cast<std::size_t>(view.size) * static_cast<std::size_t>(view.size));
  for (int blockY = 0; blockY < view.size; blockY += 2)
    for (int blockX = 0; blockX < view.size; blockX += 4)
      for (int y = blockY; y < std::min(blockY + 2, view.size); ++y)
        for (int x = blockX; x < std::min(blockX + 4, view.size); ++x) {
          const double sx = (2 * x + 1.0) / view.size - 1, sy = 1 - (2 * y + 1.0) / view.size;
          rays.push_back(
              {.origin = Vec3f(view.eye), .direction = Vec3f(normalize(forward + right * sx + up * sy))});
        }
  return rays;
}

std::array<RaySet, 3> secondaryRays(const View& view, const MeshData& mesh, std::span<const BenchRay> primary,
                                    std::span<const Answer> answers) {
  RaySet bounce{"bounce", false, {}}, shadow{"shadow", true, {}};
  Random random;
  for (std::size_t i = 0; i < primary.size(); ++i) {
    if (!answers[i].hit()) continue;
    const Vec3 direction(primary[i].direction);
    Vec3 normal = normalize(faceNormal(mesh, answers[i].triangle));
    if (dot(normal, direction) > 0) normal = -normal;
    const Vec3 point = Vec3(primary[i].origin) + direction * answers[i].t + normal * (1e-4 * view.radius);
    bounce.rays.push_back({.origin = Vec3f(point), .direction = Vec3f(aroundNormal(normal, random))});
    const Vec3 toLight = view.light - point;
    if (dot(toLight, normal) > 0)
      shadow.rays.push_back({.origin = Vec3f(point),
                             .direction = Vec3f(normalize(toLight)),
                             .tMax = static_cast<float>(0.999 * length(toLight))});
  }
  RaySet shuffled{"bounce_shuffled", false, bounce.rays};
  for (std::size_t i = shuffled.rays.size(); i > 1; --i)
    std::swap(shuffled.rays[i - 1], shuffled.rays[random.below(i)]);
  return {std::move(bounce), std::move(shuffled), std::move(shadow)};
}

}  // namespace trace::bench
