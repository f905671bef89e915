// The table of integrators.
#pragma once

#include <memory>

#include "render/samples/integrator.h"

namespace trace {

/// The integrator of the settings, prepared. Throws Error(Fault::usage) if it does not support what the
/// world has.
std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job);

}  // namespace trace
