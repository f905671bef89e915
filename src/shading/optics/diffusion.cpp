#include "shading/optics/diffusion.h"

#include "math/elementary.h"

namespace trace {

Real diffuseFresnelInside(Real index) {
  if (index == 1) return 0;
  if (index < 1)
    return -0.4399 + 0.7099 / index - 0.3319 / (index * index) + 0.0636 / (index * index * index);
  return std::clamp(-1.440 / (index * index) + 0.710 / index + 0.668 + 0.0636 * index, 0.0, 0.999);
}

Dipole::Dipole(Real scatters, Real absorbs, Real index) {
  const Real loses = scatters + absorbs;
  if (!(scatters > 0) || !std::isfinite(loses)) return;
  const Real inside = diffuseFresnelInside(index), boundary = (1 + inside) / (1 - inside);  // A
  reduced = scatters / loses;
  fade = std::sqrt(3 * absorbs * loses);
  below = 1 / loses;
  above = below * (1 + 4 * boundary / 3);
  albedo = reduced / 2 * (math::exp(-fade * below) + math::exp(-fade * above));
}

Real Dipole::profile(Real r) const {
  const auto of = [&](Real z) {
    const Real d = std::sqrt(r * r + z * z);
    return z * (1 + fade * d) * math::exp(-fade * d) / (d * d * d);
  };
  return albedo > 0 ? reduced / (4 * kPi) * (of(below) + of(above)) : 0;
}

Real Dipole::distance(Real u) const {
  const Real real = math::exp(-fade * below), all = real + math::exp(-fade * above);
  const bool ofReal = u * all < real;
  const Real z = ofReal ? below : above;
  const Real rest = 1 - (ofReal ? u * all / real : (u * all - real) / (all - real));  // beyond the distance
  // ln(d) + s d = goal, which grows and bends downward: Newton's steps from the left stay on the left.
  const Real goal = math::log(z) + fade * z - math::log(std::max(rest, 1e-300));
  Real d = z;
  for (int i = 0; i < 60; ++i) {
    const Real step = (goal - math::log(d) - fade * d) / (1 / d + fade);
    d = std::max(z, d + step);
    if (!(std::abs(step) > 1e-12 * d)) break;
  }
  return std::sqrt(std::max(0.0, d * d - z * z));
}

NormalizedDiffusion::NormalizedDiffusion(Real scatters, Real absorbs, Real albedoOfSurface)
    : albedo(albedoOfSurface) {
  const Real away = std::abs(albedo - 0.8);
  const Real fit = 1.9 - albedo + 3.5 * away * away;
  if (scatters + absorbs > 0) reach = 1 / ((scatters + absorbs) * fit);
}

Real NormalizedDiffusion::profile(Real r) const {
  if (!(r > 0)) r = 1e-9 * reach;
  return albedo * (math::exp(-r / reach) + math::exp(-r / (3 * reach))) / (8 * kPi * reach * r);
}

Real NormalizedDiffusion::distance(Real u) const {
  const bool near = u < 0.25;
  const Real rest = 1 - (near ? u * 4 : (u - 0.25) / 0.75);
  return -math::log(std::max(rest, 1e-300)) * reach * (near ? 1 : 3);
}

}  // namespace trace
