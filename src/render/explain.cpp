#include "render/explain.h"

#include <algorithm>

#include "render/pixel.h"

namespace trace {
namespace {

void require(bool good, const std::string& what, int most, const std::string& found) {
  if (!good)
    throw Error(Fault::usage, "expected " + what + " from 0 to " + std::to_string(most) + ", found " + found);
}

}  // namespace

Explanation explain(const World& world, const Integrator& integrator, const Settings& settings,
                    const Size& size, int x, int y, int sample, const std::function<bool()>& cancelled) {
  require(x >= 0 && x < size.width, "a pixel with x", size.width - 1, std::to_string(x));
  require(y >= 0 && y < size.height, "a pixel with y", size.height - 1, std::to_string(y));
  Explanation result;
  PixelTracer plain(world, integrator, settings, size);
  require(sample >= 0 && sample < plain.samples(), "a sample", plain.samples() - 1, std::to_string(sample));
  result.tree.x = x, result.tree.y = y, result.tree.sample = sample;
  PixelTracer(world, integrator, settings, size, &result.tree).sample(x, y, sample);

  Color sum;
  int count = 0;
  for (int k = 0; k < plain.samples() && !(cancelled && cancelled()); ++k) {
    Real weight = 1;
    result.samples.push_back(plain.sample(x, y, k, [&](const CameraRay& ray) { weight = ray.weight; }));
    result.weights.push_back(weight);
    if (!isFinite(result.samples.back())) continue;
    sum += result.samples.back() * weight;
    ++count;
  }
  if (count > 0) result.pixel = sum / count;
  const auto shown = static_cast<std::size_t>(sample);
  weigh(result.tree, (shown < result.weights.size() ? result.weights[shown] : 1) / std::max(count, 1));
  return result;
}

}  // namespace trace
