#include "render/integrator.h"

#include <array>

namespace trace {
namespace {

constexpr std::array kTable{
    IntegratorRow{Integrator::whitted, "whitted", "recursive ray tracing: shadows, mirrors and glass",
                  whitted},
};

}  // namespace

std::span<const IntegratorRow> integrators() { return kTable; }

const IntegratorRow& integratorRow(Integrator integrator) {
  return kTable[static_cast<std::size_t>(integrator)];
}

}  // namespace trace
