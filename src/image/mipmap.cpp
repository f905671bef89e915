#include "image/mipmap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace trace {
namespace {

/// The texel that stands at place i of a row of `size`; none where it is black.
std::optional<int> wrapped(Real i, int size, Wrap wrap) {
  const Real n = size;
  switch (wrap) {
    case Wrap::repeat: i -= std::floor(i / n) * n; break;
    case Wrap::mirror:
      i -= std::floor(i / (2 * n)) * 2 * n;
      if (i >= n) i = 2 * n - 1 - i;
      break;
    case Wrap::black:
      if (i < 0 || i >= n) return std::nullopt;
      break;
    case Wrap::clamp: break;
  }
  return static_cast<int>(std::clamp(i, 0.0, n - 1));
}

}  // namespace

MipMap::MipMap(Picture picture) : picture_(std::move(picture)) {}

std::shared_ptr<const MipMap> MipMap::decode(std::string_view bytes, const std::string& name,
                                             const PictureLimits& limits) {
  return std::make_shared<const MipMap>(decodePicture(bytes, name, limits));
}

Texel MipMap::at(const Vec2& uv, const Lookup& lookup) const {
  const int w = width(), h = height();
  const auto place = [&](Real s, int size) {
    return lookup.centersAtEnds ? s * (size - 1) : s * size - 0.5;
  };
  const Real x = place(uv.x, w), y = place(1 - uv.y, h);
  const auto stored = [&](Real i, Real j) {
    const auto column = wrapped(i, w, lookup.u), row = wrapped(j, h, lookup.v);
    return column && row ? texel(*column, *row) : Texel{Color(0), 0};
  };
  if (lookup.filter == TexelFilter::nearest) return stored(std::floor(x + 0.5), std::floor(y + 0.5));
  const Real i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
  const auto mixed = [](Real share, const Texel& a, const Texel& b) {
    return Texel{lerp(share, a.color, b.color), a.alpha + (b.alpha - a.alpha) * share};
  };
  return mixed(t, mixed(s, stored(i, j), stored(i + 1, j)), mixed(s, stored(i, j + 1), stored(i + 1, j + 1)));
}

}  // namespace trace
