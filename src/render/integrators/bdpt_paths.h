// The state of the two paths of Bidirectional.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "base/inline_stack.h"
#include "render/integrators/bdpt.h"
#include "render/paths/partial_sums.h"
#include "render/paths/path_place.h"
#include "render/paths/walk.h"
#include "shading/materials/subsurface.h"

namespace trace {

/// How many places a path has on surfaces and in media.
struct Bidirectional::Counts {
  int surfaces = 0, scatterings = 0;
  int all() const { return surfaces + scatterings; }
  /// The chance of Russian roulette behind so many vertices, where that much is left of the throughput.
  Real keeps(Real left) const { return all() <= 3 ? 1 : std::min(1.0, left); }
  friend Counts operator+(const Counts& a, const Counts& b) {
    return {a.surfaces + b.surfaces, a.scatterings + b.scatterings};
  }
};

/// State that a path from a light shares with its vertices.
struct Bidirectional::Carried {
  Color response{1};  ///< response of the wavelength, if the path was split: not in the power
  PartialSums partial{};
  Counts counts{};  ///< weights of the vertices up to and with the last one
  Last last = Last::lobe;
};

/// Where a path from the camera is.
struct Bidirectional::Path : Leg {
  Counts counts{};  ///< weights of the vertices before
  PartialSums partial{};
  bool fromMedium = false;  ///< it was scattered in a medium last
  bool fromLights = false;  ///< paths from lights bring what mirrors and glass show it

  int t() const { return counts.all() + 2; }  ///< number of the vertex where it arrives
};

/// A place of a path from a light.
struct Bidirectional::LightPlace : Bidirectional::Carried {
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
  Color power{};     ///< what arrives, over the density of the place and its cosine
  bool lit = false;  ///< by a light of the world, straight or through panes that shadow rays pass

  int s() const { return counts.all() + 1; }
};

/// The data shared by both paths of a sample.
struct Bidirectional::Sample {
  /// Not an aggregate, which would clear the memory of `lights`.
  Sample(Real spectrum_, Real shift_, const Strategies& ways_, std::vector<Thrown>* thrown_)
      : spectrum(spectrum_), shift(shift_), ways(ways_), thrown(thrown_) {}

  Real spectrum;  ///< chooses the wavelength, should a path be split
  Real shift;     ///< shift of all wavelengths to choose from
  Strategies ways;
  std::vector<Thrown>* thrown;
  InlineStack<LightPlace, 6> lights;
};

}  // namespace trace
