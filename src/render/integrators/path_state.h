// Where a path of PathTracer is.
#pragma once

#include "render/integrators/path.h"

namespace trace {

struct PathTracer::Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};   ///< weight of the ray's radiance in the sample
  Real density = 0;  ///< density of its direction, among lobes; 0 where there was one only
  const Differentials* differentials = nullptr;  ///< differentials of the ray, if footprints are needed
  Real ink = 0;                                  ///< how much of it an outline covers
  bool gathers = false;                          ///< the photon map is used where it arrives
  const Maps* maps = nullptr;                    ///< photon maps of the sample
  int scattered = 0;                             ///< / number of times, by media
  bool within = false;                           ///< it runs in a body, from where light comes out
  bool forCache = false;                         ///< the emitter and is asked for does not count
  /// It was scattered, and on through nothing but glass that shadow rays pass: lights were asked.
  bool asked = false;
  /// Photons told what is scattered where it arrives already where it comes from: it sees only emitters.
  bool told = false;
  bool near = false;     ///< except for what a surface as near as this sends evenly
  bool bounced = false;  ///< photons were asked what mirrors and glass bring to where it was scattered
};

/// A place where a medium scatters a path, until it is known what the ray from there brings.
struct PathTracer::Scattering {
  Gather sum;
  MediumTerm how;
  Color factor{}, passed{};  ///< radiance of the continuation, and transmittance of the way to the eye
  // The continuation of the path.
  Ray ray{};
  std::optional<Hit> hit{};
  Path path{};
  Interfaces inside{};
  Sampler sampler;
};

}  // namespace trace
