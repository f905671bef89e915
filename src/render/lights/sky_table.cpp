#include "render/lights/sky_table.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

constexpr int kColumns = SkySums::kColumns, kRows = SkySums::kRows;

Vec3 directionAt(Real across, Real height) {
  const Real y = 1 - 2 * height, flat = std::sqrt(std::max(0.0, 1 - y * y));
  const math::SinCos angle = math::sincos(2 * kPi * across);
  return {flat * angle.cos, y, flat * angle.sin};
}

}  // namespace

SkyTable::SkyTable(const Outside& outside, int threads, bool onlyHere) {
  if (!outside.isSeenBy(RayKind::bounce) || outside.isEven()) return;
  constexpr Real kUneven = 3, kSurelyBelow = 0.9 * kUneven;
  if (!onlyHere && outside.unevennessOfGradient() < kSurelyBelow) return;
  const std::shared_ptr<const SkySums> sums = outside.skySums(threads);
  const bool uneven = onlyHere ? sums->brightest > sums->darkest
                               : sums->brightest * kColumns * kRows > kUneven * sums->rows.back();
  if (uneven) sums_ = sums;
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
  const Real row = find(sums_->rows.data(), kRows, u.x * sums_->rows.back());
  const float* cells = &sums_->inRows[SkySums::cell(static_cast<int>(row), 0)];
  const Real column = find(cells, kColumns, u.y * cells[kColumns - 1]);
  return directionAt(column / kColumns, row / kRows);
}

Real SkyTable::density(const Vec3& direction) const {
  const Real height = (1 - direction.y) / 2 * kRows;
  const Real turn = math::atan2(direction.z, direction.x) / (2 * kPi);
  const int row = std::clamp(static_cast<int>(height), 0, kRows - 1);
  const int column = std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * kColumns), 0, kColumns - 1);
  const std::size_t here = SkySums::cell(row, column);
  const Real own =
      column > 0 ? Real{sums_->inRows[here]} - sums_->inRows[here - 1] : Real{sums_->inRows[here]};
  return own / sums_->rows.back() * (kColumns * kRows / (4 * kPi));
}

}  // namespace trace
