// Where paths from lights start: at a light of the scene, at a lamp (an emissive object), or far away
// where the sky is; and how likely each start was, which weighs paths against those that reach the same place
// from the other end (Veach 1997, section 10.2; Pharr, Jakob and Humphreys 2023, section 12.1.2).
//
// Whitted's lights keep their own rules: the light that arrives at the first surface is what the light says
// arrives there, whatever its law of distance.
#pragma once

#include <optional>
#include <vector>

#include "render/lights/lamps.h"
#include "render/rays/tracer.h"
#include "render/samples/sampler.h"

namespace trace {

class LightStarts {
 public:
  LightStarts() = default;
  /// `lamps` must outlive it.
  LightStarts(const World& world, const Lamps& lamps);

  /// Some light of the scene starts paths.
  bool anyLight() const { return !sums_.empty(); }

  static constexpr std::size_t kNoLight = static_cast<std::size_t>(-1);

  /// The start of a path, and what it meets first.
  struct Start {
    Ray ray;
    Interfaces inside;
    std::optional<Hit> hit;
    std::size_t light = kNoLight;  ///< light of the world, if it is one of them
    bool parallel = false;         ///< it comes from beyond all distances
    /// With which it was chosen and went that way: per solid angle, or per area across parallel light.
    Real density = 0;
    Vec2 onLight{};           ///< the place on a light
    Real cosine = 1;          ///< at a ball or a lamp
    Color sends;              ///< emission of a lamp and of the sky
    std::optional<Hit> lamp;  ///< the place on a lamp
  };
  std::optional<Start> start(Tracer& tracer, const Sampler& sampler) const;
  /// The light that arrives straight at a vertex of that path.
  struct Arrival {
    Color power;  ///< over the density of the place and its cosine
    /// Densities, over the start's: of the start, as places sample it from the other end; and of meeting it
    /// at random, without what only the place knows. 0 where that cannot be.
    Real asked = 0, met = 0;
  };
  /// At the distance t. Nothing where the light does not reach.
  std::optional<Arrival> arrives(const World& world, const Start& start, const Vec3& at, Real t) const;

  /// With which starts go to a place that has sampled it, over the density with which it asked, except
  /// for the cosine there: of a light of the world that gave it `arriving`; of a lamp and of the sky.
  Real overAsked(const World& world, std::size_t light, const Illumination& arriving, const Vec3& at) const;
  Real overAsked(const Lamps::Place& place, const Vec3& at) const;
  /// With which starts go along a ray that met a lamp or, from that place, the sky: per area and solid angle,
  /// except for the cosine at a lamp.
  Real ofLamp(const Hit& hit) const;
  Real ofSky(const Vec3& at, const Vec3& toLight) const;

 private:
  /// How the starts of a light of the world are spread.
  struct Source {
    Real share = 0;  ///< share of all starts
    Vec3 axis;       ///< axis of the directions of a point, which lie in a cone
    Real cosine = -1;
  };
  std::optional<Start> fromLight(Tracer& tracer, std::size_t light, const Sampler& sampler) const;
  std::optional<Start> fromLamp(Tracer& tracer, Real which, const Sampler& sampler) const;
  std::optional<Start> fromSky(Tracer& tracer, const Sampler& sampler) const;
  void follow(Tracer& tracer, Start& start, const Sampler& sampler) const;
  /// Where parallel light starts that runs in the direction.
  Ray before(Tracer& tracer, const Vec3& direction, const Vec2& u) const;
  Real diskDensity() const { return 1 / (kPi * radius_ * radius_); }
  /// The density where such light comes to a point; 0 beside the disk, where a plane may continue.
  Real diskDensity(const Vec3& at, const Vec3& toLight) const;
  Real powerOf(const World& world, std::size_t light) const;

  const Lamps* lamps_ = nullptr;
  Vec3 middle_;  ///< middle of a ball around the scene
  Real radius_ = 0;
  std::vector<Source> lights_;
  std::vector<Real> sums_;  ///< sums of their shares, up to and with each
  Real lampShare_ = 0, skyShare_ = 0;
};

}  // namespace trace
