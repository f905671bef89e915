// The state of the two paths of Bidirectional.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "render/integrators/bdpt.h"
#include "render/paths/path_place.h"
#include "render/paths/walk.h"
#include "shading/materials/subsurface.h"

namespace trace {

/// The partial sums of one end's path, whose heuristic is this power of the densities.
struct Bidirectional::Partial {
  static Real power(Real density) { return density * density; }

  Real vcm = 0, vc = 0;

  /// The path has arrived: its density was over solid angle, and is over area now.
  void arrive(Real distance2, Real cosine) {
    const Real c = 1 / power(cosine);
    vcm *= power(distance2) * c;
    vc *= c;
  }
  /// It continues: in a direction of a lobe with that density, which the other way round is `reverse`; at
  /// `cosine` to the surface.
  void leave(Real density, Real reverse, Real cosine) {
    vc = power(cosine / density) * (vc * power(reverse) + vcm);
    vcm = power(1 / density);
  }
  /// In the only direction of a mirror or of glass, where nothing is joined.
  void reflect(Real cosine) {
    vc *= power(cosine);
    vcm = 0;
  }
  /// The weights of all other strategies that start on this end, where the other end comes upon the place
  /// with that density, and the place sends its path back with `reverse`.
  Real others(Real density, Real reverse) const { return power(density) * (vcm + vc * power(reverse)); }
};

/// How many places a path has on surfaces and in media.
struct Bidirectional::Counts {
  int surfaces = 0, scatterings = 0;
  int all() const { return surfaces + scatterings; }
  friend Counts operator+(const Counts& a, const Counts& b) {
    return {a.surfaces + b.surfaces, a.scatterings + b.scatterings};
  }
};

/// Where a path from the camera is.
struct Bidirectional::Path : Leg {
  Counts counts{};  ///< weights of the vertices before
  Color weight{1};  ///< weight of the ray's radiance in the sample
  Partial partial{};
  bool fromMedium = false;  ///< it was scattered in a medium last
  bool asked = false;       ///< it was scattered, and has hit since then only panes that shadow rays pass
  bool fromLights = false;  ///< paths from lights bring what mirrors and glass show it
  bool within = false;      ///< it runs in a body, from where light comes out

  int t() const { return counts.all() + 2; }  ///< number of the vertex where it arrives
};

/// A place of a path from a light.
struct Bidirectional::LightPlace {
  /// On a surface, and in a medium.
  LightPlace(Tracer& tracer, const Ray& ray_, Interfaces inside_, const Hit& hit_, Real choice)
      : ray(ray_),
        inside(std::move(inside_)),
        hit(hit_),
        at(std::in_place, tracer, ray, *hit, nullptr, inside, choice),
        place(*at) {
    if (tracer.world().hasSubsurface()) at->takeBody();
  }
  LightPlace(const Ray& ray_, Interfaces inside_, const MediumWay::Place& where)
      : ray(ray_), inside(std::move(inside_)), place(ray, where, inside) {}

  Ray ray;
  Interfaces inside;
  std::optional<Hit> hit{};
  std::optional<Interaction> at{};
  PathPlace place;
  Color power{};      ///< what arrives, over the density of the place and its cosine
  Color response{1};  ///< response of the wavelength, if the path was split: not in the power
  Partial partial{};
  bool lit = false;  ///< by a light of the world, straight or through panes that shadow rays pass
  Counts counts{};   ///< weights of the vertices up to and with this one
  Last last = Last::lobe;

  int s() const { return counts.all() + 1; }
};

/// The data shared by both paths of a sample.
struct Bidirectional::Sample {
  Real spectrum;  ///< chooses the wavelength, should a path be split
  Real shift;     ///< shift of all wavelengths to choose from
  Ways ways;
  std::deque<LightPlace> lights{};
  std::vector<Thrown>* thrown = nullptr;
};

}  // namespace trace
