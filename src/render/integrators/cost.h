// The cost of a pixel in Whitted's tracer, as a colour: boxes of hierarchies that its rays visited and shapes
// that they were tested against. Black is none, ever brighter up to white for ten thousand (heatColor); each
// step of one colour is a factor.
//
// Use it to find what makes a scene slow. Not for the cost of the other integrators, whose rays go elsewhere.
#pragma once

#include "image/comparison/false_color.h"
#include "math/elementary.h"
#include "render/integrators/whitted.h"

namespace trace {

class Cost : public Integrator {
 public:
  void prepare(const World& world, const Settings& settings, Job& job) override {
    whitted_.prepare(world, settings, job);
  }

  bool weighsHoles() const override { return true; }

  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override {
    Tracer measured(tracer.world(), tracer.settings());  // from the camera ray on
    CameraRay again = camera;
    again.inside = measured.interfacesAt(camera.ray.origin);
    again.hit = measured.cast(camera.ray, RayKind::camera, again.inside);
    whitted_.radiance(measured, sampler, again);
    const Statistics& s = measured.statistics();
    double steps = static_cast<double>(s.nodes.count);
    for (const std::uint64_t tests : s.tests) steps += static_cast<double>(tests);
    tracer.statistics() += s;

    constexpr double kMost = 1e4;
    Gather sum(tracer, 0);
    sum.add(Term::Kind::emissive, heatColor(math::log(1 + steps) / math::log(1 + kMost)));
    return sum.radiance();
  }

 private:
  Whitted whitted_;
};

}  // namespace trace
