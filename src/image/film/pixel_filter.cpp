#include "image/film/pixel_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

Real gaussian(Real x) {  // falls to 0 at its end; a deviation of half a pixel with the usual radius
  constexpr Real kSteepness = 4.5;
  return math::exp(-kSteepness * x * x) - math::exp(-kSteepness);
}

/// Mitchell and Netravali, Reconstruction Filters in Computer Graphics, 1988, with B = C = 1/3.
Real mitchell(Real x) {
  const Real t = 2 * std::abs(x);
  if (t >= 2) return 0;
  return t < 1 ? (7 * t * t * t - 12 * t * t + 16.0 / 3) / 6
               : (-7.0 / 3 * t * t * t + 12 * t * t - 20 * t + 32.0 / 3) / 6;
}

/// Harris, On the Use of Windows for Harmonic Analysis, 1978, with four terms.
Real blackmanHarris(Real x) {
  const Real t = kPi * (x + 1);
  return 0.35875 - 0.48829 * math::cos(t) + 0.14128 * math::cos(2 * t) - 0.01168 * math::cos(3 * t);
}

constexpr std::array kFilters{
    FilterRow{FilterKind::box, "box", "all of a pixel counts the same", 0.5, [](Real) { return Real(1); }},
    FilterRow{FilterKind::tent, "tent", "falls off evenly", 1, [](Real x) { return 1 - std::abs(x); }},
    FilterRow{FilterKind::gaussian, "gaussian", "a bell, softer than the others", 1.5, gaussian},
    FilterRow{FilterKind::mitchell, "mitchell", "sharp, with a rim that counts below 0", 2, mitchell},
    FilterRow{FilterKind::blackmanHarris, "blackman-harris", "a bell that ends", 1.5, blackmanHarris},
};

constexpr int kSteps = 1024;

}  // namespace

std::span<const FilterRow> filters() { return kFilters; }

PixelFilter::PixelFilter(FilterKind kind, Real radius) {
  const FilterRow& row = kFilters[static_cast<std::size_t>(kind)];
  row_ = &row;
  radius_ = radius > 0 ? radius : row.radius;
  isPixel_ = kind == FilterKind::box && radius_ == 0.5;
  if (kind == FilterKind::box) return;
  Real sum = 0, absolute = 0;
  sums_.push_back(0);
  for (int i = 0; i < kSteps; ++i) {
    const Real value = row.profile((2 * (i + 0.5)) / kSteps - 1);
    sum += value;
    absolute += std::abs(value);
    sums_.push_back(absolute);
    signs_.push_back(value < 0 ? -1 : 1);
  }
  for (Real& s : sums_) s /= absolute;
  weight_ = absolute / sum;
  whole_ = 2 * sum / kSteps;
}

Real PixelFilter::share(Real away) const {
  if (away < -radius_ || away >= radius_) return 0;
  return row_->profile(away / radius_) / (whole_ * radius_);
}

PixelFilter::Along PixelFilter::along(Real u) const {
  if (sums_.empty()) return {(2 * u - 1) * radius_, 1};
  const auto next = std::upper_bound(sums_.begin(), sums_.end() - 1, u);
  const auto i = static_cast<std::size_t>(next - sums_.begin()) - 1;
  const Real share = (u - sums_[i]) / (sums_[i + 1] - sums_[i]);
  return {(2 * (static_cast<Real>(i) + share) / kSteps - 1) * radius_, weight_ * signs_[i]};
}

FilmSample PixelFilter::sample(const Vec2& u) const {
  const Along x = along(u.x), y = along(u.y);
  return {{x.place, y.place}, x.weight * y.weight};
}

}  // namespace trace
