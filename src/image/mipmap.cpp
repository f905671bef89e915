// Lookups in a MipMap; its levels are made in mipmap_pyramid.cpp.
#include "image/mipmap.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/match.h"

namespace trace {
namespace {

/// An ellipse may be so many times as long as wide; a longer one is made wider.
constexpr Real kMostAnisotropy = 8;

/// The channels of a texel as the level stores them, or colours that were made linear.
struct Sample {
  double v[4] = {0, 0, 0, 0};

  Sample operator-(const Sample& o) const {
    return {{v[0] - o.v[0], v[1] - o.v[1], v[2] - o.v[2], v[3] - o.v[3]}};
  }
  void add(double weight, const Sample& o) {
    for (int k = 0; k < 4; ++k) v[k] += weight * o.v[k];
  }
};

/// From a to b; of two equal ones the same.
Sample mixed(double share, Sample a, const Sample& b) {
  a.add(share, b - a);
  return a;
}

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

/// Reads the texels of a level.
template <class T>
struct Texels {
  const T* samples;
  int width, height, channels;
  const float* linear;  ///< of each integer sample; null where colours stay as they are
  bool formula;         ///< floats are sRGB
  double alphaMost;
  Wrap u, v;

  double color(T sample) const {
    if constexpr (std::is_floating_point_v<T>)
      return formula ? linearOfSrgb(sample) : sample;
    else
      return linear ? double(linear[sample]) : double(sample);
  }
  Sample at(std::size_t pixel) const {
    const T* s = samples + pixel * static_cast<std::size_t>(channels);
    if (channels == 3) return {{color(s[0]), color(s[1]), color(s[2]), alphaMost}};
    if (channels == 4) return {{color(s[0]), color(s[1]), color(s[2]), double(s[3])}};
    const double grey = color(s[0]);
    return {{grey, grey, grey, channels == 2 ? double(s[1]) : alphaMost}};
  }
  /// Black, and transparent, where there is none.
  Sample at(int x, int y) const {
    const int column = wrapped(x, width, u), row = wrapped(y, height, v);
    if (column < 0 || row < 0) return {};
    return at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(column));
  }
};

/// Calls use(Texels<...>) and makes a Texel of the Sample that it returns.
template <class Use>
Texel lookedUp(const MipMap::Level& level, const std::vector<float>* linear, const Lookup& lookup,
               const Use& use) {
  const Sample s = match(level.samples, [&]<class T>(const std::vector<T>& samples) {
    const bool made = linear && !linear->empty();
    return use(Texels<T>{samples.data(), level.width, level.height, level.channels,
                         made ? linear->data() : nullptr, linear && !made, level.alphaMost, lookup.u,
                         lookup.v});
  });
  const double most = linear ? 1 : level.colorMost;
  return {Color(s.v[0], s.v[1], s.v[2]) / most, s.v[3] / level.alphaMost};
}

Texel mixed(Real share, const Texel& a, const Texel& b) {
  const auto between = [&](Real x, Real y) { return x + (y - x) * share; };
  return {{between(a.color.r, b.color.r), between(a.color.g, b.color.g), between(a.color.b, b.color.b)},
          between(a.alpha, b.alpha)};
}

/// exp(-2 r^2) - exp(-2), by r^2 from 0 to 1 (pbrt 4th ed., 10.4.4).
struct Gaussian {
  static constexpr int kSize = 128;
  float weight[kSize];
  Gaussian() {
    for (int i = 0; i < kSize; ++i)
      weight[i] = static_cast<float>(std::exp(-2 * (i + 0.5) / kSize) - std::exp(-2.0));
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
    a += share * (square - a), b -= share * b, c += share * (square - c);
    shortest = wanted;
  }
};

Texel MipMap::texel(int x, int y) const {
  return lookedUp(base_, nullptr, {}, [&](const auto& texels) { return texels.at(x, y); });
}

Texel MipMap::bilinear(const Level& level, const Vec2& place, const Lookup& lookup) const {
  const Real x = place.x * level.width / base_.width - 0.5, y = place.y * level.height / base_.height - 0.5;
  const Real left = std::floor(x), top = std::floor(y), s = x - left, t = y - top;
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  const bool decodes = lookup.srgb && &level == &base_;
  return lookedUp(level, decodes ? &linear() : nullptr, lookup, [&](const auto& texels) {
    if (lookup.filter == TexelFilter::nearest)
      return texels.at(static_cast<int>(std::floor(x + 0.5)), static_cast<int>(std::floor(y + 0.5)));
    return mixed(t, mixed(s, texels.at(i, j), texels.at(i + 1, j)),
                 mixed(s, texels.at(i, j + 1), texels.at(i + 1, j + 1)));
  });
}

/// The mean of the texels in the ellipse, with a texel added to it so that there always is one (Heckbert,
/// Fundamentals of Texture Mapping and Image Warping, 1989, section 3.5.8).
Texel MipMap::weighted(const Level& level, const Vec2& place, const Ellipse& ellipse,
                       const Lookup& lookup) const {
  const Real toX = Real(level.width) / base_.width, toY = Real(level.height) / base_.height;
  const Real x = place.x * toX - 0.5, y = place.y * toY - 0.5;
  // A x^2 + B x y + C y^2 = r^2
  Real A = ellipse.c * toY * toY + 1, B = -2 * ellipse.b * toX * toY, C = ellipse.a * toX * toX + 1;
  const Real inverse = 1 / (A * C - B * B / 4);
  A *= inverse, B *= inverse, C *= inverse;
  const Real high = std::sqrt(A / (A * C - B * B / 4));
  const bool decodes = lookup.srgb && &level == &base_;
  return lookedUp(level, decodes ? &linear() : nullptr, lookup, [&](const auto& texels) {
    // Differences from one of the texels are summed: there are none in a picture of one colour.
    const Sample middle =
        texels.at(static_cast<int>(std::floor(x + 0.5)), static_cast<int>(std::floor(y + 0.5)));
    Sample sum;
    Real weights = 0;
    const int last = static_cast<int>(std::floor(y + high));
    for (int row = static_cast<int>(std::ceil(y - high)); row <= last; ++row) {
      const Real dy = row - y, half = -B * dy / (2 * A);
      const Real width = half * half - (C * dy * dy - 1) / A;
      if (!(width > 0)) continue;
      const Real reach = std::sqrt(width);
      const int from = static_cast<int>(std::ceil(x + half - reach)),
                to = static_cast<int>(std::floor(x + half + reach)), j = wrapped(row, level.height, lookup.v);
      // r^2 and its differences from column to column.
      const Real dx = from - x;
      Real r2 = (A * dx + B * dy) * dx + C * dy * dy, step = A * (2 * dx + 1) + B * dy;
      const std::size_t start = static_cast<std::size_t>(max(j, 0)) * static_cast<std::size_t>(level.width);
      const bool inside = j >= 0 && from >= 0 && to < level.width;
      for (int column = from; column <= to; ++column, r2 += step, step += 2 * A) {
        const int cell = std::clamp(static_cast<int>(r2 * Gaussian::kSize), 0, Gaussian::kSize - 1);
        const Real weight = kGaussian.weight[cell];
        const Sample sample =
            inside ? texels.at(start + static_cast<std::size_t>(column)) : texels.at(column, row);
        sum.add(weight, sample - middle);
        weights += weight;
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
  const Real depth = max(0, std::log2(ewa ? ellipse.shortest : ellipse.longest));
  const std::vector<Level>& smaller = pyramid(lookup.srgb).levels;
  const std::size_t last = smaller.size();
  if (!(depth < static_cast<Real>(last))) return bilinear(last > 0 ? smaller.back() : base_, at, lookup);
  const auto first = static_cast<std::size_t>(depth);
  const auto onLevel = [&](std::size_t i) {
    const Level& level = i == 0 ? base_ : smaller[i - 1];
    return ewa && i < last ? weighted(level, at, ellipse, lookup) : bilinear(level, at, lookup);
  };
  const Real share = depth - static_cast<Real>(first);
  const Texel texel = onLevel(first);
  return share > 0 ? mixed(share, texel, onLevel(first + 1)) : texel;
}

}  // namespace trace
