// Texels of a level of a MipMap, as lookups read and mix them. Part of mipmap.cpp.
#pragma once

#include <cmath>
#include <type_traits>

#include "base/match.h"
#include "image/maps/mipmap.h"
#include "image/srgb.h"

namespace trace {
namespace {  // belongs to the one file that includes it

/// Two numbers that processors add and multiply at once.
using Pair = double __attribute__((vector_size(16)));

/// The values of bytes that are not decoded.
struct PlainBytes {
  double number[256]{};
  constexpr PlainBytes() {
    for (int i = 0; i < 256; ++i) number[i] = i;
  }
};
inline constexpr PlainBytes kPlainBytes;

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
int ceilOf(Real x) {
  const int whole = static_cast<int>(x);
  return whole + (whole < x);
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
[[gnu::noinline]] Real broughtNear(Real x, Real n, Wrap wrap) {
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

inline Real nearby(Real x, Real n, Wrap wrap) { return x >= 0 && x < n ? x : broughtNear(x, n, wrap); }

/// Reads the texels of a level. It is compiled for each case of what does not change from texel to texel.
template <class T, int kChannels, bool kDecodes>
struct Texels {
  const T* samples;
  int width, height;
  const double* numbers;  ///< that integers stand for, where they are looked up
  double alphaMost;
  Wrap u, v;

  static constexpr bool kLooksUp =
      std::is_same_v<T, std::uint8_t> || (kDecodes && !std::is_floating_point_v<T>);

  double color(T sample) const {
    if constexpr (kLooksUp)
      return numbers[sample];
    else if constexpr (kDecodes)
      return linearOfSrgb(sample);
    else
      return double(sample);
  }
  Sample at(std::size_t pixel) const {
    const T* s = samples + pixel * kChannels;
    if constexpr (kChannels >= 3) {
      return {Pair{color(s[0]), color(s[1])}, Pair{color(s[2]), kChannels == 4 ? double(s[3]) : alphaMost}};
    } else {
      const double grey = color(s[0]);
      return {Pair{grey, grey}, Pair{grey, kChannels == 2 ? double(s[1]) : alphaMost}};
    }
  }
  /// Black, and transparent, where there is none.
  Sample at(int x, int y) const { return stored(wrapped(x, width, u), wrapped(y, height, v)); }
  Sample stored(int column, int row) const {
    if (column < 0 || row < 0) return {};
    return at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(column));
  }
};

Texel texelOf(const Sample& s, double colorMost, double alphaMost) {
  return {Color(s.redGreen[0], s.redGreen[1], s.blueAlpha[0]) / colorMost, s.blueAlpha[1] / alphaMost};
}

/// Calls use(Texels<...>) and makes a Texel of the Sample that it returns. `linear` is null where colours
/// stay as they are stored.
template <class Use>
Texel lookedUp(const MipMap::Level& level, const std::vector<double>* linear, const Lookup& lookup,
               const Use& use) {
  const auto read = [&]<class T, int kChannels, bool kDecodes>(const std::vector<T>& samples) {
    return use(Texels<T, kChannels, kDecodes>{samples.data(), level.width, level.height,
                                              kDecodes ? linear->data() : kPlainBytes.number, level.alphaMost,
                                              lookup.u, lookup.v});
  };
  const auto decoded = [&]<class T, int kChannels>(const std::vector<T>& samples) {
    if constexpr (std::is_invocable_v<Use, Texels<T, kChannels, true>>)
      if (linear) return read.template operator()<T, kChannels, true>(samples);
    return read.template operator()<T, kChannels, false>(samples);
  };
  const Sample s = match(level.samples, [&]<class T>(const std::vector<T>& samples) {
    switch (level.channels) {
      case 1: return decoded.template operator()<T, 1>(samples);
      case 2: return decoded.template operator()<T, 2>(samples);
      case 3: return decoded.template operator()<T, 3>(samples);
      default: return decoded.template operator()<T, 4>(samples);
    }
  });
  return texelOf(s, linear ? 1 : level.colorMost, level.alphaMost);
}

Texel mixed(Real share, const Texel& a, const Texel& b) {
  const auto between = [&](Real x, Real y) { return x + (y - x) * share; };
  return {{between(a.color.r, b.color.r), between(a.color.g, b.color.g), between(a.color.b, b.color.b)},
          between(a.alpha, b.alpha)};
}

/// A place in a level: 0 is the middle of its first texel.
struct Spot {
  Real x, y;
  Spot(const MipMap::Level& level, const MipMap::Level& base, const Vec2& place)
      : x(place.x * level.width / base.width - 0.5), y(place.y * level.height / base.height - 0.5) {}
};

/// Between the four texels around it.
template <class Texels>
Sample between(const Texels& texels, const Spot& spot) {
  const int i = floorOf(spot.x), j = floorOf(spot.y);
  const Real s = spot.x - i, t = spot.y - j;
  const int left = wrapped(i, texels.width, texels.u), right = wrapped(i + 1, texels.width, texels.u),
            top = wrapped(j, texels.height, texels.v), bottom = wrapped(j + 1, texels.height, texels.v);
  if ((left | right | top | bottom) < 0)
    return mixed(t, mixed(s, texels.stored(left, top), texels.stored(right, top)),
                 mixed(s, texels.stored(left, bottom), texels.stored(right, bottom)));
  const auto row = [&](int number) {
    const std::size_t start = static_cast<std::size_t>(number) * static_cast<std::size_t>(texels.width);
    return mixed(s, texels.at(start + static_cast<std::size_t>(left)),
                 texels.at(start + static_cast<std::size_t>(right)));
  };
  return mixed(t, row(top), row(bottom));
}

}  // namespace
}  // namespace trace
