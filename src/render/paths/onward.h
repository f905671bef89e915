// Where a path continues from a surface: into the lobe, as the mirrored ray or as a refracted one, of which
// one is chosen at random. For paths from the camera and from lights.
#pragma once

#include <optional>

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
/// a path from a light may have met it on the other.
Frame frameToward(const Interaction& at, const Vec3& toEye);

class Onward {
 public:
  /// `spectrum` from 0 up to 1 chooses the wavelength where the surface begins to split light: of all
  /// surfaces of a sample the same. `intoBody` says how much a way through a body in which light spreads is
  /// worth, which is one more to choose; the surface's own lobe is then what is left of its light.
  Onward(const Interaction& at, Real spectrum, std::optional<Real> intoBody = {});

  /// A ray that continues.
  struct Ray {
    RayKind kind;  ///< bounce, reflection or refraction
    Vec3 direction;
    Color weight;      ///< over the chance of the choice
    Real density = 0;  ///< density of a direction in the lobe, per solid angle; 0: there was one only
    Real ratio = 1;    ///< ratio of the indices before and behind
    Interfaces there;
  };
  /// Chooses where a path from the camera continues, or one `fromLight`, which carries light itself; `lit`:
  /// light that Whitted's equation knows.
  std::optional<Ray> choose(Real choice, Sampler lobe, bool fromLight = false, bool lit = false) const;
  /// The mirrored or the refracted ray, if there is one, chosen with that probability.
  std::optional<Ray> only(RayKind kind, bool fromLight = false, Real likely = 1) const;
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
  /// How much of a wavelength's light is one ray's, where the surface splits it.
  const Color& response() const { return response_; }

 private:
  const Interaction& at_;
  const SpectralShare* share_ = nullptr;
  Color response_{1}, mirror_, through_;
  Real toLobe_ = 0, toMirror_ = 0, toBody_ = 0, toBehind_ = 0;
};

}  // namespace trace
