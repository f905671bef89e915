#include "render/world/sky_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/bits.h"
#include "base/parallel.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "render/world/outside.h"

namespace trace {
namespace {

/// The brightness in directions of one height. A gradient depends on the height and on the length of the
/// rest, whose rounding gives it few values in a row: each is looked up once.
class Brightness {
 public:
  Brightness(const Outside& outside, bool gradient) : outside_(outside), gradient_(gradient) {}

  Real at(const Vec3& direction) {
    if (!gradient_) return seen(direction);
    const Real flat = math::hypot(direction.x, direction.z);
    Known& known = known_[bitCast<std::uint64_t>(flat) % known_.size()];
    if (known.flat != flat || known.y != direction.y) known = {direction.y, flat, seen(direction)};
    return known.light;
  }

 private:
  struct Known {
    Real y = kInfinity, flat = 0, light = 0;
  };
  Real seen(const Vec3& direction) const {
    const Real light = luminanceOf(outside_.view({{}, direction}, RayKind::bounce).color);
    return light > 0 && light < kInfinity ? light : 0;
  }

  const Outside& outside_;
  bool gradient_;
  std::array<Known, 64> known_;
};

}  // namespace

SkySums::SkySums(const Outside& outside, int threads) : inRows(std::size_t{kColumns} * kRows), rows(kRows) {
  constexpr int kSide = 2;  // directions of a cell that are looked in, along each side
  std::vector<math::SinCos> angles;
  for (int i = 0; i < kColumns * kSide; ++i)
    angles.push_back(math::sincos(2 * kPi * ((i / kSide + (i % kSide + 0.5) / kSide) / kColumns)));
  std::vector<Real> most(kRows), least(kRows, kInfinity);
  const bool gradient = outside.unevennessOfGradient() < kInfinity;
  Job job;
  parallelChunks(kRows, threads, job, [&](std::int64_t number, int) {
    const int row = static_cast<int>(number);
    Brightness brightness(outside, gradient);
    Real sum = 0;
    for (int column = 0; column < kColumns; ++column) {
      Real light = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const math::SinCos& angle = angles[static_cast<std::size_t>(column * kSide + i % kSide)];
        const Real y = 1 - 2 * ((row + (i / kSide + 0.5) / kSide) / kRows);
        const Real flat = std::sqrt(std::max(0.0, 1 - y * y));
        const Vec3 direction{flat * angle.cos, y, flat * angle.sin};
        light += brightness.at(direction);
      }
      most[number] = std::max(most[number], light);
      least[number] = std::min(least[number], light);
      inRows[cell(row, column)] = static_cast<float>(sum += light);
    }
    rows[number] = sum;
  });
  brightest = *std::max_element(most.begin(), most.end());
  darkest = *std::min_element(least.begin(), least.end());
  for (std::size_t row = 1; row < rows.size(); ++row) rows[row] += rows[row - 1];
}

}  // namespace trace
