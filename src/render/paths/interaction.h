// The data of a ray's hit on a surface that integrators share: the normal that light sees, what is on both
// sides and the weights of the rays that continue in one direction only. It stands here once for all
// integrators.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/maps/photon_map.h"
#include "render/rays/gather.h"
#include "render/samples/sampler.h"
#include "shading/optics/dispersion.h"

namespace trace {

struct Subsurface;
struct SubsurfaceBsdf;

class Interaction {
 public:
  /// For a ray that ends at `hit`; `inside` is what it was in there. `footprint` is that of the ray at the
  /// hit, if textures want it. `spread` from 0 to 1 says where wavelengths lie, should light be split here.
  /// The arguments must live longer.
  Interaction(Tracer& tracer, const Ray& ray, const Hit& hit, const Differentials* footprint,
              const Interfaces& inside, Real spread);
  Interaction(const Interaction&) = delete;
  Interaction& operator=(const Interaction&) = delete;

  const Bsdf& bsdf() const { return *bsdf_; }
  /// Takes what goes into the body out of bsdf(), and gives the whole: of a body in which light spreads. One
  /// so large that the light's way is lost in rounding is not, there it comes out where it goes in.
  std::unique_ptr<const SubsurfaceBsdf> takeBody();
  /// The place is one where light goes in that comes out elsewhere: bsdf() becomes how much.
  void letIn();
  /// Above 0 if the surface's true normal is on the side where the ray comes from.
  Real facing() const { return -dot(ray.direction, hit.surface.normal); }
  /// That normal, on this side.
  Vec3 trueNormal() const { return facing() > 0 ? hit.surface.normal : -hit.surface.normal; }

  // --- light that arrives from elsewhere ---

  /// Where rays to light start that do not start at the hit: with Settings::smoothTerminator the place on the
  /// smooth surface that a mesh stands for. Light that arrives is asked for there.
  const std::optional<Vec3>& raised() const { return raised_; }
  const Vec3& lightPlace() const { return raised_ ? *raised_ : hit.surface.point; }
  /// An object that light crosses is not in the way of the light that leaves it.
  Ray leaveToLight(const Vec3& direction) const {
    Ray next = raised_ ? Ray{*raised_, direction} : hit.leave(direction);
    if (material.litThrough && !hit.strands) next.leaves = hit.object;
    return next;
  }
  /// A direction on the side that light is seen on, which the normals between vertices have turned into the
  /// surface.
  bool isAstray(const Vec3& direction) const {
    return !raised_ && dot(direction, hit.surface.normal) * facing() < 0;
  }

  // As a point that asks emitters (render/media/lamp_light.h); the light goes to where the ray comes from.
  const Vec3& point() const { return lightPlace(); }
  Ray leave(const Vec3& toLight) const { return leaveToLight(toLight); }
  Interfaces side(const Vec3& toLight) const {
    return transmits && dot(toLight, normal) < 0 ? behind() : inside;
  }
  Color scattered(const Vec3& toLight) const {
    if (!(dot(toLight, normal) < 0) && isAstray(toLight)) return Color(0);
    return evaluate(*bsdf_, frame, -ray.direction, toLight, Transport::importance) * (1 - coat);
  }
  Real density(const Vec3& toLight) const { return trace::density(*bsdf_, frame, -ray.direction, toLight); }

  /// Adds what arrives of the lights of the scene, by shadow rays, and is scattered to where the ray comes
  /// from: of all of them, or of Settings::lightChoices (render/lights/light_choice.h). Lights with a size
  /// are asked for Settings::lightSamples of their places.
  void addLights(Gather& sum, const Sampler& sampler) const;

  /// Adds `factor` times the part of the half space above the surface that is open, by so many rays, whose
  /// directions are spread by the cosine to the normal: what they hit within Settings::occlusionReach closes
  /// it.
  void addOpen(Gather& sum, Term::Kind kind, const Color& factor, int rays, const Sampler& sampler) const;

  /// The nearest photons of a map, on the side where the ray comes from.
  PhotonMap::Near photonsOf(const PhotonMap& photons) const {
    return photons.near(hit.surface.point, trueNormal());
  }
  /// Whether all of a disk of that radius around the place lies on the surface, and nothing stands on it:
  /// only then the density of the photons there is the light that arrives at the place. Short rays look,
  /// around which the numbers turn.
  bool hasDisk(Real radius, Sampler numbers) const;
  /// The share of such a disk that does, by the kernel of PhotonMap::Near::perArea().
  Real shareOfDisk(Real radius, Sampler numbers) const;
  /// Whether it scatters, without a lobe that is nearly a mirror, as hair has some.
  bool sendsEvenly() const;
  /// Adds the light of photons that is scattered to where the ray comes from: the diffuse part of it, or all.
  /// `share` is how much of their disk lies on the surface. Photons that a surface less than `apart` away has
  /// sent do not count.
  void addPhotons(Gather& sum, Term::Kind kind, const PhotonMap::Near& near, bool all, Real share = 1,
                  Real apart = 0) const;
  /// Adds what mirrors and glass throw there, of which a map holds all.
  void addCaustics(Gather& sum, const PhotonMap& photons, const Sampler& numbers) const;

  // --- rays that continue in one direction ---

  /// The refracted rays: light of all colours, or a fan of wavelengths where this surface begins to split it;
  /// nothing if it sends no ray through.
  std::span<const SpectralShare> shares() const {
    return !fan_.empty() ? std::span(fan_) : std::span(&whole_, transmits ? 1 : 0);
  }
  /// The weight of the mirrored ray, for all shares together. If rays `follow` lobes, without what it stands
  /// for in place of these.
  Color mirror(bool follow) const {
    if (transmits) return mirrorOfGlass(follow);
    if (follow && isGlossy(*bsdf_)) return Color(coat);
    return Color(coat) +
           (follow ? exactMirrorWeight(*bsdf_, cosine) : mirrorWeight(*bsdf_, cosine)) * (1 - coat);
  }
  /// The weight of the refracted ray, without that of the share.
  Color filter(const SpectralShare& share) const;
  /// Where it goes, and how the index changes there; nothing at total reflection.
  std::optional<Vec3> through(const SpectralShare& share) const;
  Real ratio(const SpectralShare& share) const;
  /// The media of a ray on the other side.
  Interfaces behind() const;

  Tracer& tracer;
  const Ray& ray;
  const Hit& hit;
  const Interfaces& inside;

 private:
  PlaceBsdf bsdf_;

 public:
  const WhittedTerms& material;
  Vec3 normal;      ///< unit: to the side that light is seen on
  Frame frame;      ///< around it
  Real cosine;      ///< cosine of the ray and the normal
  bool transmits;   ///< it sends a ray through
  bool straight;    ///< ... which is not bent
  Real coat;        ///< the share that a varnish mirrors
  Indices indices;  ///< before the surface and behind it, where anybody asks

 private:
  bool spreads(const Subsurface& said) const;
  bool continues(const Vec3& to, Real height) const;
  Real mirroredShare(const SpectralShare& share) const;
  Color mirrorOfGlass(bool follow) const;
  [[gnu::noinline]] void raise(bool turned);

  /// The medium inside the object, and both sides of its surface.
  struct Boundary {
    Filling body;
    Sides sides;
  };
  std::optional<Boundary> boundary_;  ///< where somebody asks for it
  Fresnel fresnel_;
  std::optional<Vec3> raised_;
  SpectralShare whole_{0, Color(1)};
  std::vector<SpectralShare> fan_;
};

}  // namespace trace
