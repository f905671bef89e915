// A Gaussian as a sum of four damped waves, each of which is a recursion of one step: a pixel costs the same
// for any width.
//
// Source: Deriche, Recursively Implementing the Gaussian and its Derivatives, 1993, of fourth order:
//   exp(-x^2 / 2) ~ (1.68 cos 0.6318 x + 3.735 sin 0.6318 x) exp(-1.783 x)
//                 - (0.6803 cos 1.997 x + 0.2598 sin 1.997 x) exp(-1.723 x),   x >= 0
// A damped wave is the real part of a c p^n, which follows from the pixel before by one product with p. One
// run goes forward and one back; since the picture is 0 outside, both begin at 0 without any error.
#include "image/development/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/budget.h"
#include "math/complex.h"

namespace trace {
namespace {

constexpr std::size_t kDampedWaves = 2;  // each with its conjugate
constexpr std::size_t kLanes = 16;       // columns that are blurred together
constexpr std::size_t kValues = 4;       // values of a pixel: its colour, and how much of it is there
constexpr std::size_t kTogether = kLanes * kValues;
constexpr double kLargest = 1e290;  // sums stay finite

/// Numbers that are worked on together, side by side.
using Lanes = std::array<double, kTogether>;

struct DampedWave {
  Complex amplitude, pole;
};

std::array<DampedWave, kDampedWaves> dampedWaves(double sigma) {
  const auto pole = [&](double decay, double frequency) {
    const math::SinCos turn = math::sincos(frequency / sigma);
    return math::exp(-decay / sigma) * Complex{turn.cos, turn.sin};
  };
  return {DampedWave{{1.68, -3.735}, pole(1.783, 0.6318)}, DampedWave{{-0.6803, 0.2598}, pole(1.723, 1.997)}};
}

/// One wave of every lane, and its state.
struct RunningWave {
  explicit RunningWave(const DampedWave& wave)
      : re(wave.pole.re), im(wave.pole.im), a(wave.amplitude.re), b(wave.amplitude.im) {}

  /// Takes the next values.
  void step(const double* values) {
    for (std::size_t i = 0; i < kTogether; ++i) {
      const double x = real[i] * re - imaginary[i] * im + values[i];
      imaginary[i] = real[i] * im + imaginary[i] * re;
      real[i] = x;
    }
  }
  /// Takes 0 in place of values, and then the values without giving them yet: the run back has the places
  /// behind a pixel alone, since the run forward has the pixel itself.
  void decay() {
    for (std::size_t i = 0; i < kTogether; ++i) {
      const double x = real[i] * re - imaginary[i] * im;
      imaginary[i] = real[i] * im + imaginary[i] * re;
      real[i] = x;
    }
  }
  void take(const double* values) {
    for (std::size_t i = 0; i < kTogether; ++i) real[i] += values[i];
  }
  void give(double* sums) const {
    for (std::size_t i = 0; i < kTogether; ++i) sums[i] += a * real[i] - b * imaginary[i];
  }

  double re, im, a, b;
  Lanes real{}, imaginary{};
};

/// Blurs each of `lanes` lines of `length` pixels; `values` are those of the first pixel of all lanes, then
/// of the second ...
void blurLines(std::vector<double>& values, std::vector<double>& sums, std::size_t length,
               const std::array<DampedWave, kDampedWaves>& waves) {
  std::fill(sums.begin(), sums.end(), 0.0);
  std::array<RunningWave, kDampedWaves> forward{RunningWave(waves[0]), RunningWave(waves[1])}, back = forward;
  for (std::size_t n = 0; n < length; ++n) {
    checkBudget();
    for (RunningWave& wave : forward) {
      wave.step(&values[n * kTogether]);
      wave.give(&sums[n * kTogether]);
    }
  }
  for (std::size_t n = length; n-- > 0;) {
    checkBudget();
    for (RunningWave& wave : back) {
      wave.decay();
      wave.give(&sums[n * kTogether]);
      wave.take(&values[n * kTogether]);
    }
  }
}

/// Blurs along y, and turns the picture over its diagonal, so that doing it twice blurs both ways.
Picture blurredAndTurned(const Picture& picture, double sigma) {
  const auto waves = dampedWaves(sigma);
  const auto width = static_cast<std::size_t>(picture.width),
             height = static_cast<std::size_t>(picture.height);
  Picture result(picture.height, picture.width);
  std::vector<double> values(height * kTogether), sums(height * kTogether);
  for (std::size_t first = 0; first < width; first += kLanes) {
    const std::size_t lanes = std::min(kLanes, width - first);
    for (std::size_t y = 0; y < height; ++y) {
      double* to = &values[y * kTogether];
      for (std::size_t lane = 0; lane < lanes; ++lane, to += kValues) {
        const Color& c = picture.pixels[y * width + first + lane];
        const bool counts = std::isfinite(c.r + c.g + c.b);
        to[0] = counts ? std::clamp(c.r, -kLargest, kLargest) : 0;
        to[1] = counts ? std::clamp(c.g, -kLargest, kLargest) : 0;
        to[2] = counts ? std::clamp(c.b, -kLargest, kLargest) : 0;
        to[3] = counts ? 1 : 0;
      }
      std::fill(to, &values[y * kTogether] + kTogether, 0.0);
    }
    blurLines(values, sums, height, waves);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t y = 0; y < height; ++y) {
        const double* sum = &sums[y * kTogether + lane * kValues];
        result.pixels[(first + lane) * height + y] =
            sum[3] > 0 ? Color(sum[0], sum[1], sum[2]) / sum[3] : Color(0);
      }
  }
  return result;
}

}  // namespace

Picture gaussianBlurred(const Picture& picture, double sigma) {
  return blurredAndTurned(blurredAndTurned(picture, sigma), sigma);
}

Picture bloomed(const Picture& picture, double share) {
  constexpr double kSizes[] = {0.005, 0.02, 0.06};  // sizes relative to the height
  Picture result = picture;
  for (Color& c : result.pixels) {
    checkBudget();
    c = c * (1 - share);
  }
  for (const double size : kSizes) {
    const Picture around = gaussianBlurred(picture, size * picture.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
      checkBudget();
      result.pixels[i] += around.pixels[i] * (share / std::size(kSizes));
    }
  }
  return result;
}

}  // namespace trace
