// Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10): a path from the camera and
// one from a light, of which every place is joined with every other.
//
//   L = sum over s and t of w(s, t) * (s places of the light's path, t of the camera's, the way between)
//
//   s = 0    the path from the camera hit something that shines
//   s = 1    a place of it samples lights and lamps, as a path tracer does
//   t = 1    a place of the path from the light is seen by the camera: it lands anywhere in the picture
//   else     a place of one and a place of the other see each other
//
// Places lie on surfaces and in media (render/paths/path_place.h). The same path can come about in several
// ways; w is the power heuristic over their densities, by partial sums (render/paths/partial_sums.h).
//
// Left out of the densities are chances of Russian roulette, of the choice between lobe, mirror and glass, of
// the choice among lights, and of how far a ray gets in a medium: any weights that sum up to 1 give the same
// picture. Light that glass refracts is found by paths from lights: shadow rays pass only panes that bend
// nothing (thin_glass), which are no vertices of a path on its way straight from a light. Parallel light
// begins no path in a medium; it is asked there.
//
// A path from the camera goes through a body in which light spreads as a path tracer does: from where light
// comes out to where it went in (render/paths/subsurface.h), which count as one place of it. A path from a
// light knows no way through: its density to have come out is 0, so the sums begin anew behind a body.
//
// Use it for lights that visible surfaces do not see: behind shades, shining at ceilings, or through glass.
// Not for lights in the open, where path takes three to four times as many samples in the same time, nor for
// caustics of the sun or of point lights that are seen through glass or in a mirror: it never finds them.
#pragma once

#include <memory>

#include "render/lights/lamps.h"
#include "render/lights/light_starts.h"
#include "render/media/media.h"
#include "render/paths/partial_sums.h"
#include "render/paths/strategies.h"
#include "render/rays/gather.h"
#include "render/samples/integrator.h"
#include "shading/cameras/importance.h"

namespace trace {

class Turns;
struct LegMedia;

class Bidirectional : public Integrator {
 public:
  /// multiplexed: each sample shows one way to put its path together, which its own numbers choose, and
  /// counts the more: for chains, which then find out which way serves them (Hachisuka, Kaplanyan and
  /// Dachsbacher, Multiplexed Metropolis Light Transport, 2014).
  explicit Bidirectional(bool multiplexed = false) : multiplexed_(multiplexed) {}
  void prepare(const World& world, const Settings& settings, Job& job) override;
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;
  void throwLight(Tracer& tracer, const Sampler& sampler, std::vector<Thrown>& thrown) const override;

 private:
  // integrators/bdpt_paths.h
  struct Carried;
  struct Counts;
  struct Path;
  struct Sample;
  struct LightPlace;
  /// The vertex of a whole path next to the light.
  enum class Last { lobe, mirror, medium };
  Sample sampleOf(const Sampler& sampler, std::vector<Thrown>* thrown) const;
  Real share(int s, int t, Real others, const Sample& sample) const;
  bool allows(const Counts& whole, Last last) const;
  bool comesFromLights(const Path& path) const;

  // The path from the camera: integrators/bdpt.cpp.
  Color along(Tracer& tracer, Path& path, const std::optional<Hit>& hit, const Sample& sample) const;
  std::optional<Color> arrive(Tracer& tracer, Path& path, const std::optional<Hit>& hit, Turns& turns,
                              const Sample& sample) const;
  std::optional<Color> scatter(Tracer& tracer, Path& path, const LegMedia& media, Turns& turns,
                               const Sample& sample) const;

  // The one from a light: integrators/bdpt_light.cpp.
  struct Flight;
  void walkFromLight(Tracer& tracer, const Sampler& sampler, Sample& sample) const;
  Color travels(Tracer& tracer, const Flight& flight, std::optional<MediumWay::Place>& where) const;
  bool scatters(Flight& flight, const MediumWay::Place& where) const;
  bool goesOn(Flight& flight, const LightPlace& place, const Sample& sample) const;
  void land(Tracer& tracer, const LightPlace& light, const Sample& sample, const Sampler& sampler) const;

  // The connections of both paths: integrators/bdpt_joins.cpp. `factor` is the place's factor besides the
  // path's weight.
  void joinAll(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts, const Color& factor,
               const Sample& sample) const;
  void askLights(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                 const Sample& sample) const;
  void askLamps(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                const Sample& sample) const;
  void join(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts, const Color& factor,
            const LightPlace& light, const Sample& sample) const;

  bool multiplexed_;
  int depth_ = 0;          ///< the most bounces
  int mostScattered_ = 0;  ///< the most times that media scatter
  Strategies ways_;
  bool splits_ = false;  ///< glass may split light
  bool weighs_ = true;
  bool lands_ = false;  ///< t = 1 is one of the ways
  Lamps lamps_;
  LightStarts starts_;
  CameraImportance camera_;
};

}  // namespace trace
