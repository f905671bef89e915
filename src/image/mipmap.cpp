// Lookups in a MipMap; its levels are made in mipmap_pyramid.cpp.
#include "image/mipmap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "base/match.h"
#include "image/srgb.h"

namespace trace {
namespace {

/// An ellipse may be so many times as long as wide; a longer one is made wider.
constexpr Real kMostAnisotropy = 8;

/// Two numbers that processors add and multiply at once.
using Pair = double __attribute__((vector_size(16)));

/// The channels of a texel as the level stores them, or colours that were made linear.
struct Sample {
  Pair redGreen{}, blueAlpha{};

  Sample operator-(const Sample& o) const { return {redGreen - o.redGreen, blueAlpha - o.blueAlpha}; }
  void add(double weight, const Sample& o) {
    redGreen += weight * o.redGreen;
    blueAlpha += weight * o.blueAlpha;
  }
};

/// From a to b; of two equal ones the same.
Sample mixed(double share, Sample a, const Sample& b) {
  a.add(share, b - a);
  return a;
}

/// The largest whole number up to x, and the least from it on; of a size that int holds. std::floor is a
/// call.
int floorOf(Real x) {
  const int whole = static_cast<int>(x);
  return whole - (x < whole);
}
int ceilOf(Real x) { return -floorOf(-x); }

/// The column or row that stands at place i of a row of n; -1 where it is black.
int wrapped(int i, int n, Wrap wrap) {
  if (static_cast<unsigned>(i) < static_cast<unsigned>(n)) return i;
  switch (wrap) {
    case Wrap::repeat: i %= n; return i < 0 ? i + n : i;
    case Wrap::mirror:
      i %= 2 * n;
      if (i < 0) i += 2 * n;
      return i < n ? i : 2 * n - 1 - i;
    case Wrap::clamp: return i < 0 ? 0 : n - 1;
    case Wrap::black: break;
  }
  return -1;
}

/// An equal place, so near to the picture that its texels can be numbered; 0 to n are the picture's edges.
Real nearby(Real x, Real n, Wrap wrap) {
  if (x >= 0 && x < n) return x;
  constexpr Real kFar = 1 << 28, kFarthest = 1e300;  // beyond that even a difference is infinite
  x = std::clamp(x, -kFarthest, kFarthest);
  switch (wrap) {
    case Wrap::repeat: x -= std::floor(x / n) * n; break;
    case Wrap::mirror: x -= std::floor(x / (2 * n)) * (2 * n); break;
    case Wrap::clamp: return std::clamp(x, 0.0, n);
    case Wrap::black: break;
  }
  return std::clamp(x, -kFar, kFar);
}

/// Reads the texels of a level. It is compiled for each case of what does not change from texel to texel.
template <class T, int kChannels, bool kDecodes>
struct Texels {
  const T* samples;
  int width, height;
  const float* linear;  ///< of each sample that an integer can be; null for floats
  double alphaMost;
  Wrap u, v;

  double color(T sample) const {
    if constexpr (!kDecodes)
      return double(sample);
    else if constexpr (std::is_floating_point_v<T>)
      return linearOfSrgb(sample);
    else
      return double(linear[sample]);
  }
  Sample at(std::size_t pixel) const {
    const T* s = samples + pixel * kChannels;
    if constexpr (kChannels >= 3)
      return {Pair{color(s[0]), color(s[1])}, Pair{color(s[2]), kChannels == 4 ? double(s[3]) : alphaMost}};
    const double grey = color(s[0]);
    return {Pair{grey, grey}, Pair{grey, kChannels == 2 ? double(s[1]) : alphaMost}};
  }
  /// Black, and transparent, where there is none.
  Sample at(int x, int y) const { return stored(wrapped(x, width, u), wrapped(y, height, v)); }
  Sample stored(int column, int row) const {
    if (column < 0 || row < 0) return {};
    return at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(column));
  }
};

/// Calls use(Texels<...>) and makes a Texel of the Sample that it returns. `linear` is null where colours
/// stay as they are stored.
template <class Use>
Texel lookedUp(const MipMap::Level& level, const std::vector<float>* linear, const Lookup& lookup,
               const Use& use) {
  const auto read = [&]<class T, int kChannels, bool kDecodes>(const std::vector<T>& samples) {
    return use(Texels<T, kChannels, kDecodes>{samples.data(), level.width, level.height,
                                              kDecodes ? linear->data() : nullptr, level.alphaMost, lookup.u,
                                              lookup.v});
  };
  const auto decoded = [&]<class T, int kChannels>(const std::vector<T>& samples) {
    return linear ? read.template operator()<T, kChannels, true>(samples)
                  : read.template operator()<T, kChannels, false>(samples);
  };
  const Sample s = match(level.samples, [&]<class T>(const std::vector<T>& samples) {
    switch (level.channels) {
      case 1: return decoded.template operator()<T, 1>(samples);
      case 2: return decoded.template operator()<T, 2>(samples);
      case 3: return decoded.template operator()<T, 3>(samples);
      default: return decoded.template operator()<T, 4>(samples);
    }
  });
  const double most = linear ? 1 : level.colorMost;
  return {Color(s.redGreen[0], s.redGreen[1], s.blueAlpha[0]) / most, s.blueAlpha[1] / level.alphaMost};
}

Texel mixed(Real share, const Texel& a, const Texel& b) {
  const auto between = [&](Real x, Real y) { return x + (y - x) * share; };
  return {{between(a.color.r, b.color.r), between(a.color.g, b.color.g), between(a.color.b, b.color.b)},
          between(a.alpha, b.alpha)};
}

/// exp(-2 r^2) - exp(-2), by r^2 from 0 to 1 (pbrt 4th ed., 10.4.4).
struct Gaussian {
  static constexpr int kSize = 128;
  double weight[kSize + 1]{};  // the last for what rounding makes of 1
  Gaussian() {
    for (int i = 0; i < kSize; ++i) weight[i] = std::exp(-2 * (i + 0.5) / kSize) - std::exp(-2.0);
  }
};
const Gaussian kGaussian;

}  // namespace

/// The ellipse that a circle of radius 1 pixel makes, in texels: (a c - b^2) = c x^2 - 2 b x y + a y^2.
struct MipMap::Ellipse {
  Real a = 0, b = 0, c = 0;
  Real longest = 0, shortest = 0;  ///< half axes

  /// Through the ends of the footprint p, q.
  Ellipse(const Vec2& p, const Vec2& q)
      : a(p.x * p.x + q.x * q.x), b(p.x * p.y + q.x * q.y), c(p.y * p.y + q.y * q.y) {
    const Real half = (a - c) / 2, area = std::abs(p.x * q.y - p.y * q.x);
    longest = std::sqrt((a + c) / 2 + std::sqrt(half * half + b * b));
    shortest = longest > 0 ? area / longest : 0;
  }
  /// Makes it so wide that it is no more than `most` times as long.
  void widen(Real most) {
    const Real wanted = longest / most;
    if (!(shortest < wanted)) return;
    const Real square = longest * longest, narrow = shortest * shortest;
    const Real share = (wanted * wanted - narrow) / (square - narrow);
    a += share * (square - a);
    b -= share * b;
    c += share * (square - c);
    shortest = wanted;
  }
};

Texel MipMap::texel(int x, int y) const {
  return lookedUp(base_, nullptr, {}, [&](const auto& texels) { return texels.at(x, y); });
}

Texel MipMap::bilinear(const Level& level, const Vec2& place, const Lookup& lookup) const {
  const Real x = place.x * level.width / base_.width - 0.5, y = place.y * level.height / base_.height - 0.5;
  const int i = floorOf(x), j = floorOf(y);
  const Real s = x - i, t = y - j;
  const bool decodes = lookup.srgb && &level == &base_;
  return lookedUp(level, decodes ? &linear() : nullptr, lookup, [&](const auto& texels) {
    if (lookup.filter == TexelFilter::nearest) return texels.at(floorOf(x + 0.5), floorOf(y + 0.5));
    const int left = wrapped(i, level.width, lookup.u), right = wrapped(i + 1, level.width, lookup.u),
              top = wrapped(j, level.height, lookup.v), bottom = wrapped(j + 1, level.height, lookup.v);
    if ((left | right | top | bottom) < 0)
      return mixed(t, mixed(s, texels.stored(left, top), texels.stored(right, top)),
                   mixed(s, texels.stored(left, bottom), texels.stored(right, bottom)));
    const auto row = [&](int number) {
      const std::size_t start = static_cast<std::size_t>(number) * static_cast<std::size_t>(level.width);
      return mixed(s, texels.at(start + static_cast<std::size_t>(left)),
                   texels.at(start + static_cast<std::size_t>(right)));
    };
    return mixed(t, row(top), row(bottom));
  });
}

/// The mean of the texels in the ellipse (Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989,
/// section 3.5.8), which is made a texel wide where it is less, so that there always is one in it.
Texel MipMap::weighted(const Level& level, const Vec2& place, const Ellipse& ellipse,
                       const Lookup& lookup) const {
  const Real toX = Real(level.width) / base_.width, toY = Real(level.height) / base_.height;
  const Real x = place.x * toX - 0.5, y = place.y * toY - 0.5;
  // A x^2 + B x y + C y^2 = r^2
  const Real narrow = ellipse.shortest * min(toX, toY), room = max(0, 1 - narrow * narrow);
  Real A = ellipse.c * toY * toY + room, B = -2 * ellipse.b * toX * toY, C = ellipse.a * toX * toX + room;
  const Real inverse = 1 / (A * C - B * B / 4);
  A *= inverse;
  B *= inverse;
  C *= inverse;
  const Real high = std::sqrt(A / (A * C - B * B / 4));
  const bool decodes = lookup.srgb && &level == &base_;
  return lookedUp(level, decodes ? &linear() : nullptr, lookup, [&](const auto& texels) {
    // Differences from one of the texels are summed: there are none in a picture of one colour.
    const Sample middle = texels.at(floorOf(x + 0.5), floorOf(y + 0.5));
    Sample sum;
    Real weights = 0;
    const int last = floorOf(y + high);
    for (int row = ceilOf(y - high); row <= last; ++row) {
      const Real dy = row - y, half = -B * dy / (2 * A);
      const Real width = half * half - (C * dy * dy - 1) / A;
      if (!(width > 0)) continue;
      const Real reach = std::sqrt(width);
      const int from = ceilOf(x + half - reach), to = floorOf(x + half + reach),
                j = wrapped(row, level.height, lookup.v);
      // r^2 and its differences from column to column.
      const Real dx = from - x;
      Real r2 = (A * dx + B * dy) * dx + C * dy * dy, step = A * (2 * dx + 1) + B * dy;
      const auto sumUp = [&](const auto& texelIn) {
        for (int column = from; column <= to; ++column, r2 += step, step += 2 * A) {
          const Real weight = kGaussian.weight[static_cast<int>(r2 * Gaussian::kSize)];
          sum.add(weight, texelIn(column) - middle);
          weights += weight;
        }
      };
      if (j >= 0 && from >= 0 && to < level.width) {
        const std::size_t start = static_cast<std::size_t>(j) * static_cast<std::size_t>(level.width);
        sumUp([&](int column) { return texels.at(start + static_cast<std::size_t>(column)); });
      } else {
        sumUp([&](int column) { return texels.stored(wrapped(column, level.width, lookup.u), j); });
      }
    }
    Sample mean = middle;
    if (weights > 0) mean.add(1 / weights, sum);
    return mean;
  });
}

Texel MipMap::at(const Vec2& uv, const Lookup& lookup) const {
  const auto place = [&](Real s, int size, Wrap wrap) {
    return nearby(lookup.centersAtEnds ? s * (size - 1) + 0.5 : s * size, size, wrap);
  };
  const Vec2 at{place(uv.x, width(), lookup.u), place(1 - uv.y, height(), lookup.v)};
  const auto inTexels = [&](const Vec2& d) { return Vec2{d.x * width(), -d.y * height()}; };
  Ellipse ellipse(inTexels(lookup.uvX), inTexels(lookup.uvY));
  const bool ewa = lookup.filter == TexelFilter::ewa, wide = ewa || lookup.filter == TexelFilter::trilinear;
  if (!wide || !(ellipse.longest > 0)) return bilinear(base_, at, lookup);

  if (ewa) ellipse.widen(kMostAnisotropy);
  const Real size = ewa ? ellipse.shortest : ellipse.longest;
  const std::vector<Level>& smaller = pyramid(lookup.srgb).levels;
  const auto level = [&](std::size_t i) -> const Level& { return i == 0 ? base_ : smaller[i - 1]; };
  if (!(size < static_cast<Real>(std::uint64_t{1} << smaller.size())))
    return bilinear(level(smaller.size()), at, lookup);
  // The texels of a level are as many times as large as those of the picture, rounded down.
  const auto number = static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(max(size, 1))) - 1);
  if (ewa) return weighted(level(number), at, ellipse, lookup);
  const Texel texel = bilinear(level(number), at, lookup);
  return size > 1 ? mixed(std::log2(size) - static_cast<Real>(number), texel,
                          bilinear(level(number + 1), at, lookup))
                  : texel;
}

}  // namespace trace
