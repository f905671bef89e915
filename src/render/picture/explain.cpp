#include "render/picture/explain.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "image/film/film.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

void require(const std::string& flag, const std::string& what, int found, int most) {
  if (found >= 0 && found <= most) return;
  throw Error(Fault::usage, flag + ": expected " + what +
                                (most == 0 ? " 0, the only one" : " from 0 to " + std::to_string(most)) +
                                ", found " + std::to_string(found));
}

/// Explains a pixel that is divided: its corners take the place of samples.
Explanation explainDivided(std::span<const Moment> moments, const Settings& settings, const Size& size, int x,
                           int y, int sample, const std::function<bool()>& cancelled) {
  const Subdivision rules = subdivisionOf(settings, size);
  const auto ignore = [](const CameraRay&, const Sampler&) {};
  PixelTracer plain(moments, settings, size);
  std::map<std::pair<int, int>, Color> seen;
  const auto colors = [&](Corner corner) -> const Color& {
    const auto [at, isNew] = seen.try_emplace({corner.y, corner.x});
    if (isNew && !(cancelled && cancelled())) at->second = plain.corner({x, y, corner}, ignore);
    return at->second;
  };
  const std::vector<Corner> corners = cornersOf(rules, rules.depth, colors);
  const int last = static_cast<int>(corners.size()) - 1;
  require("--sample", "a corner of this pixel", sample, last);

  Explanation result;
  result.tree.x = x;
  result.tree.y = y;
  result.tree.sample = sample;
  PixelTracer(moments, settings, size, &result.tree)
      .corner({x, y, corners[static_cast<std::size_t>(sample)]}, ignore);
  Real finite = 0;
  for (const Corner corner : corners) {
    result.samples.push_back(colors(corner));
    result.corners.push_back({corner.x / Real(rules.side()), corner.y / Real(rules.side())});
    finite += isFinite(result.samples.back());
  }
  result.pixel = meanOver(rules, rules.depth, colors, colors);
  std::map<std::pair<int, int>, Real> shares;
  Real sum = 0;
  forEachShare(rules, rules.depth, colors, [&](Corner corner, Real share) {
    shares[{corner.y, corner.x}] += share;
    sum += share;
  });
  for (const Corner corner : corners)
    result.weights.push_back(sum > 0 ? shares[{corner.y, corner.x}] / sum * finite : 0);
  weigh(result.tree, result.weights[static_cast<std::size_t>(sample)] / std::max<Real>(finite, 1));
  return result;
}

/// The greatest of the pixels around, and of this one.
float firstErrorAround(PixelTracer& tracer, const Size& size, int x, int y, double white) {
  const auto waves = wavesOf(tracer.samples());
  const auto first = std::find_if(waves.begin(), waves.end(),
                                  [](const Wave& wave) { return wave.end >= PixelSum::kFewest; });
  float greatest = 0;
  for (int v = std::max(0, y - 1); v <= std::min(size.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(size.width - 1, x + 1); ++u)
      greatest = std::max(greatest, firstErrorOf(tracer, u, v, first->end, white));
  return greatest;
}

}  // namespace

Explanation explain(std::span<const Moment> moments, const Settings& settings, const Size& size, int x, int y,
                    int sample, const std::function<bool()>& cancelled) {
  require("--pixel X,Y", "X", x, size.width - 1);
  require("--pixel X,Y", "Y", y, size.height - 1);
  if (subdivides(settings)) return explainDivided(moments, settings, size, x, y, sample, cancelled);
  Explanation result;
  PixelTracer plain(moments, settings, size);
  require("--sample", "a sample", sample, plain.samples() - 1);
  result.tree.x = x;
  result.tree.y = y;
  result.tree.sample = sample;
  PixelTracer(moments, settings, size, &result.tree).sample(x, y, sample);

  PixelSum sum;
  std::optional<float> around;
  const auto isSure = [&] {
    if (!around) around = firstErrorAround(plain, size, x, y, whiteOf(settings));
    return sum.isSure(settings.noiseTarget, *around);
  };
  for (const Wave& wave : wavesOf(plain.samples())) {
    result.settled = sum.settles(settings.noiseTarget, whiteOf(settings)) && isSure();
    if (result.settled) break;
    for (int k = wave.first; k < wave.end && !(cancelled && cancelled()); ++k)
      addWave(plain, x, y, {k, k + 1}, sum, [&](const Color& color, Real weight) {
        result.samples.push_back(color);
        result.weights.push_back(weight);
      });
  }
  if (result.settled)
    require("--sample", "a sample of this pixel, which then was good enough,", sample, sum.taken() - 1);
  const WeightedMean& mean = sum.colors();
  result.pixel = mean.mean();
  const auto finite = std::count_if(result.samples.begin(), result.samples.end(),
                                    [](const Color& color) { return isFinite(color); });
  for (Real& weight : result.weights) weight = mean.counts(weight, static_cast<Real>(finite));
  const auto shown = static_cast<std::size_t>(sample);
  weigh(result.tree, (shown < result.weights.size() ? result.weights[shown] : 1) /
                         static_cast<Real>(std::max<std::ptrdiff_t>(finite, 1)));
  return result;
}

Explanation explain(const World& world, const Integrator& integrator, const Settings& settings,
                    const Size& size, int x, int y, int sample) {
  return explain(std::array{Moment{&world, &integrator}}, settings, size, x, y, sample);
}

}  // namespace trace
