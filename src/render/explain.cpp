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

Explanation explain(const World& world, const Settings& settings, const Size& size, int x, int y,
                    int sample) {
  require(x >= 0 && x < size.width, "a pixel with x", size.width - 1, std::to_string(x));
  require(y >= 0 && y < size.height, "a pixel with y", size.height - 1, std::to_string(y));
  Explanation result;
  PixelTracer plain(world, settings, size);
  require(sample >= 0 && sample < plain.samples(), "a sample", plain.samples() - 1, std::to_string(sample));
  result.tree.x = x, result.tree.y = y, result.tree.sample = sample;
  PixelTracer(world, settings, size, &result.tree).sample(x, y, sample);

  result.pixel = plain.pixel(x, y, [](int, int, int) {});
  for (int k = 0; k < plain.samples(); ++k) result.samples.push_back(plain.sample(x, y, k));
  const auto good = std::count_if(result.samples.begin(), result.samples.end(),
                                  [](const Color& color) { return isFinite(color); });
  weigh(result.tree, good > 0 ? 1.0 / static_cast<Real>(good) : 1);
  return result;
}

}  // namespace trace
