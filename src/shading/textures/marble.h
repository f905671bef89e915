// Layers across x, bent by turbulence (Perlin, An Image Synthesizer, SIGGRAPH 1985).
#pragma once

#include "math/fractal_sum.h"
#include "shading/textures/pattern.h"

namespace trace {

struct Marble : PatternColors, FractalSum {
  static constexpr std::string_view kKeyword = "marble";
  static constexpr std::string_view kHelp = "layers across x, bent by turbulence";

  Real frequency = 1, turbulence = 2;
  Vec3 grain{1, 1, 1};
  WaveForm wave = WaveForm::smooth;

  Marble() {
    a = {0.95, 0.94, 0.92};
    b = {0.22, 0.22, 0.27};
    sum = SumKind::turbulence;
  }

  static constexpr auto fields() {
    return Fields{
        PatternColors::fields(),

        Field{"frequency", &Marble::frequency, "", -kNoLimit, kNoLimit, "layers in a step along x"},
        Field{"turbulence", &Marble::turbulence, "", -kNoLimit, kNoLimit, "how far they are bent, in layers"},
        Field{"grain", &Marble::grain, "", -kNoLimit, kNoLimit,
              "how fine the turbulence is along x, y and z"},
        Field{"wave", &Marble::wave, "", -kNoLimit, kNoLimit, "how a layer goes from a to b and back"},
        FractalSum::fields()};
  }
  bool operator==(const Marble&) const = default;

  Real pattern(const TexturePlace& place) const {
    const Vec3& p = place.point;
    const Vec3 width = abs(place.pointX) + abs(place.pointY);
    const Real bent = FractalSum::at<3>(
        {p.x * grain.x, p.y * grain.y, p.z * grain.z},
        max(width.x * std::abs(grain.x), max(width.y * std::abs(grain.y), width.z * std::abs(grain.z))));
    return trace::wave(wave, p.x * frequency + turbulence * bent);
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
