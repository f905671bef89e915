#include "render/picture/render.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <tuple>

#include "base/budget.h"
#include "math/noise.h"
#include "render/chains/metropolis.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/light_split.h"
#include "render/picture/passes.h"
#include "render/picture/seen_behind.h"
#include "render/rays/fog.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

std::int64_t pixelsIn(const Tile& area) {
  return std::int64_t{std::max(0, area.x1 - area.x0)} * std::max(0, area.y1 - area.y0);
}
bool isIn(const Tile& area, int x, int y) {
  return x >= area.x0 && x < area.x1 && y >= area.y0 && y < area.y1;
}

/// How much of what the camera ray sees is not the environment behind the scene. Glass and mirrors are
/// opaque.
Real alphaOf(const CameraRay& camera, bool weighsHoles, Tracer& tracer) {
  constexpr int kMostHoles = 64;
  Real through = 1;
  Ray ray = camera.ray;
  std::optional<Hit> hit = camera.hit;
  Interfaces inside = camera.inside;
  for (int k = 0; hit && k < kMostHoles; ++k) {
    through *= weighsHoles ? 1 - hit->opacity : 0;
    if (!(through > 0)) return 1;
    ray = hit->leave(ray.direction);
    hit = tracer.cast(ray, RayKind::refraction, inside);
  }
  if (hit || tracer.world().lampAlong(ray, kInfinity)) return 1;
  const Fog fog(tracer.settings());
  if (!fog.none() && isInOpenAir(inside, tracer.world())) through *= fog.passes(ray, kInfinity);
  return 1 - through * (1 - camera.ink);
}

}  // namespace

/// Takes the samples of tiles; what a worker does.
class TileRenderer {
 public:
  /// `chains`, if any, bring the light. `interrupt` may throw GivenUp.
  TileRenderer(std::span<const Moment> moments, const Settings& settings, const Film& film,
               const Metropolis* chains, std::function<void()> interrupt)
      : budget_(std::move(interrupt)),
        tracer_(moments, settings, {film.width(), film.height()}),
        area_(areaOf(settings.region, {film.width(), film.height()})),
        passes_(layersOf(settings)),
        film_(film),
        chains_(chains),
        moments_(moments) {
    const PassFacts* facts = moments.front().facts;
    groups_ = facts ? facts->other + 1 : 0;
    light_ = lightLayersOf(settings, groups_);
    if (static_cast<int>(film.layers()) != light_.end) {
      passes_.clear();
      light_ = {};
    }
    if (light_.direct >= 0 || light_.indirect >= 0)
      splitter_.emplace(moments, settings, Size{film.width(), film.height()}, &tree_);
    guides_ = std::any_of(passes_.begin(), passes_.end(), [](const PassRow* row) { return row->behind; });
    hasLayers_ = !passes_.empty() || light_.end > 0;
    if (chains_) chainTracer_.emplace(chains_->tracer());
    throws_ = film.takesSplats() && !chains_;
  }

  TileSamples take(std::int64_t tile, const Wave& wave) {
    const BudgetScope scope(&budget_);
    const bool own = film_.owns(tile);
    TileSamples samples{.area = own ? intersection(film_.tile(tile), area_) : Tile{0, 0, 0, 0},
                        .colors = {},
                        .layers = std::vector<std::vector<Color>>(static_cast<std::size_t>(light_.end))};
    if (own)
      chains_           ? takeChain(tile, wave, samples)
      : film_.corners() ? takeCorners(wave, samples)
                        : takePixels(tile, wave, samples);
    const bool isFirstJudged = wave.first < PixelSum::kFewest && wave.end >= PixelSum::kFewest;
    if (isFirstJudged && film_.noiseTarget() > 0) lookBeside(tile, wave, samples);
    return samples;
  }

  Statistics statistics() const {
    Statistics sum = tracer_.statistics();
    if (chainTracer_) sum += chainTracer_->statistics();
    if (splitter_) sum += splitter_->statistics();
    sum.badSamples += badCount_;  // those of chains are counted already
    return sum;
  }
  std::vector<BadSample>& badSamples() { return bad_; }

 private:
  void takePixels(std::int64_t tile, const Wave& wave, TileSamples& samples) {
    const Tile& area = samples.area;
    samples.colors.reserve(static_cast<std::size_t>(pixelsIn(area) * wave.count()));
    tracer_.collect(throws_ ? &samples.splats : nullptr);
    names_.clear();
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x)
        if (!film_.settled(x, y))
          for (int k = wave.first; k < wave.end; ++k) names_.push_back({x, y, k});
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (i % RayPacket::kRays == 0)
        tracer().lookAhead(
            std::span(names_).subspan(i, std::min<std::size_t>(RayPacket::kRays, names_.size() - i)));
      takePixel(names_[i], samples);
    }
    if (throws_) throwFromBeside(film_.tile(tile), wave, samples);
    std::erase_if(samples.splats, [&](const Splat& s) { return !isIn(area_, s.x, s.y); });
  }

  void takePixel(const PixelTracer::Name& name, TileSamples& samples) {
    const auto [x, y, k] = name;
    Real weight = 1;
    tree_.nodes.clear();
    const Color color = tracer().sample(x, y, k, [&](const CameraRay& camera, const Sampler& sampler) {
      weight = camera.weight;
      if (hasLayers_) addPasses(camera, sampler, samples.layers);
    });
    if (weight != 1 && samples.weights.empty()) samples.weights.assign(samples.colors.size(), 1);
    if (weight != 1 || !samples.weights.empty()) samples.weights.push_back(weight);
    samples.colors.push_back(color);
    samples.paths += throws_;
    if (!isFinite(color)) noteBad({x, y, k});
  }

  /// Light that samples of the tile's pixels beside the area bring into it, so that what is seen there is the
  /// same as in the whole picture.
  void throwFromBeside(const Tile& tile, const Wave& wave, TileSamples& samples) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (isIn(area_, x, y)) continue;
        for (int k = wave.first; k < wave.end; ++k) tracer_.throwLight(x, y, k);
        samples.paths += wave.count();
      }
  }

  /// Pixels of the tile that lie beside those that are rendered, so that these stop as they do in the whole
  /// picture.
  void lookBeside(std::int64_t number, const Wave& wave, TileSamples& samples) {
    if (area_.x0 >= area_.x1 || area_.y0 >= area_.y1) return;
    const Tile tile =
        intersection(film_.tile(number), {area_.x0 - 1, area_.y0 - 1, area_.x1 + 1, area_.y1 + 1});
    tracer_.collect(nullptr);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        if (isRendered(x, y) || !isBesideRendered(x, y)) continue;
        samples.beside.push_back(
            {x, y, firstErrorOf(tracer_, x, y, wave.end, whiteOf(tracer_.tracer().settings()))});
      }
  }

  bool isRendered(int x, int y) const { return isIn(area_, x, y) && film_.owns(film_.tileAt(x, y)); }
  bool isBesideRendered(int x, int y) const {
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u)
        if (isRendered(u, v)) return true;
    return false;
  }

  /// Those of the wave's level that are to be looked at.
  void takeCorners(const Wave& wave, TileSamples& samples) {
    const CornerSamples& before = *film_.corners();
    for (int y = samples.area.y0; y < samples.area.y1; ++y)
      for (int x = samples.area.x0; x < samples.area.x1; ++x) {
        samples.starts.push_back(samples.corners.size());
        for (const Corner corner : before.wanted(x, y, wave.first)) {
          const CornerPlace place{x, y, corner};
          samples.corners.push_back(corner);
          tree_.nodes.clear();
          samples.colors.push_back(
              tracer().corner(place, [&](const CameraRay& camera, const Sampler& sampler) {
                if (hasLayers_) addPasses(camera, sampler, samples.layers);
              }));
          if (!isFinite(samples.colors.back())) noteBad(numbered(before.userOf(place), wave.first));
        }
      }
    samples.starts.push_back(samples.corners.size());
  }

  /// The corner's number among those of its pixel, as explain() counts them.
  BadSample numbered(const CornerPlace& place, int level) const {
    const CornerSamples& before = *film_.corners();
    const auto corners = cornersOf(before.rules(), level, before.of(place.x, place.y));
    const auto at = std::find(corners.begin(), corners.end(), place.corner);
    return {place.x, place.y, static_cast<int>(at - corners.begin())};
  }

  /// The offset of the area, in the tiles before that one.
  std::int64_t pixelsBefore(std::int64_t tile) {
    if (pixelsBefore_.empty())
      for (std::int64_t i = 0, pixels = 0; i <= film_.tiles(); ++i) {
        pixelsBefore_.push_back(pixels);
        if (i < film_.tiles()) pixels += pixelsIn(intersection(film_.tile(i), area_));
      }
    return pixelsBefore_[static_cast<std::size_t>(tile)];
  }

  /// One chain of as many samples; of the tile's own pixels only the passes are seen.
  void takeChain(std::int64_t tile, const Wave& wave, TileSamples& samples) {
    const Tile& area = samples.area;
    samples.paths = pixelsIn(area) * wave.count();
    samples.colors.assign(static_cast<std::size_t>(samples.paths), Color(0));
    const std::uint64_t number = Metropolis::numberOf(tile, wave.first);
    const std::int64_t before = pixelsBefore(film_.tiles()) * wave.first + pixelsBefore(tile) * wave.count();
    samples.splats = chains_->chain(*chainTracer_, number, samples.paths, {}, before);
    if (!hasLayers_) return;
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x)
        for (int k = wave.first; k < wave.end; ++k)
          tracer_.look(x, y, k, [&](const CameraRay& camera, const Sampler& sampler) {
            addPasses(camera, sampler, samples.layers);
          });
  }

  /// The one that records rays, where light is split by them.
  PixelTracer& tracer() { return splitter_ ? *splitter_ : tracer_; }

  void addPasses(const CameraRay& camera, const Sampler& sampler, std::vector<std::vector<Color>>& layers) {
    PixelTracer& pixels = this->tracer();
    Tracer& tracer = pixels.tracer();
    const Moment& moment = moments_[pixels.moment()];
    if (splitter_)  // first: rays of passes would be recorded too
      splitLight(tree_, *moment.facts, groups_, split_);
    const bool tooNear = !camera.hit && tracer.tooNear(camera.ray);
    const Size size{film_.width(), film_.height()};
    const auto behind = guides_ && camera.hit ? seenBehind(tracer, camera, sampler) : std::nullopt;
    for (std::size_t i = 0; i < passes_.size(); ++i) {
      const PassRow& row = *passes_[i];
      const auto value = [&](const CameraRay& seen, const Color& passes, Real before) {
        return seen.hit  ? row.value({seen, *seen.hit, tracer, sampler, moment.facts, size, passes, before})
               : tooNear ? row.tooNear
                         : row.background;
      };
      layers[i].push_back(behind && row.behind ? value(behind->last, behind->passes, behind->distance)
                                               : value(camera, Color(1), 0));
    }
    if (light_.alpha >= 0)
      layers[static_cast<std::size_t>(light_.alpha)].push_back(
          Color(alphaOf(camera, moment.integrator->weighsHoles(), tracer)));
    if (!splitter_) return;
    const auto put = [&](int first, const std::vector<Color>& parts) {
      for (std::size_t group = 0; first >= 0 && group < groups_; ++group)
        layers[static_cast<std::size_t>(first) + group].push_back(parts[group]);
    };
    put(light_.direct, split_.direct);
    put(light_.indirect, split_.indirect);
  }

  void noteBad(const BadSample& sample) {
    ++badCount_;
    if (bad_.size() < kMostBadSamples) bad_.push_back(sample);
  }

  Budget budget_;
  PixelTracer tracer_;
  const Tile area_;
  std::vector<const PassRow*> passes_;
  bool guides_ = false;  ///< some are of what is seen behind mirrors and glass
  const Film& film_;
  const Metropolis* chains_;
  const std::span<const Moment> moments_;
  LightLayers light_;
  std::size_t groups_ = 0;
  RayTree tree_;  ///< rays of the last sample, for the splitter
  LightSplit split_;
  std::optional<PixelTracer> splitter_;  ///< takes the samples whose light is split
  bool hasLayers_ = false;
  std::optional<PixelTracer> chainTracer_;
  std::vector<std::int64_t> pixelsBefore_;
  std::vector<PixelTracer::Name> names_;  ///< the samples of a tile and a wave
  bool throws_ = false;                   ///< samples bring light to other pixels, too
  std::vector<BadSample> bad_;            ///< the first
  std::uint64_t badCount_ = 0;
};

RenderResult render(const World& world, const Settings& settings, Film& film, Job& job) {
  const auto integrator = makeIntegrator(world, settings, job);
  return render(std::array{Moment{&world, integrator.get()}}, settings, film, job);
}

RenderResult render(std::span<const Moment> moments, const Settings& settings, Film& film, Job& job) {
  return *RenderInParts(moments, settings, film, job).next(kInfinity);
}

struct RenderInParts::State {
  using Clock = std::chrono::steady_clock;

  State(std::span<const Moment> theMoments, const Settings& theSettings, Film& theFilm, Job& theJob)
      : moments(theMoments), settings(theSettings), film(theFilm), job(theJob), clock(budgetOfThread.budget) {
    if (!budgetOfThread.budget) clock.limitTime(settings.timeLimit);
    workers.resize(static_cast<std::size_t>(settings.threads > 0 ? settings.threads : hardwareThreads()));
    for (std::int64_t i = 0; i < film.tiles(); ++i)
      if (film.owns(i) || film.noiseTarget() > 0) tiles.push_back(i);
  }

  /// Looks at the time in the midst of a tile, of which one can take hours. Each worker has a copy.
  auto interrupt() {
    return [this, stopping = std::optional<Clock::time_point>()]() mutable {
      if (clock.timeIsOver() && !job.cancel.exchange(true)) late = true;
      if (!job.cancel) return;
      const Clock::time_point now = Clock::now();
      if (!stopping) stopping = now;
      if (now - *stopping >= job.patience) throw GivenUp{};
    };
  }

  /// Takes the samples of a tile and a wave, unless the film has them since before. Throws GivenUp at the end
  /// of a part.
  void takeChunk(std::int64_t tile, std::size_t wave, int worker) {
    if (film.has(tile, wave)) return;
    if (partIsOver()) throw GivenUp{};
    auto& renderer = workers[static_cast<std::size_t>(worker)];
    if (!renderer)
      renderer =
          std::make_unique<TileRenderer>(moments, settings, film, chains ? &*chains : nullptr, interrupt());
    film.add(tile, wave, renderer->take(tile, film.waves()[wave]));
    progressed = true;
  }

  bool partIsOver() {
    if (std::isfinite(seconds) && progressed &&
        std::chrono::duration<double>(Clock::now() - partBegan).count() >= seconds)
      paused = true;
    return paused;
  }

  /// All waves that the film lacks, or those of a part.
  void takeWaves() {
    const std::vector<Wave>& waves = film.waves();
    std::size_t firstWave = 0;  // first wave of the current chunks
    const auto waveOf = [&](std::int64_t chunk) {
      return firstWave + static_cast<std::size_t>(chunk / std::ssize(tiles));
    };
    const ChunkSizes samples{std::ssize(tiles) * waves.back().end,
                             [&](std::int64_t chunk) { return waves[waveOf(chunk)].count(); }};
    if (!chains && film.takesSplats() && hasTrait(settings, Trait::byChains))
      chains.emplace(moments, settings, Size{film.width(), film.height()}, job, interrupt());
    job.before = film.samplesDone();
    if (!doneAtFirst) doneAtFirst = job.done.load();
    job.done = *doneAtFirst;  // parts count what the film has once more
    const std::ptrdiff_t together = film.adaptive() ? 1 : std::ssize(waves);
    for (; firstWave < waves.size() && !job.cancel && !paused;
         firstWave += static_cast<std::size_t>(together))
      parallelChunks(
          std::ssize(tiles) * together, static_cast<int>(workers.size()), job,
          [&](std::int64_t chunk, int worker) {
            takeChunk(tiles[static_cast<std::size_t>(chunk % std::ssize(tiles))], waveOf(chunk), worker);
          },
          samples);
  }

  RenderResult result() {
    RenderResult result;
    result.failure = failure;
    if (chains) result.brightnessError = chains->brightnessError();
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
    result.end = film.complete()    ? End::finished
                 : outOfMemory      ? End::outOfMemory
                 : !failure.empty() ? End::failed
                 : late             ? End::timeLimit
                                    : End::cancelled;
    return result;
  }

  const std::span<const Moment> moments;
  const Settings settings;
  Film& film;
  Job& job;
  Budget clock;
  std::atomic<bool> late{false};
  std::vector<std::int64_t> tiles;  // own ones, and where pixels stop for an error all: lookBeside()
  std::optional<Metropolis> chains;
  std::vector<std::unique_ptr<TileRenderer>> workers;
  std::optional<std::int64_t> doneAtFirst;  // count of the job before the first part
  double seconds = kInfinity;               // that the part may take
  Clock::time_point partBegan;
  std::atomic<bool> progressed{false}, paused{false};  // in this part
  std::string failure;
  bool outOfMemory = false;
};

RenderInParts::RenderInParts(std::span<const Moment> moments, const Settings& settings, Film& film, Job& job)
    : state_(std::make_unique<State>(moments, settings, film, job)) {}

RenderInParts::~RenderInParts() = default;

std::optional<RenderResult> RenderInParts::next(double seconds) {
  State& state = *state_;
  state.seconds = seconds;
  state.partBegan = State::Clock::now();
  state.progressed = state.paused = false;
  try {
    state.takeWaves();
  } catch (const std::bad_alloc&) {
    state.outOfMemory = true;
    state.failure = "out of memory";
  } catch (const std::exception& error) {
    state.failure = error.what();
  }
  if (state.paused && state.failure.empty() && !state.job.cancel) return {};
  return state.result();
}

}  // namespace trace
