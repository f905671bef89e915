#include "shading/materials/marschner.h"

#include <algorithm>

#include "math/elementary.h"

namespace trace {
namespace {

constexpr Real kLeastRoughness = 0.02;  // narrower lobes would overflow

/// x to a whole power.
Real power(Real x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }

/// The logarithm of the modified Bessel function of the first kind and order 0.
Real logBessel(Real x) {
  if (x > 20)
    return x - math::log(2 * kPi * x) / 2 +
           math::log(1 + 1 / (8 * x) + 9 / (128 * x * x) + 225 / (3072 * x * x * x));
  Real sum = 1, term = 1;
  for (int i = 1; i < 40; ++i) {
    term *= x * x / (4.0 * i * i);
    sum += term;
  }
  return math::log(sum);
}

/// Along the strand: the density, per sine and cosine of the light's angle, around the mirrored eye (d'Eon
/// and others 2011, equation 7).
Real along(Real sinLight, Real cosLight, Real sinEye, Real cosEye, Real v) {
  const Real logSinh = 1 / v + math::log1p(-math::exp(-2 / v)) - math::log(2);
  return math::exp(logBessel(cosLight * cosEye / v) - sinLight * sinEye / v - logSinh - math::log(2 * v));
}

/// The logistic curve of that scale, cut to -pi .. pi.
struct Logistic {
  Real scale, least, whole;
  explicit Logistic(Real s) : scale(s), least(below(-kPi)), whole(below(kPi) - least) {}
  Real below(Real x) const { return 1 / (1 + math::exp(-x / scale)); }
  Real density(Real x) const {
    const Real e = math::exp(-std::abs(x) / scale);
    return e / (scale * (1 + e) * (1 + e)) / whole;
  }
  Real chosen(Real u) const { return std::clamp(-scale * math::log(1 / (u * whole + least) - 1), -kPi, kPi); }
};

/// An angle as one from -pi to pi.
Real wrapped(Real angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

namespace {

/// Chiang and others 2016, equation 9: the root of the absorption is the logarithm of a head's colour,
/// divided by this.
Real logarithmOfColor(const Marschner& model) {
  const Real n = max(kLeastRoughness, model.roughnessAround);
  return 5.969 - 0.215 * n + 2.532 * n * n - 10.73 * power(n, 3) + 5.574 * power(n, 4) + 0.245 * power(n, 5);
}

bool hasPigments(const Marschner& model) { return model.eumelanin > 0 || model.pheomelanin > 0; }

}  // namespace

Color Marschner::absorption() const {
  // d'Eon and others 2011, table 1: the absorption of each pigment.
  const Color brown{0.419, 0.697, 1.37}, red{0.187, 0.4, 1.05};
  if (hasPigments(*this)) return brown * max(0, eumelanin) + red * max(0, pheomelanin);
  const Real by = logarithmOfColor(*this);
  const auto channel = [&](Real c) {
    const Real root = math::log(max(1e-6, min(1, c))) / by;
    return root * root;
  };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

Color Marschner::headColor() const {
  if (!hasPigments(*this)) return color;
  const Color absorbed = absorption();
  const Real by = logarithmOfColor(*this);
  const auto channel = [&](Real a) { return math::exp(-std::sqrt(a) * std::abs(by)); };
  return {channel(absorbed.r), channel(absorbed.g), channel(absorbed.b)};
}

MarschnerBsdf::MarschnerBsdf(const Marschner& model) : LocalBsdf(model) {
  litThrough = true;
  const Real m = max(kLeastRoughness, model.roughness), n = max(kLeastRoughness, model.roughnessAround);
  // Chiang and others 2016, equations 7 and 8.
  const Real width = 0.726 * m + 0.812 * m * m + 3.7 * power(m, 20);
  variance = {width * width, width * width / 4, 4 * width * width, 4 * width * width};
  scale = std::sqrt(kPi / 8) * (0.265 * n + 1.194 * n * n + 5.372 * power(n, 22));
  absorption = model.absorption();
}

struct MarschnerBsdf::Seen {
  std::array<Color, kLobes> share;    ///< share of light that each lobe gets
  std::array<Real, kLobes> often;     ///< how often it is chosen
  std::array<Real, kLobes> sin, cos;  ///< the eye's angle across the strand, by the scales
  std::array<Real, kLobes> turn;      ///< in which direction around the strand it lies
  Real around;                        ///< where the eye is

  Seen(const MarschnerBsdf& bsdf, const Vec3& eye) {
    const Real sine = max(-1, min(1, eye.x)), cosine = std::sqrt(max(0, 1 - sine * sine));
    const Real across = std::sqrt(eye.y * eye.y + eye.z * eye.z), eta = max(1, bsdf.said.index);
    const Real offset = across > 0 ? max(-1, min(1, -eye.y / across)) : 0;  // from the strand's middle
    around = math::atan2(eye.z, eye.y);
    const Real bent =
        std::sqrt(max(0, eta * eta - sine * sine));  // the index across the strand, times cosine
    const Real cosInside = bent / eta;
    const Real sinOff = bent > 0 ? max(-1, min(1, offset * cosine / bent)) : 0;
    const Real off = math::asin(offset), offInside = math::asin(sinOff);

    const Real mirrored = fresnelDielectric(cosine * math::cos(off), 1, eta), in = 1 - mirrored;
    const auto passes = [&](Real absorbed) {
      return cosInside > 0 ? math::exp(-absorbed * 2 * math::cos(offInside) / cosInside) : 0;
    };
    const Color t{passes(bsdf.absorption.r), passes(bsdf.absorption.g), passes(bsdf.absorption.b)};
    share[0] = Color(mirrored);
    share[1] = t * (in * in);
    share[2] = share[1] * t * mirrored;
    const auto rest = [&](Real last, Real pass) {
      const Real again = pass * mirrored;
      return again < 1 ? last * again / (1 - again) : 0;
    };
    share[3] = {rest(share[2].r, t.r), rest(share[2].g, t.g), rest(share[2].b, t.b)};
    Real sum = 0;
    for (std::size_t p = 0; p < kLobes; ++p) sum += share[p].r + share[p].g + share[p].b;
    for (std::size_t p = 0; p < kLobes; ++p)
      often[p] = sum > 0 ? (share[p].r + share[p].g + share[p].b) / sum : 1.0 / kLobes;

    const Real tilts[] = {2, -1, -4, 0};  // how often the tilt of the scales counts
    for (std::size_t p = 0; p < kLobes; ++p) {
      const Real lean = tilts[p] * bsdf.said.tilt * kPi / 180;
      const math::SinCos by = math::sincos(lean);
      sin[p] = sine * by.cos - cosine * by.sin;
      cos[p] = std::abs(cosine * by.cos + sine * by.sin);
      turn[p] = 2 * static_cast<Real>(p) * offInside - 2 * off + static_cast<Real>(p) * kPi;
    }
  }
};

Real MarschnerBsdf::lobe(std::size_t p, const Seen& seen, const Vec3& light) const {
  const Real sine = max(-1, min(1, light.x)), cosine = std::sqrt(max(0, 1 - sine * sine));
  const Real turned = math::atan2(light.z, light.y) - seen.around - seen.turn[p];
  const Real around = p + 1 == kLobes ? 1 / (2 * kPi) : Logistic(scale).density(wrapped(turned));
  return along(sine, cosine, seen.sin[p], seen.cos[p], variance[p]) * around;
}

Scatter MarschnerBsdf::value(const Vec3& eye, const Vec3& light, Transport) const {
  const Seen seen(*this, eye);
  Scatter sum;
  for (std::size_t p = 0; p < kLobes; ++p)
    (p == 0 ? sum.specular : sum.diffuse) += seen.share[p] * lobe(p, seen, light);
  return sum;
}

Real MarschnerBsdf::directionDensity(const Vec3& eye, const Vec3& light) const {
  const Seen seen(*this, eye);
  Real sum = 0;
  for (std::size_t p = 0; p < kLobes; ++p) sum += seen.often[p] * lobe(p, seen, light);
  return sum;
}

Vec3 MarschnerBsdf::direction(const Vec3& eye, Real choose, Vec2 u) const {
  const Seen seen(*this, eye);
  std::size_t p = 0;
  while (p + 1 < kLobes && choose >= seen.often[p]) choose -= seen.often[p++];
  const Real rest = seen.often[p] > 0 ? min(choose / seen.often[p], 0x1.fffffep-1) : 0;
  // A turn away from the mirrored eye, and one around it (d'Eon, Marschner and Hanika, SIGGRAPH Asia 2013).
  const Real v = variance[p], c = 1 + v * math::log((1 - u.x) + u.x * math::exp(-2 / v));
  const Real s = std::sqrt(max(0, 1 - c * c));
  const Real sine = max(-1, min(1, -c * seen.sin[p] + s * math::cos(2 * kPi * u.y) * seen.cos[p]));
  const Real cosine = std::sqrt(max(0, 1 - sine * sine));
  const Real turn = p + 1 == kLobes ? 2 * kPi * rest : seen.turn[p] + Logistic(scale).chosen(rest);
  const math::SinCos around = math::sincos(seen.around + turn);
  return {sine, cosine * around.cos, cosine * around.sin};
}

}  // namespace trace
