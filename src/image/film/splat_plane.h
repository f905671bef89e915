// Light that lands anywhere in a picture, whichever tile's samples bring it: sums of whole numbers, which no
// order changes. So the bits do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "math/color.h"

namespace trace {

/// The contribution of one path to a pixel.
struct Splat {
  int x, y;
  Color value;
  int sample = 0;  ///< its number among those of the pixel that brings it
};

/// Not for several threads at once, except for those that hold its mutex.
class SplatPlane {
 public:
  SplatPlane(int width, int height)
      : width_(width), sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  mutable std::mutex mutex;

  /// Bytes that a pixel takes here.
  static constexpr std::uint64_t bytesPerPixel() { return sizeof(Sum); }

  /// The contribution of that many paths together. A value that is not finite does not count; one beyond
  /// kMost counts as that.
  void add(std::span<const Splat> splats, std::int64_t paths) {
    paths_ += paths;
    for (const Splat& splat : splats) {
      if (!isFinite(splat.value)) continue;
      Sum& sum = sums_[index(splat.x, splat.y)];
      sum[0] += parts(splat.value.r);
      sum[1] += parts(splat.value.g);
      sum[2] += parts(splat.value.b);
    }
  }
  std::int64_t paths() const { return paths_; }
  /// The mean contribution of a path to the pixel.
  Color mean(int x, int y) const { return mean(sums_[index(x, y)], paths_); }
  /// That of the paths that are not among those of `part`.
  Color meanWithout(const SplatPlane& part, int x, int y) const {
    Sum sum = sums_[index(x, y)];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= part.sums_[index(x, y)][i];
    return mean(sum, paths_ - part.paths_);
  }

 private:
  friend class FilmState;
  __extension__ using Whole = __int128;
  using Sum = std::array<Whole, 3>;
  static constexpr double kParts = 0x1p40;          ///< parts of one: very dark values count as well
  static constexpr double kMost = 0x1p50;           ///< 2^37 of these do not overflow
  static constexpr Whole kLimit = Whole{1} << 126;  ///< largest sum that is read: as much can still be added

  static Color mean(const Sum& sum, std::int64_t paths) {
    if (paths == 0) return Color(0);
    const double scale = 1 / (kParts * static_cast<double>(paths));
    return Color(static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])) *
           scale;
  }
  static Whole parts(double value) {
    return static_cast<Whole>(std::nearbyint(std::clamp(value, -kMost, kMost) * kParts));
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  std::vector<Sum> sums_;
  std::int64_t paths_ = 0;
};

}  // namespace trace
