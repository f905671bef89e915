#include "image/development/development.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "image/development/bloom.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "math/noise.h"

namespace trace {
namespace {

using Rows = std::array<std::array<double, 3>, 3>;
using Triple = std::array<double, 3>;

constexpr Rows kXyzOfRgb{{{0.4124564, 0.3575761, 0.1804375},  // sRGB, D65
                          {0.2126729, 0.7151522, 0.0721750},
                          {0.0193339, 0.1191920, 0.9503041}}};
constexpr Rows kRgbOfXyz{{{3.2404542, -1.5371385, -0.4985314},
                          {-0.9692660, 1.8760108, 0.0415560},
                          {0.0556434, -0.2040259, 1.0572252}}};
constexpr Rows kConesOfXyz{{{0.8951, 0.2664, -0.1614},  // Bradford
                            {-0.7502, 1.7135, 0.0367},
                            {0.0389, -0.0685, 1.0296}}};
constexpr Rows kXyzOfCones{{{0.9869929, -0.1470543, 0.1599627},
                            {0.4323053, 0.5183603, 0.0492912},
                            {-0.0085287, 0.0400428, 0.9684867}}};

Triple operator*(const Rows& m, const Triple& v) {
  Triple r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

Rows operator*(const Rows& a, const Rows& b) {
  Rows r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
  return r;
}

/// XYZ of luminance 1 of a black body (Kang et al., Design of advanced color temperature control system for
/// HDTV applications, 2002; 1667 to 25000 K).
Triple blackBody(double kelvin) {
  const double t = std::clamp(kelvin, 1667.0, 25000.0), u = 1e3 / t;
  const double x = t <= 4000 ? ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910
                             : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
  const double y = t <= 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : t <= 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                               : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return {x / y, 1, (1 - x - y) / y};
}

/// Reinhard et al., Photographic Tone Reproduction, 2002, equation 3: of the luminance, so that hues stay.
Color reinhard(const Color& c) {
  const double luminance = std::max(0.0, luminanceOf(c));
  return c / (1 + luminance);
}

/// A film's S-shaped curve: Narkowicz's fit of the Academy's reference (ACES), 2015.
Color filmic(const Color& c) {
  const auto curve = [](double x) {
    x = std::max(0.0, x);
    return x < 1e9 ? std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)) : 1.0;
  };
  return {curve(c.r), curve(c.g), curve(c.b)};
}

/// Bright colours fade to white as on film: Sobotka's AgX, by Wrensch's polynomial of 2023.
Color agx(const Color& c) {
  constexpr Rows kInset{{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                         {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                         {0.0423756549057051, 0.0784336, 0.879142973793104}}};
  constexpr Rows kOutset{{{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                          {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                          {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}}};
  constexpr double kLeast = -12.47393, kMost = 4.026069;  // stops
  Triple v = kInset * Triple{c.r, c.g, c.b};
  for (double& x : v) {
    x = (std::clamp(math::log2(std::max(x, 1e-10)), kLeast, kMost) - kLeast) / (kMost - kLeast);
    const double x2 = x * x, x4 = x2 * x2;
    x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  }
  v = kOutset * v;
  for (double& x : v) x = math::pow(std::clamp(x, 0.0, 1.0), 2.2);  // to linear light
  return {v[0], v[1], v[2]};
}

Color curved(const Color& c, Tone tone) {
  switch (tone) {
    case Tone::reinhard: return reinhard(c);
    case Tone::filmic: return filmic(c);
    case Tone::agx: return agx(c);
    case Tone::clamp:
    case Tone::stretch: break;
  }
  return c;
}

Color transferred(const Color& c, Transfer transfer) {
  return transfer == Transfer::linear ? c : Color{srgbOfLinear(c.r), srgbOfLinear(c.g), srgbOfLinear(c.b)};
}

Color lightOf(const Color& c, double workingGamma) {
  const auto power = [&](double v) { return v > 0 ? math::pow(v, workingGamma) : v; };
  return workingGamma == 1 ? c : Color{power(c.r), power(c.g), power(c.b)};
}

/// The steps that each colour takes by itself.
class ColorSteps {
 public:
  explicit ColorSteps(const Development& d) : d_(d), scale_(math::exp2(d.exposure)) {
    if (d.whiteBalance > 0) balance_ = whiteBalance(d.whiteBalance);
  }
  Color operator()(const Color& c) const { return toScreen(toned(c)); }
  /// Up to the tone, except for Tone::stretch.
  Color toned(Color c) const {
    if (d_.exposure != 0) c = c * scale_;
    if (balance_) c = (*balance_)(c);
    return curved(c, d_.tone);
  }
  /// After it.
  Color toScreen(const Color& c) const { return transferred(lightOf(c, d_.workingGamma), d_.transfer); }

 private:
  const Development& d_;
  double scale_;
  std::optional<WhiteBalance> balance_;
};

/// Noise of one level, a triangle from -1 to 1: the mean of many pixels is the value itself.
void dither(Picture& picture) {
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    checkBudget();
    std::uint64_t bits = mixBits(i);
    const auto uniform = [&] {
      bits = mixBits(bits);
      return unitFromBits(bits);
    };
    Color& c = picture.pixels[i];
    for (double* channel : {&c.r, &c.g, &c.b})
      if (*channel > 0 && *channel < 1) *channel += (uniform() + uniform() - 1) / 255;
  }
}

}  // namespace

Color WhiteBalance::operator()(const Color& c) const {
  const auto along = [&](const Color& row) { return row.r * c.r + row.g * c.g + row.b * c.b; };
  return {along(red), along(green), along(blue)};
}

WhiteBalance whiteBalance(double kelvin) {
  const Triple seen = kConesOfXyz * blackBody(kelvin), white = kConesOfXyz * (kXyzOfRgb * Triple{1, 1, 1});
  Rows scale{};
  for (std::size_t i = 0; i < 3; ++i) scale[i][i] = white[i] / seen[i];
  const Rows all = kRgbOfXyz * (kXyzOfCones * (scale * (kConesOfXyz * kXyzOfRgb)));
  const auto row = [&](std::size_t i) { return Color{all[i][0], all[i][1], all[i][2]}; };
  return {row(0), row(1), row(2)};
}

Color developed(Color color, const Development& d) { return ColorSteps(d)(color); }

Picture developed(Picture picture, const Development& d) {
  const auto each = [&](auto change) {
    for (Color& c : picture.pixels) {
      checkBudget();
      c = change(c);
    }
  };
  if (d.bloom > 0) {
    const Work work("adding bloom");
    picture = bloomed(picture, d.bloom);
  }
  const ColorSteps steps(d);
  if (d.tone == Tone::stretch) {
    each([&](const Color& c) { return steps.toned(c); });
    picture = toned(std::move(picture), d.tone);
    each([&](const Color& c) { return steps.toScreen(c); });
  } else {
    each(steps);
  }
  if (d.dither) dither(picture);
  return picture;
}

Bytes developedBytes(const Picture& picture, const Development& d, Rounding rounding) {
  if (d == Development{}) return toBytes(picture, rounding);
  if (d.bloom > 0 || d.dither || d.tone == Tone::stretch) return toBytes(developed(picture, d), rounding);
  return toBytes(picture, rounding, ColorSteps(d));
}

}  // namespace trace
