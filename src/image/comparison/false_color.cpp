// Colours for numbers: see false_color.h. Beside the life of a picture: it serves passes and comparison.
// Source: hues a golden section apart spread evenly however many there are (as the leaves of a plant).
// Numbers a Fibonacci number apart come close again; they differ in brightness or saturation, whose periods,
// 3 and 4, divide no small Fibonacci number both.
#include "image/comparison/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trace {
namespace {

/// `hue` in turns, the others from 0 to 1.
Color fromHsv(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double around = hue + shift, sixth = 6 * (around - std::floor(around));
    const double share = std::clamp(std::min(sixth, 4 - sixth), 0.0, 1.0);
    return value * (1 - saturation * share);
  };
  return {channel(5.0 / 6), channel(3.0 / 6), channel(1.0 / 6)};
}

}  // namespace

Color numberColor(std::uint64_t number) {
  if (number == 0) return Color(0);
  constexpr double kGolden = 0.6180339887498949;
  const double turns = static_cast<double>(number % (1u << 20)) * kGolden;
  const double saturation = 1 - 0.2 * static_cast<double>(number % 4);
  const double value = 1 - 0.2 * static_cast<double>(number % 3);
  return fromHsv(turns - std::floor(turns), saturation, value);
}

Color heatColor(double value) {
  static constexpr std::array<Color, 7> kScale{{{0, 0, 0},
                                                {0.20, 0.05, 0.40},
                                                {0.52, 0.08, 0.52},
                                                {0.85, 0.20, 0.33},
                                                {0.98, 0.50, 0.13},
                                                {0.99, 0.82, 0.30},
                                                {1, 1, 1}}};
  if (!(value < 1)) return kScale.back();
  const double place = std::max(value, 0.0) * (kScale.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  return lerp(place - static_cast<double>(below), kScale[below], kScale[below + 1]);
}

}  // namespace trace
