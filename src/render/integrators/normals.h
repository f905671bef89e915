// The normals of what the camera sees, as colours: -1 to 1 along x, y and z become 0 to 1 of red, green and
// blue. The smallest integrator.
//
// Use it to check a mesh and its normals. Not as data for other programs: the pass normal has the numbers.
#pragma once

#include "render/rays/gather.h"
#include "render/samples/integrator.h"

namespace trace {

class Normals : public Integrator {
 public:
  Color radiance(Tracer& tracer, Sampler, const CameraRay& camera) const override {
    Gather sum(tracer, 0);
    if (camera.hit) {
      const Vec3& n = camera.hit->surface.shading;
      sum.add(Term::Kind::emissive, Color{n.x + 1, n.y + 1, n.z + 1} * 0.5);
    }
    sum.draw(camera.ink);
    return sum.radiance();
  }
};

}  // namespace trace
