#include "render/lights/sky_table.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "image/srgb.h"
#include "math/elementary.h"

namespace trace {
namespace {

Vec3 directionAt(Real across, Real height) {
  const Real y = 1 - 2 * height, flat = std::sqrt(std::max(0.0, 1 - y * y));
  const math::SinCos angle = math::sincos(2 * kPi * across);
  return {flat * angle.cos, y, flat * angle.sin};
}

}  // namespace

SkyTable::SkyTable(const Outside& outside, int threads, bool onlyHere) {
  if (!outside.isSeenBy(RayKind::bounce) || outside.isEven()) return;
  constexpr int kSide = 2;  // places of a cell that are looked at, along each side
  sums_.resize(std::size_t{kColumns} * kRows);
  std::vector<Real> most(kRows), least(kRows, kInfinity);
  rowSums_.resize(kRows);
  Job job;
  parallelChunks(kRows, threads, job, [&](std::int64_t number, int) {
    const int row = static_cast<int>(number);
    Real sum = 0;
    for (int column = 0; column < kColumns; ++column) {
      Real light = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec3 direction = directionAt((column + (i % kSide + 0.5) / kSide) / kColumns,
                                           (row + (i / kSide + 0.5) / kSide) / kRows);
        const Real seen = luminanceOf(outside.view({{}, direction}, RayKind::bounce).color);
        if (seen > 0 && seen < kInfinity) light += seen;
      }
      most[number] = std::max(most[number], light);
      least[number] = std::min(least[number], light);
      sums_[cell(row, column)] = static_cast<float>(sum += light);
    }
    rowSums_[number] = sum;
  });
  const Real brightest = *std::max_element(most.begin(), most.end());
  for (std::size_t row = 1; row < rowSums_.size(); ++row) rowSums_[row] += rowSums_[row - 1];
  constexpr Real kUneven = 3;
  const bool uneven = onlyHere ? brightest > *std::min_element(least.begin(), least.end())
                               : brightest * kColumns * kRows > kUneven * rowSums_.back();
  if (!uneven) *this = {};
}

Vec3 SkyTable::choose(const Vec2& u) const {
  // The first whose sum is beyond the number, and how far into it that is.
  const auto find = [](const auto* first, int count, Real number) {
    const auto found = std::min<std::ptrdiff_t>(
        std::upper_bound(first, first + count, number, [](Real n, auto sum) { return n < sum; }) - first,
        count - 1);
    const Real before = found > 0 ? first[found - 1] : 0, own = first[found] - before;
    const Real into = own > 0 ? (number - before) / own : 0.5;
    return static_cast<Real>(found) + std::clamp(into, 0.0, 1 - 0x1p-53);
  };
  const Real row = find(rowSums_.data(), kRows, u.x * rowSums_.back());
  const float* cells = &sums_[cell(static_cast<int>(row), 0)];
  const Real column = find(cells, kColumns, u.y * cells[kColumns - 1]);
  return directionAt(column / kColumns, row / kRows);
}

Real SkyTable::density(const Vec3& direction) const {
  const Real height = (1 - direction.y) / 2 * kRows;
  const Real turn = math::atan2(direction.z, direction.x) / (2 * kPi);
  const int row = std::clamp(static_cast<int>(height), 0, kRows - 1);
  const int column = std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * kColumns), 0, kColumns - 1);
  const std::size_t here = cell(row, column);
  const Real own = column > 0 ? Real{sums_[here]} - sums_[here - 1] : Real{sums_[here]};
  return own / rowSums_.back() * (kColumns * kRows / (4 * kPi));
}

}  // namespace trace
