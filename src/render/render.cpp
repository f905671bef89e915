#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <tuple>

#include "base/budget.h"
#include "render/passes.h"
#include "render/pixel.h"

namespace trace {
namespace {

/// Pixels of one tile, one after the other; what a worker does.
class TileRenderer {
 public:
  /// `interrupt` may throw GivenUp.
  TileRenderer(const World& world, const Settings& settings, Film& film, std::function<void()> interrupt)
      : budget_(std::move(interrupt)),
        tracer_(world, settings, {film.width(), film.height()}),
        region_(settings.region),
        film_(film),
        passes_(passesOf(settings)),
        passSums_(passes_.size()) {
    if (film.layers() != passes_.size()) passes_.clear();
  }

  void render(const Tile& tile) {
    const BudgetScope scope(&budget_);
    const auto bad = [&](int x, int y, int sample) {
      ++tracer_.statistics().badSamples;
      if (bad_.size() < kMostBadSamples) bad_.push_back({x, y, sample});
    };
    const Region& r = region_;
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        if (r.whole() || (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1)) {
          film_.set(x, y, tracer_.pixel(x, y, bad));
          if (!passes_.empty()) setPasses(x, y);
        }
  }

  Statistics& statistics() { return tracer_.statistics(); }
  std::vector<BadSample>& badSamples() { return bad_; }

 private:
  /// Casts camera rays of its own, so that no integrator has to know of passes.
  void setPasses(int x, int y) {
    const bool averages =
        std::any_of(passes_.begin(), passes_.end(), [](const PassRow* pass) { return pass->averaged; });
    const int samples = averages ? tracer_.samples() : 1;
    std::fill(passSums_.begin(), passSums_.end(), Color(0));
    for (int sample = 0; sample < samples; ++sample) {
      const Ray ray = tracer_.cameraRay(x, y, sample);
      Tracer& tracer = tracer_.tracer();
      const std::optional<Hit> hit = tracer.cast(ray, RayKind::camera);
      const bool tooNear = !hit && tracer.tooNear(ray);
      for (std::size_t i = 0; i < passes_.size(); ++i)
        if (sample == 0 || passes_[i]->averaged)
          passSums_[i] += hit       ? passes_[i]->value(*hit, ray, tracer)
                          : tooNear ? passes_[i]->tooNear
                                    : passes_[i]->background;
    }
    for (std::size_t i = 0; i < passes_.size(); ++i)
      film_.set(i, x, y, passes_[i]->averaged ? passSums_[i] / samples : passSums_[i]);
  }

  Budget budget_;
  PixelTracer tracer_;
  const Region region_;
  Film& film_;
  std::vector<const PassRow*> passes_;
  std::vector<Color> passSums_;
  std::vector<BadSample> bad_;
};

}  // namespace

Size pictureSize(const Settings& settings, const Camera& camera) {
  constexpr double kMost = 1 << 20;
  double height = settings.height;
  if (settings.height == 0) height = std::max(1.0, std::floor(settings.width / camera.aspectratio + 0.5));
  if (!(height <= kMost))
    throw Error(Fault::limit,
                "the picture would be " + std::to_string(settings.width) + " pixels wide and more than " +
                    std::to_string(static_cast<int>(kMost)) + " high",
                "the camera's aspect ratio (width / height) is very small; --height N sets the height");
  return {settings.width, static_cast<int>(height)};
}

int gridSize(const Settings& settings) { return static_cast<int>(std::ceil(std::sqrt(settings.spp))); }

RenderResult render(const World& world, const Settings& settings, Film& film, Job& job) {
  using Clock = std::chrono::steady_clock;
  Budget clock(budgetOfThread.budget);
  if (!budgetOfThread.budget) clock.limitTime(settings.timeLimit);
  std::atomic<bool> late{false};
  // Looks at the time in the midst of a tile, of which one can take hours. Each worker has a copy.
  const auto interrupt = [&, stopping = std::optional<Clock::time_point>()]() mutable {
    if (clock.timeIsOver() && !job.cancel.exchange(true)) late = true;
    if (!job.cancel) return;
    const Clock::time_point now = Clock::now();
    if (!stopping) stopping = now;
    if (now - *stopping >= job.patience) throw GivenUp{};
  };

  const int threads = settings.threads > 0 ? settings.threads : hardwareThreads();
  std::vector<std::unique_ptr<TileRenderer>> workers(static_cast<std::size_t>(threads));
  const auto renderTile = [&](std::int64_t chunk, int worker) {
    auto& renderer = workers[static_cast<std::size_t>(worker)];
    if (!renderer) renderer = std::make_unique<TileRenderer>(world, settings, film, interrupt);
    renderer->render(film.tile(chunk));
    film.markDone(chunk);
  };

  RenderResult result;
  bool outOfMemory = false;
  try {
    parallelChunks(film.tiles(), threads, job, renderTile);
  } catch (const std::bad_alloc&) {
    outOfMemory = true;
    result.failure = "out of memory";
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  for (const auto& renderer : workers) {
    if (!renderer) continue;
    result.statistics += renderer->statistics();
    result.badSamples.insert(result.badSamples.end(), renderer->badSamples().begin(),
                             renderer->badSamples().end());
  }
  std::sort(result.badSamples.begin(), result.badSamples.end(), [](const BadSample& a, const BadSample& b) {
    return std::tie(a.y, a.x, a.sample) < std::tie(b.y, b.x, b.sample);
  });
  result.badSamples.resize(std::min(result.badSamples.size(), kMostBadSamples));
  result.end = job.done == job.total     ? End::finished
               : outOfMemory             ? End::outOfMemory
               : !result.failure.empty() ? End::failed
               : late                    ? End::timeLimit
                                         : End::cancelled;
  return result;
}

}  // namespace trace
