#include "shading/cameras/aperture.h"

#include <algorithm>

#include "image/srgb.h"

namespace trace {
namespace {

/// Where in the ascending sums the number lies: the step, and the part of it.
Real placeIn(const Real* sums, int count, Real number) {
  const auto found = std::min<std::ptrdiff_t>(std::upper_bound(sums, sums + count, number) - sums, count - 1);
  const Real before = found > 0 ? sums[found - 1] : 0, own = sums[found] - before;
  return static_cast<Real>(found) + (own > 0 ? std::clamp((number - before) / own, 0.0, 1.0) : 0.5);
}

}  // namespace

Aperture::Aperture(const Picture& picture) : width_(picture.width), height_(picture.height) {
  const auto fill = [&](auto brightness) {
    sums_.clear();
    rowSums_.clear();
    Real all = 0;
    for (int y = 0; y < height_; ++y) {
      Real row = 0;
      for (int x = 0; x < width_; ++x) sums_.push_back(row += brightness(x, y));
      rowSums_.push_back(all += row);
    }
    return all;
  };
  const Real open = fill([&](int x, int y) { return max(0, luminanceOf(picture.at(x, y))); });
  if (!(open > 0 && open < kInfinity)) fill([](int, int) { return 1.0; });
}

Vec2 Aperture::at(const Vec2& u) const {
  const Real row = placeIn(rowSums_.data(), height_, u.x * rowSums_.back());
  const auto first = static_cast<std::size_t>(std::min(static_cast<int>(row), height_ - 1)) *
                     static_cast<std::size_t>(width_);
  const Real* sums = &sums_[first];
  const Real column = placeIn(sums, width_, u.y * sums[width_ - 1]);
  const Real longer = std::max(width_, height_);
  return {(2 * column - width_) / longer, (height_ - 2 * row) / longer};
}

}  // namespace trace
