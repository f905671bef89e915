#include "shading/optics/dispersion.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

/// Coefficients of Schott's catalogue of optical glass, in the order of Disperses.
constexpr std::array<Sellmeier, 7> kGlasses{{
    {{1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},   // BK7
    {{1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},    // BAF10
    {{0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},  // FK51A
    {{2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},    // LASF9
    {{1.46141885, 0.247713019, 0.949995832}, {0.0111826126, 0.0508594669, 112.041888}},   // SF5
    {{1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}},     // SF10
    {{1.73848403, 0.311168974, 1.17490871}, {0.0136068604, 0.0615960463, 121.922711}},    // SF11
}};

constexpr Real kShortest = 400, kLongest = 700;

/// Two halves of normal curves that meet at their top.
Real lobe(Real x, Real top, Real below, Real above) {
  const Real t = (x - top) / (x < top ? below : above);
  return math::exp(-t * t / 2);
}

}  // namespace

Real Sellmeier::index(Real nanometres) const {
  const Real squared = nanometres * nanometres * 1e-6;
  Real sum = 1;
  for (std::size_t i = 0; i < 3; ++i) sum += b[i] * squared / (squared - c[i]);
  return std::sqrt(sum);
}

const Sellmeier* sellmeier(Disperses glass) {
  static_assert(names(Disperses{}).size() == kGlasses.size() + 1);
  return glass == Disperses::byAbbe ? nullptr : &kGlasses[static_cast<std::size_t>(glass) - 1];
}

Dispersion::Dispersion(Disperses glass, Real abbe, Real index) : glass_(sellmeier(glass)) {
  constexpr auto inverseSquare = [](Real nanometres) { return 1e6 / (nanometres * nanometres); };
  if (!glass_ && abbe > 0) cauchy_ = (index - 1) / abbe / (inverseSquare(kLineF) - inverseSquare(kLineC));
}

Real Dispersion::shifted(Real atD, Real nanometres) const {
  if (glass_) return atD + (glass_->index(nanometres) - glass_->index(kLineD));
  return atD + cauchy_ * 1e6 * (1 / (nanometres * nanometres) - 1 / (kLineD * kLineD));
}

Color spectralColor(Real l) {
  const Real x = 1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
                 0.065 * lobe(l, 501.1, 20.4, 26.2);
  const Real y = 0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1);
  const Real z = 1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,  // the primaries of Rec. 709, white D65
          -0.9692660 * x + 1.8760108 * y + 0.0415560 * z, 0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

std::vector<SpectralShare> spectralFan(int count, Real shift) {
  std::vector<SpectralShare> fan;
  Color sum;
  for (int i = 0; i < count; ++i) {
    const Real nanometres = kShortest + (kLongest - kShortest) * (i + shift) / count;
    const Color color = spectralColor(nanometres);
    fan.push_back({nanometres, {std::max(0.0, color.r), std::max(0.0, color.g), std::max(0.0, color.b)}});
    sum += fan.back().weight;
  }
  const auto balanced = [&](Real Color::*channel) {
    if (!(sum.*channel > 0)) {  // so few that none is of this colour
      for (SpectralShare& share : fan) share.weight.*channel = 1;
      sum.*channel = count;
    }
    // Multiples of a small unit, so that no sum of them is rounded. The largest takes what is left over.
    constexpr Real kUnit = 0x1p-40;
    Real rest = 1;
    SpectralShare* largest = fan.data();
    for (SpectralShare& share : fan) {
      share.weight.*channel = std::round(share.weight.*channel / (sum.*channel) / kUnit) * kUnit;
      rest -= share.weight.*channel;
      if (share.weight.*channel > largest->weight.*channel) largest = &share;
    }
    largest->weight.*channel += rest;
  };
  balanced(&Color::r);
  balanced(&Color::g);
  balanced(&Color::b);
  return fan;
}

}  // namespace trace
