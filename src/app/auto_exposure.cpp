#include "app/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "app/darkness.h"
#include "image/development.h"
#include "image/srgb.h"

namespace trace {
namespace {

constexpr double kMiddle = 0.52;   // the mean of the values shown, 0 to 1: a little above middle grey in sRGB
constexpr double kMostStops = 30;  // up or down
constexpr double kNothing = 1e-6;  // of the brightest: black, as far as an eye tells

double meanShown(const Picture& picture, const std::vector<std::size_t>& lit, Development development,
                 double stops) {
  development.exposure += stops;
  double sum = 0;
  for (const std::size_t i : lit) {
    const Color shown = developed(picture.pixels[i], development);
    sum += std::clamp(luminanceOf(shown), 0.0, 1.0);
  }
  return sum / static_cast<double>(lit.size());
}

}  // namespace

Real exposureFor(const Picture& picture, const Development& development) {
  double brightest = 0;
  for (const Color& c : picture.pixels)
    if (isFinite(c)) brightest = std::max(brightest, luminanceOf(c));
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (isFinite(picture.pixels[i]) && luminanceOf(picture.pixels[i]) > kNothing * brightest)
      lit.push_back(i);
  if (lit.empty() || development.tone == Tone::stretch) return 0;
  double low = -kMostStops, high = kMostStops;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (meanShown(picture, lit, development, middle) < kMiddle ? low : high) = middle;
  }
  return std::round(high * 100) / 100;
}

Real settleExposure(const World& world, Settings& settings) {
  if (!settings.autoExposure) return 0;
  Development development = developmentOf(settings);
  development.exposure = 0;
  const Real stops = exposureFor(tracedCells(world, settings), development);
  settings.exposure += stops;
  settings.autoExposure = false;
  return stops;
}

}  // namespace trace
