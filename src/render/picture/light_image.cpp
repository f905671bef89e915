#include "render/picture/light_image.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <tuple>

#include "base/budget.h"
#include "image/film/splat_plane.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

/// The splats of the pixel, in an order that does not depend on threads.
class Landings {
 public:
  void add(std::span<const Landing> landings, std::int64_t paths) {
    std::vector<Splat> splats;
    for (const Landing& landing : landings) splats.push_back({0, 0, landing.brings});
    const std::lock_guard lock(mutex_);
    sum_.add(splats, paths);
    all_ += std::ssize(landings);
    brightest_.insert(brightest_.end(), landings.begin(), landings.end());
    keepBrightest();
  }
  LightImagePixel result() const {
    LightImagePixel result{sum_.mean(0, 0), sum_.paths(), all_, brightest_};
    for (Landing& landing : result.brightest) landing.brings *= Color(1 / static_cast<Real>(sum_.paths()));
    return result;
  }

 private:
  void keepBrightest() {
    std::sort(brightest_.begin(), brightest_.end(), [](const Landing& a, const Landing& b) {
      return std::tuple(-luminanceOf(a.brings), a.y, a.x, a.sample, a.light) <
             std::tuple(-luminanceOf(b.brings), b.y, b.x, b.sample, b.light);
    });
    if (brightest_.size() > LightImagePixel::kMostShown) brightest_.resize(LightImagePixel::kMostShown);
  }

  std::mutex mutex_;
  SplatPlane sum_{1, 1};
  std::int64_t all_ = 0;
  std::vector<Landing> brightest_;
};

}  // namespace

LightImagePixel lightImageAt(std::span<const Moment> moments, const Settings& settings, const Size& size,
                             int x, int y, Job& job) {
  if (!hasLightImage(settings) || subdivides(settings)) return {};
  const Tile area = areaOf(settings.region, size);
  if (x < area.x0 || x >= area.x1 || y < area.y0 || y >= area.y1) return {};
  if (settings.cameraVertices >= 0 && settings.cameraVertices != 1) return {};
  const int samples = PixelTracer(moments, settings, size).samples();
  Landings landings;
  Work work("following paths from the lights", size.height);
  std::atomic<std::int64_t> rows{0};
  parallelChunks(size.height, settings.threads, job, [&](std::int64_t row, int) {
    PixelTracer tracer(moments, settings, size);
    std::vector<Splat> splats;
    tracer.collect(&splats);
    std::vector<Landing> here;
    const int v = static_cast<int>(row);
    for (int u = 0; u < size.width; ++u)
      for (int k = 0; k < samples; ++k) {
        splats.clear();
        tracer.throwLight(u, v, k);
        if (std::none_of(splats.begin(), splats.end(),
                         [&](const Splat& splat) { return splat.x == x && splat.y == y; }))
          continue;
        for (const Thrown& thrown : tracer.thrown())
          tracer.spread(thrown, [&](const Splat& splat) {
            if (splat.x == x && splat.y == y) here.push_back({u, v, k, thrown.light, splat.value});
          });
      }
    landings.add(here, std::int64_t{size.width} * samples);
    work.reached(++rows);
  });
  return landings.result();
}

}  // namespace trace
