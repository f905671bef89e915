#include "app/advice/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "app/advice/darkness.h"
#include "image/development/development.h"
#include "image/srgb.h"
#include "scene/integrators.h"

namespace trace {
namespace {

constexpr double kMiddle = 0.52;  // the mean of the values shown, 0 to 1: a little above middle grey in sRGB
constexpr double kBright = 0.85;  // what the brightest are shown as at most, except for
constexpr double kLights = 0.05;  // this share: lights and highlights,
constexpr double kLamp = 30;  // and what is so many times as bright as the middle one: lamps, however large
constexpr double kMostStops = 30;  // up or down
constexpr double kNothing = 1e-6;  // relative to the brightest: black, as far as an eye sees

double luminanceShown(const Color& color, Development development, double stops) {
  development.exposure += stops;
  return std::clamp(luminanceOf(developed(color, development)), 0.0, 1.0);
}

double meanShown(const Picture& picture, const std::vector<std::size_t>& lit, const Development& development,
                 double stops) {
  double sum = 0;
  for (const std::size_t i : lit) sum += luminanceShown(picture.pixels[i], development, stops);
  return sum / static_cast<double>(lit.size());
}

/// Half as many pixels across and down, each the mean of four: their noise would count as light.
Picture halved(const Picture& picture) {
  Picture half(picture.width / 2, picture.height / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      Color sum;
      for (const int i : {0, 1, 2, 3}) {
        const Color& c = picture.at(2 * x + i % 2, 2 * y + i / 2);
        if (isFinite(c)) sum += c;
      }
      half.at(x, y) = sum * 0.25;
    }
  return half;
}

}  // namespace

Real exposureFor(const Picture& picture, const Development& development) {
  double most = 0;
  for (const Color& c : picture.pixels)
    if (isFinite(c)) most = std::max(most, luminanceOf(c));
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (isFinite(picture.pixels[i]) && luminanceOf(picture.pixels[i]) > kNothing * most) lit.push_back(i);
  if (lit.empty() || development.tone == Tone::stretch) return 0;
  const auto darker = [&](std::size_t a, std::size_t b) {
    const double first = luminanceOf(picture.pixels[a]), second = luminanceOf(picture.pixels[b]);
    return first != second ? first < second : a < b;
  };
  const auto placeOf = [&](double share) {
    return lit.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(lit.size() - 1));
  };
  const auto middle = placeOf(0.5), bright = placeOf(1 - kLights);
  std::nth_element(lit.begin(), bright, lit.end(), darker);
  std::nth_element(lit.begin(), middle, bright, darker);
  const Color usual = picture.pixels[*middle] * kLamp;
  const Color brightest = std::min(picture.pixels[*bright], usual, [](const Color& a, const Color& b) {
    return luminanceOf(a) < luminanceOf(b);
  });
  double low = -kMostStops, high = kMostStops;
  for (int i = 0; i < 40; ++i) {
    const double stops = (low + high) / 2;
    const bool dark = meanShown(picture, lit, development, stops) < kMiddle &&
                      luminanceShown(brightest, development, stops) < kBright;
    (dark ? low : high) = stops;
  }
  return std::round(high * 100) / 100;
}

std::optional<Real> settleExposure(const World& world, Settings& settings) {
  if (!settings.autoExposure) return {};
  Development development = developmentOf(settings);
  development.exposure = 0;
  Settings measuring = settings;
  // One exposure of a scene, whoever traces its light: by the integrator with the least noise.
  if (hasTrait(settings, Trait::bounces)) measuring.integrator = IntegratorKind::bdpt;
  const Real stops = exposureFor(halved(tracedCells(world, measuring)), development);
  settings.exposure += stops;
  settings.autoExposure = false;
  return stops;
}

}  // namespace trace
