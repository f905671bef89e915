// The irradiance cache of PhotonTracer: which places it has, and what they see.
//
// Pixels are looked at from coarse to fine, always as many at once. Those whose place no record tells of
// become records, worked out side by side and added in their order: so the cache is the same for any number
// of threads.
#include <algorithm>
#include <limits>

#include "base/budget.h"
#include "render/integrators/photon.h"
#include "render/paths/onward.h"
#include "render/samples/hashed_numbers.h"
#include "render/samples/pixel.h"
#include "shading/materials/lambert.h"
#include "shading/optics/optics.h"

namespace trace {
namespace {

/// The share of light that a surface scatters evenly, if that is all that it scatters.
std::optional<Color> evenShare(const Bsdf& bsdf) {
  if (const auto* phong = bsdf.as<PhongBsdf>()) {
    if (isBlack(phong->specular) && !phong->litFromBehind && !isBlack(phong->diffuse)) return phong->diffuse;
  } else if (const auto* lambert = bsdf.as<LambertBsdf>()) {
    if (lambert->scatters()) return lambert->said.diffuse;
  }
  return {};
}

}  // namespace

bool PhotonTracer::addCached(Gather& sum, const Interaction& at) const {
  if (cache_.empty()) return false;
  const auto share = evenShare(at.bsdf());
  if (!share || !(at.cosine > 0)) return false;
  const auto found = cache_.at(at.hit.surface.point, at.normal);
  if (!found) return false;
  sum.add(*share * (1 - at.coat), found->light, CacheTerm{found->records});
  return true;
}

/// One worker.
class PhotonTracer::CacheFiller {
 public:
  struct Pixel {
    int x, y;
  };
  CacheFiller(const PhotonTracer& path, const World& world, const Settings& settings, const Size& size)
      : path_(path),
        settings_(settings),
        pixels_(world, path, settings, size),
        cells_(settings.irradianceRays) {}

  /// Calls use(Interaction) for the first place behind the pixel that scatters evenly, through mirrors and
  /// glass.
  template <class Use>
  void look(const Pixel& pixel, const Use& use) {
    pixels_.look(pixel.x, pixel.y, 0, [&](const CameraRay& camera, const Sampler&) {
      if (camera.hit) follow(camera.ray, *camera.hit, camera.inside, 0, use);
    });
  }
  /// No record tells of it.
  bool isOpen(const Pixel& pixel) {
    bool open = false;
    look(pixel, [&](const Interaction& at) { open = !path_.cache_.at(at.hit.surface.point, at.normal); });
    return open;
  }
  std::optional<IrradianceRecord> record(const Pixel& pixel) {
    std::optional<IrradianceRecord> record;
    look(pixel, [&](const Interaction& at) { record = seenFrom(at, pixel); });
    return record;
  }

 private:
  template <class Use>
  void follow(const Ray& ray, const Hit& hit, const Interfaces& inside, int depth, const Use& use) {
    Tracer& tracer = pixels_.tracer();
    const Interaction at(tracer, ray, hit, nullptr, inside, 0.5);
    if (evenShare(at.bsdf())) {
      if (at.cosine > 0) use(at);
      return;
    }
    if (depth >= settings_.depth) return;
    const auto next = strongestOf(at);
    if (!next) return;
    const Ray onward = hit.leave(next->direction);
    Interfaces there = next->in(inside);
    if (const auto met = tracer.cast(onward, next->kind, there)) follow(onward, *met, there, depth + 1, use);
  }

  IrradianceRecord seenFrom(const Interaction& at, const Pixel& pixel) {
    Tracer& tracer = at.tracer;
    const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    constexpr std::uint64_t kPlaces = 0x6361636865ull;  // other numbers than those of samples
    HashedNumbers hashed(mixBits(mixBits(static_cast<std::uint64_t>(settings_.seed) ^ kPlaces) ^
                                 (bits(pixel.x) << 32 | bits(pixel.y))));
    const Sampler numbers(rules_, hashed);
    const Basis basis = Frame{at.normal}.basis();
    std::vector<HemisphereCells::Seen> seen(static_cast<std::size_t>(cells_.count()));
    for (int n = 0; n < cells_.count(); ++n) {
      const Sampler own = numbers.branch(static_cast<std::uint32_t>(n));
      const Vec3 direction = basis.toWorld(cells_.direction(n, own.branch(0).next2()));
      Path path{{at.leaveToLight(direction), at.inside, own.branch(2), RayKind::bounce}};
      path.depth = 1;
      path.density = std::numeric_limits<Real>::min();  // lamps are sampled, and never hit
      path.from = path.ray.origin;
      path.asked = true;
      path.told = {
          .maps = static_cast<std::size_t>(n) % path_.maps_.size(), .gathers = true, .bounced = true};
      const auto met = tracer.cast(path.ray, RayKind::bounce, path.inside, tracer.chance(own.branch(1)));
      const bool astray = !at.raised() && dot(direction, at.hit.surface.normal) * at.facing() < 0;
      const Color light = astray ? Color(0) : path_.along(tracer, path, met);
      seen[static_cast<std::size_t>(n)] = {isFinite(light) ? light : Color(0), met ? met->t : kInfinity};
    }
    return cells_.record(at.hit.surface.point, basis.x, basis.y, basis.z, seen);
  }

  const PhotonTracer& path_;
  const Settings& settings_;
  PixelTracer pixels_;
  HemisphereCells cells_;
  SampleRules rules_{settings_, Size{1, 1}};
};

void PhotonTracer::fillCache(const World& world, const Settings& settings, Job& job) {
  const Box3& box = world.bounds();
  if (box.empty() || !(maxComponent(box.size()) > 0) || job.cancel) return;
  cache_ = IrradianceCache(box, settings.irradianceCache);
  const CameraFrame& camera = world.camera();
  const Real shape = length(camera.up) / length(camera.right);
  const int width = settings.width, height = settings.height > 0
                                                 ? settings.height
                                                 : std::max(1, static_cast<int>(width * shape + 0.5));
  std::vector<CacheFiller::Pixel> order;
  constexpr int kCoarsest = 16;
  for (int step = kCoarsest; step >= 1; step /= 2)
    for (int y = 0; y < height; y += step)
      for (int x = 0; x < width; x += step)
        if (step == kCoarsest || x % (2 * step) != 0 || y % (2 * step) != 0) order.push_back({x, y});

  constexpr std::size_t kAtOnce = 512, kLooks = 64;
  Work work("filling the irradiance cache", std::ssize(order));
  for (std::size_t first = 0; first < order.size() && !job.cancel; first += kAtOnce) {
    const std::span<const CacheFiller::Pixel> pixels(order.data() + first,
                                                     std::min(kAtOnce, order.size() - first));
    std::vector<char> open(pixels.size());
    const auto chunks = static_cast<std::int64_t>((pixels.size() + kLooks - 1) / kLooks);
    parallelChunks(chunks, settings.threads, job, [&](std::int64_t chunk, int) {
      CacheFiller filler(*this, world, settings, {width, height});
      const auto from = static_cast<std::size_t>(chunk) * kLooks;
      for (std::size_t i = from; i < std::min(from + kLooks, pixels.size()); ++i)
        open[i] = filler.isOpen(pixels[i]);
    });
    std::vector<CacheFiller::Pixel> wanted;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (open[i]) wanted.push_back(pixels[i]);
    std::vector<std::optional<IrradianceRecord>> records(wanted.size());
    if (!job.cancel)
      parallelChunks(std::ssize(wanted), settings.threads, job, [&](std::int64_t i, int) {
        CacheFiller filler(*this, world, settings, {width, height});
        const auto n = static_cast<std::size_t>(i);
        records[n] = filler.record(wanted[n]);
      });
    if (job.cancel) break;
    for (const auto& record : records)
      if (record) cache_.add(*record);
    work.reached(static_cast<std::int64_t>(first + pixels.size()));
  }
  job.done = 0;  // what comes next counts anew
}

}  // namespace trace
