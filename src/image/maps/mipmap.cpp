// Lookups in a MipMap; its levels are made in mipmap_pyramid.cpp.
#include "image/maps/mipmap.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "image/maps/mipmap_texels.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// An ellipse may be so many times as long as wide; a longer one is made wider.
constexpr Real kMostAnisotropy = 8;

/// exp(-2 r^2) - exp(-2), by r^2 from 0 to 1 (pbrt 4th ed., 10.4.4).
struct Gaussian {
  static constexpr int kSize = 128;
  double weight[kSize + 1]{};  // the last for what rounding makes of 1
  Gaussian() {
    for (int i = 0; i < kSize; ++i) weight[i] = math::exp(-2 * (i + 0.5) / kSize) - math::exp(-2.0);
  }
};
const Gaussian kGaussian;

}  // namespace

/// The ellipse that a circle of radius 1 pixel makes, in texels: (a c - b^2) = c x^2 - 2 b x y + a y^2.
struct MipMap::Footprint {
  Real a = 0, b = 0, c = 0;
  Real longest = 0;  ///< half axis

  /// Through the ends of the footprint p, q.
  Footprint(const Vec2& p, const Vec2& q)
      : a(p.x * p.x + q.x * q.x), b(p.x * p.y + q.x * q.y), c(p.y * p.y + q.y * q.y) {
    const Real half = (a - c) / 2;
    longest = std::sqrt((a + c) / 2 + std::sqrt(half * half + b * b));
  }
};

/// One whose half axes are both known, at most `most` times as long as wide.
struct MipMap::Ellipse : Footprint {
  Real shortest = 0;

  /// Precondition: it has a length.
  Ellipse(const Footprint& footprint, const Vec2& p, const Vec2& q, Real most) : Footprint(footprint) {
    shortest = std::abs(p.x * q.y - p.y * q.x) / longest;
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
  const Spot spot(level, base_, place);
  const bool decodes = lookup.srgb && &level == &base_;
  return lookedUp(level, decodes ? &linear() : nullptr, lookup, [&](const auto& texels) {
    return lookup.filter == TexelFilter::nearest ? texels.at(floorOf(spot.x + 0.5), floorOf(spot.y + 0.5))
                                                 : between(texels, spot);
  });
}

/// Both levels in one go where they are stored alike.
Texel MipMap::trilinear(const Level& larger, const Level& smaller, Real share, const Vec2& place,
                        const Lookup& lookup) const {
  if (&larger == &base_)
    return mixed(share, bilinear(larger, place, lookup), bilinear(smaller, place, lookup));
  const Spot first(larger, base_, place), second(smaller, base_, place);
  Sample other;
  const Texel texel = lookedUp(larger, nullptr, lookup,
                               [&]<class T, int kChannels>(const Texels<T, kChannels, false>& texels) {
                                 Texels<T, kChannels, false> below = texels;
                                 below.samples = std::get<std::vector<T>>(smaller.samples).data();
                                 below.width = smaller.width;
                                 below.height = smaller.height;
                                 other = between(below, second);
                                 return between(texels, first);
                               });
  return mixed(share, texel, texelOf(other, smaller.colorMost, smaller.alphaMost));
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
  const bool ewa = lookup.filter == TexelFilter::ewa, wide = ewa || lookup.filter == TexelFilter::trilinear;
  if (!wide) return bilinear(base_, at, lookup);
  const Vec2 p = inTexels(lookup.uvX), q = inTexels(lookup.uvY);
  const Footprint footprint(p, q);
  if (!(footprint.longest > 0)) return bilinear(base_, at, lookup);

  const std::vector<Level>& smaller = pyramid(lookup.srgb);
  const auto level = [&](std::size_t i) -> const Level& { return i == 0 ? base_ : smaller[i - 1]; };
  const auto last = static_cast<Real>(std::uint64_t{1} << smaller.size());
  // The texels of a level are as many times as large as those of the picture, rounded down.
  const auto numberOf = [](Real size) {
    return static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(max(size, 1))) - 1);
  };
  if (ewa) {
    const Ellipse ellipse(footprint, p, q, kMostAnisotropy);
    if (!(ellipse.shortest < last)) return bilinear(level(smaller.size()), at, lookup);
    return weighted(level(numberOf(ellipse.shortest)), at, ellipse, lookup);
  }
  const Real size = footprint.longest;
  if (!(size < last)) return bilinear(level(smaller.size()), at, lookup);
  const std::size_t number = numberOf(size);
  if (!(size > 1)) return bilinear(level(number), at, lookup);
  return trilinear(level(number), level(number + 1), math::log2(size) - static_cast<Real>(number), at,
                   lookup);
}

}  // namespace trace
