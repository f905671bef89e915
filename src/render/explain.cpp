#include "render/explain.h"

#include <algorithm>
#include <array>

#include "image/film.h"
#include "render/pixel.h"

namespace trace {
namespace {

void require(bool good, const std::string& what, int most, const std::string& found) {
  if (!good)
    throw Error(Fault::usage, "expected " + what + " from 0 to " + std::to_string(most) + ", found " + found);
}

}  // namespace

Explanation explain(std::span<const Moment> moments, const Settings& settings, const Size& size, int x, int y,
                    int sample, const std::function<bool()>& cancelled) {
  require(x >= 0 && x < size.width, "a pixel with x", size.width - 1, std::to_string(x));
  require(y >= 0 && y < size.height, "a pixel with y", size.height - 1, std::to_string(y));
  Explanation result;
  PixelTracer plain(moments, settings, size);
  require(sample >= 0 && sample < plain.samples(), "a sample", plain.samples() - 1, std::to_string(sample));
  result.tree.x = x;
  result.tree.y = y;
  result.tree.sample = sample;
  PixelTracer(moments, settings, size, &result.tree).sample(x, y, sample);

  PixelSum sum;
  for (const Wave& wave : wavesOf(plain.samples())) {
    result.settled = sum.settles(settings.noiseTarget);
    if (result.settled) break;
    for (int k = wave.first; k < wave.end && !(cancelled && cancelled()); ++k) {
      Real weight = 1;
      result.samples.push_back(plain.sample(x, y, k, [&](const CameraRay& ray) { weight = ray.weight; }));
      result.weights.push_back(weight);
      sum.add(result.samples.back(), weight);
    }
  }
  if (result.settled)
    require(sample < sum.taken(), "a sample of this pixel, which then was good enough,", sum.taken() - 1,
            std::to_string(sample));
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
