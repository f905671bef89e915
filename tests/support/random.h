// Random numbers for tests: the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "base/sanitized.h"
#include "math/transform.h"

namespace trace::test {

/// `./dev test thorough` asks for as many rays as it takes to find what is one in a million.
inline bool thorough() { return std::getenv("TRACE_THOROUGH") != nullptr; }

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  bool coin() { return engine_() & 1; }

  Vec3 inCube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Vec3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * kPi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  /// Rotation, uneven scale around `scale`, sometimes mirrored, and a shift of a few times the size.
  Affine affine(double scale) {
    const Vec3 s = Vec3{uniform(0.3, 3), uniform(0.3, 3), uniform(coin() ? 0.3 : -3, 3)} * scale;
    return Affine::translation(inCube(5 * scale)) * Affine::rotation(direction(), uniform(0, 6)) *
           Affine::scaling(s);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trace::test
