// Whitted's recursive ray tracing (CACM 23(6), 1980), as the courses define it:
//
//   I = ke + ka Ia + sum over lights  Shadow Attenuation Il (kd max(0, N.L) + ks max(0, S)^n)
//     + kr I(mirrored ray) + kt I(refracted ray)
//
// The camera ray has depth 0; a ray of depth k makes new ones while k < the depth set. Nothing takes the
// place of the refracted ray under total internal reflection. kr and kt are constants, unless a Fresnel term
// is asked for.
#pragma once

#include "render/integrator.h"

namespace trace {

class Whitted : public Integrator {
 public:
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;
};

}  // namespace trace
