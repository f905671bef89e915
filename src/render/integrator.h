// THE table of integrators: the ways to find the light that comes along a camera ray. A new one is one
// file, one value of the enum Integrator (scene/settings.h) and one row.
#pragma once

#include <span>
#include <string_view>

#include "render/tracer.h"

namespace trace {

struct IntegratorRow {
  Integrator integrator;
  std::string_view name;
  std::string_view help;
  /// The radiance that arrives along the camera ray.
  Color (*radiance)(Tracer& tracer, const Ray& ray);
};

std::span<const IntegratorRow> integrators();
const IntegratorRow& integratorRow(Integrator integrator);

/// Whitted's recursive ray tracing (whitted.cpp).
Color whitted(Tracer& tracer, const Ray& ray);

}  // namespace trace
