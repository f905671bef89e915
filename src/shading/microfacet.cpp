#include "shading/microfacet.h"

#include <algorithm>

#include "shading/fresnel.h"

namespace trace {
namespace {

/// The number of which the error function is y (Giles, Approximating the erfinv Function, 2010, single
/// precision), made exact by a step of Newton's.
Real inverseErf(Real y) {
  y = std::clamp(y, -1 + 0x1p-50, 1 - 0x1p-50);
  Real w = -std::log((1 - y) * (1 + y)), p = 0;
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
  return x - (std::erf(x) - y) * std::sqrt(kPi) / 2 * std::exp(x * x);
}

/// Of the slopes of Beckmann's surface of width 1 that are seen at an angle to the normal, that along the
/// view; u from 0 to 1. The share below slope s is as (1 + erf(s)) cos + exp(-s^2) sin / sqrt(pi), up to
/// where the facets turn away (Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs, EGSR 2014).
Real visibleSlope(Real cosine, Real u) {
  const Real sine = std::sqrt(max(0, 1 - cosine * cosine));
  if (sine < 1e-7) return inverseErf(2 * u - 1);
  const Real last = cosine / sine;
  const auto below = [&](Real erf, Real s) {
    return (1 + erf) * cosine + std::exp(-s * s) * sine / std::sqrt(kPi);
  };
  const Real wanted = u * below(std::erf(last), last);
  Real low = -6, high = min(6, last);
  for (int i = 0; i < 50 && high - low > 1e-12; ++i) {
    const Real middle = (low + high) / 2;
    (below(std::erf(middle), middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Seen from a surface of width 1.
Vec2 chosenSlopes(const Vec3& eye, Vec2 u) {
  const Real along = visibleSlope(eye.z, u.x), across = inverseErf(2 * u.y - 1);
  const Real r = std::sqrt(eye.x * eye.x + eye.y * eye.y);
  const Real c = r > 0 ? eye.x / r : 1, s = r > 0 ? eye.y / r : 0;
  return {c * along - s * across, s * along + c * across};
}

}  // namespace

Vec3 Microfacets::chosen(const Vec3& eye, Vec2 u) const {
  const Vec3 v = normalize(Vec3{x * eye.x, y * eye.y, eye.z});
  if (kind == Distribution::beckmann) {
    const Vec2 slope = chosenSlopes(v, u);
    return normalize(Vec3{-slope.x * x, -slope.y * y, 1});
  }
  // Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018.
  const Real across = v.x * v.x + v.y * v.y;
  const Vec3 t1 = across > 0 ? Vec3{-v.y, v.x, 0} / std::sqrt(across) : Vec3{1, 0, 0}, t2 = cross(v, t1);
  const Real r = std::sqrt(u.x), phi = 2 * kPi * u.y, p1 = r * std::cos(phi), s = (1 + v.z) / 2;
  const Real p2 = (1 - s) * std::sqrt(max(0, 1 - p1 * p1)) + s * r * std::sin(phi);
  const Vec3 h = t1 * p1 + t2 * p2 + v * std::sqrt(max(0, 1 - p1 * p1 - p2 * p2));
  return normalize(Vec3{x * h.x, y * h.y, max(0, h.z)});
}

// --- tables of albedos
// ----------------------------------------------------------------------------------------

namespace {

constexpr int kSteps = 32;    // of the cosine and of the roughness
constexpr int kSamples = 24;  // along each side of the square of numbers for a choice

/// By the roots of cosine and width, where the albedo changes evenly.
struct AlbedoTable {
  MicrofacetAlbedo at[kSteps + 1][kSteps + 1];  ///< by width, cosine
  MicrofacetAlbedo mean[kSteps + 1];

  explicit AlbedoTable(Distribution kind) {
    for (int w = 0; w <= kSteps; ++w) {
      const Real roughness = 1.0 * w / kSteps;
      const Microfacets facets = Microfacets::of(kind, roughness * kMostRoughness);
      for (int c = 0; c <= kSteps; ++c) at[w][c] = albedo(facets, c);
      mean[w] = {0, 0};
      // Simpson's rule for 2 cos d cos with cos = t^2, d cos = 2 t dt.
      for (int c = 0; c <= kSteps; ++c) {
        const Real t = 1.0 * c / kSteps, weight = (c == 0 || c == kSteps ? 1
                                                   : c % 2               ? 4
                                                                         : 2) /
                                                  (3.0 * kSteps);
        mean[w].white += weight * 4 * t * t * t * at[w][c].white;
        mean[w].schlick += weight * 4 * t * t * t * at[w][c].schlick;
      }
    }
  }

  static constexpr Real kMostRoughness = 1.8;  // of a width of 3.2, that of strong grain

 private:
  static MicrofacetAlbedo albedo(const Microfacets& facets, int step) {
    const Real root = max(1e-3, 1.0 * step / kSteps), cosine = root * root;
    const Vec3 eye{std::sqrt(1 - cosine * cosine), 0, cosine};
    MicrofacetAlbedo sum{0, 0};
    for (int i = 0; i < kSamples; ++i)
      for (int j = 0; j < kSamples; ++j) {
        const Vec3 half = facets.chosen(eye, {(i + 0.5) / kSamples, (j + 0.5) / kSamples});
        const Vec3 light = mirroredAt(half, eye);
        if (!(light.z > 0)) continue;
        const Real share = facets.seenAndLit(eye, light) / facets.seen(eye) / (kSamples * kSamples);
        sum.white += share;
        sum.schlick += share * schlickWeight(dot(eye, half));
      }
    return {min(1, sum.white), min(1, sum.schlick)};
  }
};

const AlbedoTable& table(Distribution kind) {
  if (kind == Distribution::ggx) {
    static const AlbedoTable kGgx(Distribution::ggx);
    return kGgx;
  }
  static const AlbedoTable kBeckmann(Distribution::beckmann);
  return kBeckmann;
}

/// The two entries around a number from 0 to 1, and how far it is on the way between them.
struct Between {
  int low;
  Real share;
  explicit Between(Real x) {
    const Real place = max(0, min(1, x)) * kSteps;
    low = std::min(kSteps - 1, static_cast<int>(place));
    share = place - low;
  }
};

MicrofacetAlbedo lerp(Real t, const MicrofacetAlbedo& a, const MicrofacetAlbedo& b) {
  return {a.white + t * (b.white - a.white), a.schlick + t * (b.schlick - a.schlick)};
}

}  // namespace

MicrofacetAlbedo microfacetAlbedo(Distribution kind, Real cosine, Real width) {
  const AlbedoTable& t = table(kind);
  const Between w(std::sqrt(width) / AlbedoTable::kMostRoughness), c(std::sqrt(max(0, cosine)));
  const auto row = [&](int i) { return lerp(c.share, t.at[i][c.low], t.at[i][c.low + 1]); };
  return lerp(w.share, row(w.low), row(w.low + 1));
}

MicrofacetAlbedo meanMicrofacetAlbedo(Distribution kind, Real width) {
  const AlbedoTable& t = table(kind);
  const Between w(std::sqrt(width) / AlbedoTable::kMostRoughness);
  return lerp(w.share, t.mean[w.low], t.mean[w.low + 1]);
}

MicrofacetLobe::MicrofacetLobe(const Microfacets& which, const Color& alongNormal) : facets(which) {
  meanWhite = mean().white;
  const Color mean = alongNormal + (Color(1) + alongNormal * -1) / 21;  // of Schlick's formula
  const auto channel = [&](Real f) { return f * f * meanWhite / (1 - f * (1 - meanWhite)); };
  multiple = {channel(mean.r), channel(mean.g), channel(mean.b)};
}

MicrofacetAlbedo MicrofacetLobe::mean() const {
  if (facets.x == facets.y) return meanMicrofacetAlbedo(facets.kind, facets.x);
  constexpr int kAround = 8;
  MicrofacetAlbedo sum{0, 0};
  for (int i = 0; i < kAround; ++i) {
    const Real phi = (i + 0.5) * kPi / 2 / kAround;
    const MicrofacetAlbedo there =
        meanMicrofacetAlbedo(facets.kind, widthTo({std::cos(phi), std::sin(phi), 0}));
    sum.white += there.white / kAround;
    sum.schlick += there.schlick / kAround;
  }
  return sum;
}

}  // namespace trace
