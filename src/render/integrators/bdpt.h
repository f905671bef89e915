// Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10): a path from the camera and
// one from a light, of which every place is joined with every other.
//
//   L = sum over s and t of w(s, t) * (s places from the light's end, t from the camera's, and the way
//   between)
//
//   s = 0    the path from the camera met something that shines
//   s = 1    a place of it asks lights and lamps for their light, as a path tracer does
//   t = 1    a place of the path from the light is seen by the camera: it lands anywhere in the picture
//   else     a place of one and a place of the other see each other
//
// The same path can come about in several ways; w is the power heuristic over their densities. Each path
// carries two partial sums of density ratios (van Antwerpen, Recursive MIS Computation for Streaming BDPT on
// the GPU, 2011; Georgiev, Implementing Vertex Connection and Merging, 2012), so that w takes no loop:
//
//   vcm  densities of all ways in which the place was not joined from the other end, over that of this path
//   vc   those in which the place before it was not reached from this end, likewise
//
// Chances of Russian roulette and of the choice between lobe, mirror and glass are left out of the densities:
// any weights that sum up to 1 give the same picture. Light that glass refracts is found by paths from
// lights: no shadow ray passes glass. Light is scattered in fog as in the path tracer, along the path from
// the camera; fog dims all the other ways.
#pragma once

#include "render/gather.h"
#include "render/integrator.h"
#include "render/lamps.h"
#include "render/light_starts.h"
#include "shading/cameras/importance.h"

namespace trace {

class Interaction;

class Bidirectional : public Integrator {
 public:
  /// multiplexed: each sample shows one way to put its path together, which its own numbers choose, and
  /// counts the more: for chains, which then find out which way serves them (Hachisuka, Kaplanyan and
  /// Dachsbacher, Multiplexed Metropolis Light Transport, 2014).
  explicit Bidirectional(bool multiplexed = false) : multiplexed_(multiplexed) {}
  void prepare(const World& world, const Settings& settings, Job& job) override;
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;

 private:
  struct Path;
  struct Sample;
  struct Place;
  void walkFromLight(Tracer& tracer, const Sampler& sampler, Sample& sample) const;
  Color along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, Path path,
              const Interfaces& inside, const Sampler& sampler, const Sample& sample) const;
  void askLights(Gather& sum, const Interaction& at, const Path& path, const Sampler& sampler,
                 const Sample& sample) const;
  void askLamps(Gather& sum, const Interaction& at, const Path& path, const Sampler& sampler,
                const Sample& sample) const;
  void join(Gather& sum, const Interaction& at, const Path& path, const Place& light, int s,
            const Sample& sample) const;
  void land(Tracer& tracer, const Place& light, int s, const Sampler& sampler, const Sample& sample) const;
  /// The ways that a sample shows.
  struct Ways {
    int light = -1, camera = -1;  ///< s and t; -1: any
    Real counts = 1;
    bool shows(int s, int t) const { return (light < 0 || light == s) && (camera < 0 || camera == t); }
  };
  Ways waysOf(const Sampler& sampler) const;
  Real share(int s, int t, Real others, const Sample& sample) const;

  bool multiplexed_;
  int depth_ = 0;  ///< the most bounces
  Ways ways_;
  bool weighs_ = true;
  bool lands_ = false;  ///< t = 1 is one of the ways
  Lamps lamps_;
  LightStarts starts_;
  CameraImportance camera_;
};

}  // namespace trace
