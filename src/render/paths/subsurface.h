// Where light that comes out of a body went in, and the other way round: marble, milk, skin
// (shading/materials/subsurface.h).
//
// Profiles are looked up by probes: a line through the body, along the normal or one of two tangents, at a
// distance that the profile chooses; of the places where it crosses the surface one is taken by what it
// counts, and weighed by all ways to come upon it (King, Kulla, Conty and Fajardo, BSSRDF Importance
// Sampling, SIGGRAPH 2013 talks; pbrt, 3rd ed., section 15.4). The line has no end, so nothing is lost at the
// brim of a disk.
//
// A walk goes step by step, as light does, from where the eye's ray is refracted into the body until the
// surface lets it out (Chiang, Kutz and Burley, Practical and Controllable Subsurface Scattering, SIGGRAPH
// 2016 talks). By similarity light is scattered evenly, as often as the reduced coefficient says.
//
// A photon goes the same ways backward. Profiles do not change when the two places are exchanged. A walk
// begins in any direction below the surface that lets light in, evenly, and where it comes out it is
// refracted to the eye.
#pragma once

#include <optional>

#include "render/paths/interaction.h"

namespace trace {

/// Where light goes in.
struct Entrance {
  Hit hit;       ///< seen from outside
  Ray ray;       ///< on which it is so seen
  Color weight;  ///< weight of the light there in that which comes out and goes to the eye
  BodyTerm how;
};

/// Where the light went in that goes to the eye of `at`, whose body that is. `importance` says how much each
/// colour counts. Nothing where no way was found. The place is the one that the Tracer has met last.
std::optional<Entrance> entrance(const Interaction& at, const SubsurfaceBsdf& body, const Color& importance,
                                 Sampler numbers);

/// Where a photon leaves a body, and how.
struct Departure {
  Hit hit;
  Vec3 direction;
  Color weight;  ///< what its power is to be multiplied by
};

/// The exit of the photon that hit the object at `at` with that power. Nothing where it does not come out.
std::optional<Departure> departure(const Interaction& at, const SubsurfaceBsdf& body, const Color& power,
                                   Sampler numbers);

}  // namespace trace
