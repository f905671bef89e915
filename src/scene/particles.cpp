#include "scene/particles.h"

#include <algorithm>
#include <cstdint>

#include "base/budget.h"
#include "base/error.h"
#include "math/elementary.h"
#include "math/noise.h"

namespace trace {
namespace {

/// The random numbers of one particle.
class Chance {
 public:
  Chance(int seed, std::int64_t particle)
      : state_(mixBits(mixBits(static_cast<std::uint64_t>(seed)) ^ static_cast<std::uint64_t>(particle))) {}
  Real between(Real low, Real high) {
    state_ = mixBits(state_);
    return low + (high - low) * unitFromBits(state_);
  }
  /// Anywhere in the ball of radius 1.
  Vec3 inBall() {
    constexpr int kMost = 32;  // each fails less than half of the time
    Vec3 p;
    for (int i = 0; i < kMost; ++i) {
      p = {between(-1, 1), between(-1, 1), between(-1, 1)};
      if (dot(p, p) <= 1) return p;
    }
    return p * 0.5;
  }

 private:
  std::uint64_t state_;
};

struct Motion {
  Vec3 place, velocity;
};

/// Puts what is below a surface back on it, and turns its way.
void collide(const Particles& system, Motion& m, const Vec3& normal, Real depth) {
  m.place += normal * depth;
  const Real across = dot(m.velocity, normal);
  if (across >= 0) return;
  const Vec3 along = m.velocity - normal * across;
  m.velocity = along * (1 - system.friction) - normal * (across * system.bounce);
}

/// Over a short time; the drag's exponential keeps it stable however strong the drag is.
void advance(const Particles& system, Motion& m, Real dt) {
  checkBudget();
  const Real kept = math::exp(-system.drag * dt);
  m.velocity = system.wind + (m.velocity - system.wind) * kept + system.gravity * dt;
  m.place += m.velocity * dt;
  for (const auto& [x, y, z, d] : system.planes) {
    const Real l = std::sqrt(x * x + y * y + z * z);
    if (!(l > 0)) continue;
    const Vec3 normal = Vec3{x, y, z} / l;
    const Real depth = d / l - dot(normal, m.place);
    if (depth > 0) collide(system, m, normal, depth);
  }
  for (const auto& [x, y, z, radius] : system.spheres) {
    const Vec3 out = m.place - Vec3{x, y, z};
    const Real l = length(out);
    if (l > 0 && l < radius) collide(system, m, out / l, radius - l);
  }
}

}  // namespace

std::vector<Particle> particlesAt(const Particles& system, Real time) {
  const Real since = time - system.begin, step = std::clamp(system.step, 1e-4, 1.0);
  const Real longest = system.lifetime * (1 + system.lifetimeSpread);
  if (!(since >= 0 && system.rate > 0 && longest > 0)) return {};
  // Number i is thrown at i / rate.
  const Real first = std::max(0.0, std::ceil((since - longest) * system.rate));
  const Real last = std::floor(std::min(since, system.duration) * system.rate);
  constexpr Real kMostNumber = 1e15;  // beyond, whole numbers have gaps
  if (!(last - first < Particles::kMostAlive && last < kMostNumber))
    throw Error(Fault::scene,
                "particles: more than " + std::to_string(Particles::kMostAlive) + " would be alive",
                "give a lower rate or a shorter lifetime");
  if ((last - first + 1) * std::min(longest, since) / step > Particles::kMostSteps)
    throw Error(Fault::scene, "particles: the simulation would take too many steps", "give a longer step");

  const Work work("following particles");
  std::vector<Particle> alive;
  for (Real number = first; number <= last; ++number) {
    if (!(number / system.rate < system.duration || number == 0)) break;
    checkBudget();
    Chance chance(system.seed, static_cast<std::int64_t>(number));
    const Real age = since - number / system.rate;
    const Real life = system.lifetime * (1 + system.lifetimeSpread * chance.between(-1, 1));
    const Vec3 off{chance.between(-1, 1), chance.between(-1, 1), chance.between(-1, 1)};
    if (!(age >= 0 && age < life)) continue;
    const Vec3& s = system.spread;
    Motion m{system.position + Vec3{off.x * s.x, off.y * s.y, off.z * s.z},
             system.velocity + chance.inBall() * system.velocitySpread};
    Real left = age;
    for (; left > step; left -= step) advance(system, m, step);
    advance(system, m, left);
    if (isFinite(m.place)) alive.push_back({m.place, age / life});
  }
  return alive;
}

}  // namespace trace
