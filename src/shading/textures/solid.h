// Patterns that fill space, each a number at a point, bent by turbulence, repeated as a wave and coloured by
// a ramp. Noise, stone and wood by Ebert and others, Texturing and Modeling, 3rd ed., chapters 2 and 6;
// cracks by Worley, A Cellular Texture Basis Function, SIGGRAPH 1996.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "math/noise.h"
#include "shading/textures/cells.h"
#include "shading/textures/pattern.h"

namespace trace {

enum class SolidPattern {
  bozo,
  agate,
  granite,
  gradient,
  leopard,
  onion,
  marble,
  wood,
  radial,
  spherical,
  boxed,
  cylindrical,
  planar,
  wrinkles,
  crackle,
  cells,
  spiral,
  weave,
  quilted,
  waves,
  ripples,
  dents,
  hexagon,
  brick,
  checker,
};
constexpr std::array<std::string_view, 25> names(SolidPattern) {
  return {"bozo",    "agate",   "granite",   "gradient", "leopard",     "onion",  "marble",
          "wood",    "radial",  "spherical", "boxed",    "cylindrical", "planar", "wrinkles",
          "crackle", "cells",   "spiral",    "weave",    "quilted",     "waves",  "ripples",
          "dents",   "hexagon", "brick",     "checker"};
}

enum class SolidWave { saw, triangle, sine, scallop, cubic, power };
constexpr std::array<std::string_view, 6> names(SolidWave) {
  return {"saw", "triangle", "sine", "scallop", "cubic", "power"};
}

struct Solid : PatternColors {
  static constexpr std::string_view kKeyword = "solid";
  static constexpr std::string_view kHelp =
      "patterns that fill space, such as agate, leopard and crackle, bent by turbulence";

  SolidPattern kind = SolidPattern::bozo;
  Vec3 turbulence{}, axis{1, 0, 0};
  int octaves = 6;
  Real lambda = 2, omega = 0.5, frequency = 1, phase = 0, number = 1, exponent = 1;
  SolidWave wave = SolidWave::saw;

  static constexpr auto fields() {
    return Fields{
        PatternColors::fields(),
        Field{"pattern", &Solid::kind, "", -kNoLimit, kNoLimit, "which pattern"},
        Field{"turbulence", &Solid::turbulence, "", -kNoLimit, kNoLimit,
              "how far it is bent along x, y and z"},
        Field{"octaves", &Solid::octaves, "", 1, 10, "octaves of the turbulence, each finer"},
        Field{"lambda", &Solid::lambda, "", 0, 100, "how much finer each octave is"},
        Field{"omega", &Solid::omega, "", 0, 100, "how much weaker each octave is"},
        Field{"axis", &Solid::axis, "", -kNoLimit, kNoLimit,
              "the direction of a gradient, the size of a brick, the weights of a crackle"},
        Field{"number", &Solid::number, "", -kNoLimit, kNoLimit,
              "turbulence of an agate, arms of a spiral, width of mortar"},
        Field{"frequency", &Solid::frequency, "", -kNoLimit, kNoLimit, "how often the wave repeats"},
        Field{"phase", &Solid::phase, "", -kNoLimit, kNoLimit, "where the wave begins"},
        Field{"wave", &Solid::wave, "", -kNoLimit, kNoLimit, "the form of the wave"},
        Field{"exponent", &Solid::exponent, "", 0, kNoLimit, "exponent of the wave called power"}};
  }
  bool operator==(const Solid&) const = default;

  Real pattern(const TexturePlace& place) const {
    const bool flat = kind >= SolidPattern::hexagon;
    Vec3 p = place.point;
    if (!(turbulence == Vec3{}) && kind != SolidPattern::agate && kind != SolidPattern::marble) p = bent(p);
    const Real value = valueAt(p);
    return flat ? value : waved(value);
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }

  /// The bare number, before the wave.
  Real valueAt(const Vec3& p) const {
    switch (kind) {
      case SolidPattern::bozo: return noiseAt(p);
      case SolidPattern::agate: {
        const Real t = 0.5 * (math::sin(2 * kPi * (1.3 * number * sum(p) + 1.1 * p.z)) + 1);
        return math::pow(std::clamp(t, 0.0, 1.0), 0.77);
      }
      case SolidPattern::granite: {
        Real value = 0, f = 1;
        for (int i = 0; i < 6; ++i, f *= 2)
          value += std::min(std::abs(1 - 2 * noiseAt(p * (4 * f))), 0.5) / f;
        return std::min(value, 1.0);
      }
      case SolidPattern::gradient: return dot(p, axis);
      case SolidPattern::leopard: {
        const Real s = (math::sin(p.x) + math::sin(p.y) + math::sin(p.z)) / 3;
        return s * s;
      }
      case SolidPattern::onion: return length(p);
      case SolidPattern::marble: return p.x + (turbulence == Vec3{} ? 0 : turbulence.x * sum(p));
      case SolidPattern::wood: return math::hypot(p.x, p.y);
      case SolidPattern::radial: {
        const Real turn = 0.25 + (math::atan2(p.x, p.z) + kPi) / (2 * kPi);
        return turn - std::floor(turn);
      }
      case SolidPattern::spherical: return std::max(0.0, 1 - length(p));
      case SolidPattern::boxed: return std::max(0.0, 1 - maxComponent(abs(p)));
      case SolidPattern::cylindrical: return std::max(0.0, 1 - math::hypot(p.x, p.z));
      case SolidPattern::planar: return std::max(0.0, 1 - std::abs(p.y));
      case SolidPattern::wrinkles: {
        Real value = strongNoiseAt(p), f = 2;
        for (int i = 1; i < 10; ++i, f *= 2) value += strongNoiseAt(p * f) / f;
        return value / 2;
      }
      case SolidPattern::crackle: {
        const CellDistances d = cellDistances(p, 3, 1, 3);
        const Real value = axis == Vec3{1, 0, 0} ? d.second - d.first : axis.x * d.first + axis.y * d.second;
        return std::clamp(std::abs(value), 0.0, 1.0);
      }
      case SolidPattern::cells: {
        const std::int64_t cell[3]{cellOf(p.x).whole, cellOf(p.y).whole, cellOf(p.z).whole};
        return cellBits(cell, 3, 5) * 0x1p-32;
      }
      case SolidPattern::spiral: return peak(spiralAt(p, 1));
      case SolidPattern::weave: return std::abs(peak(spiralAt(p, 1)) - peak(spiralAt(p, -1)));
      case SolidPattern::quilted: {
        const auto middle = [](Real x) { return x - std::floor(x) - 0.5; };
        return std::min(1.0, length(Vec3{middle(p.x), middle(p.y), middle(p.z)}));
      }
      case SolidPattern::waves:
      case SolidPattern::ripples: {
        constexpr int kSources = 10;
        Real value = 0;
        for (int i = 0; i < kSources; ++i) {
          const std::uint32_t bits = mixBits32(static_cast<std::uint32_t>(i) * 0x9e3779b1u + 17);
          const Vec3 source = normalize(Vec3{(bits & 1023) / 511.5 - 1, (bits >> 10 & 1023) / 511.5 - 1,
                                             (bits >> 20 & 1023) / 511.5 - 1.003});
          const Real away = std::max(length(p - source), 1e-3);
          const bool isWave = kind == SolidPattern::waves;  // long ones are higher
          const Real f = isWave ? 0.05 + 0.95 * ((bits >> 5 & 255) / 255.0) : 1;
          value += (isWave ? 0.577 / std::sqrt(f) : 1) * math::sin(2 * kPi * (away * f + phase));
        }
        return 0.5 + 0.5 * value / kSources;
      }
      case SolidPattern::dents: {
        const Real n = noiseAt(p);
        return n * n * n;
      }
      case SolidPattern::hexagon: return hexagonAt(p) / 2.0;
      case SolidPattern::brick: return brickAt(p);
      case SolidPattern::checker: {
        const std::int64_t cell = cellOf(p.x).whole + cellOf(p.y).whole + cellOf(p.z).whole;
        return cell % 2 != 0;
      }
    }
    return 0;
  }

 private:
  /// Gradient noise with the wavelength of POV-Ray's. Faces of objects often lie on whole numbers, where
  /// gradient noise is 0: it is moved away from these.
  static Real lattice(const Vec3& p, std::uint32_t seed) {
    constexpr Real kFrequency = 0.93;
    return gradientNoise<3>({kFrequency * p.x + 0.37, kFrequency * p.y + 0.21, kFrequency * p.z + 0.43},
                            seed);
  }
  /// Smooth noise from 0 to 1: mean 0.507, standard deviation 0.115.
  static Real noiseAt(const Vec3& p) { return std::clamp(0.507 + 0.405 * lattice(p, 7), 0.0, 1.0); }
  /// The noise that sums are made of, spread twice as wide.
  static Real strongNoiseAt(const Vec3& p) { return std::clamp(2 * noiseAt(p) - 0.5, 0.0, 1.0); }
  static Vec3 vectorAt(const Vec3& p) {
    constexpr Real kSpread = 0.83;
    return Vec3{lattice(p, 11), lattice(p, 12), lattice(p, 13)} * kSpread;
  }
  /// The sum of octaves of noise, about 0.5 each.
  Real sum(const Vec3& p) const {
    Real value = strongNoiseAt(p), l = lambda, o = omega;
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) value += o * strongNoiseAt(p * l);
    return value;
  }
  Vec3 bent(const Vec3& p) const {
    Vec3 v = vectorAt(p);
    Real l = lambda, o = omega;
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) v += vectorAt(p * l) * o;
    return {p.x + v.x * turbulence.x, p.y + v.y * turbulence.y, p.z + v.z * turbulence.z};
  }
  Real waved(Real value) const {
    const bool repeats = kind == SolidPattern::gradient || kind == SolidPattern::onion ||
                         kind == SolidPattern::marble || kind == SolidPattern::wood ||
                         kind == SolidPattern::radial || frequency != 1 || phase != 0;
    Real t = value;
    if (kind != SolidPattern::waves && kind != SolidPattern::ripples) t = t * frequency + phase;
    if (repeats && !(t >= 0 && t <= 1)) t -= std::floor(t);  // 1 itself is the end of the map
    switch (wave) {
      case SolidWave::saw: return t;
      case SolidWave::triangle: return t < 0.5 ? 2 * t : 2 * (1 - t);
      case SolidWave::sine: return 0.5 * (1 + math::sin(2 * kPi * t));
      case SolidWave::scallop: return std::abs(math::sin(kPi * t));
      case SolidWave::cubic: return t * t * (3 - 2 * t);
      case SolidWave::power: return math::pow(std::max(t, 0.0), exponent);
    }
    return t;
  }
  /// 0, 1 or 2: which of three kinds of hexagons, of side 1, over x and z.
  static int hexagonAt(const Vec3& p) {
    constexpr Real kWide = 1.7320508075688772;  // between two opposite sides
    // The nearest middle: rows are 1.5 apart, each half a hexagon along.
    Real best = kInfinity;
    std::int64_t row = 0, column = 0;
    const auto middle = static_cast<std::int64_t>(std::floor(p.x / 1.5));
    for (std::int64_t r = middle; r <= middle + 1; ++r) {
      const Real shift = r % 2 != 0 ? kWide / 2 : 0;
      const auto c = static_cast<std::int64_t>(std::floor((p.z - shift) / kWide + 0.5));
      const Real dx = p.x - 1.5 * static_cast<Real>(r), dz = p.z - shift - kWide * static_cast<Real>(c);
      if (dx * dx + dz * dz < best) best = dx * dx + dz * dz, row = r, column = c;
    }
    // Three colours, so that no neighbours share one.
    const std::int64_t half = row >= 0 ? row / 2 : (row - 1) / 2;
    const std::int64_t id = column - half + 2 * row;
    return static_cast<int>(((id % 3) + 3) % 3);
  }
  /// Spirals on cones around z that turn that way: whole numbers lie on one.
  Real spiralAt(const Vec3& p, Real turn) const {
    const Real around = math::atan2(p.y, p.x) / (2 * kPi) + 0.25;
    return math::hypot(p.x, p.y) + p.z + turn * number * around;
  }
  /// 0 at whole numbers, 1 half way between them.
  static Real peak(Real t) { return 1 - std::abs(1 - 2 * (t - std::floor(t))); }
  /// 0 for mortar, 1 for brick. Mortar ends where the next brick begins. A surface that lies on such a border
  /// is brick, whatever its points are rounded to.
  Real brickAt(const Vec3& p) const {
    constexpr Real kBorder = 1e-9;  // in bricks
    const auto cell = [](Real x, Real size) { return size > 0 ? x / size + kBorder : 0; };
    const auto isJoint = [&](Real t, Real size) {
      return size > 0 && (1 - (t - std::floor(t))) * size <= number;
    };
    const Real y = cell(p.y, axis.y);
    Real x = cell(p.x, axis.x), z = cell(p.z, axis.z);
    if (isJoint(y, axis.y)) return 0;
    (cellOf(y).whole % 2 != 0 ? x : z) += 0.5;
    return isJoint(x, axis.x) || isJoint(z, axis.z) ? 0 : 1;
  }
};

}  // namespace trace
