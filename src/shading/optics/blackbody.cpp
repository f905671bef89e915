#include "shading/optics/blackbody.h"

#include <algorithm>
#include <array>

#include "math/elementary.h"
#include "shading/optics/dispersion.h"

namespace trace {
namespace {

constexpr Real kColdest = 500, kHottest = 20000, kCandle = 1900;
constexpr int kBlackbodySteps = 256;  // blackbody steps of the logarithm of the temperature

/// Planck's law up to a factor.
Real planck(Real nanometres, Real kelvin) {
  constexpr Real kSecond = 1.438776877e7;  // nanometres times kelvin
  const Real x = nanometres / 1000;
  return 1 / (x * x * x * x * x * math::expm1(kSecond / (nanometres * kelvin)));
}

Color summed(Real kelvin) {
  Color sum;
  for (Real w = 385; w <= 725; w += 5) sum += spectralColor(w) * planck(w, kelvin);
  return {std::max(0.0, sum.r), std::max(0.0, sum.g), std::max(0.0, sum.b)};
}

Real brightness(const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// The logarithm of the brightness, and the colour of brightness 1, at each step.
struct BlackbodyRow {
  Real brightness;
  Color color;
};

std::array<BlackbodyRow, kBlackbodySteps + 1> blackbodyTable() {
  std::array<BlackbodyRow, kBlackbodySteps + 1> rows;
  const Real candle = brightness(summed(kCandle));
  for (int i = 0; i <= kBlackbodySteps; ++i) {
    const Color color = summed(kColdest * math::pow(kHottest / kColdest, Real(i) / kBlackbodySteps));
    rows[static_cast<std::size_t>(i)] = {math::log(brightness(color) / candle), color / brightness(color)};
  }
  return rows;
}

}  // namespace

Color blackbodyColor(Real kelvin) {
  static const auto kRows = blackbodyTable();
  if (!(kelvin >= kColdest)) return {};
  const Real place =
      math::log(std::min(kelvin, kHottest) / kColdest) / math::log(kHottest / kColdest) * kBlackbodySteps;
  const auto i = std::min(static_cast<std::size_t>(place), std::size_t{kBlackbodySteps - 1});
  const Real rest = place - static_cast<Real>(i);
  const BlackbodyRow &a = kRows[i], &b = kRows[i + 1];
  return lerp(rest, a.color, b.color) * math::exp((1 - rest) * a.brightness + rest * b.brightness);
}

}  // namespace trace
