#include "shading/optics/microfacet.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "math/between.h"
#include "math/elementary.h"
#include "shading/optics/fresnel.h"

namespace trace {
namespace {

/// The number of which the error function is y (Giles, Approximating the erfinv Function, 2010, single
/// precision), made exact by a step of Newton's.
Real inverseErf(Real y) {
  y = std::clamp(y, -1 + 0x1p-50, 1 - 0x1p-50);
  Real w = -math::log((1 - y) * (1 + y)), p = 0;
  const auto horner = [&](const std::array<Real, 9>& c) {
    p = c[0];
    for (std::size_t i = 1; i < c.size(); ++i) p = p * w + c[i];
  };
  if (w < 5) {
    w -= 2.5;
    horner({2.81022636e-08, 3.43273939e-07, -3.5233877e-06, -4.39150654e-06, 0.00021858087, -0.00125372503,
            -0.00417768164, 0.246640727, 1.50140941});
  } else {
    w = std::sqrt(w) - 3;
    horner({-0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844, 0.00573950773, -0.0076224613,
            0.00943887047, 1.00167406, 2.83297682});
  }
  const Real x = p * y;
  return x - (math::erf(x) - y) * std::sqrt(kPi) / 2 * math::exp(x * x);
}

/// Chooses by u from 0 to 1 a slope along the view among those of Beckmann's surface of width 1 that are seen
/// at an angle to the normal. The share below slope s is as (1 + erf(s)) cos + exp(-s^2) sin / sqrt(pi), up
/// to where the facets turn away (Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs, EGSR 2014).
Real visibleSlope(Real cosine, Real u) {
  const Real sine = std::sqrt(max(0, 1 - cosine * cosine));
  if (sine < 1e-7) return inverseErf(2 * u - 1);
  const Real last = cosine / sine;
  const auto below = [&](Real erf, Real s) {
    return (1 + erf) * cosine + math::exp(-s * s) * sine / std::sqrt(kPi);
  };
  const Real wanted = u * below(math::erf(last), last);
  Real low = -6, high = min(6, last);
  for (int i = 0; i < 50 && high - low > 1e-12; ++i) {
    const Real middle = (low + high) / 2;
    (below(math::erf(middle), middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// From where a surface of width 1 is seen as one of these facets is from `eye`.
Vec3 stretched(const Microfacets& facets, const Vec3& eye) {
  return normalize(Vec3{facets.x * eye.x, facets.y * eye.y, eye.z});
}

/// The normal of slopes along the view and across it, of a surface of width 1 that is seen from v.
Vec3 normalOf(const Microfacets& facets, const Vec3& v, Real along, Real across) {
  const Real r = std::sqrt(v.x * v.x + v.y * v.y);
  const Real c = r > 0 ? v.x / r : 1, s = r > 0 ? v.y / r : 0;
  const Vec2 slope{c * along - s * across, s * along + c * across};
  return normalize(Vec3{-slope.x * facets.x, -slope.y * facets.y, 1});
}

}  // namespace

Vec3 Microfacets::chosen(const Vec3& eye, Vec2 u) const {
  const Vec3 v = stretched(*this, eye);
  if (kind == Distribution::beckmann)
    return normalOf(*this, v, visibleSlope(v.z, u.x), inverseErf(2 * u.y - 1));
  // Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018.
  const Real across = v.x * v.x + v.y * v.y;
  const Vec3 t1 = across > 0 ? Vec3{-v.y, v.x, 0} / std::sqrt(across) : Vec3{1, 0, 0}, t2 = cross(v, t1);
  const math::SinCos phi = math::sincos(2 * kPi * u.y);
  const Real r = std::sqrt(u.x), p1 = r * phi.cos, s = (1 + v.z) / 2;
  const Real p2 = (1 - s) * std::sqrt(max(0, 1 - p1 * p1)) + s * r * phi.sin;
  const Vec3 h = t1 * p1 + t2 * p2 + v * std::sqrt(max(0, 1 - p1 * p1 - p2 * p2));
  return normalize(Vec3{x * h.x, y * h.y, max(0, h.z)});
}

// --- tables of albedos ---

namespace {

MicrofacetAlbedo lerp(Real t, const MicrofacetAlbedo& a, const MicrofacetAlbedo& b) {
  return {a.white + t * (b.white - a.white), a.schlick + t * (b.schlick - a.schlick)};
}

/// Calls visit(share, cosine) for mirrors at the middles of samples x samples cells of the numbers that
/// choose them: the share of light that each gives back, and the cosine of light to it. Facets that lean
/// most, which mirror nothing upward, have numbers near 0 and 1: there cells are narrow.
template <class Visit>
void forEachMirror(const Microfacets& facets, const Vec3& eye, int samples, const Visit& visit) {
  const bool slopes = facets.kind == Distribution::beckmann;
  const Vec3 v = stretched(facets, eye);
  const auto even = [&](int j) { return EndCell{(j + 0.5) / samples, 1.0 / samples}; };  // sampling an angle
  const auto second = [&](int j) { return slopes ? EndCell(j, samples) : even(j); };
  std::vector<Real> across;
  for (int j = 0; slopes && j < samples; ++j) across.push_back(inverseErf(2 * second(j).middle - 1));
  const Real seen = facets.seen(eye);
  for (int i = 0; i < samples; ++i) {
    const EndCell first(i, samples);
    const Real along = slopes ? visibleSlope(v.z, first.middle) : 0;  // which takes long
    for (int j = 0; j < samples; ++j) {
      const EndCell other = second(j);
      const Vec3 half = slopes ? normalOf(facets, v, along, across[static_cast<std::size_t>(j)])
                               : facets.chosen(eye, {first.middle, other.middle});
      const Vec3 light = mirroredAt(half, eye);
      if (!(light.z > 0)) continue;
      visit(facets.seenAndLit(eye, light) / seen * (first.width * other.width), dot(eye, half));
    }
  }
}

MicrofacetAlbedo integrated(const Microfacets& facets, const Vec3& eye, int samples) {
  MicrofacetAlbedo sum{0, 0};
  forEachMirror(facets, eye, samples, [&](Real share, Real cosine) {
    sum.white += share;
    sum.schlick += share * schlickWeight(cosine);
  });
  return {min(1, sum.white), min(1, sum.schlick)};
}

/// How much the cosine t^2, t = step / steps, counts in a mean over all directions, weighed by the cosine:
/// Simpson's rule for 2 cos d cos, with d cos = 2 t dt.
Real meanWeight(int step, int steps) {
  const Real t = 1.0 * step / steps;
  const Real weight = (step == 0 || step == steps ? 1 : step % 2 ? 4 : 2) / (3.0 * steps);
  return weight * 4 * t * t * t;
}

/// The mean over the cosines t^2 of evenly spaced t from 0 to 1.
template <class At>
MicrofacetAlbedo meanOf(int steps, const At& at) {
  MicrofacetAlbedo mean{0, 0};
  for (int c = 0; c <= steps; ++c) {
    const MicrofacetAlbedo there = at(c);
    mean.white += meanWeight(c, steps) * there.white;
    mean.schlick += meanWeight(c, steps) * there.schlick;
  }
  return mean;
}

/// From that cosine, at an angle around the normal whose cosine is `along`.
Vec3 seenFrom(int step, int steps, Real along = 1) {
  const Real root = max(1e-3, 1.0 * step / steps), cosine = root * root,
             sine = std::sqrt(1 - cosine * cosine);
  return {sine * along, sine * std::sqrt(1 - along * along), cosine};
}

constexpr Real kMostRoughness = 1.8;  // width 3.2, that of strong grain

/// A table by width whose rows are computed when they are first needed: few materials need all of it. Any
/// thread may ask.
template <class Row>
class Table {
 public:
  explicit Table(Distribution kind) : kind_(kind) {}
  const Row& operator[](int width) const {
    const auto i = static_cast<std::size_t>(width);
    if (!made_[i].load(std::memory_order_acquire)) make(i);
    return rows_[i];
  }

 private:
  void make(std::size_t i) const {
    const std::lock_guard lock(mutex_);
    if (made_[i].load(std::memory_order_relaxed)) return;
    rows_[i].fill(kind_, static_cast<int>(i));
    made_[i].store(true, std::memory_order_release);
  }

  Distribution kind_;
  mutable std::mutex mutex_;
  mutable std::array<std::atomic<bool>, Row::kWidths + 1> made_{};
  mutable std::array<Row, Row::kWidths + 1> rows_;
};

/// Without grain: by the roots of cosine and width, where the albedo changes evenly.
struct EvenRow {
  static constexpr int kWidths = 64, kCosines = 32, kSamples = 20;
  MicrofacetAlbedo at[kCosines + 1];
  MicrofacetAlbedo mean;

  void fill(Distribution kind, int w) {
    const Microfacets facets = Microfacets::of(kind, 1.0 * w / kWidths * kMostRoughness);
    for (int c = 0; c <= kCosines; ++c) at[c] = integrated(facets, seenFrom(c, kCosines), kSamples);
    mean = meanOf(kCosines, [&](int c) { return at[c]; });
  }
};

/// With grain: by the root of the mean width, the logarithm of how much longer it is along than across, and
/// whence it is seen.
struct GrainRow {
  static constexpr int kWidths = 20, kGrains = 6, kCosines = 16, kAround = 6, kSamples = 16;
  static constexpr Real kMostGrain = 10;  // Microfacets::of() gives no more
  MicrofacetAlbedo at[kGrains + 1][kAround + 1][kCosines + 1];
  MicrofacetAlbedo mean[kGrains + 1];

  void fill(Distribution kind, int w) {
    for (int g = 0; g <= kGrains; ++g) {
      const Real root = max(0.01, 1.0 * w / kWidths * kMostRoughness);
      const Real aspect = math::pow(kMostGrain, 0.5 * g / kGrains);
      const Microfacets facets{kind, root * root * aspect, root * root / aspect};
      mean[g] = {0, 0};
      for (int a = 0; a <= kAround; ++a) {
        auto& row = at[g][a];
        const Real along = 1.0 * a / kAround;
        for (int c = 0; c <= kCosines; ++c)
          row[c] = integrated(facets, seenFrom(c, kCosines, along), kSamples);
        const MicrofacetAlbedo there = meanOf(kCosines, [&](int c) { return row[c]; });
        mean[g].white += there.white * shareAround(a);
        mean[g].schlick += there.schlick * shareAround(a);
      }
    }
  }

  /// How much of a mean over all angles the entry counts, if values between entries are on the line between
  /// them.
  static Real shareAround(int entry) {
    const auto angle = [](int i) { return math::acos(1.0 * i / kAround) * 2 / kPi; };
    const auto sine = [](int i) { return std::sqrt(1 - Real(i * i) / (kAround * kAround)) * 2 / kPi; };
    // The integrals of 1 and of the cosine over the angles between two entries.
    const auto all = [&](int i) { return angle(i) - angle(i + 1); };
    const auto cosines = [&](int i) { return sine(i) - sine(i + 1); };
    Real share = 0;
    if (entry > 0) share += cosines(entry - 1) * kAround - (entry - 1) * all(entry - 1);
    if (entry < kAround) share += (entry + 1) * all(entry) - cosines(entry) * kAround;
    return share;
  }

  static Between width(const Microfacets& f) {
    return {std::sqrt(std::sqrt(f.x * f.y)) / kMostRoughness, kWidths};
  }
  static Between grain(const Microfacets& f) {
    return {std::abs(math::log(f.x / f.y)) / math::log(kMostGrain), kGrains};
  }
};

template <class Row>
const Table<Row>& table(Distribution kind) {
  if (kind == Distribution::ggx) {
    static const Table<Row> kGgx(Distribution::ggx);
    return kGgx;
  }
  static const Table<Row> kBeckmann(Distribution::beckmann);
  return kBeckmann;
}

}  // namespace

MicrofacetAlbedo microfacetAlbedo(const Microfacets& facets, const Vec3& eye) {
  const Real root = std::sqrt(max(0, eye.z));
  if (facets.x == facets.y) {
    const auto& t = table<EvenRow>(facets.kind);
    const Between w(std::sqrt(facets.x) / kMostRoughness, EvenRow::kWidths), c(root, EvenRow::kCosines);
    const auto row = [&](int i) { return lerp(c.share, t[i].at[c.low], t[i].at[c.low + 1]); };
    return lerp(w.share, row(w.low), row(w.low + 1));
  }
  const auto& t = table<GrainRow>(facets.kind);
  const Real across2 = eye.x * eye.x + eye.y * eye.y;
  const Real along = across2 > 0 ? std::abs(facets.x > facets.y ? eye.x : eye.y) / std::sqrt(across2) : 1;
  const Between w = GrainRow::width(facets), g = GrainRow::grain(facets), a(along, GrainRow::kAround),
                c(root, GrainRow::kCosines);
  const auto by = [](const Between& b, const auto& entry) {
    return lerp(b.share, entry(b.low), entry(b.low + 1));
  };
  return by(w, [&](int i) {
    return by(g, [&](int j) {
      return by(a, [&](int k) { return by(c, [&](int l) { return t[i].at[j][k][l]; }); });
    });
  });
}

MicrofacetAlbedo meanMicrofacetAlbedo(const Microfacets& facets) {
  if (facets.x == facets.y) {
    const auto& t = table<EvenRow>(facets.kind);
    const Between w(std::sqrt(facets.x) / kMostRoughness, EvenRow::kWidths);
    return lerp(w.share, t[w.low].mean, t[w.low + 1].mean);
  }
  const auto& t = table<GrainRow>(facets.kind);
  const Between w = GrainRow::width(facets), g = GrainRow::grain(facets);
  const auto row = [&](int i) { return lerp(g.share, t[i].mean[g.low], t[i].mean[g.low + 1]); };
  return lerp(w.share, row(w.low), row(w.low + 1));
}

// --- albedos of any reflectance ---

namespace {

/// Lagrange's polynomials of the nodes: 1 at their own, 0 at the others.
class NodeWeights {
 public:
  NodeWeights() {
    for (std::size_t j = 0; j < kFresnelNodes; ++j) {
      node_[j] = fresnelNode(j);
      for (std::size_t k = 0; k < kFresnelNodes; ++k) apart_[j][k] = k == j ? 1 : fresnelNode(k) - node_[j];
    }
  }
  FacetShares at(Real x) const {
    FacetShares weights;
    weights.fill(1);
    for (std::size_t j = 0; j < kFresnelNodes; ++j) {
      const Real own = weights[j];
      for (std::size_t k = 0; k < kFresnelNodes; ++k) weights[k] *= (x - node_[j]) / apart_[j][k];
      weights[j] = own;
    }
    return weights;
  }

 private:
  FacetShares node_, apart_[kFresnelNodes];  ///< apart_[j][k]: from node j to node k
};
void add(FacetShares& sum, const FacetShares& shares, Real weight) {
  for (std::size_t k = 0; k < kFresnelNodes; ++k) sum[k] += shares[k] * weight;
}
FacetShares lerp(Real t, const FacetShares& a, const FacetShares& b) {
  FacetShares mixed{};
  add(mixed, a, 1 - t);
  add(mixed, b, t);
  return mixed;
}

/// As EvenRow.
struct ShareRow {
  static constexpr int kWidths = EvenRow::kWidths, kCosines = EvenRow::kCosines;
  FacetShares at[kCosines + 1];
  FacetShares mean;

  void fill(Distribution kind, int w) {
    static const NodeWeights kWeights;
    const Microfacets facets = Microfacets::of(kind, 1.0 * w / kWidths * kMostRoughness);
    mean = {};
    for (int c = 0; c <= kCosines; ++c) {
      at[c] = {};
      forEachMirror(facets, seenFrom(c, kCosines), EvenRow::kSamples,
                    [&](Real share, Real cosine) { add(at[c], kWeights.at(cosine), share); });
      add(mean, at[c], meanWeight(c, kCosines));
    }
  }
  static Between width(Real width) { return {std::sqrt(width) / kMostRoughness, kWidths}; }
};

Real sumOf(const FacetShares& shares) {
  Real sum = 0;
  for (const Real share : shares) sum += share;
  return sum;
}
/// With that sum.
FacetShares scaledTo(Real sum, const FacetShares& shares) {
  FacetShares scaled{};
  add(scaled, shares, sum / sumOf(shares));
  return scaled;
}

}  // namespace

Real fresnelNode(std::size_t k) {
  static const FacetShares kNodes = [] {
    FacetShares nodes;
    for (std::size_t i = 0; i < kFresnelNodes; ++i)
      nodes[i] = (1 - math::cos((2 * static_cast<Real>(i) + 1) * kPi / (2 * kFresnelNodes))) / 2;
    return nodes;
  }();
  return kNodes[k];
}

FacetShares facetShares(const Microfacets& facets, const Vec3& eye) {
  // Grain: as even facets that are as wide as these seen along the view.
  const Real across2 = eye.x * eye.x + eye.y * eye.y;
  const Real cos2 = across2 > 0 ? eye.x * eye.x / across2 : 0.5;
  const bool even = facets.x == facets.y;
  const Real width =
      even ? facets.x : std::sqrt(facets.x * facets.x * cos2 + facets.y * facets.y * (1 - cos2));
  const auto& t = table<ShareRow>(facets.kind);
  const Between w = ShareRow::width(width), c(std::sqrt(max(0, eye.z)), ShareRow::kCosines);
  const auto row = [&](int i) { return lerp(c.share, t[i].at[c.low], t[i].at[c.low + 1]); };
  const FacetShares shares = lerp(w.share, row(w.low), row(w.low + 1));
  return even ? shares : scaledTo(microfacetAlbedo(facets, eye).white, shares);
}

FacetShares meanFacetShares(const Microfacets& facets) {
  const auto& t = table<ShareRow>(facets.kind);
  const Between w = ShareRow::width(std::sqrt(facets.x * facets.y));
  const FacetShares shares = lerp(w.share, t[w.low].mean, t[w.low + 1].mean);
  return facets.x == facets.y ? shares : scaledTo(meanMicrofacetAlbedo(facets).white, shares);
}

const FacetShares& meanFresnelShares() {
  static const FacetShares kMean = [] {
    FacetShares mean{};
    constexpr int kSteps = 1024;
    const NodeWeights weights;
    for (int c = 0; c <= kSteps; ++c)
      add(mean, weights.at(1.0 * c / kSteps * c / kSteps), meanWeight(c, kSteps));
    return mean;
  }();
  return kMean;
}

MicrofacetLobe::MicrofacetLobe(const Microfacets& which, const Color& alongNormal) : facets(which) {
  meanWhite = meanMicrofacetAlbedo(facets).white;
  multiple = multipleOf(meanSchlick(alongNormal));
}

Color MicrofacetLobe::multipleOf(const Color& mean) const {
  const auto channel = [&](Real f) { return f * f * meanWhite / (1 - f * (1 - meanWhite)); };
  return {channel(mean.r), channel(mean.g), channel(mean.b)};
}

}  // namespace trace
