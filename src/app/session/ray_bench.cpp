#include "app/session/ray_bench.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "app/session/session.h"
#include "base/budget.h"
#include "base/os/process.h"
#include "math/elementary.h"
#include "math/perpendicular.h"
#include "render/picture/render.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

struct Query {
  Ray ray;
  Real tMost = kInfinity;
};

/// Cosine-distributed about the normal; the i-th of a sequence that fills the square evenly (Roberts 2018).
Vec3 aroundNormal(const Vec3& normal, std::uint64_t i) {
  const auto n = static_cast<Real>(i);
  const Real u = std::fmod(0.5 + n * 0.7548776662466927, 1.0),
             v = std::fmod(0.5 + n * 0.5698402909980532, 1.0);
  const Vec3 x = perpendicularTo(normal), y = cross(normal, x);
  const Real angle = 2 * kPi * u, r = std::sqrt(v);
  return normalize(x * (r * math::cos(angle)) + y * (r * math::sin(angle)) + normal * std::sqrt(1 - v));
}

/// Answers all queries once; closest hits, or whether there is any.
std::uint64_t answer(const World& world, const std::vector<Query>& queries, bool anyHit,
                     Statistics& statistics) {
  std::uint64_t hits = 0;
  for (const Query& query : queries)
    if (anyHit)
      world.crossings(query.ray, query.tMost, Faces::both, statistics, [&](const Found&) {
        ++hits;
        return true;
      });
    else
      hits += world.closest(query.ray, Faces::both, statistics).has_value();
  return hits;
}

RayBench::Kind measureKind(const World& world, std::string_view name, const std::vector<Query>& queries,
                           bool anyHit, int passes) {
  constexpr double kLeastSeconds = 0.1;  // least seconds of a pass, which repeats the queries if they are few
  const Work work("measuring");
  RayBench::Kind kind{.name = name, .rays = queries.size()};
  Statistics statistics;
  kind.hits = answer(world, queries, anyHit, statistics);  // also fills the caches
  const double count = static_cast<double>(queries.size());
  kind.nodes = static_cast<double>(statistics.nodes.count) / count;
  for (std::uint64_t tests : statistics.tests) kind.tests += static_cast<double>(tests) / count;

  std::vector<double> seconds;
  for (int pass = 0; pass < passes; ++pass) {
    const double begin = os::cpuSeconds();
    double spent = 0, rounds = 0;
    do {
      answer(world, queries, anyHit, statistics);
      spent = os::cpuSeconds() - begin;
      ++rounds;
    } while (spent < kLeastSeconds);
    seconds.push_back(spent / rounds);
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  kind.seconds = *middle;
  return kind;
}

}  // namespace

RayBench benchRays(const Scene& scene, const Settings& settings, int passes, Messages& messages) {
  const Size size = pictureSize(settings, scene.camera);
  // All rays are kept, so that making them is not measured: up to one of each kind, of shadow one per light.
  checkMemory("the list of rays", size, (2 + scene.lights.size()) * sizeof(Query), settings);
  RayBench bench;
  const auto start = std::chrono::steady_clock::now();
  const double cpu = os::cpuSeconds();
  const World world = compile(scene, settings, messages);
  bench.buildCpu = os::cpuSeconds() - cpu;
  bench.buildWall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  bench.triangles = world.triangleCount();
  bench.bytes = world.bytes();

  const SampleRules rules(settings, size);
  const std::size_t most = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  std::vector<Query> primary, bounce, shadow;
  primary.reserve(most);
  bounce.reserve(most);
  shadow.reserve(most * scene.lights.size());
  Statistics statistics;
  std::optional<Work> work(std::in_place, "making the rays", size.height);
  for (int y = 0; y < size.height; ++y) {
    work->reached(y);
    for (int x = 0; x < size.width; ++x) {
      const Ray ray = world.camera().ray(Sampler(rules, x, y, 0).film().place);
      primary.push_back({ray});
      const auto found = world.closest(ray, Faces::both, statistics);
      if (!found) continue;
      const Hit hit(world, ray, *found);
      const Vec3 facing = hit.leaving ? -hit.surface.normal : hit.surface.normal;
      bounce.push_back({hit.leave(aroundNormal(facing, bounce.size()))});
      for (std::size_t light = 0; light < world.lights().size(); ++light) {
        const auto arriving = world.illuminate(light, hit.surface.point);
        if (arriving && dot(facing, arriving->toLight) > 0)
          shadow.push_back({hit.leave(arriving->toLight), arriving->distance});
      }
    }
  }
  work.reset();
  const auto add = [&](std::string_view name, const std::vector<Query>& queries, bool anyHit) {
    if (!queries.empty()) bench.kinds.push_back(measureKind(world, name, queries, anyHit, passes));
  };
  add("primary", primary, false);
  add("bounce", bounce, false);
  add("shadow", shadow, true);
  return bench;
}

}  // namespace trace
