// World -> Film: all camera rays, by any number of threads, in fixed tiles and waves of samples.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "image/film/film.h"
#include "render/samples/picture_size.h"
#include "render/samples/sampler.h"
#include "render/world/statistics.h"
#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

/// A camera ray whose colour was not finite. It is dropped from its pixel, which keeps its other samples.
struct BadSample {
  int x = 0, y = 0, sample = 0;
  bool operator==(const BadSample&) const = default;
};

enum class End { finished, cancelled, timeLimit, outOfMemory, failed };

struct RenderResult {
  End end = End::finished;
  std::string failure;  ///< message of End::failed: what went wrong
  Statistics statistics;
  Real brightnessError = 0;           ///< brightness error of chains: Metropolis::brightnessError()
  std::vector<BadSample> badSamples;  ///< in picture order, the first kMostBadSamples
};
inline constexpr std::size_t kMostBadSamples = 1000;

class Integrator;
struct Moment;

/// Renders what is seen at the moments, each sample one of them, into `film`, which must be of pictureSize()
/// and samplesOf() (makeFilm() in passes.h). Passes are made where the film has a layer for each; in any
/// other film, such as one without layers, none is. What the film has already is not rendered again
/// (Film::restore). The job counts samples of tiles. Returns early when job.cancel is set or the time is
/// over: that of the thread's Budget, or without one the settings' limit from now on. Waves of tiles that
/// were begun are finished, unless they take longer than the job's patience. What is finished survives a
/// failure too. The same bits for any number of threads.
RenderResult render(std::span<const Moment> moments, const Settings& settings, Film& film, Job& job);

/// A render in parts, for a window without threads, which draws frames between them. The moments, the film
/// and the job have to live as long as this.
class RenderInParts {
 public:
  RenderInParts(std::span<const Moment> moments, const Settings& settings, Film& film, Job& job);
  ~RenderInParts();
  RenderInParts(const RenderInParts&) = delete;
  RenderInParts& operator=(const RenderInParts&) = delete;

  /// Continues for about so many seconds, at least by one wave of a tile. Nothing until the render ends; then
  /// its result, of all parts together.
  std::optional<RenderResult> next(double seconds);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// Renders one moment, with the integrator of the settings, made for it.
RenderResult render(const World& world, const Settings& settings, Film& film, Job& job);

}  // namespace trace
