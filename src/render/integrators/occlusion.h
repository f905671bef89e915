// Ambient occlusion: how much of the half space above a surface is open, seen as if everything were of white
// clay under an even sky (Zhukov, Iones and Kronin, An Ambient Light Illumination Model, 1998).
//
// Use it to see where things touch. Not for light or colours: all is of clay, and without fog.
#pragma once

#include "render/samples/integrator.h"

namespace trace {

class Occlusion : public Integrator {
 public:
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;
};

}  // namespace trace
