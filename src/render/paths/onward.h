// Where a path continues from a surface: into the lobe, as the mirrored ray or as a refracted one, of which
// one is chosen at random. For paths from the camera and from lights.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "render/paths/interaction.h"

namespace trace {

/// The scattering of a surface from one direction to another, as a path from the camera sees it,
/// times the cosine to the light; black where the normals between vertices would turn light through it. Of
/// the light that Whitted's equation knows, if it is `lit`: its shadows may be pale, and it is seen from
/// where the normals have turned away.
Color scattered(const Interaction& at, const Vec3& toEye, const Vec3& toLight, bool lit = false);

/// The scattering for a path that came from the light, whose places are spread over the surface's true area,
/// for what continues from there over solid angle (Veach 1997, section 5.3).
Color scatteredOn(const Interaction& at, const Vec3& toEye, const Vec3& toLight, bool lit = false);

/// Around the normal on the side of `toEye` where the surface is a sheet, which is the same from both sides:
/// a path from a light may have hit it on the other.
Frame frameToward(const Interaction& at, const Vec3& toEye);

/// How often a path continues that was scattered that many times and carries so much of what it brings to the
/// sample: Russian roulette. Short ones and those that carry half of it surely: to end them spares less time
/// than the noise costs.
inline Real survival(int bounces, const Color& weight) {
  constexpr int kSurely = 3;
  const Real carries = 2 * maxComponent(weight);
  return bounces < kSurely && carries > 0 ? 1 : std::min(carries, 1.0);
}

/// The numbers that choose a direction in a lobe, from 0 up to 1.
struct LobeNumbers {
  Real which;
  Vec2 where;
};

class Onward {
 public:
  /// `spectrum` from 0 up to 1 chooses the wavelength where the surface begins to split light: of all
  /// surfaces of a sample the same. `intoBody` says how much a way through a body in which light spreads is
  /// worth, which is one more to choose; the surface's own lobe is then what is left of its light. Without
  /// `lobe` no ray goes there.
  Onward(const Interaction& at, Real spectrum, std::optional<Real> intoBody = {}, bool lobe = true);

  /// A ray that continues.
  struct Ray {
    RayKind kind;  ///< bounce, reflection or refraction
    Vec3 direction;
    Color weight;      ///< over the chance of the choice
    Real density = 0;  ///< density of a direction in the lobe, per solid angle; 0: there was one only
    Real ratio = 1;    ///< ratio of the indices before and behind
    std::optional<Interfaces> behind{};  ///< what it runs in, if it goes to the other side
    /// The media that it runs in, where the ray that led here ran in `before`.
    const Interfaces& in(const Interfaces& before) const { return behind ? *behind : before; }
  };
  /// Chooses where a path from the camera continues, or one `fromLight`, which carries light itself; `lit`:
  /// light that Whitted's equation knows. draw() gives LobeNumbers, where they are wanted.
  template <class Draw>
  std::optional<Ray> choose(Real choice, const Draw& draw, bool fromLight = false, bool lit = false) const {
    if (choice < toLobe_) return fromLight ? lightIntoLobe(draw(), lit) : intoLobe(draw());
    return ofOne(choice, fromLight);
  }
  /// The mirrored or the refracted ray, if there is one, without the chance of its choice.
  std::optional<Ray> only(RayKind kind, bool fromLight = false) const;
  /// The number for choose(), drawn only where there is something to choose.
  Real choice(Sampler& numbers) const { return toLobe_ < 1 ? numbers.next() : numbers.skip(); }
  /// How likely choose() continues by such a ray: bounce, reflection or refraction.
  Real chance(RayKind kind) const {
    return kind == RayKind::bounce ? toLobe_ : kind == RayKind::reflection ? toMirror_ : toBehind_;
  }
  /// How likely the choice of a way through the body was, if it is that; else 0.
  Real goesIntoBody(Real choice) const {
    return choice >= toLobe_ + toMirror_ && choice < toLobe_ + toMirror_ + toBody_ ? toBody_ : 0;
  }
  /// It was the choice of a refracted ray that is totally reflected.
  bool totallyReflected(Real choice) const;
  /// The weight of a ray of a path from the camera, for the wavelengths that it stands for.
  Color seen(const Ray& ray) const {
    return ray.kind == RayKind::refraction ? ray.weight * response_ : ray.weight;
  }
  /// How much of a wavelength's light is one ray's, where the surface splits it.
  const Color& response() const { return response_; }

 private:
  std::optional<Ray> intoLobe(const LobeNumbers& numbers) const;
  std::optional<Ray> lightIntoLobe(const LobeNumbers& numbers, bool lit) const;
  std::optional<Ray> ofOne(Real choice, bool fromLight) const;
  std::optional<Ray> intoLobe(const BsdfSample& drawn, const Color& weight) const;

  const Interaction& at_;
  const SpectralShare* share_ = nullptr;
  Color response_{1}, mirror_, through_;
  Real toLobe_ = 0, toMirror_ = 0, toBody_ = 0, toBehind_ = 0;
  Real all_ = 0;  ///< the chances, before they are made to sum up to 1
};

inline Onward::Onward(const Interaction& at, Real spectrum, std::optional<Real> intoBody, bool lobe)
    : at_(at) {
  const bool glossy = isGlossy(at.bsdf());
  const auto shares = glossy ? at.shares().first(0) : at.shares();
  if (!shares.empty()) {
    const auto count = static_cast<Real>(shares.size());
    share_ = &shares[static_cast<std::size_t>(spectrum * count)];
    through_ = at.filter(*share_);
    response_ = share_->weight * count;
  }
  mirror_ = at.mirror(true);
  const Real mirrors = maxComponent(mirror_), passes = maxComponent(through_);
  constexpr Real kLeastLobe = 0.2;  // what is scattered is not known beforehand
  const Real likely = intoBody ? kLeastLobe : std::max(kLeastLobe, 1 - mirrors - passes);
  const Real scattered = lobe && scatters(at.bsdf()) ? likely : 0;
  all_ = scattered + mirrors + passes + intoBody.value_or(0);
  if (!(all_ > 0)) return;
  toLobe_ = scattered / all_;
  toMirror_ = mirrors / all_;
  toBody_ = intoBody.value_or(0) / all_;
  toBehind_ = passes / all_;
}

inline std::optional<Onward::Ray> Onward::intoLobe(const BsdfSample& drawn, const Color& weight) const {
  std::optional<Ray> ray(Ray{RayKind::bounce, drawn.toLight, weight, drawn.density});
  if (at_.transmits && dot(drawn.toLight, at_.normal) < 0) ray->behind = at_.behind();
  return ray;
}

inline std::optional<Onward::Ray> Onward::intoLobe(const LobeNumbers& numbers) const {
  const auto drawn =
      sample(at_.bsdf(), at_.frame, -at_.ray.direction, numbers.which, numbers.where, Transport::importance);
  if (!drawn || isBlack(drawn->weight)) return {};
  if (!(dot(drawn->toLight, at_.normal) < 0) && at_.isAstray(drawn->toLight)) return {};
  return intoLobe(*drawn, drawn->weight * ((1 - at_.coat) / toLobe_));
}

/// The mirrored or refracted ray that carries more, if the surface sends any.
std::optional<Onward::Ray> strongestOf(const Interaction& at);

/// Two draws of a sampler of its own; the first decides nothing where there is `one` lobe.
inline auto lobeNumbers(Sampler numbers, bool one = false) {
  return [numbers, one] {
    Sampler own = numbers;
    const Real which = one ? own.skip() : own.next();
    return LobeNumbers{which, own.next2()};
  };
}

/// The term of a ray's radiance that such a ray brings.
constexpr Term::Kind termOf(RayKind kind) {
  return kind == RayKind::bounce       ? Term::Kind::bounce
         : kind == RayKind::reflection ? Term::Kind::reflection
                                       : Term::Kind::refraction;
}

}  // namespace trace
