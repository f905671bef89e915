#include "shading/optics/glass_albedo.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "math/between.h"
#include "shading/optics/fresnel.h"

namespace trace {
namespace {

constexpr int kCosines = 32, kWidths = 40, kIndices = 48;
constexpr int kSamples = 48;  // samples of the first number for a facet; half as many of the second
constexpr Real kMostIndex = 4;

/// A stretch between two entries by the root t of the cosine, over which a value is taken to change evenly.
struct Stretch {
  Real low, width = 1.0 / kCosines;

  explicit Stretch(int entry) : low(static_cast<Real>(entry) / kCosines) {}
  /// Its addition, up to t, to the mean over all directions weighed by the cosine, 2 cos d cos = 4 t^3 dt.
  Real mean(Real atLow, Real atHigh, Real t) const {
    const Real slope = (atHigh - atLow) / width, a4 = low * low * low * low, t4 = t * t * t * t;
    return (atLow - slope * low) * (t4 - a4) + slope * 0.8 * (t4 * t - a4 * low);
  }
};

/// The albedo for one index and width, by the root of the cosine, over which it changes evenly.
struct WidthRow {
  std::once_flag made;
  Real at[kCosines + 1];
  Real mean = 0;

  void make(const Microfacets& facets, Real eta) {
    for (int c = 0; c <= kCosines; ++c) at[c] = albedo(facets, max(1e-3, 1.0 * c / kCosines), eta);
    for (int c = 0; c < kCosines; ++c)
      mean += Stretch(c).mean(at[c], at[c + 1], static_cast<Real>(c + 1) / kCosines);
  }

 private:
  static Real albedo(const Microfacets& facets, Real root, Real eta) {
    const Real cosine = root * root;
    const Vec3 eye{std::sqrt(1 - cosine * cosine), 0, cosine};
    // Facets are symmetric to the plane of the eye and the normal: half of them do. The numbers that choose
    // them lie the closer the nearer they are to 0 and 1, where facets lean most.
    const bool around = facets.kind == Distribution::ggx;  // the second number is an angle
    Real sum = 0;
    for (int i = 0; i < kSamples; ++i)
      for (int j = 0; j < kSamples / 2; ++j) {
        const EndCell first(i, kSamples), other(j, kSamples / 2);
        const Real second = (around ? other.middle - 0.5 : other.middle) / 2;
        const Vec3 half = facets.chosen(eye, {first.middle, second});
        const Real counts = first.width * other.width;
        const Real mirrors = fresnelDielectric(dot(eye, half), 1, eta);
        const Vec3 up = mirroredAt(half, eye);
        if (up.z > 0) sum += counts * mirrors * facets.seenAndLit(eye, up);
        if (!(mirrors < 1)) continue;
        const Vec3 down = refractedAt(half, eye, eta);
        if (down.z < 0) sum += counts * (1 - mirrors) * facets.seenAndLit(eye, {down.x, down.y, -down.z});
      }
    return min(1, sum / facets.seen(eye));
  }
};

/// Rows by the root of the width and by (eta - 1) / (eta + 1), each made when it is first asked for: most
/// pictures show one kind of glass.
class GlassTable {
 public:
  explicit GlassTable(Distribution kind) : kind_(kind) {}

  /// The value of ask(row) at the place, interpolated from the rows around it.
  template <class Ask>
  Real at(Real width, Real eta, const Ask& ask) {
    const Between index(((eta - 1) / (eta + 1) / kMost + 1) / 2, kIndices), w(std::sqrt(width), kWidths);
    return index.of([&](int i) { return w.of([&](int j) { return ask(row(i, j)); }); });
  }

 private:
  const WidthRow& row(int index, int width) {
    WidthRow& row = rows_[static_cast<std::size_t>(index * (kWidths + 1) + width)];
    std::call_once(row.made, [&] {
      const Real x = (2.0 * index / kIndices - 1) * kMost;
      row.make(Microfacets::of(kind_, 1.0 * width / kWidths), (1 + x) / (1 - x));
    });
    return row;
  }

  static constexpr Real kMost = (kMostIndex - 1) / (kMostIndex + 1);
  Distribution kind_;
  std::vector<WidthRow> rows_ = std::vector<WidthRow>((kIndices + 1) * (kWidths + 1));
};

GlassTable& glassTable(Distribution kind) {
  static GlassTable ggx(Distribution::ggx), beckmann(Distribution::beckmann);
  return kind == Distribution::ggx ? ggx : beckmann;
}

}  // namespace

Real glassAlbedo(Distribution kind, Real cosine, Real width, Real eta) {
  const Between c(std::sqrt(max(0, cosine)), kCosines);
  return glassTable(kind).at(width, eta,
                             [&](const WidthRow& row) { return c.of([&](int i) { return row.at[i]; }); });
}

Real meanGlassAlbedo(Distribution kind, Real width, Real eta) {
  return glassTable(kind).at(width, eta, [](const WidthRow& row) { return row.mean; });
}

Vec3 GlassLoss::direction(bool inside, Vec2 u) const {
  const Real eta = inside ? 1 / index_ : index_;
  const auto lossAt = [&](int i) {
    return 1 - glassTable(kind_).at(width_, eta, [&](const WidthRow& row) { return row.at[i]; });
  };
  // The stretch of the table in which the share u of the mean loss is reached, and there the place.
  Real left = u.x * mean_[inside], before = lossAt(0), t = 1;
  for (int i = 0; i < kCosines; ++i) {
    const Real next = lossAt(i + 1);
    const Stretch stretch(i);
    const Real all = stretch.mean(before, next, stretch.low + stretch.width);
    if (left < all || i == kCosines - 1) {
      Real low = stretch.low, high = low + stretch.width;
      for (int step = 0; step < 40; ++step) {
        t = (low + high) / 2;
        (stretch.mean(before, next, t) < left ? low : high) = t;
      }
      break;
    }
    left -= all;
    before = next;
  }
  return sphericalDirection(t * t, 2 * kPi * u.y);
}

GlassLoss::GlassLoss(Distribution kind, Real width, Real index)
    : kind_(kind),
      width_(width),
      index_(index),
      mean_{1 - meanGlassAlbedo(kind, width, index), 1 - meanGlassAlbedo(kind, width, 1 / index)} {
  if (none()) return;
  // From the thinner side as much passes as a smooth surface lets through on the average (Kulla and Conty's
  // fit), and from the other as much as reciprocity asks.
  const bool airIsThin = index > 1;
  const Real n = airIsThin ? index : 1 / index, thin = mean_[airIsThin ? 0 : 1],
             dense = mean_[airIsThin ? 1 : 0];
  const Real down = 1 - (n - 1) / (4.08567 + 1.00071 * n), up = down * thin / (n * n * dense);
  const Real most = std::max(1.0, up);
  passes_[airIsThin ? 0 : 1] = down / most;
  passes_[airIsThin ? 1 : 0] = up / most;
}

}  // namespace trace
