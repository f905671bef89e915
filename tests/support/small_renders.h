// Scenes of ours, small enough for tests to render them all.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "scene/options.h"
#include "scene/settings.h"

namespace trace::test {

/// For a small picture of a scene with these settings: photons and chains for each of seven threads.
inline std::vector<Choice> smallChoices(const Settings& s, int width, int mostSamples) {
  std::vector<Choice> choices{{"width", std::to_string(width), {}},
                              {"spp", std::to_string(std::min(s.spp, mostSamples)), {}}};
  if (s.integrator == IntegratorKind::photon) choices.push_back({"photons", "20000", {}});
  if (s.integrator == IntegratorKind::mlt) choices.push_back({"chain-starts", "10000", {}});
  if (s.caustics > 0) choices.push_back({"caustics", "20000", {}});
  return choices;
}

}  // namespace trace::test
